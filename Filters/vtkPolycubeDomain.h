// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPolycubeDomain
 * @brief   cubes as the parameter domain of a segment, and their faces laid out on its surface
 *
 * Each segment gets a group of glued cubes. The corners of the group lie on the surface of the
 * segment; borders between them, which never cross, cut the surface into patches, one for each face
 * between a cube and the outside. On a patch one of the parameters u, v, w is constant. Between
 * picked corners borders are geodesics; those that are found follow the normals and are nearly as
 * short.
 *
 * Automatic: cubes, corners and patches are found, so that the normals of the surface point along
 * the axes of the patches, at a cost for each corner; what is so bent that the hexahedron between
 * the corners of a cube would be inverted is cut into a chain of cubes. A segment with one cavity
 * is a shell around it, with a block on each patch. A segment with handles gets cubes around its
 * holes where the normals of its surface show such cubes, as of a torus or a box with a hole; else
 * the message names the place of a handle. Neither the order of the triangles nor where the surface
 * lies changes what is found, nor a rotation where it is not round.
 *
 * What neighbours share: a segment that fills the cavity of another has that surface in common with
 * it, its corners, patches and coordinates. Two segments without cavities that touch in one disc
 * (a box cut in two) have that disc as a patch in common, with corners on the curve around it. Both
 * then lie side by side in one lattice, and what is fitted to them cannot crack there. Segments
 * that touch in another way (in a ring, in several places, along a curve with a third one, over
 * much more than a face) have separate domains; a warning says which and why.
 *
 * Manual: the shape is NumberOfCubes, without those that are switched off, and each corner of the
 * shape has a point near the surface, to which it is moved. Corners are those lattice points of the
 * shape that lie on its boundary, in order of w, then v, then u: of one cube (0, 0, 0), (1, 0, 0),
 * (0, 1, 0), (1, 1, 0), (0, 0, 1), ... Their points come from the second input, which must have
 * some, or from CornerPositions; where there are neither, from the corners that were found
 * automatically. Points of the second input may be for several segments: their point array Segment
 * says whose each is, and the order counts within each segment. All of these have the one shape, or
 * each its automatic one. Segments without corners get their automatic domain. Those with corners
 * share nothing with the segments that they touch; a warning names them.
 *
 * Layered, the default: every patch gets a block of its own along the surface, around cubes with
 * corners inside: 8 + 8 corners and 7 blocks for one cube. A smooth surface is not forced into a
 * cube's edges, and the ramp of density at the boundary has a direction of its own.
 *
 * @par Input
 * Port 0: vtkPolyData with triangles, a closed surface of each segment. The cell array
 * BoundaryLabels (2 components, see vtkSegmentBoundary) says which triangles are whose; without it
 * all is the surface of segment 1. Port 1 (optional): vtkPointSet, the points of the corners in
 * manual mode, with the point array Segment (one component) where they are for several segments.
 *
 * @par Output
 * Port 0, patches: vtkPolyData, for each segment the triangles of its surface, cut along the
 * borders, seen from outside of it (what two segments share is there for both, with common
 * points).
 * - cells: Patch (int32); PatchAxis (int8): 0, 1, 2, aligned with u, v, w of the block that it
 *   bounds; PatchSide (int8): 0 at the low end of the block, 1 at the high end; Segment (int32);
 *   BoundaryLabels (int32 x 2), that segment and the one on the other side. A patch that two
 *   segments share has one number, and opposite sides.
 * - points: CornerId (int32), -1 where no corner is; with RelaxBorders Parameter (double x 3), its
 *   place on the boundary of the polycube, in DomainCoordinates: one to one on each patch, with
 *   little stretch; zero on surfaces whose borders were not moved.
 *
 * Port 1, polycube: vtkUnstructuredGrid with a hexahedron for each block.
 * - points: DomainCoordinates (int32 x 3), where the corner lies in the integer polycube (an inner
 *   corner: as the one above it); CornerId (int32), -1 for points inside; SnapDistance (double, if
 *   corners were given), how far each was moved, 0 where none was given.
 * - cells: Segment; Block (int32), the group of cubes that shares one (u, v, w) grid: all of a
 *   segment, or each by itself where there are layers; Patch (int32), on which the block stands, or
 *   -1; Alignment (double), of the segment: the mean over its outer surface of the cosine between
 * the normal and the axis of the patch, 1 where all fit.
 *
 * Port 2, borders: vtkPolyData with a line for each border between two patches.
 * - points: CornerId (int32), -1 but for the ends. cells: BorderPatches (int32 x 2), on the left
 *   and on the right, seen from outside.
 *
 * @par Cost
 * 5 to 25 s for each segment of 1e5 to 5e5 triangles, shells up to a minute, and 0.4 GB for each
 * 1e5 triangles: surfaces of more than 200000 are searched on 20000 of them, and only the domain
 * found is laid out on all. The corners found are kept, so that corners picked from there take
 * less.
 *
 * @par Distributed data
 * Under several processes the pieces are gathered to process 0 with a warning; it gives the same
 * result as one process would, the others give empty outputs. Corners are those of all processes,
 * in their order, or of one where all have the same; where the filter is not updated on all of
 * them, of the process that is asked, which is an error if they are too few.
 *
 * @par Errors
 * A surface that is empty, not of triangles, open or not two-manifold; a segment that is not there,
 * or lies around the others; in manual mode a corner of a segment that gets no domain, corners
 * fewer or more than the shape has, none from a second input, two at one place, farther than
 * SnapLimit from the surface, mirrored. Where some of several segments get no domain, a warning
 * says why; where none gets one, an error does.
 *
 * @sa vtkSegmentBoundary vtkSegmentTopology
 */
