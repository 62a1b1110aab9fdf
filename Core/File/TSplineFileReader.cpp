// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSplineFileReader.h"

#include "DatasetReader.h"
#include "Hdf5.h"
#include "Structure.h"
#include "TSplineFileFormat.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>

namespace trivariate
{
namespace
{
using hdf5::Handle;
using hdf5::Require;

const char* const Damaged = "It is damaged";

//------------------------------------------------------------------------------
// The size of a regular file. Anything else (a folder, a pipe, a device) is refused here, since
// opening it might never return.
std::uint64_t RegularFileSize(const std::string& path)
{
  struct stat status;
  if (stat(path.c_str(), &status) != 0)
  {
    throw std::runtime_error(std::string(std::strerror(errno)) + ".");
  }
  if (!S_ISREG(status.st_mode))
  {
    throw std::runtime_error("It is not a regular file.");
  }
  return static_cast<std::uint64_t>(status.st_size);
}

//------------------------------------------------------------------------------
Handle OpenFile(const std::string& path)
{
  const std::uint64_t size = RegularFileSize(path);
  std::ifstream stream(path, std::ios::binary);
  const std::string fault =
    StructureFault(size, [&stream](std::uint64_t offset, char* bytes, std::size_t count)
      { stream.seekg(static_cast<std::streamoff>(offset)).read(bytes, count); });
  if (!stream || !fault.empty())
  {
    throw std::runtime_error(stream ? fault : "It cannot be opened for reading.");
  }
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Many network file systems know no locks, and what rename replaces needs none.
  H5Pset_file_locking(access, false, true);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  Require(bool(file), Damaged);
  return file;
}

//------------------------------------------------------------------------------
Handle OpenImage(const void* bytes, std::size_t size)
{
  const std::string fault =
    StructureFault(size, [bytes](std::uint64_t offset, char* part, std::size_t count)
      { std::memcpy(part, static_cast<const char*>(bytes) + offset, count); });
  if (!fault.empty())
  {
    throw std::runtime_error(fault);
  }
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 1 << 16, false);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  Require(H5Pset_file_image(access, const_cast<void*>(bytes), size) >= 0, Damaged);
  Handle file(H5Fopen("image.tspline", H5F_ACC_RDONLY, access), H5Fclose);
  Require(bool(file), Damaged);
  return file;
}

//------------------------------------------------------------------------------
// What a file is, from its root attributes; empty when it is in this format and version.
std::string IdentityFault(hid_t file)
{
  if (ReadString(file, file::Format) != file::FormatName)
  {
    return "It is an HDF5 file, but not a T-spline file.";
  }
  std::array<std::int32_t, 2> version = { 0, 0 };
  if (!ReadIntegers(file, file::Version, version.data(), 2))
  {
    return "It has no valid format version.";
  }
  if (version[0] != file::CurrentVersion[0])
  {
    return "It has format version " + std::to_string(version[0]) + "." +
           std::to_string(version[1]) + "; this program reads version " +
           std::to_string(file::CurrentVersion[0]) + ".x.";
  }
  return {};
}

//------------------------------------------------------------------------------
// Called before memory for `count` control points of `components` numbers is asked for.
void RequireMemory(std::uint64_t count, std::uint64_t components, double maximumBytes)
{
  const std::uint64_t each = sizeof(BlendingFunction) + sizeof(double) * (1 + components) + 8;
  const double bytes = static_cast<double>(count) * static_cast<double>(each);
  if (bytes > maximumBytes)
  {
    throw std::runtime_error("Its " + std::to_string(count) + " control points need " +
                             std::to_string(static_cast<std::uint64_t>(bytes / 1048576)) +
                             " MiB of memory; no more than " +
                             std::to_string(static_cast<std::uint64_t>(maximumBytes / 1048576)) +
                             " MiB may be used.");
  }
}

//------------------------------------------------------------------------------
void ReadKnots(DatasetReader& reader, int a, const Execution& execution, TSpline& spline)
{
  const Dataset line = reader.Open(file::KnotLines[a], DatasetReader::Float64, { 0 });
  if (line.Rows > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max()))
  {
    throw std::runtime_error(std::string("The dataset ") + file::KnotLines[a] + " is too long.");
  }
  const Dataset knots =
    reader.Open(file::Knots[a], DatasetReader::UnsignedInteger, { spline.Functions.size(), 5 });
  spline.KnotLines[a].resize(line.Rows);
  line.ReadRows<double>(H5T_NATIVE_DOUBLE, execution,
    [&](std::uint64_t row, const double* value) { spline.KnotLines[a][row] = *value; });
  // An index too large for int32 becomes negative, which Validate refuses like every wrong one.
  knots.ReadRows<std::int32_t>(H5T_NATIVE_INT32, execution,
    [&](std::uint64_t row, const std::int32_t* values)
    { std::copy_n(values, 5, spline.Functions[row][a].begin()); });
}

