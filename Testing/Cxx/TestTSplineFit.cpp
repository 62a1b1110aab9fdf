// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "vtkTSplineFit.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace
{
using Function = std::function<double(const double*)>;

//------------------------------------------------------------------------------
// An image that sits askew in space, its extent far from zero.
vtkNew<vtkImageData> SkewImage()
{
  vtkNew<vtkImageData> image;
  image->SetExtent(-7, 8, 100, 111, 3, 16);
  image->SetOrigin(10.0, -20.0, 5.0);
  image->SetSpacing(0.5, 1.25, 2.0);
  const double c = std::cos(0.4), s = std::sin(0.4);
  const double direction[9] = { c, -s, 0.0, s, c, 0.0, 0.0, 0.0, -1.0 };
  image->SetDirectionMatrix(direction);
  return image;
}

// Adds samples of f, a function of the point in space.
template <typename ArrayT = vtkDoubleArray>
ArrayT* AddSamples(vtkImageData* image, const char* name, const Function& f)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    array->SetComponent(id, 0, f(image->GetPoint(id)));
  }
  image->GetPointData()->AddArray(array);
  image->GetPointData()->SetActiveScalars(name);
  return array;
}

double Linear(const double* p)
{
  return 3.0 - 0.5 * p[0] + 0.25 * p[1] + 2.0 * p[2];
}

double Wave(const double* p)
{
  return std::sin(p[0]) * std::cos(0.3 * p[1]) + 0.1 * p[2];
}

// The coefficients of a linear function are its values at the control points, up to the solver's
// tolerance.
void ExpectLinear(vtkUnstructuredGrid* grid, const char* name)
{
  vtkDataArray* values = grid->GetPointData()->GetArray(name);
  ASSERT_NE(values, nullptr);
  for (vtkIdType id = 0; id < grid->GetNumberOfPoints(); ++id)
  {
    ASSERT_NEAR(values->GetComponent(id, 0), Linear(grid->GetPoint(id)), 1e-2) << id;
  }
}

std::vector<double> Bytes(vtkUnstructuredGrid* grid, const char* name)
{
  vtkDataArray* array = grid->GetPointData()->GetArray(name);
  std::vector<double> all;
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    all.push_back(array->GetVariantValue(i).ToDouble());
  }
  return all;
}

//------------------------------------------------------------------------------
// On a bad input there is exactly one error, and nothing comes out.
void ExpectFault(vtkTSplineFit* filter, ErrorLog& log, const std::string& words)
{
  filter->Update();
  const std::string message = log.TakeOnly();
  EXPECT_NE(message.find(words), std::string::npos) << message;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}
}

//------------------------------------------------------------------------------
TEST(TSplineFit, FollowsTheImageThroughSpace)
{
  for (const int rule :
    { vtkTSplineFit::COMPACT, vtkTSplineFit::ANALYSIS_SUITABLE, vtkTSplineFit::UNIFORM })
  {
    vtkNew<vtkImageData> image = SkewImage();
    AddSamples(image, "wave", Wave);
    AddSamples<vtkFloatArray>(image, "unused", Wave);
    AddSamples(image, "linear", Linear);
    vtkNew<vtkTSplineFit> fit;
    fit->SetInputData(image);
    fit->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "wave");
    fit->AddAttribute("linear");
    fit->AddAttribute("wave");
    fit->SetRefinementRule(rule);
    fit->SetMaximumNumberOfControlPoints(400);
    fit->Update();
    vtkUnstructuredGrid* grid = fit->GetOutput();
    EXPECT_GT(grid->GetNumberOfPoints(), 64);
    EXPECT_LE(grid->GetNumberOfPoints(), 400);
    EXPECT_EQ(grid->GetPointData()->GetArray("unused"), nullptr);
    ASSERT_NE(grid->GetPointData()->GetArray("wave"), nullptr);
    ExpectLinear(grid, "linear");
    double bounds[6], wanted[6];
    grid->GetBounds(bounds);
    image->GetBounds(wanted);
    for (int i = 0; i < 6; ++i)
    {
      EXPECT_NEAR(bounds[i], wanted[i], 1e-9);
    }
  }
}

TEST(TSplineFit, StopsAtTheWantedErrorAndTellsEachRound)
{
  vtkNew<vtkImageData> image = SkewImage();
  AddSamples(image, "wave", Wave);
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(image);
  fit->SetRMSTolerance(0.05);
  fit->Update();
  vtkTable* rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  const vtkIdType last = rounds->GetNumberOfRows() - 1;
  ASSERT_GE(last, 1);
  EXPECT_LE(rounds->GetValueByName(last, "RMS").ToDouble(), 0.05);
  EXPECT_GT(rounds->GetValueByName(last - 1, "RMS").ToDouble(), 0.05);
  EXPECT_EQ(rounds->GetValueByName(last, "ControlPoints").ToLongLong(),
    fit->GetOutput()->GetNumberOfPoints());
  const double rms = rounds->GetValueByName(last, "RMS").ToDouble();

  fit->SetMaximumErrorTolerance(0.0002);
  fit->Update();
  rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  const vtkIdType end = rounds->GetNumberOfRows() - 1;
  EXPECT_GT(end, last);
  EXPECT_LE(rounds->GetValueByName(end, "MaximumError").ToDouble(), 0.0002);
  EXPECT_LT(rounds->GetValueByName(end, "RMS").ToDouble(), rms);
}

