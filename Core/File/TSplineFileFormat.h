// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Names and limits of the .tspline format, version 1 (Documentation/FileFormat.md).
 */
#ifndef trivariate_TSplineFileFormat_h
#define trivariate_TSplineFileFormat_h

#include <hdf5.h>

#include <array>
#include <cstdint>

namespace trivariate
{
namespace file
{
/// Attributes of the root group: a string, int32[2] (major, minor) and, if known, int32[3].
inline constexpr const char* Format = "Format";
inline constexpr const char* FormatName = "Trivariate T-spline";
inline constexpr const char* Version = "Version";
inline constexpr std::array<std::int32_t, 2> CurrentVersion = { 1, 0 };
inline constexpr const char* RootCells = "RootCells";

/// Datasets of n control points: float64[knots], unsigned integers[n][5], float64[n][3],
/// float64[n], int32[n], int32[n].
inline constexpr std::array<const char*, 3> KnotLines = { "KnotLineU", "KnotLineV", "KnotLineW" };
inline constexpr std::array<const char*, 3> Knots = { "KnotsU", "KnotsV", "KnotsW" };
inline constexpr const char* Points = "Points";
inline constexpr const char* Weight = "Weight";
inline constexpr const char* Segment = "Segment";
inline constexpr const char* Block = "Block";

/// If the spline has holes: unsigned integers[m][6], the knots u low, u high, v low, ...
inline constexpr const char* Holes = "Holes";

/// The group of the attributes "0", "1", ..., each float64[n][components] with a string
/// AttributeName.
inline constexpr const char* Attributes = "Attributes";
inline constexpr const char* AttributeName = "Name";
inline constexpr std::size_t MaximumNameLength = 4096; ///< bytes

/// Chunks are no larger, so that no damaged one can ask for much memory; the writer's are half.
inline constexpr std::uint64_t MaximumChunkBytes = std::uint64_t(1) << 20;

/// Deflate makes data at most 1032 times smaller: a file that promises more is none of ours.
inline constexpr std::uint64_t MaximumCompression = 1040;
}
}

#endif
