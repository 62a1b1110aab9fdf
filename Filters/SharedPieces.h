// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Who holds what of an image or surface that several processes work on.
#ifndef SharedPieces_h
#define SharedPieces_h

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace trivariate
{
/// Whether every process was asked for its piece of one output, so that all of them are here to
/// bring their pieces together.
inline bool ArePiecesShared(
  vtkMultiProcessController* controller, vtkInformationVector* outputVector)
{
  return controller && controller->GetNumberOfProcesses() > 1 &&
         outputVector->GetInformationObject(0)->Get(
           vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()) ==
           controller->GetNumberOfProcesses();
}

/// Asks a source that has no extent for all of its data.
inline void RequestAll(vtkInformation* inInfo)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  inInfo->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

/// Asks a source for the piece that is wanted here where pieces are brought together, else for all.
inline void RequestPiece(
  vtkInformation* inInfo, vtkInformationVector* outputVector, bool piecesAreShared)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  RequestAll(inInfo);
  if (piecesAreShared)
  {
    vtkInformation* outInfo = outputVector->GetInformationObject(0);
    inInfo->Set(Pipeline::UPDATE_PIECE_NUMBER(), outInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()));
    inInfo->Set(
      Pipeline::UPDATE_NUMBER_OF_PIECES(), outInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()));
  }
}

/// Asks an image's source for all of it.
inline void RequestWholeImage(vtkInformation* inInfo)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  RequestAll(inInfo);
  inInfo->Set(Pipeline::UPDATE_EXTENT(), inInfo->Get(Pipeline::WHOLE_EXTENT()), 6);
}
}

#endif
