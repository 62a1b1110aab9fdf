// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// One stage of a fit over blocks: its shape, or its attributes.
#ifndef trivariate_FitStage_h
#define trivariate_FitStage_h

#include "Fit.h"
#include "FitSteps.h"
#include "ScatteredSystem.h"
#include "ShapeTarget.h"

#include <algorithm>
#include <vector>

namespace trivariate
{
/// Some components are fitted to some samples, and the spline is refined for them.
struct FitStage
{
  ScatteredSystem& System;
  int FirstComponent;
  std::vector<double> Scales; ///< of each component: the unit of its error
  double RmsTolerance, MaximumTolerance;
  Index MaximumPoints;
  ShapeTarget* Target; ///< null: a stage of attributes

  bool Slides() const { return this->Target && this->Target->Slides(); }

  /// Of the worst component; of a shape that slides the distance from its surface.
  FitRound Measure(double seconds) const
  {
    FitRound round{ this->System.Points().Count(), 0.0, 0.0, seconds };
    if (this->Slides())
    {
      round.Rms = this->Target->Distance().Rms;
      round.MaximumError = this->Target->Distance().Maximum;
      return round;
    }
    for (std::size_t c = 0; c < this->Scales.size(); ++c)
    {
      const ScatteredError error = this->System.Error(static_cast<int>(c));
      round.Rms = std::max(round.Rms, error.Rms / this->Scales[c]);
      round.MaximumError = std::max(round.MaximumError, error.Maximum / this->Scales[c]);
    }
    return round;
  }

  bool IsGoodEnough(const FitRound& round) const
  {
    const bool wantsRms = this->RmsTolerance > 0.0, wantsMaximum = this->MaximumTolerance > 0.0;
    return round.Rms <= RmsFloor ||
           ((wantsRms || wantsMaximum) && (!wantsRms || round.Rms <= this->RmsTolerance) &&
             (!wantsMaximum || round.MaximumError <= this->MaximumTolerance));
  }
};
}

#endif
