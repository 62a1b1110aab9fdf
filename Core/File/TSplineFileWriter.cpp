// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSplineFileWriter.h"

#include "Hdf5.h"
#include "SuperBlock.h"
#include "TSplineFileFormat.h"

#include <algorithm>
#include <cstring>

namespace trivariate
{
namespace
{
using hdf5::Handle;
using hdf5::Require;

const char* const OutOfMemory = "The T-spline file cannot be made";

Handle Checked(hid_t id, Handle::Closer close)
{
  Require(id >= 0, OutOfMemory);
  return { id, close };
}

void Checked(herr_t status)
{
  Require(status >= 0, OutOfMemory);
}

//------------------------------------------------------------------------------
// Memory of `size` bytes in the vector at `data`; null when there is none.
void* Resize(void* data, std::size_t size)
{
  auto& bytes = *static_cast<std::vector<char>*>(data);
  try
  {
    bytes.resize(size);
  }
  catch (const std::exception&)
  {
    return nullptr; // HDF5 is C: it wants no exceptions
  }
  return bytes.data();
}

//------------------------------------------------------------------------------
// Where HDF5 keeps a file in memory: the functions that it calls instead of malloc and free. Unlike
// a copy asked for with H5Fget_file_image (whose superblock has a wrong checksum in HDF5 1.10), the
// bytes are those of a file that was closed.
H5FD_file_image_callbacks_t KeepIn(std::vector<char>& bytes)
{
  H5FD_file_image_callbacks_t calls = {};
  calls.image_malloc = [](std::size_t size, H5FD_file_image_op_t, void* data) -> void*
  { return Resize(data, size); };
  calls.image_memcpy = [](void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*)
  { return std::memcpy(to, from, size); };
  calls.image_realloc = [](void*, std::size_t size, H5FD_file_image_op_t, void* data) -> void*
  { return Resize(data, size); };
  calls.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
  calls.udata_copy = [](void* data) { return data; };
  calls.udata_free = [](void*) -> herr_t { return 0; };
  calls.udata = &bytes;
  return calls;
}

//------------------------------------------------------------------------------
// An HDF5 file in memory. Format 1.10 has checksums on all of its own structures; without
// timestamps the same data are the same bytes.
Handle CreateImage(std::vector<char>& bytes)
{
  const Handle access = Checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5FD_file_image_callbacks_t calls = KeepIn(bytes);
  Checked(H5Pset_file_image_callbacks(access, &calls));
  Checked(H5Pset_fapl_core(access, std::size_t(1) << 22, false));
  Checked(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110));
  const Handle creation = Checked(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  Checked(H5Pset_obj_track_times(creation, false));
  return Checked(H5Fcreate("image.tspline", H5F_ACC_TRUNC, creation, access), H5Fclose);
}

//------------------------------------------------------------------------------
void WriteAttribute(hid_t object, const char* name, hid_t type, hid_t space, const void* value)
{
  const Handle attribute =
    Checked(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle memoryType = Checked(
    H5Tget_class(type) == H5T_STRING ? H5Tcopy(type) : H5Tget_native_type(type, H5T_DIR_ASCEND),
    H5Tclose);
  Checked(H5Awrite(attribute, memoryType, value));
}

void WriteString(hid_t object, const char* name, const std::string& text)
{
  if (text.size() > file::MaximumNameLength)
  {
    throw std::invalid_argument("The name of an attribute is longer than " +
                                std::to_string(file::MaximumNameLength) + " bytes.");
  }
  const Handle type = Checked(H5Tcopy(H5T_C_S1), H5Tclose);
  Checked(H5Tset_size(type, text.size()));
  Checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
  Checked(H5Tset_cset(type, H5T_CSET_UTF8));
  const Handle space = Checked(H5Screate(H5S_SCALAR), H5Sclose);
  WriteAttribute(object, name, type, space, text.data());
}

void WriteIntegers(hid_t object, const char* name, const std::int32_t* values, hsize_t count)
{
  const Handle space = Checked(H5Screate_simple(1, &count, nullptr), H5Sclose);
  WriteAttribute(object, name, H5T_STD_I32LE, space, values);
}

//------------------------------------------------------------------------------
// Writes datasets one after the other into a file.
class DatasetWriter
{
public:
  DatasetWriter(hid_t file, int compression, std::uint64_t numbers, const Execution& execution)
    : File(file)
    , Compression(compression)
    , Numbers(static_cast<double>(numbers))
    , Run(execution)
  {
  }

  /**
   * Writes `rows` x `columns` numbers (columns = 0: one dimension), a chunk of rows at a time.
   * fill(row, numbers) sets the numbers of one row. Returns the dataset.
   */
  template <typename T, typename Fill>
  Handle Write(const std::string& path, hid_t fileType, hid_t memoryType, hsize_t rows,
    hsize_t columns, const Fill& fill)
  {
    const int rank = columns > 0 ? 2 : 1;
    const hsize_t width = std::max<hsize_t>(columns, 1);
    const hsize_t target = file::MaximumChunkBytes / 2 / H5Tget_size(fileType);
    const hsize_t chunk[2] = { std::min(rows, std::max<hsize_t>(target / width, 1)),
      std::min(width, target) };
    const hsize_t size[2] = { rows, width };
    const Handle space = Checked(H5Screate_simple(rank, size, nullptr), H5Sclose);
    const Handle creation = this->Creation(rank, chunk);
    Handle dataset = Checked(
      H5Dcreate2(this->File, path.c_str(), fileType, space, H5P_DEFAULT, creation, H5P_DEFAULT),
      H5Dclose);
    std::vector<T> slab(chunk[0] * width);
    for (hsize_t begin = 0; begin < rows; begin += chunk[0])
    {
      this->Run.Check(this->Written / this->Numbers);
      const hsize_t start[2] = { begin, 0 };
      const hsize_t count[2] = { std::min(chunk[0], rows - begin), width };
      for (hsize_t i = 0; i < count[0]; ++i)
      {
        fill(static_cast<Index>(begin + i), &slab[i * width]);
      }
      const Handle slabSpace = Checked(H5Screate_simple(rank, count, nullptr), H5Sclose);
      Checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr));
      Checked(H5Dwrite(dataset, memoryType, slabSpace, space, H5P_DEFAULT, slab.data()));
      this->Written += static_cast<double>(count[0] * width);
    }
    return dataset;
  }

private:
  Handle Creation(int rank, const hsize_t* chunk) const
  {
    Handle creation = Checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    Checked(H5Pset_obj_track_times(creation, false));
    Checked(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER));
    Checked(H5Pset_chunk(creation, rank, chunk));
    if (this->Compression > 0)
    {
      Checked(H5Pset_shuffle(creation));
      Checked(H5Pset_deflate(creation, static_cast<unsigned>(this->Compression)));
    }
    Checked(H5Pset_fletcher32(creation));
    return creation;
  }

