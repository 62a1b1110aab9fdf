// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DatasetReader.h"

#include "TSplineFileFormat.h"

#include <initializer_list>
#include <limits>

namespace trivariate
{
namespace
{
using hdf5::Handle;

bool IsOneOf(hid_t type, std::initializer_list<hid_t> types)
{
  return std::any_of(
    types.begin(), types.end(), [type](hid_t other) { return H5Tequal(type, other) > 0; });
}

//------------------------------------------------------------------------------
bool HasType(hid_t type, DatasetReader::Type wanted)
{
  switch (wanted)
  {
    case DatasetReader::Float64:
      return IsOneOf(type, { H5T_IEEE_F64LE });
    case DatasetReader::Int32:
      return IsOneOf(type, { H5T_STD_I32LE });
    default:
      return IsOneOf(type, { H5T_STD_U8LE, H5T_STD_U16LE, H5T_STD_U32LE });
  }
}

//------------------------------------------------------------------------------
// Others would be searched for as plugins, or are more code than is needed for reading numbers.
bool OnlyKnownFilters(hid_t creation)
{
  const int filters = H5Pget_nfilters(creation);
  for (int i = 0; i < filters; ++i)
  {
    unsigned int flags = 0;
    std::size_t parameters = 0;
    const H5Z_filter_t filter = H5Pget_filter2(
      creation, static_cast<unsigned>(i), &flags, &parameters, nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_DEFLATE &&
        filter != H5Z_FILTER_FLETCHER32)
    {
      return false;
    }
  }
  return filters >= 0;
}

//------------------------------------------------------------------------------
// The attribute `name` of an object, closed when there is none.
Handle OpenAttribute(hid_t object, const char* name)
{
  const htri_t exists = H5Aexists(object, name);
  Handle attribute(exists > 0 ? H5Aopen(object, name, H5P_DEFAULT) : -1, H5Aclose);
  hdf5::Require(exists == 0 || attribute, std::string("Its ") + name + " is damaged");
  return attribute;
}
}

//------------------------------------------------------------------------------
std::string ReadString(hid_t object, const char* name)
{
  const Handle attribute = OpenAttribute(object, name);
  const Handle type(attribute ? H5Aget_type(attribute) : -1, H5Tclose);
  const Handle space(attribute ? H5Aget_space(attribute) : -1, H5Sclose);
  if (!type || !space || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
      H5Tget_size(type) > file::MaximumNameLength)
  {
    return {};
  }
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, &text[0]) < 0)
  {
    return {};
  }
  return text.substr(0, text.find('\0'));
}

//------------------------------------------------------------------------------
bool ReadIntegers(hid_t object, const char* name, std::int32_t* values, std::size_t count)
{
  const Handle attribute = OpenAttribute(object, name);
  const Handle type(attribute ? H5Aget_type(attribute) : -1, H5Tclose);
  const Handle space(attribute ? H5Aget_space(attribute) : -1, H5Sclose);
  return type && space && IsOneOf(type, { H5T_STD_I32LE, H5T_STD_I64LE }) &&
         H5Sget_simple_extent_npoints(space) == static_cast<hssize_t>(count) &&
         H5Aread(attribute, H5T_NATIVE_INT32, values) >= 0;
}

//------------------------------------------------------------------------------
void Dataset::ReadSlab(
  hid_t memoryType, std::uint64_t begin, std::uint64_t rows, void* values) const
{
  const hsize_t start[2] = { begin, 0 };
  const hsize_t count[2] = { rows, this->Columns };
  const Handle fileSpace(H5Dget_space(this->Id), H5Sclose);
  const Handle memorySpace(
    H5Screate_simple(H5Sget_simple_extent_ndims(fileSpace), count, nullptr), H5Sclose);
  hdf5::Require(
    H5Sselect_hyperslab(fileSpace, H5S_SELECT_SET, start, nullptr, count, nullptr) >= 0 &&
      H5Dread(this->Id, memoryType, memorySpace, fileSpace, H5P_DEFAULT, values) >= 0,
    "The dataset " + this->Name + " cannot be read; the file is damaged");
}

//------------------------------------------------------------------------------
DatasetReader::DatasetReader(hid_t file, std::uint64_t fileSize)
  : File(file)
  , FileSize(
      std::min(fileSize, std::numeric_limits<std::uint64_t>::max() / file::MaximumCompression))
  , UnclaimedBytes(this->FileSize)
{
}

