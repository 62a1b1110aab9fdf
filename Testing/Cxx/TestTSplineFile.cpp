// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// What is written comes back bit for bit; what cannot be written or read leaves all as it was.
#include "ErrorLog.h"
#include "RandomTSplineModel.h"
#include "TSplineGrid.h"

#include "vtkCallbackCommand.h"
#include "vtkErrorCode.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTSplineReader.h"
#include "vtkTSplineWriter.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace trivariate;
namespace fs = std::filesystem;

namespace
{
const char* const FileName = "spline.tspline";

std::string Bytes(const fs::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

void SetBytes(const fs::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

bool SameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

bool Same(const TSplineModel& a, const TSplineModel& b)
{
  bool same = a.Attributes.size() == b.Attributes.size() &&
              a.Spline.Functions == b.Spline.Functions &&
              SameBits(a.Spline.Weights, b.Spline.Weights) &&
              SameBits(a.Spline.ControlPoints, b.Spline.ControlPoints) && a.Segment == b.Segment &&
              a.Block == b.Block && a.RootCells == b.RootCells;
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

TEST_F(TSplineFile, GivesBackEveryBit)
{
  for (unsigned seed = 0; seed < 40; ++seed)
  {
    RandomModelOptions options;
    options.Functions = 9 + 31 * seed;
    options.Knots = 2 + seed % 8;
    const TSplineModel model = RandomModel(seed, options);
    ASSERT_EQ(this->Write(model, FileName, static_cast<int>(seed % 10)), "");
    ASSERT_EQ(this->ReadError(), "");
    EXPECT_TRUE(Same(this->Read, model)) << seed;
  }
  EXPECT_EQ(this->CountFiles(), 1u);
}

TEST_F(TSplineFile, GivesBackLongKnotLinesAndManyChunks)
{
  for (const std::size_t knots : { 256u, 257u, 65536u, 65537u })
  {
    RandomModelOptions options;
    options.Functions = 70000;
    options.Knots = knots;
    const TSplineModel model = RandomModel(1, options);
    ASSERT_EQ(this->Write(model, FileName, 1), "");
    ASSERT_EQ(this->ReadError(), "");
    EXPECT_TRUE(Same(this->Read, model)) << knots;
  }
}

TEST_F(TSplineFile, GivesBackAttributesOfAnyNameAndWidth)
{
  RandomModelOptions options;
  options.Functions = 10;
  options.Attributes = { { "a/b", 1 }, { ".", 2 }, { "\xce\xb1 \xe5\xaf\x86\xe5\xba\xa6", 3 },
    { "Points", 9 }, { std::string(300, 'x'), 1 }, { "wide", 70000 } };
  for (int a = 0; a < 40; ++a)
  {
    options.Attributes.push_back({ "number " + std::to_string(a), 1 });
  }
  const TSplineModel model = RandomModel(5, options);
  ASSERT_EQ(this->Write(model), "");
  ASSERT_EQ(this->ReadError(), "");
  EXPECT_TRUE(Same(this->Read, model));
  options.Attributes.clear();
  const TSplineModel bare = RandomModel(5, options);
  ASSERT_EQ(this->Write(bare), "");
  ASSERT_EQ(this->ReadError(), "");
  EXPECT_TRUE(Same(this->Read, bare));
}

TEST_F(TSplineFile, IsTheSameForTheSameSplineAndCompact)
{
  RandomModelOptions options;
  options.Functions = 20000;
  const TSplineModel model = RandomModel(7, options);
  ASSERT_EQ(this->Write(model, "a.tspline"), "");
  ASSERT_EQ(this->Write(model, "b.tspline"), "");
  EXPECT_EQ(Bytes("a.tspline"), Bytes("b.tspline"));

  const KnotLine line = MakeUniformKnotLine(0.0, 255.0, 28);
  TSplineModel regular;
  regular.Spline = MakeTensorProduct({ line, line, line }, { 1, 1, 1 }, 1);
  regular.Attributes = { { "density", 1 } };
  regular.Segment.assign(regular.Spline.Size(), 0);
  regular.Block.assign(regular.Spline.Size(), 0);
  ASSERT_EQ(this->Write(regular), "");
  EXPECT_LT(fs::file_size(FileName), 6u * regular.Spline.Size());
}

TEST_F(TSplineFile, IsEmptyOnAllPiecesButTheFirst)
{
  ASSERT_EQ(this->Write(RandomModel(1)), "");
  vtkNew<vtkTSplineReader> reader;
  reader->SetFileName(FileName);
  reader->UpdatePiece(1, 2, 0);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  reader->UpdatePiece(0, 2, 0);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 64);
  EXPECT_EQ(vtkTSplineReader::CanReadFile(FileName), 1);
}

TEST_F(TSplineFile, NeedsAnInputThatIsATSpline)
{
  vtkNew<vtkTSplineWriter> writer;
  ErrorLog errors(writer);
  writer->SetFileName(FileName);
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_NE(errors.TakeOnly().find("No input"), std::string::npos);

  ASSERT_EQ(this->Write(RandomModel(1)), "");
  const std::string old = Bytes(FileName);
  vtkNew<vtkUnstructuredGrid> grid;
  EXPECT_NE(this->Write(grid).find("empty"), std::string::npos);
  TSplineToGrid(RandomModel(1), grid);
  EXPECT_NE(this->Write(grid, nullptr).find("No file to write"), std::string::npos);
  EXPECT_EQ(this->ErrorCode, vtkErrorCode::NoFileNameError);
  grid->GetPointData()->GetArray("density")->SetComponent(5, 0, std::nan(""));
  EXPECT_NE(this->Write(grid).find("Control point 5"), std::string::npos);
  grid->GetPointData()->RemoveArray("KnotsU");
  EXPECT_NE(this->Write(grid).find("KnotsU"), std::string::npos);
  RandomModelOptions options;
  options.Attributes = { { std::string(5000, 'x'), 1 } };
  EXPECT_NE(this->Write(RandomModel(1, options)).find("4096 bytes"), std::string::npos);
  EXPECT_EQ(Bytes(FileName), old);
  EXPECT_EQ(this->CountFiles(), 1u);
}

TEST_F(TSplineFile, NeedsAPlaceThatCanBeWritten)
{
  const TSplineModel model = RandomModel(1);
  EXPECT_NE(this->Write(model, "nowhere/a.tspline").find("No such file"), std::string::npos);
  EXPECT_EQ(this->ErrorCode, vtkErrorCode::CannotOpenFileError);
  SetBytes("file", "no folder");
  EXPECT_NE(this->Write(model, "file/a.tspline").find("Not a directory"), std::string::npos);
  fs::create_directory("folder");
  EXPECT_NE(this->Write(model, "folder").find("not a regular file"), std::string::npos);
  EXPECT_TRUE(fs::is_empty("folder"));
  if (geteuid() != 0) // to root no folder is closed
  {
    SetBytes("kept.tspline", "old");
    fs::permissions("kept.tspline", fs::perms::owner_read);
    EXPECT_NE(this->Write(model, "kept.tspline").find("Permission denied"), std::string::npos);
    fs::permissions("folder", fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_NE(this->Write(model, "folder/a.tspline").find("Permission denied"), std::string::npos);
    fs::permissions("folder", fs::perms::owner_all);
    EXPECT_EQ(Bytes("kept.tspline"), "old");
  }
  EXPECT_EQ(Bytes("file"), "no folder");
}

TEST_F(TSplineFile, KeepsLinksAndPermissions)
{
  fs::create_directory("data");
  SetBytes("data/real.tspline", "old");
  fs::permissions("data/real.tspline", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("data/real.tspline", FileName);
  ASSERT_EQ(this->Write(RandomModel(1)), "");
  EXPECT_TRUE(fs::is_symlink(FileName));
  EXPECT_EQ(
    fs::status("data/real.tspline").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_EQ(this->ReadError("data/real.tspline"), "");
}

TEST_F(TSplineFile, LeavesTheOldOneWholeWhenTheDiskIsFull)
{
  ASSERT_EQ(this->Write(RandomModel(1)), "");
  const std::string old = Bytes(FileName);
  RandomModelOptions options;
  options.Functions = 5000;

  std::signal(
    SIGXFSZ, SIG_IGN); // so that a file that grows too large is an error, as on a full disk
  rlimit unlimited;
  getrlimit(RLIMIT_FSIZE, &unlimited);
  const rlimit limited = { 65536, unlimited.rlim_max };
  setrlimit(RLIMIT_FSIZE, &limited);
  const std::string error = this->Write(RandomModel(2, options));
  const std::string errorOfNew = this->Write(RandomModel(2, options), "new.tspline");
  setrlimit(RLIMIT_FSIZE, &unlimited);

  EXPECT_NE(error.find("File too large"), std::string::npos) << error;
  EXPECT_NE(errorOfNew.find("File too large"), std::string::npos) << errorOfNew;
  EXPECT_EQ(this->ErrorCode, vtkErrorCode::OutOfDiskSpaceError);
  EXPECT_EQ(Bytes(FileName), old);
  EXPECT_EQ(this->CountFiles(), 1u);
}

TEST_F(TSplineFile, LeavesTheOldOneWholeWhenStopped)
{
  ASSERT_EQ(this->Write(RandomModel(1)), "");
  const std::string old = Bytes(FileName);
  vtkNew<vtkCallbackCommand> stop;
  for (double at = 0.0; at <= 1.0; at += 0.09)
  {
    stop->SetClientData(&at);
    stop->SetCallback(
      [](vtkObject* caller, unsigned long, void* at, void*)
      {
        auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
        if (algorithm->GetProgress() >= *static_cast<double*>(at))
        {
          algorithm->AbortExecuteOn();
        }
      });
    vtkNew<vtkUnstructuredGrid> grid;
    TSplineToGrid(RandomModel(2), grid);
    vtkNew<vtkTSplineWriter> writer;
    writer->AddObserver(vtkCommand::ProgressEvent, stop);
    writer->SetInputDataObject(grid);
    writer->SetFileName(FileName);
    EXPECT_EQ(writer->Write(), 0) << at;
    EXPECT_EQ(Bytes(FileName), old);
    EXPECT_EQ(this->CountFiles(), 1u);
  }
  double atOnce = 0.0;
  stop->SetClientData(&atOnce);
  vtkNew<vtkTSplineReader> reader;
  reader->AddObserver(vtkCommand::ProgressEvent, stop);
  reader->SetFileName(FileName);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
}

TEST_F(TSplineFile, IsNotReadFromWhatIsNone)
{
  EXPECT_NE(this->ReadError(nullptr).find("No file to read"), std::string::npos);
  EXPECT_NE(this->ReadError().find("No such file"), std::string::npos);
  EXPECT_NE(this->ReadError(".").find("not a regular file"), std::string::npos);
  EXPECT_NE(this->ReadError("/dev/zero").find("not a regular file"), std::string::npos);
  SetBytes("empty", "");
  EXPECT_NE(this->ReadError("empty").find("only 0 bytes"), std::string::npos);
  SetBytes("text", std::string(1000, 'x'));
  EXPECT_NE(this->ReadError("text").find("no HDF5 file"), std::string::npos);
  for (const char* name : { "none", ".", "empty", "text" })
  {
    EXPECT_EQ(vtkTSplineReader::CanReadFile(name), 0) << name;
  }
}

TEST_F(TSplineFile, IsNotReadWhenCutShort)
{
  RandomModelOptions options;
  options.Functions = 3000;
  ASSERT_EQ(this->Write(RandomModel(3, options)), "");
  const std::string whole = Bytes(FileName);
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 20)
  {
    SetBytes("cut.tspline", whole.substr(0, size));
    EXPECT_NE(this->ReadError("cut.tspline").find("Cannot read"), std::string::npos) << size;
  }
  SetBytes("cut.tspline", whole.substr(0, whole.size() - 1));
  EXPECT_NE(this->ReadError("cut.tspline").find("cut short"), std::string::npos);
}

TEST_F(TSplineFile, IsNotReadWhenDamagedAnywhere)
{
  RandomModelOptions options;
  options.Functions = 9;
  const TSplineModel model = RandomModel(4, options);
  ASSERT_EQ(this->Write(model), "");
  const std::string whole = Bytes(FileName);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < whole.size(); i += 7)
  {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ (i % 2 == 0 ? 0xFF : 1 << i % 8));
    SetBytes("damaged.tspline", damaged);
    if (!this->ReadError("damaged.tspline").empty())
    {
      ++refused;
    }
    else
    {
      ASSERT_TRUE(Same(this->Read, model)) << "other numbers from a wrong byte at " << i;
    }
  }
  // What is left are bytes that nothing uses.
  EXPECT_GT(refused, whole.size() / 21);
}