TEST(TSplineFit, DoesNotDependOnThreadsOrPieces)
{
  vtkNew<vtkImageData> image = SkewImage();
  AddSamples(image, "wave", Wave);
  const auto run = [&image](int piece, int pieces)
  {
    vtkNew<vtkTSplineFit> fit;
    fit->SetInputData(image);
    fit->SetMaximumNumberOfControlPoints(500);
    fit->UpdatePiece(piece, pieces, 0);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->ShallowCopy(fit->GetOutput());
    return grid;
  };
  vtkSMPTools::Initialize(1);
  const vtkNew<vtkUnstructuredGrid> one = run(0, 1);
  vtkSMPTools::Initialize(0);
  const vtkNew<vtkUnstructuredGrid> all = run(0, 1);
  const vtkNew<vtkUnstructuredGrid> first = run(0, 3);
  ASSERT_GT(one->GetNumberOfPoints(), 300);
  for (const char* name : { "wave", "KnotsU", "KnotsV", "KnotsW", "Weight" })
  {
    EXPECT_EQ(Bytes(one, name), Bytes(all, name)) << name;
    EXPECT_EQ(Bytes(one, name), Bytes(first, name)) << name;
  }
  EXPECT_EQ(run(1, 3)->GetNumberOfPoints(), 0);
}

TEST(TSplineFit, FitsOnlyWhereTheMaskSays)
{
  vtkNew<vtkImageData> image = SkewImage();
  const auto inside = [](const double* p) { return p[2] > -20.0; };
  AddSamples<vtkUnsignedCharArray>(image, "mask", inside);
  AddSamples(image, "half", [&inside](const double* p) { return inside(p) ? Linear(p) : 1e3; });
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(image);
  fit->SetMaskArray("mask");
  fit->SetRMSTolerance(0.1);
  fit->SetMaximumNumberOfControlPoints(500);
  fit->Update();
  // The spline of a linear function is cheap, that of the jump at the mask's border is not.
  vtkTable* rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  EXPECT_LT(rounds->GetValueByName(rounds->GetNumberOfRows() - 1, "RMS").ToDouble(), 0.1);
  EXPECT_GT(fit->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(TSplineFit, StopsWhenAborted)
{
  vtkNew<vtkImageData> image = SkewImage();
  AddSamples(image, "wave", Wave);
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(image);
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* filter = vtkAlgorithm::SafeDownCast(caller);
      filter->SetAbortExecute(filter->GetProgress() > 0.05);
    });
  fit->AddObserver(vtkCommand::ProgressEvent, stop);
  fit->Update();
  EXPECT_EQ(fit->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_NE(fit->GetAbortExecute(), 0);
}

//------------------------------------------------------------------------------
TEST(TSplineFit, SaysWhatIsWrongWithTheInput)
{
  vtkNew<vtkTSplineFit> fit;
  ErrorLog log(fit);
  vtkNew<vtkImageData> image;
  fit->SetInputData(image);
  ExpectFault(fit, log, "no points");

  image->SetDimensions(6, 5, 4);
  image->Modified();
  ExpectFault(fit, log, "does not have the point array");

  vtkDoubleArray* wave = AddSamples(image, "wave", Wave);
  fit->AddAttribute("absent");
  ExpectFault(fit, log, "\"absent\"");
  fit->ClearAttributes();

  fit->SetMaskArray("absent");
  ExpectFault(fit, log, "\"absent\"");
  AddSamples(image, "none", [](const double*) { return 0.0; });
  image->GetPointData()->SetActiveScalars("wave");
  fit->SetMaskArray("none");
  ExpectFault(fit, log, "mask");
  fit->SetMaskArray(nullptr);

  for (const double bad :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    wave->SetValue(17, bad);
    wave->Modified();
    image->Modified();
    ExpectFault(fit, log, "finite");
  }
  wave->SetValue(17, 0.0);

  wave->SetNumberOfTuples(7);
  image->Modified();
  fit->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "wave");
  ExpectFault(fit, log, "7 values for 120 points");

  AddSamples(image, "Weight", Wave);
  fit->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Weight");
  ExpectFault(fit, log, "\"Weight\"");

  vtkNew<vtkImageData> flat;
  flat->SetDimensions(20, 1, 30);
  AddSamples(flat, "wave", Wave);
  fit->SetInputData(flat);
  fit->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "wave");
  ExpectFault(fit, log, "20 x 1 x 30");
}

//------------------------------------------------------------------------------
// The samples of a cube of 20000 voxels a side would fill terabytes. The array has none of them;
// who reads one before asking for the memory crashes.
TEST(TSplineFit, RefusesAnImageThatDoesNotFitIntoMemory)
{
  unsigned char sample = 0;
  vtkNew<vtkUnsignedCharArray> samples;
  samples->SetName("samples");
  samples->SetArray(&sample, vtkIdType(20000) * 20000 * 20000, 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(20000, 20000, 20000);
  image->GetPointData()->SetScalars(samples);
  vtkNew<vtkTSplineFit> fit;
  ErrorLog log(fit);
  fit->SetInputData(image);
  ExpectFault(fit, log, "The copy of the voxels would need 122070313 MiB of memory, but only ");
}
