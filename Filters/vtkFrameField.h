// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFrameField
 * @brief   smooth orthonormal frames in segments, aligned with their boundaries
 *
 * At every voxel of a segment three directions u, v, w at right angles, as smooth as the boundary
 * allows: at voxels along the surface one of them is the surface's normal. With the patches of a
 * domain it is the one that the patch names, pointing from the low to the high side; without, it
 * is any, and frames are known up to the 24 rotations of the cube.
 *
 * The method is that of section 2.2 of "Feature-Aware Reconstruction of Volume Data via Trivariate
 * Splines" (2011): each frame in turn goes to the best place between those of its neighbours, then
 * onto its constraints. Beyond it the sweeps go from coarse to fine and over the mark (Chebyshev),
 * start from the solution of a linear problem, and can minimise the energy of the crosses as
 * spherical harmonics itself, which needs no matching.
 *
 * Only registration without jumps knows which direction is which. Crosses are smoothest with
 * singular curves inside, whatever the labels at the boundary; so with labels the default is the
 * registration without jumps, which has none away from the borders of the patches, and without
 * labels the quartic step.
 *
 * The surface acts where it is: its triangles, by area, within a voxel of the voxels along it; each
 * segment is bound on its own side. Where two axes meet on a surface that is smooth, neither can be
 * its normal: the middle of both is.
 *
 * Spacing may differ along the axes: pairs of neighbours count as the faces between them over their
 * distance, and coarser levels first join voxels along the finer axes. Frames are directions in
 * space, whatever the image's direction matrix, and right-handed in it.
 *
 * @par Input
 * Port 0: a vtkImageData with two or more points along each axis, and a point array of labels,
 * whole numbers from 0, chosen with SetInputArrayToProcess(0, ...), by default "Segment". Port 1
 * (optional): vtkPolyData with triangles, the patches of vtkPolycubeDomain (cell arrays PatchAxis,
 * PatchSide, Segment), or the surfaces of vtkSegmentBoundary (cell array BoundaryLabels), which
 * bind any axis. Without it, the surfaces of the labels bind any axis. A part of a surface that no
 * triangle covers binds nothing.
 *
 * @par Output
 * Port 0: the image with the point arrays FrameU, FrameV, FrameW (float x 3): of unit length, at
 * right angles, right-handed; zero outside the segments. Field data, one value a segment:
 * FrameSegment; FrameVoxels; FrameEnergy, the sum over pairs of neighbours of the squared distance
 * of their crosses as spherical harmonics (20/3 t^2 for a small angle t); FrameAlignmentError, the
 * largest angle in degrees between a normal and its direction where nothing else binds the voxel;
 * FrameSingularPlaquettes.
 *
 * Port 1, singular graph: vtkPolyData with lines between the middles of 2 x 2 x 2 voxels, where the
 * frames around do not close up; voxels along the surface are left out. Cell array Segment.
 *
 * Port 2, energies: vtkTable with a row for the state after each sweep. Segment; Level, 0 is the
 * voxels, 1 half as fine; Sweep, made before on that level; HarmonicEnergy, as FrameEnergy;
 * RegisteredEnergy, the same of the squared distances of the frames as matrices, of the closest of
 * the 24 with jumps.
 *
 * @par Cost
 * 0.3 to 0.5 microseconds a voxel and sweep on one core, all coarser levels included: a segment
 * that fills 256^3 some 70 seconds. Memory: 63 bytes a voxel of the segment and 45 a voxel of the
 * image, the output's 36 included; without coarse to fine up to 576 more. Threaded with
 * vtkSMPTools; the result does not depend on the number of threads.
 *
 * @par Distributed data
 * Under several processes the pieces are gathered to process 0 with a warning; the image is given
 * back in pieces, graph and table are there on process 0 alone.
 *
 * @par Errors
 * An image without points or labels, with labels that are no whole numbers or negative, one voxel
 * thick, or too large for the memory; a segment that is not there, or has no patches while others
 * do; patches of another image (more than half of their area is at no voxel of the segment);
 * patches with left-handed axes; without patches, one label only; harmonic coordinates without
 * patches.
 *
 * @sa vtkPolycubeDomain vtkSegmentBoundary vtkStreamTracer
 */
#ifndef vtkFrameField_h
#define vtkFrameField_h

#include "vtkImageAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

#include <memory> // for FrameOutput
#include <string> // for faults
#include <vector> // for Segments

