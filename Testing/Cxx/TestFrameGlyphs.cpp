// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "vtkFrameGlyphs.h"

#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace
{
// Frames along x, y, z where x is not negative.
vtkNew<vtkImageData> ImageWithFrames(const int* extent, double dz)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(const_cast<int*>(extent));
  image->SetSpacing(1.0, 1.0, dz);
  const char* const names[3] = { "FrameU", "FrameV", "FrameW" };
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(names[axis]);
    array->SetNumberOfComponents(3);
    for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
    {
      const double length = image->GetPoint(id)[0] < 0.0 ? 0.0 : 1.0;
      array->InsertNextTuple3(
        axis == 0 ? length : 0.0, axis == 1 ? length : 0.0, axis == 2 ? length : 0.0);
    }
    image->GetPointData()->AddArray(array);
  }
  return image;
}
}

//------------------------------------------------------------------------------
TEST(FrameGlyphs, DrawsThreeLinesEvenlyInSpace)
{
  const int extent[6] = { -12, 11, 5, 28, 0, 11 };
  const vtkNew<vtkImageData> image = ImageWithFrames(extent, 2.0);
  vtkNew<vtkFrameGlyphs> glyphs;
  glyphs->SetInputData(image);
  glyphs->SetStride(4);
  glyphs->SetLength(0.5);
  glyphs->Update();
  vtkPolyData* lines = glyphs->GetOutput();
  ASSERT_EQ(lines->GetNumberOfCells(), 3 * 3 * 6 * 6); // half of x is empty
  for (vtkIdType id = 0; id < lines->GetNumberOfCells(); ++id)
  {
    const int axis = static_cast<int>(lines->GetCellData()->GetScalars()->GetComponent(id, 0));
    EXPECT_EQ(axis, id % 3);
    double a[3], b[3];
    lines->GetPoint(2 * id, a);
    lines->GetPoint(2 * id + 1, b);
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(b[i] - a[i], i == axis ? 2.0 : 0.0, 1e-6);
    }
    EXPECT_EQ(std::fmod(0.5 * (a[0] + b[0]) + 10.0, 4.0), 0.0);
    EXPECT_EQ(std::fmod(0.5 * (a[2] + b[2]) - 2.0, 4.0), 0.0);
  }
  // By default some thirty along the longest side, here all.
  glyphs->SetStride(0);
  glyphs->Update();
  EXPECT_EQ(lines->GetNumberOfCells(), 3 * 12 * 24 * 12);
}

//------------------------------------------------------------------------------
// A slice is drawn, wherever it lies; pieces draw what the whole does.
TEST(FrameGlyphs, DrawsSlicesAndPieces)
{
  const int slice[6] = { 0, 20, 0, 20, 7, 7 };
  const vtkNew<vtkImageData> image = ImageWithFrames(slice, 1.0);
  vtkNew<vtkFrameGlyphs> glyphs;
  glyphs->SetInputData(image);
  glyphs->SetStride(5);
  glyphs->Update();
  EXPECT_EQ(glyphs->GetOutput()->GetNumberOfCells(), 3 * 4 * 4);
  std::set<double> whole, parts;
  const auto collect = [&glyphs](std::set<double>& middles)
  {
    for (vtkIdType id = 0; id < glyphs->GetOutput()->GetNumberOfPoints(); id += 2)
    {
      double a[3], b[3];
      glyphs->GetOutput()->GetPoint(id, a);
      glyphs->GetOutput()->GetPoint(id + 1, b);
      middles.insert(0.5 * (a[0] + b[0]) + 100.0 * (a[1] + b[1]));
    }
  };
  collect(whole);
  for (const auto& [begin, end] : { std::pair(0, 8), std::pair(8, 20) })
  {
    const int extent[6] = { begin, end, 0, 20, 7, 7 };
    const vtkNew<vtkImageData> piece = ImageWithFrames(extent, 1.0);
    vtkNew<vtkTrivialProducer> producer;
    producer->SetOutput(piece);
    producer->SetWholeExtent(0, 20, 0, 20, 7, 7);
    glyphs->SetInputConnection(producer->GetOutputPort());
    glyphs->Update();
    collect(parts);
  }
  EXPECT_EQ(parts, whole);
}

//------------------------------------------------------------------------------
TEST(FrameGlyphs, NeedsFrames)
{
  const int extent[6] = { 0, 4, 0, 4, 0, 4 };
  const vtkNew<vtkImageData> image = ImageWithFrames(extent, 1.0);
  image->GetPointData()->RemoveArray("FrameV");
  vtkNew<vtkFrameGlyphs> glyphs;
  ErrorLog log(glyphs);
  glyphs->SetInputData(image);
  glyphs->Update();
  EXPECT_NE(log.TakeOnly().find("no point array \"FrameV\""), std::string::npos);
  EXPECT_EQ(glyphs->GetOutput()->GetNumberOfCells(), 0);
}