  hid_t File;
  int Compression;
  double Numbers, Written = 0.0;
  const Execution& Run;
};

//------------------------------------------------------------------------------
// The smallest unsigned integer that holds the indices of a knot line.
hid_t IndexType(std::size_t knots)
{
  return knots <= (1u << 8) ? H5T_STD_U8LE : knots <= (1u << 16) ? H5T_STD_U16LE : H5T_STD_U32LE;
}

//------------------------------------------------------------------------------
void WriteDatasets(DatasetWriter& writer, const TSplineModel& model)
{
  const TSpline& spline = model.Spline;
  const auto n = static_cast<hsize_t>(spline.Size());
  for (int a = 0; a < 3; ++a)
  {
    const KnotLine& line = spline.KnotLines[a];
    writer.Write<double>(file::KnotLines[a], H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, line.size(), 0,
      [&](Index i, double* value) { *value = line[i]; });
    writer.Write<std::int32_t>(file::Knots[a], IndexType(line.size()), H5T_NATIVE_INT32, n, 5,
      [&](Index i, std::int32_t* row)
      { std::copy(spline.Functions[i][a].begin(), spline.Functions[i][a].end(), row); });
  }
  if (!spline.Holes.empty())
  {
    writer.Write<std::int32_t>(file::Holes, H5T_STD_U32LE, H5T_NATIVE_INT32, spline.Holes.size(), 6,
      [&](Index i, std::int32_t* row)
      {
        for (int a = 0; a < 3; ++a)
        {
          *row++ = spline.Holes[i].Low[a];
          *row++ = spline.Holes[i].High[a];
        }
      });
  }
  writer.Write<double>(file::Points, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, n, 3,
    [&](Index i, double* row) { std::copy_n(spline.ControlPoint(i), 3, row); });
  writer.Write<double>(file::Weight, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, n, 0,
    [&](Index i, double* value) { *value = spline.Weights[i]; });
  writer.Write<std::int32_t>(file::Segment, H5T_STD_I32LE, H5T_NATIVE_INT32, n, 0,
    [&](Index i, std::int32_t* value) { *value = model.Segment[i]; });
  writer.Write<std::int32_t>(file::Block, H5T_STD_I32LE, H5T_NATIVE_INT32, n, 0,
    [&](Index i, std::int32_t* value) { *value = model.Block[i]; });
  int first = 3;
  for (std::size_t k = 0; k < model.Attributes.size(); ++k)
  {
    const int components = model.Attributes[k].Components;
    const Handle dataset = writer.Write<double>(
      std::string(file::Attributes) + "/" + std::to_string(k), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, n,
      components,
      [&](Index i, double* row) { std::copy_n(spline.ControlPoint(i) + first, components, row); });
    WriteString(dataset, file::AttributeName, model.Attributes[k].Name);
    first += components;
  }
}
}

//------------------------------------------------------------------------------
std::vector<char> TSplineFileImage(
  const TSplineModel& model, int compression, const Execution& execution)
{
  const std::string fault = Validate(model);
  if (!fault.empty())
  {
    throw std::invalid_argument(fault);
  }
  if (model.Spline.Size() == 0)
  {
    throw std::invalid_argument("The T-spline has no control points.");
  }
  const hdf5::Quiet quiet;
  std::vector<char> bytes;
  Handle image = CreateImage(bytes);
  WriteString(image, file::Format, file::FormatName);
  WriteIntegers(image, file::Version, file::CurrentVersion.data(), file::CurrentVersion.size());
  if (model.RootCells[0] > 0)
  {
    WriteIntegers(image, file::RootCells, model.RootCells.data(), model.RootCells.size());
  }
  const Handle creation = Checked(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  Checked(H5Pset_obj_track_times(creation, false));
  Checked(H5Gcreate2(image, file::Attributes, H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
  const auto numbers =
    static_cast<std::uint64_t>(model.Spline.Size()) * (15 + 3 + model.Spline.Components);
  DatasetWriter writer(image, compression, numbers, execution);
  WriteDatasets(writer, model);

  Require(image.Reset() >= 0 && bytes.size() >= SuperBlock::Size, OutOfMemory);
  bytes.resize(SuperBlock(bytes.data()).EndOfFile()); // HDF5 asks for memory in large steps
  return bytes;
}
}