//------------------------------------------------------------------------------
void ReadHoles(
  DatasetReader& reader, double maximumBytes, const Execution& execution, TSpline& spline)
{
  if (!reader.Has(file::Holes))
  {
    return;
  }
  const Dataset holes = reader.Open(file::Holes, DatasetReader::UnsignedInteger, { 0, 6 });
  if (static_cast<double>(holes.Rows) * sizeof(IndexBox) > maximumBytes)
  {
    throw std::runtime_error("It has too many holes for the memory that may be used.");
  }
  spline.Holes.resize(holes.Rows);
  holes.ReadRows<std::int32_t>(H5T_NATIVE_INT32, execution,
    [&](std::uint64_t row, const std::int32_t* values)
    {
      for (int a = 0; a < 3; ++a)
      {
        spline.Holes[row].Low[a] = values[2 * a];
        spline.Holes[row].High[a] = values[2 * a + 1];
      }
    });
}

//------------------------------------------------------------------------------
// X, Y, Z and the attributes; all is opened and checked before the first is read.
void ReadControlPoints(
  DatasetReader& reader, double maximumBytes, const Execution& execution, TSplineModel& model)
{
  TSpline& spline = model.Spline;
  const std::uint64_t n = spline.Functions.size();
  std::vector<Dataset> datasets;
  datasets.push_back(reader.Open(file::Points, DatasetReader::Float64, { n, 3 }));
  std::uint64_t components = 3;
  for (std::size_t i = 0;; ++i)
  {
    const std::string path = std::string(file::Attributes) + "/" + std::to_string(i);
    if (!reader.Has(path))
    {
      break;
    }
    datasets.push_back(reader.Open(path, DatasetReader::Float64, { n, 0 }));
    const Dataset& dataset = datasets.back();
    components += dataset.Columns;
    if (components > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
    {
      throw std::runtime_error("A control point has too many components.");
    }
    model.Attributes.push_back(
      { ReadString(dataset.Id, file::AttributeName), static_cast<int>(dataset.Columns) });
  }
  RequireMemory(n, components, maximumBytes);
  spline.Components = static_cast<int>(components);
  spline.ControlPoints.resize(n * components);
  double* first = spline.ControlPoints.data();
  for (const Dataset& dataset : datasets)
  {
    dataset.ReadRows<double>(H5T_NATIVE_DOUBLE, execution,
      [&](std::uint64_t row, const double* values)
      { std::copy_n(values, dataset.Columns, first + row * components); });
    first += dataset.Columns;
  }
}

//------------------------------------------------------------------------------
TSplineModel ReadModel(
  hid_t file, std::uint64_t size, double maximumBytes, const Execution& execution)
{
  const std::string identityFault = IdentityFault(file);
  if (!identityFault.empty())
  {
    throw std::runtime_error(identityFault);
  }

  TSplineModel model;
  TSpline& spline = model.Spline;
  DatasetReader reader(file, size);
  const Dataset weights = reader.Open(file::Weight, DatasetReader::Float64, { 0 });
  const Dataset segment = reader.Open(file::Segment, DatasetReader::Int32, { weights.Rows });
  const Dataset block = reader.Open(file::Block, DatasetReader::Int32, { weights.Rows });
  RequireMemory(weights.Rows, 3, maximumBytes);
  spline.Functions.resize(weights.Rows);
  spline.Weights.resize(weights.Rows);
  model.Segment.resize(weights.Rows);
  model.Block.resize(weights.Rows);
  weights.ReadRows<double>(H5T_NATIVE_DOUBLE, execution,
    [&](std::uint64_t row, const double* value) { spline.Weights[row] = *value; });
  segment.ReadRows<std::int32_t>(H5T_NATIVE_INT32, execution,
    [&](std::uint64_t row, const std::int32_t* value) { model.Segment[row] = *value; });
  block.ReadRows<std::int32_t>(H5T_NATIVE_INT32, execution,
    [&](std::uint64_t row, const std::int32_t* value) { model.Block[row] = *value; });
  for (int a = 0; a < 3; ++a)
  {
    ReadKnots(reader, a, execution, spline);
  }
  ReadHoles(reader, maximumBytes, execution, spline);
  ReadControlPoints(reader, maximumBytes, execution, model);
  ReadIntegers(file, file::RootCells, model.RootCells.data(), 3);

  const std::string fault = Validate(model);
  if (!fault.empty())
  {
    throw std::runtime_error(fault);
  }
  return model;
}
}

//------------------------------------------------------------------------------
bool IsTSplineFile(const std::string& path)
{
  try
  {
    const hdf5::Quiet quiet;
    const Handle file = OpenFile(path);
    return ReadString(file, file::Format) == file::FormatName;
  }
  catch (const std::runtime_error&)
  {
    return false;
  }
}

//------------------------------------------------------------------------------
TSplineModel ReadTSplineFile(
  const std::string& path, double maximumBytes, const Execution& execution)
{
  const hdf5::Quiet quiet;
  const std::uint64_t size = RegularFileSize(path);
  const Handle file = OpenFile(path);
  return ReadModel(file, size, maximumBytes, execution);
}

//------------------------------------------------------------------------------
TSplineModel ParseTSplineFile(
  const void* bytes, std::size_t size, double maximumBytes, const Execution& execution)
{
  const hdf5::Quiet quiet;
  const Handle file = OpenImage(bytes, size);
  return ReadModel(file, size, maximumBytes, execution);
}
}