#ifndef vtkPolycubeDomain_h
#define vtkPolycubeDomain_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

#include <memory> // for Internals
#include <vector> // for Segments

class vtkDoubleArray;
class vtkMultiProcessController;
class vtkPolyData;
class vtkUnstructuredGrid;

class VTKTRIVARIATEFILTERS_EXPORT vtkPolycubeDomain : public vtkPolyDataAlgorithm
{
public:
  static vtkPolycubeDomain* New();
  vtkTypeMacro(vtkPolycubeDomain, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Modes
  {
    AUTOMATIC = 0,
    MANUAL = 1
  };

  ///@{
  /**
   * Whether shape and corners are found (AUTOMATIC, 0) or given (MANUAL, 1). Default is AUTOMATIC.
   */
  vtkSetClampMacro(Mode, int, AUTOMATIC, MANUAL);
  vtkGetMacro(Mode, int);
  void SetModeToAutomatic() { this->SetMode(AUTOMATIC); }
  void SetModeToManual() { this->SetMode(MANUAL); }
  ///@}

  ///@{
  /**
   * The segments that get a domain, one each however often it is named. Default is none, which
   * means all but 0, the background.
   */
  void AddSegment(int segment);
  void ClearSegments();
  int GetNumberOfSegments() const { return static_cast<int>(this->Segments.size()); }
  int GetSegment(int i) const;
  ///@}

  ///@{
  /**
   * In manual mode, the number of cubes along u, v and w. Default is (0, 0, 0), which means the
   * shape that is found automatically.
   */
  vtkSetVector3Macro(NumberOfCubes, int);
  vtkGetVector3Macro(NumberOfCubes, int);
  ///@}

  ///@{
  /**
   * Cubes that the shape does without, as u + nu (v + nv w), counted from 0. Default is none.
   */
  void AddSwitchedOffCube(int cube);
  void ClearSwitchedOffCubes();
  int GetNumberOfSwitchedOffCubes() const
  {
    return static_cast<int>(this->SwitchedOffCubes.size());
  }
  int GetSwitchedOffCube(int i) const;
  ///@}

  ///@{
  /**
   * In manual mode without a second input, the points of the corners, in the order told above.
   * Default is none, which means those of GetStartCorners(). So does a single one, which no shape
   * has: ParaView's handles cannot be none.
   */
  void AddCornerPosition(double x, double y, double z);
  void AddCornerPosition(const double position[3])
  {
    this->AddCornerPosition(position[0], position[1], position[2]);
  }
  void ClearCornerPositions();
  int GetNumberOfCornerPositions() const
  {
    return static_cast<int>(this->CornerPositions.size() / 3);
  }
  ///@}

  /**
   * Corners to start from, after an update: of the shape of manual mode, on the surface, as they
   * were found automatically or, for a shape of another kind, spread over the cube that was. A
   * single one at the origin where there is not just one segment, or it has none, or the update was
   * stopped. The first call after manual updates may search for them, with progress, which
   * AbortExecute stops as it does an update: then there is a single one too, and the next call
   * searches again.
   */
  vtkDoubleArray* GetStartCorners();

  ///@{
  /**
   * How far from the surface a given corner may be, as a share of the surface's diagonal. Default
   * is 0.1.
   */
  vtkSetClampMacro(SnapLimit, double, 0.0, 1.0);
  vtkGetMacro(SnapLimit, double);
  ///@}

  ///@{
  /**
   * In automatic mode, how much better one more corner must make the domain. Its value is the mean
   * scaled Jacobian of some 2000 hexahedra in its blocks, made on a coarse copy of the surface,
   * over 1 + d / h: d is the root mean square distance of the surface from the hexahedra or, where
   * that is more, of these from the surface, and h the edge of a cube with 1 / 2000 of the volume.
   * Cubes that fill a solid only roughly must be better by 0.035. Chains of cubes have the
   * hexahedra of one cube: for them it is a third of the alignment, the area-weighted mean of the
   * cosine between normals and the directions of the patches, which also decides between cubes
   * whose values differ by less than 0.035. Where one cube is found whose alignment is above 0.9,
   * the surface has the edges of a cube, bent perhaps, and others must also be better by all the
   * alignment that they lose. 0: as many cubes as are best; 1: one cube wherever one
   * will do. Valid range [0, 1]. Default is 0.0005.
   */
  vtkSetClampMacro(CornerCost, double, 0.0, 1.0);
  vtkGetMacro(CornerCost, double);
  ///@}

  ///@{
  /**
   * In automatic mode, the largest number of cubes of a segment. Valid range [1, 1000]. Default is
   * 64.
   */
  vtkSetClampMacro(MostCubes, int, 1, 1000);
  vtkGetMacro(MostCubes, int);
  ///@}

  ///@{
  /**
   * Whether borders go to where the map of the surface onto the cubes stretches it least, also
   * where patches then follow the normals less; corners of the cubes' surface stay, and so do sharp
   * edges. Block meshes start from this map (Parameter). Borders of contacts and of the outer
   * surface of a shell are not moved. Default is off.
   */
  vtkSetMacro(RelaxBorders, bool);
  vtkGetMacro(RelaxBorders, bool);
  vtkBooleanMacro(RelaxBorders, bool);
  ///@}

  ///@{
  /**
   * Whether every patch gets a block of its own along the surface. Default is true.
   */
  vtkSetMacro(Layered, bool);
  vtkGetMacro(Layered, bool);
  vtkBooleanMacro(Layered, bool);
  ///@}

  ///@{
  /**
   * How deep the blocks along the surface are, in voxels: of the size that field data VoxelSpacing
   * of the surface tells, as that of Segment Boundary does (the third root of their volume), or,
   * without it, in mean edges of the surface's triangles. Graded: below each corner no deeper than
   * half of the way to the middle, so less where the segment is thin, and less where a block would
   * be inverted. Default is 0, automatic: 2.5 mean edges, so graded too.
   */
  vtkSetClampMacro(LayerDepth, double, 0.0, 1e6);
  vtkGetMacro(LayerDepth, double);
  ///@}

  ///@{
  /**
   * Processes that share distributed data. Default is the global controller.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const { return this->Controller; }
  ///@}

  vtkPolyData* GetPatches();
  vtkUnstructuredGrid* GetPolycube();
  vtkPolyData* GetBorders();

protected:
  vtkPolycubeDomain();
  ~vtkPolycubeDomain() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkPolycubeDomain(const vtkPolycubeDomain&) = delete;
  void operator=(const vtkPolycubeDomain&) = delete;

  void MakeDomains(vtkPolyData* surface, vtkPolyData* corners, vtkInformationVector* outputVector);

  std::vector<int> Segments;
  int Mode = AUTOMATIC;
  int NumberOfCubes[3] = { 0, 0, 0 };
  std::vector<int> SwitchedOffCubes;
  std::vector<double> CornerPositions;
  double SnapLimit = 0.1;
  double CornerCost = 0.0005;
  int MostCubes = 64;
  bool RelaxBorders = false;
  bool Layered = true;
  double LayerDepth = 0.0;
  vtkMultiProcessController* Controller = nullptr;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