class vtkMultiProcessController;
class vtkPolyData;
class vtkTable;

namespace trivariate
{
class FrameOutput;
struct FieldOptions;
struct LabelledImage;
}

class VTKTRIVARIATEFILTERS_EXPORT vtkFrameField : public vtkImageAlgorithm
{
public:
  static vtkFrameField* New();
  vtkTypeMacro(vtkFrameField, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Steps
  {
    AUTOMATIC = 0,
    REGISTRATION = 1,
    REGISTRATION_WITH_JUMPS = 2,
    QUARTIC = 3
  };

  enum Starts
  {
    LINEAR = 0,
    PRINCIPAL_AXES = 1,
    HARMONIC_COORDINATES = 2
  };

  ///@{
  /**
   * The segments that get frames. Default is none, which means those with patches or, without
   * patches, all but 0, the background.
   */
  void AddSegment(int segment);
  void ClearSegments();
  int GetNumberOfSegments() const { return static_cast<int>(this->Segments.size()); }
  int GetSegment(int i) const;
  ///@}

  ///@{
  /**
   * How a frame finds its best place. REGISTRATION (1): u with the neighbours' u, v with v, w with
   * w. REGISTRATION_WITH_JUMPS (2): the end of each axis with the closest one, whatever its name;
   * the paper's. QUARTIC (3): the lowest energy of crosses. AUTOMATIC (0): REGISTRATION with
   * patches, QUARTIC without. Default is AUTOMATIC.
   */
  vtkSetClampMacro(Step, int, AUTOMATIC, QUARTIC);
  vtkGetMacro(Step, int);
  ///@}

  ///@{
  /**
   * The frames to begin with. LINEAR (0): the smoothest matrices or spherical harmonics, made
   * frames. PRINCIPAL_AXES (1): of the segment, everywhere; the paper's. HARMONIC_COORDINATES (2):
   * the rotations closest to the gradients of the domain's harmonic coordinates; needs patches on
   * all six sides. Default is LINEAR.
   */
  vtkSetClampMacro(Start, int, LINEAR, HARMONIC_COORDINATES);
  vtkGetMacro(Start, int);
  ///@}

  ///@{
  /**
   * Whether the frames are smoothed on coarser levels first. Default is true.
   */
  vtkSetMacro(CoarseToFine, bool);
  vtkGetMacro(CoarseToFine, bool);
  vtkBooleanMacro(CoarseToFine, bool);
  ///@}

  ///@{
  /**
   * Whether frames go beyond the best place, so that fewer sweeps do. Default is true.
   */
  vtkSetMacro(Relaxed, bool);
  vtkGetMacro(Relaxed, bool);
  vtkBooleanMacro(Relaxed, bool);
  ///@}

  ///@{
  /**
   * The most sweeps over the voxels; coarser levels have up to sixteen times as many. Valid range
   * [0, 10000]. Default is 15.
   */
  vtkSetClampMacro(Sweeps, int, 0, 10000);
  vtkGetMacro(Sweeps, int);
  ///@}

  ///@{
  /**
   * Sweeps end when one lowers the energy by less than this share of it. Valid range [0, 1].
   * Default is 1e-4.
   */
  vtkSetClampMacro(EnergyDrop, double, 0.0, 1.0);
  vtkGetMacro(EnergyDrop, double);
  ///@}

  ///@{
  /**
   * Processes that share distributed data. Default is the global controller.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const { return this->Controller; }
  ///@}

  vtkPolyData* GetSingularGraph();
  vtkTable* GetEnergies();

protected:
  vtkFrameField();
  ~vtkFrameField() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkFrameField(const vtkFrameField&) = delete;
  void operator=(const vtkFrameField&) = delete;

  trivariate::LabelledImage ReadImage(vtkImageData* input, std::string& fault);
  bool Gather(trivariate::LabelledImage& image, vtkPolyData* surface, std::string& fault);
  trivariate::FieldOptions Options() const;
  std::unique_ptr<trivariate::FrameOutput> MakeFields(
    const trivariate::LabelledImage& image, vtkPolyData* patches);

  std::vector<int> Segments;
  int Step = AUTOMATIC;
  int Start = LINEAR;
  bool CoarseToFine = true;
  bool Relaxed = true;
  int Sweeps = 15;
  double EnergyDrop = 1e-4;
  vtkMultiProcessController* Controller = nullptr;
};

#endif
