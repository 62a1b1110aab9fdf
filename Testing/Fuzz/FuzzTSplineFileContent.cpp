// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Valid HDF5 with anything in it: the fuzzer's bytes choose what is wrong with a T-spline file.
//
// Changed bytes of a file seldom get past HDF5's checksums, so this target lets HDF5 write the
// file: any of its objects may be missing, a link, or of another type, shape, storage or value.
#include "File/Hdf5.h"
#include "File/TSplineFileFormat.h"
#include "File/TSplineFileReader.h"

#include <fuzzer/FuzzedDataProvider.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <vector>

namespace
{
using trivariate::hdf5::Handle;
namespace file = trivariate::file;

class Forger
{
public:
  Forger(const std::uint8_t* bytes, std::size_t size, hid_t file)
    : In(bytes, size)
    , File(file)
  {
  }

  void Forge()
  {
    const hsize_t n = this->In.ConsumeIntegralInRange(1, 3);
    this->Attribute(this->File, file::Format, this->Text(file::FormatName));
    this->Attribute(this->File, file::Version, { 1, 0, 0, 0, 0, 0, 0, 0 }, H5T_STD_I32LE, 2);
    this->Attribute(this->File, file::RootCells, std::vector<char>(12, 1), H5T_STD_I32LE, 3);
    for (int a = 0; a < 3; ++a)
    {
      const double line[3] = { 0, 1, 2 };
      std::vector<char> knots;
      for (hsize_t i = 0; i < n; ++i)
      {
        knots.insert(knots.end(), { 0, 0, 0, 1, 2 });
      }
      const char* values = reinterpret_cast<const char*>(line);
      this->Object(file::KnotLines[a], H5T_IEEE_F64LE, { 3 }, { values, values + sizeof(line) });
      this->Object(file::Knots[a], H5T_STD_U8LE, { n, 5 }, knots);
    }
    this->Object(file::Points, H5T_IEEE_F64LE, { n, 3 }, std::vector<char>(24 * n, 0));
    std::vector<double> ones(n, 1.0);
    const char* values = reinterpret_cast<const char*>(ones.data());
    this->Object(file::Weight, H5T_IEEE_F64LE, { n }, { values, values + 8 * n });
    this->Object(file::Segment, H5T_STD_I32LE, { n }, std::vector<char>(4 * n, 0));
    this->Object(file::Block, H5T_STD_I32LE, { n }, std::vector<char>(4 * n, 0));
    Handle(
      H5Gcreate2(this->File, file::Attributes, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    const int attributes = this->In.ConsumeIntegralInRange(0, 3);
    for (int i = 0; i < attributes; ++i)
    {
      const hsize_t columns = this->In.ConsumeIntegralInRange(1, 3);
      const std::string path = std::string(file::Attributes) + "/" + std::to_string(i);
      const Handle dataset =
        this->Object(path, H5T_IEEE_F64LE, { n, columns }, std::vector<char>(8 * n * columns, 0));
      if (dataset)
      {
        this->Attribute(dataset, file::AttributeName, this->Text("a" + std::to_string(i)));
      }
    }
  }

private:
  /// True for one choice in sixteen, false when the fuzzer has no bytes left.
  bool Odd() { return this->In.ConsumeIntegral<std::uint8_t>() % 16 == 1; }

  std::vector<char> Text(const std::string& right)
  {
    const std::string text = this->Odd() ? this->In.ConsumeRandomLengthString(40) : right;
    return { text.begin(), text.end() };
  }

  Handle AnyType(std::size_t size)
  {
    switch (this->In.ConsumeIntegralInRange(0, 8))
    {
      case 0:
        return { H5Tcopy(H5T_IEEE_F32LE), H5Tclose };
      case 1:
        return { H5Tcopy(H5T_IEEE_F64BE), H5Tclose };
      case 2:
        return { H5Tcopy(H5T_STD_I64LE), H5Tclose };
      case 3:
        return { H5Tcopy(H5T_STD_U16LE), H5Tclose };
      case 4:
        return { H5Tcopy(H5T_STD_U32LE), H5Tclose };
      case 5:
      {
        Handle type(H5Tcopy(H5T_STD_I32LE), H5Tclose);
        H5Tset_precision(type, this->In.ConsumeIntegralInRange(1, 31));
        return type;
      }
      case 6:
        return { H5Tvlen_create(H5T_IEEE_F64LE), H5Tclose };
      case 7:
      {
        Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
        H5Tset_size(type, H5T_VARIABLE);
        return type;
      }
      default:
        return { H5Tcreate(H5T_OPAQUE, size), H5Tclose };
    }
  }

  void Attribute(hid_t object, const char* name, const std::vector<char>& value,
    hid_t element = H5I_INVALID_HID, hsize_t count = 0)
  {
    if (this->Odd() || value.empty())
    {
      return;
    }
    Handle type(H5Tcopy(count > 0 ? element : H5T_C_S1), H5Tclose);
    if (count == 0)
    {
      H5Tset_size(type, value.size());
    }
    if (this->Odd())
    {
      type = this->AnyType(8);
    }
    count = this->Odd() ? this->In.ConsumeIntegralInRange(0, 5) : count;
    const Handle space(
      count > 0 ? H5Screate_simple(1, &count, nullptr) : H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(
      H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const std::size_t bytes = H5Tget_size(type) * H5Sget_simple_extent_npoints(space);
    if (attribute && H5Tis_variable_str(type) <= 0 && H5Tget_class(type) != H5T_VLEN)
    {
      std::vector<char> padded = value;
      padded.resize(std::max(bytes, value.size()), 1);
      if (this->Odd())
      {
        this->In.ConsumeData(padded.data(), padded.size());
      }
      H5Awrite(attribute, type, padded.data());
    }
  }

  std::vector<hsize_t> AnyShape()
  {
    const hsize_t sizes[] = { 0, 1, 2, 3, 5, 1000, hsize_t(1) << 20, hsize_t(1) << 31,
      hsize_t(1) << 40, hsize_t(1) << 62 };
    std::vector<hsize_t> shape(this->In.ConsumeIntegralInRange(0, 3));
    for (hsize_t& size : shape)
    {
      size = this->In.PickValueInArray(sizes);
    }
    return shape;
  }

  /// Anything but a sound dataset; a dataset where one is made, for what comes after.
  bool Replaced(const std::string& path)
  {
    switch (this->In.ConsumeIntegralInRange(0, 5))
    {
      case 0:
        return true; // missing
      case 1:
        return H5Lcreate_soft("/Weight", this->File, path.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0;
      case 2:
        return H5Lcreate_external(
                 "other.h5", "/x", this->File, path.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0;
      case 3:
        return bool(Handle(
          H5Gcreate2(this->File, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose));
      case 4:
        return H5Lcreate_hard(
                 this->File, file::Points, this->File, path.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0;
      default:
        return H5Lcreate_soft(path.c_str(), this->File, path.c_str(), H5P_DEFAULT, H5P_DEFAULT) >=
               0;
    }
  }

  Handle AnyStorage(const std::vector<hsize_t>& shape)
  {
    Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (this->Odd())
    {
      H5Pset_external(creation, "other.raw", 0, H5F_UNLIMITED);
    }
    if (this->In.ConsumeBool() && !shape.empty())
    {
      std::vector<hsize_t> chunk;
      for (const hsize_t size : shape)
      {
        chunk.push_back(this->Odd() ? this->In.ConsumeIntegralInRange<hsize_t>(1, 1 << 22)
                                    : std::max<hsize_t>(1, std::min<hsize_t>(size, 64)));
      }
      H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
      const int filters = this->In.ConsumeIntegralInRange(0, 31);
      filters & 1 ? H5Pset_shuffle(creation) : 0;
      filters & 2 ? H5Pset_deflate(creation, 1) : 0;
      filters & 4 ? H5Pset_fletcher32(creation) : 0;
      filters == 8 ? H5Pset_nbit(creation) : 0;
      filters == 16 ? H5Pset_scaleoffset(creation, H5Z_SO_INT, 0) : 0;
      filters == 24 ? H5Pset_filter(creation, 32000, H5Z_FLAG_OPTIONAL, 0, nullptr) : 0;
    }
    return creation;
  }

  Handle Object(
    const std::string& path, hid_t rightType, std::vector<hsize_t> shape, std::vector<char> value)
  {
    if (this->Odd() && this->Replaced(path))
    {
      return {};
    }
    const Handle type = this->Odd() ? this->AnyType(8) : Handle(H5Tcopy(rightType), H5Tclose);
    shape = this->Odd() ? this->AnyShape() : shape;
    const Handle space(shape.empty()
                         ? H5Screate(this->Odd() ? H5S_NULL : H5S_SCALAR)
                         : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
      H5Sclose);
    const Handle creation = this->AnyStorage(shape);
    Handle dataset(
      H5Dcreate2(this->File, path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
      H5Dclose);
    const double bytes =
      static_cast<double>(H5Sget_simple_extent_npoints(space)) * H5Tget_size(type);
    if (dataset && bytes >= 0 && bytes <= 1 << 14 && H5Tis_variable_str(type) <= 0 &&
        H5Tget_class(type) != H5T_VLEN)
    {
      value.resize(std::max<std::size_t>(static_cast<std::size_t>(bytes), value.size()), 0);
      if (this->Odd())
      {
        this->In.ConsumeData(value.data(), value.size());
      }
      H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data());
    }
    return dataset;
  }

  FuzzedDataProvider In;
  hid_t File;
};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  static const std::string path = "content-" + std::to_string(getpid()) + ".tspline";
  {
    const trivariate::hdf5::Quiet quiet;
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
    const Handle made(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
    Forger(bytes, size, made).Forge();
  }
  constexpr double MaximumBytes = 64.0 * 1024 * 1024;
  try
  {
    const trivariate::TSplineModel model = trivariate::ReadTSplineFile(path, MaximumBytes);
    if (!trivariate::Validate(model).empty())
    {
      std::abort();
    }
  }
  catch (const std::runtime_error&)
  {
  }
  unlink(path.c_str());
  return 0;
}