//------------------------------------------------------------------------------
bool DatasetReader::Has(const std::string& path) const
{
  for (std::size_t end = path.find('/');; end = path.find('/', end + 1))
  {
    const std::string part = path.substr(0, end);
    const htri_t exists = H5Lexists(this->File, part.c_str(), H5P_DEFAULT);
    hdf5::Require(exists >= 0, "What should be " + part + " is damaged");
    if (exists == 0)
    {
      return false;
    }
    H5L_info_t info;
    hdf5::Require(
      H5Lget_info(this->File, part.c_str(), &info, H5P_DEFAULT) >= 0 && info.type == H5L_TYPE_HARD,
      part + " is a link to somewhere else, which is not followed");
    if (end == std::string::npos)
    {
      return true;
    }
  }
}

//------------------------------------------------------------------------------
Dataset DatasetReader::Open(
  const std::string& path, Type type, const std::vector<std::uint64_t>& shape)
{
  const auto require = [&path](bool good, const char* fault)
  { hdf5::Require(good, "The dataset " + path + " " + fault + "."); };

  require(this->Has(path), "is missing");
  Dataset dataset;
  dataset.Name = path;
  dataset.Id = Handle(H5Dopen2(this->File, path.c_str(), H5P_DEFAULT), H5Dclose);
  require(bool(dataset.Id), "cannot be opened; the file is damaged");

  const Handle creation(H5Dget_create_plist(dataset.Id), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation);
  require(
    (layout == H5D_CHUNKED || layout == H5D_CONTIGUOUS) && H5Pget_external_count(creation) == 0,
    "is not stored in chunks or in one piece in this file");
  require(OnlyKnownFilters(creation), "uses a filter other than shuffle, deflate and fletcher32");

  const Handle storedType(H5Dget_type(dataset.Id), H5Tclose);
  require(storedType && HasType(storedType, type), "has a wrong type of number");

  const Handle space(H5Dget_space(dataset.Id), H5Sclose);
  hsize_t size[2] = { 0, 1 };
  bool shaped = H5Sget_simple_extent_type(space) == H5S_SIMPLE &&
                H5Sget_simple_extent_ndims(space) == static_cast<int>(shape.size()) &&
                H5Sget_simple_extent_dims(space, size, nullptr) >= 0;
  for (std::size_t d = 0; d < shape.size() && shaped; ++d)
  {
    shaped = size[d] > 0 && (shape[d] == 0 || size[d] == shape[d]);
  }
  require(shaped, "has a wrong shape");
  dataset.Rows = size[0];
  dataset.Columns = size[1];

  // Divisions instead of products: the sizes may be anything up to 2^64.
  const std::uint64_t width = H5Tget_size(storedType);
  const std::uint64_t most = this->FileSize * file::MaximumCompression;
  require(dataset.Rows <= most / width / dataset.Columns, "is larger than the file can hold");

  hsize_t chunk[2] = { 0, 1 };
  dataset.SlabRows = std::max<std::uint64_t>(1, file::MaximumChunkBytes / 2 / 8 / dataset.Columns);
  if (layout == H5D_CHUNKED)
  {
    const bool chunked = H5Pget_chunk(creation, 2, chunk) == static_cast<int>(shape.size()) &&
                         chunk[0] > 0 && chunk[1] > 0;
    require(chunked && chunk[0] <= file::MaximumChunkBytes / width / chunk[1],
      "has chunks of more than a megabyte");
    dataset.SlabRows = std::max<std::uint64_t>(1, dataset.SlabRows / chunk[0]) * chunk[0];
  }
  const std::uint64_t stored = H5Dget_storage_size(dataset.Id);
  require(stored <= this->UnclaimedBytes &&
            dataset.Rows <= stored * file::MaximumCompression / width / dataset.Columns,
    "is larger than what is stored of it; the file is damaged");
  const auto fileSize = static_cast<double>(this->FileSize);
  dataset.ProgressBegin = 1.0 - static_cast<double>(this->UnclaimedBytes) / fileSize;
  this->UnclaimedBytes -= stored;
  dataset.ProgressEnd = 1.0 - static_cast<double>(this->UnclaimedBytes) / fileSize;
  return dataset;
}
}
