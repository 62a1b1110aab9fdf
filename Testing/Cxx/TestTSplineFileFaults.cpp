// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// What cannot be written or read is one error and leaves all as it was.
#include "TSplineFileFixture.h"

#include "vtkCallbackCommand.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>

using namespace trivariate;

using TSplineFileFaults = TSplineFile;

TEST_F(TSplineFileFaults, NeedsAPlaceThatCanBeWritten)
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

TEST_F(TSplineFileFaults, KeepsLinksAndPermissions)
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

TEST_F(TSplineFileFaults, LeavesTheOldOneWholeWhenTheDiskIsFull)
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

TEST_F(TSplineFileFaults, LeavesTheOldOneWholeWhenStopped)
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

TEST_F(TSplineFileFaults, IsWholeWheneverTheWriterIsKilled)
{
  RandomModelOptions options;
  options.Functions = 3000;
  const TSplineModel models[] = { RandomModel(1, options), RandomModel(2, options) };
  ASSERT_EQ(this->Write(models[0]), "");
  for (int kill = 0; kill < 15; ++kill)
  {
    const pid_t child = fork();
    if (child == 0)
    {
      for (unsigned i = 1;; ++i)
      {
        this->Write(models[i % 2]);
      }
    }
    usleep(3000 + 1700 * kill);
    ::kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    ASSERT_EQ(this->ReadError(), "") << kill;
    EXPECT_TRUE(Same(this->Read, models[0]) || Same(this->Read, models[1])) << kill;
  }
}

TEST_F(TSplineFileFaults, IsNotReadFromWhatIsNone)
{
  EXPECT_NE(this->ReadError(nullptr).find("No file to read"), std::string::npos);
  EXPECT_NE(this->ReadError().find("No such file"), std::string::npos);
  EXPECT_NE(this->ReadError(".").find("not a regular file"), std::string::npos);
  EXPECT_NE(this->ReadError("/dev/zero").find("not a regular file"), std::string::npos);
  ASSERT_EQ(mkfifo("pipe", 0600), 0); // opening it would wait for ever
  EXPECT_NE(this->ReadError("pipe").find("not a regular file"), std::string::npos);
  EXPECT_NE(this->Write(RandomModel(1), "pipe").find("not a regular file"), std::string::npos);
  SetBytes("empty", "");
  EXPECT_NE(this->ReadError("empty").find("only 0 bytes"), std::string::npos);
  SetBytes("text", std::string(1000, 'x'));
  EXPECT_NE(this->ReadError("text").find("no HDF5 file"), std::string::npos);
  for (const char* name : { "none", ".", "pipe", "empty", "text" })
  {
    EXPECT_EQ(vtkTSplineReader::CanReadFile(name), 0) << name;
  }
}

TEST_F(TSplineFileFaults, IsNotReadWhenCutShort)
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

TEST_F(TSplineFileFaults, IsNotReadWhenDamagedAnywhere)
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
