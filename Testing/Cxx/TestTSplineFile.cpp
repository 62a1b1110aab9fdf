// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// What is written comes back bit for bit, compact, and in any distribution.
#include "TSplineFileFixture.h"

#include "vtkCallbackCommand.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

using namespace trivariate;

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

TEST_F(TSplineFile, GivesBackHoles)
{
  TSplineModel model = RandomModel(3);
  const auto last = [&model](int a)
  { return static_cast<std::int32_t>(model.Spline.KnotLines[a].size()) - 1; };
  model.Spline.Holes = { { { 0, 0, 0 }, { last(0), 1, last(2) } },
    { { 0, 1, 0 }, { 1, last(1), 1 } } };
  ASSERT_EQ(this->Write(model), "");
  ASSERT_EQ(this->ReadError(), "");
  EXPECT_TRUE(Same(this->Read, model));
  model.Spline.Holes[0].High[0] = model.Spline.Holes[0].Low[0];
  EXPECT_NE(this->Write(model).find("Hole 0"), std::string::npos);
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

TEST_F(TSplineFile, TellsItsProgress)
{
  RandomModelOptions options;
  options.Functions = 70000;
  vtkNew<vtkUnstructuredGrid> grid;
  TSplineToGrid(RandomModel(1, options), grid);
  std::vector<double> progress;
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&progress);
  note->SetCallback([](vtkObject*, unsigned long, void* list, void* amount)
    { static_cast<std::vector<double>*>(list)->push_back(*static_cast<double*>(amount)); });
  const auto check = [&progress]()
  {
    EXPECT_GT(progress.size(), 15u);
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_EQ(progress.front(), 0.0);
    EXPECT_EQ(progress.back(), 1.0);
    progress.clear();
  };
  vtkNew<vtkTSplineWriter> writer;
  writer->SetInputDataObject(grid);
  writer->SetFileName(FileName);
  writer->AddObserver(vtkCommand::ProgressEvent, note);
  writer->Write();
  check();
  vtkNew<vtkTSplineReader> reader;
  reader->SetFileName(FileName);
  reader->AddObserver(vtkCommand::ProgressEvent, note);
  reader->Update();
  check();
}
