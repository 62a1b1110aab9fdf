// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What tests of T-spline files share: a folder of their own, writing, reading, comparing.
#ifndef TSplineFileFixture_h
#define TSplineFileFixture_h

#include "ErrorLog.h"
#include "RandomTSplineModel.h"
#include "TSplineGrid.h"

#include "vtkErrorCode.h"
#include "vtkNew.h"
#include "vtkTSplineReader.h"
#include "vtkTSplineWriter.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace trivariate
{
namespace fs = std::filesystem;

inline const char* const FileName = "spline.tspline";

inline std::string Bytes(const fs::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

inline void SetBytes(const fs::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

inline bool SameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

inline bool Same(const TSplineModel& a, const TSplineModel& b)
{
  bool same = a.Attributes.size() == b.Attributes.size() &&
              a.Spline.Functions == b.Spline.Functions &&
              SameBits(a.Spline.Weights, b.Spline.Weights) &&
              SameBits(a.Spline.ControlPoints, b.Spline.ControlPoints) && a.Segment == b.Segment &&
              a.Block == b.Block && a.RootCells == b.RootCells && a.Spline.Holes.size() == b.Spline.Holes.size();
  for (std::size_t h = 0; same && h < a.Spline.Holes.size(); ++h)
  {
    same = a.Spline.Holes[h].Low == b.Spline.Holes[h].Low &&
           a.Spline.Holes[h].High == b.Spline.Holes[h].High;
  }
  for (int d = 0; d < 3; ++d)
  {
    same = same && SameBits(a.Spline.KnotLines[d], b.Spline.KnotLines[d]);
  }
  for (std::size_t k = 0; same && k < a.Attributes.size(); ++k)
  {
    same = a.Attributes[k].Name == b.Attributes[k].Name &&
           a.Attributes[k].Components == b.Attributes[k].Components;
  }
  return same;
}

// Every test has a folder of its own, removed at its end.
class TSplineFile : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Home = fs::current_path();
    this->Folder = this->Home / ("tspline-" + std::to_string(getpid()));
    fs::create_directory(this->Folder);
    fs::current_path(this->Folder);
  }

  void TearDown() override
  {
    fs::current_path(this->Home);
    fs::remove_all(this->Folder);
  }

  std::size_t CountFiles() const
  {
    return std::distance(fs::directory_iterator(this->Folder), fs::directory_iterator());
  }

  // Writes; returns the error, empty for success.
  std::string Write(vtkUnstructuredGrid* grid, const char* name = FileName, int compression = 5)
  {
    vtkNew<vtkTSplineWriter> writer;
    ErrorLog errors(writer);
    writer->SetInputDataObject(grid);
    writer->SetFileName(name);
    writer->SetCompressionLevel(compression);
    const bool success = writer->Write() == 1;
    this->ErrorCode = writer->GetErrorCode();
    EXPECT_EQ(success, this->ErrorCode == vtkErrorCode::NoError);
    return success ? "" : errors.TakeOnly();
  }

  std::string Write(const TSplineModel& model, const char* name = FileName, int compression = 5)
  {
    vtkNew<vtkUnstructuredGrid> grid;
    TSplineToGrid(model, grid);
    return this->Write(grid, name, compression);
  }

  // Reads into Read; returns the error, empty for success. No output comes with an error.
  std::string ReadError(const char* name = FileName)
  {
    vtkNew<vtkTSplineReader> reader;
    ErrorLog errors(reader);
    reader->SetFileName(name);
    reader->Update();
    if (reader->GetErrorCode() != vtkErrorCode::NoError)
    {
      EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
      return errors.TakeOnly();
    }
    this->Read = TSplineFromGrid(reader->GetOutput());
    return {};
  }

  fs::path Home, Folder;
  unsigned long ErrorCode = 0;
  TSplineModel Read;
};
}

#endif
