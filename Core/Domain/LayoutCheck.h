// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Whether patches of a surface are the faces of a polycube. Each routine returns one message for
 * each failure, naming the patch, corner or border; none where all is well. CheckLayout looks at
 * every domain that is found, picked, laid out on more triangles or relaxed; CheckCharts at charts
 * before they have a polycube (ChartDomain.cpp), and CheckContact (ContactPatch.h) at each face
 * that two segments share (SegmentContacts.cxx); all of them begin with CheckPatches but the last.
 */
#ifndef trivariate_LayoutCheck_h
#define trivariate_LayoutCheck_h

#include "SurfaceLayout.h"

namespace trivariate
{
/// The surface is closed and two-manifold, every triangle has a patch, every patch is a disc, every
/// border runs between its two corners and its two patches, borders meet at corners only, and
/// patches meet at borders only.
std::vector<std::string> CheckPatches(const SurfaceLayout& layout);

/// CheckPatches, and that patches, corners and borders are the faces, corners and edges of the
/// polycube: the same numbers and labels, and the four corners of each in the same cyclic order.
std::vector<std::string> CheckLayout(const SurfaceLayout& layout, const Polycube& polycube);

/**
 * CheckPatches, and that charts are those of some polycube. Of each: at least four neighbours, none
 * of them of its own axis; three axes at each corner. Of all: the turns of the charts' outlines
 * close, give every border one direction and every chart an integer coordinate, and along every
 * line through the solid low and high charts alternate. (Three low u charts and no high one pass
 * all local tests.) `corners` receives the integer coordinates of all corners where all is well.
 */
std::vector<std::string> CheckCharts(
  const SurfaceLayout& layout, std::vector<LatticePoint>* corners = nullptr);
}

#endif
