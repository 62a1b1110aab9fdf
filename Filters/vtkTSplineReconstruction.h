// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTSplineReconstruction
 * @brief   from a volume image to a T-spline in one step
 *
 * Splits the image into segments and fits a T-spline to each of them, with automatic choices; all
 * lie in one parameter space and are one T-spline grid. Every voxel of the image is represented,
 * the background too, so that vtkTSplineSource writes the whole image back (with the segmented
 * image as its second input, which tells whose spline counts where).
 *
 * The chain is that of vtkTextureSegmentation, vtkSegmentTopology, vtkSegmentBoundary and
 * vtkTSplineFit, each with its defaults (texture windows as large as fit into images of three or
 * four voxels; of two it needs labels). A segment is fitted over its bounding box, the voxels of
 * other segments masked. With Domain AUTOMATIC every segment for which vtkPolycubeDomain finds a
 * domain is fitted again, over its cubes with layers and without (vtkFrameField,
 * vtkVolumeParameterization), with as many control points, and what is most accurate in the round
 * trip is kept. Cubes that are less accurate than the box with an eighth of the control points
 * already (64 for each block, if that is more) are not tried with all. Segments whose domains share
 * a surface, one around another or side by side, are fitted over it together, with layers: there is
 * no gap between them, while attributes jump; where boxes are more accurate for them, or a block
 * mesh or the spline has folds, each is fitted by itself. Segments for which one of these filters
 * fails are left out of the domains, and the others are tried again. Then one spline is fitted over
 * the whole image, and if it is more accurate than all segments together (or, where both meet the
 * tolerance, has fewer control points), it is the result, as the Remark of the rounds says. With
 * Domain GIVEN the segments with a domain in the second input are fitted over that. A warning tells why a
 * segment with a domain stays with its box, or with cubes without layers: half or more of the
 * blocks that were found are inverted between their corners, folds, voxels that are missed. Up to 2
 * % of a segment's voxels may be missed, since the spline does not pass through them or they have
 * no Parameter; these are counted to the lowest segment, which is therefore always fitted over its
 * box. What the filters warn of is told. Of several attributes the one with the largest error, in
 * parts of its range, decides.
 *
 * @par Input
 * Port 0: a vtkImageData with two or more points along each axis. The point array to fit is chosen
 * with SetInputArrayToProcess(0, ...), those named with AddAttribute are fitted beside it. A point
 * array of labels, whole numbers from 0, that is chosen with SetInputArrayToProcess(1, ...) takes
 * the place of the segmentation; the default "None" is none.
 * Port 1 (for Domain GIVEN): vtkUnstructuredGrid, cubes and corners of some segments, as output 1
 * of vtkPolycubeDomain: hexahedra with the cell array Segment and the point array
 * DomainCoordinates, eight neighbouring lattice points each. The points of the shape's boundary are
 * the corners, each at most a tenth of the segment's diagonal away from its surface, to which it is
 * moved. Where there is a cell array Patch, cells with a patch are no cubes, but tell that there
 * are to be blocks along the surface; where there is a point array CornerId, points with -1 are no
 * corners.
 *
 * @par Output
 * Port 0: the T-spline grid; the control points' arrays Segment and Block tell whose they are.
 * Port 1: vtkTable, the rounds of all fits, with the columns of vtkTSplineFit; and, but not of one
 * spline over the whole image, Segment, Together (int32: the lowest of the segments that were
 * fitted at once; they have the same rounds), Range (double, of the array in these, of which RMS
 * and MaximumError are parts), SegmentRMS (double, percent of Range: what the last round left in
 * the segment itself; NaN with several attributes), GradientJump (double, root mean square, of
 * vtkTSplineFit) and Domain (string: SegmentBox, Cubes or LayeredCubes). Field data: Step (string)
 * and StepSeconds (double), where the time went: the names of the filters without "vtk", FitOverBox
 * and FitOverCubes; Remark (string) where AUTOMATIC takes one spline over the whole image. Unless
 * Domain is BOX also:
 * Port 2: the image with the point array Segment. Port 3: vtkPolyData, the surfaces of the segments
 * of vtkSegmentBoundary.
 * With Domain AUTOMATIC or GIVEN also, of those segments that have a domain:
 * Port 4: vtkPolyData, patches, of vtkPolycubeDomain. Port 5: vtkUnstructuredGrid, polycubes, and
 * port 6: vtkImageData, fields, both of vtkVolumeParameterization (frames, Parameter,
 * ParameterMask, Block; of the domain with its layers; without domains the image of port 2). Port
 * 7: vtkUnstructuredGrid, hexahedra of vtkHexRemesh. Port 8: vtkPartitionedDataSetCollection, the
 * block meshes behind the parameters, of vtkVolumeParameterization: with the fields and polycubes
 * they are what vtkTSplineFit needs to fit anew over the domain. Hexahedra and blocks have cells
 * two voxels long, or as long as 30,000 of them fill the image if that is more. With the field data
 * InvertedCells (double x 2, before and after repair) and ScaledJacobian (double x 2, least and
 * mean).
 *
 * @par Cost
 * The sum of the steps; memory that of the most expensive one. Threaded with vtkSMPTools; the
 * result does not depend on the number of threads.
 *
 * @par Distributed data
 * Every process asks for the whole image; process 0 makes the result, the one that one process
 * would make, the others give empty outputs.
 *
 * @par Errors
 * What the first step that cannot go on says: an image without points or the chosen array, one
 * voxel thick, with NaN or infinity, too large for the memory; labels that are no whole numbers or
 * negative. A given domain that is none: no unit cubes, corners that are missing, twice there, too
 * far from the surface or mirrored, a segment that is not there or in pieces.
 *
 * @sa vtkReconstructionReport vtkTSplineFit vtkTSplineSource
 */
#ifndef vtkTSplineReconstruction_h
#define vtkTSplineReconstruction_h

#include "vtkSmartPointer.h"            // for images
#include "vtkTrivariateFiltersModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

#include <string> // for Attributes
#include <vector> // for Attributes

class vtkDataArray;
class vtkImageData;
class vtkPolyData;
class vtkTSplineFit;

namespace trivariate
{
struct Chain;
struct FilledDomains;
struct GivenDomain;
struct SegmentFitOptions;
struct SegmentFits;
}

class VTKTRIVARIATEFILTERS_EXPORT vtkTSplineReconstruction : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTSplineReconstruction* New();
  vtkTypeMacro(vtkTSplineReconstruction, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Domains
  {
    /// One spline over the image's box: vtkTSplineFit.
    BOX = 0,
    /// A spline for each segment, over its bounding box.
    SEGMENTS = 1,
    /// A spline for each segment, over its cubes or its bounding box, or one over the image's box,
    /// whichever is better.
    AUTOMATIC = 2,
    /// A spline for each segment, over the cubes of the second input where it has some.
    GIVEN = 3
  };

  /// Cubes and corners of some segments, for Domain GIVEN.
  void SetDomainConnection(vtkAlgorithmOutput* input) { this->SetInputConnection(1, input); }

  ///@{
  /**
   * Over what is fitted. Default is AUTOMATIC.
   */
  vtkSetClampMacro(Domain, int, BOX, GIVEN);
  vtkGetMacro(Domain, int);
  void SetDomainToBox() { this->SetDomain(BOX); }
  void SetDomainToSegments() { this->SetDomain(SEGMENTS); }
  void SetDomainToAutomatic() { this->SetDomain(AUTOMATIC); }
  void SetDomainToGiven() { this->SetDomain(GIVEN); }
  ///@}

  ///@{
  /**
   * How many segments, the background included; 0 looks for their number as vtkTextureSegmentation
   * does. Not used with labels of one's own. Valid range [0, 64]. Default is 0.
   */
  vtkSetClampMacro(NumberOfSegments, int, 0, 64);
  vtkGetMacro(NumberOfSegments, int);
  ///@}

  ///@{
  /**
   * Most control points of all segments together, those that blocks share counted once, though
   * every segment may have 64, and one with a given domain 64 for each of its blocks. They are
   * shared out by how much the values bend within a segment and by its size. Valid range [64,
   * VTK_INT_MAX]. Default is 50000.
   */
  vtkSetClampMacro(MaximumNumberOfControlPoints, int, 64, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfControlPoints, int);
  ///@}

  ///@{
  /**
   * A segment is not refined further when its root mean square error, of each array that is fitted,
   * is at most this many percent of the array's range over the image. 0 is no such limit. Valid
   * range [0, 100]. Default is 0.1.
   */
  vtkSetClampMacro(RMSTolerance, double, 0.0, 100.0);
  vtkGetMacro(RMSTolerance, double);
  ///@}

  ///@{
  /**
   * Names of further point arrays that are fitted beside the chosen one. Default is none.
   */
  void AddAttribute(const char* name);
  void ClearAttributes();
  int GetNumberOfAttributes() const { return static_cast<int>(this->Attributes.size()); }
  const char* GetAttribute(int i) const;
  ///@}

protected:
  vtkTSplineReconstruction();
  ~vtkTSplineReconstruction() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkTSplineReconstruction(const vtkTSplineReconstruction&) = delete;
  void operator=(const vtkTSplineReconstruction&) = delete;

  std::vector<vtkDataArray*> ChosenArrays(vtkImageData* image);
  vtkSmartPointer<vtkDataArray> ChosenLabels(vtkImageData* image);
  trivariate::SegmentFitOptions FitOptions(vtkImageData* image);
  vtkSmartPointer<vtkTSplineFit> FitBox(
    vtkImageData* image, trivariate::Chain& chain, double from, double to);
  std::string WhyBox(vtkTSplineFit* box, const trivariate::SegmentFits& segments);
  void FitParts(vtkImageData* image, bool labelled,
    const std::vector<trivariate::GivenDomain>& given, trivariate::Chain& chain,
    vtkInformationVector* outputVector);
  std::vector<trivariate::FilledDomains> Fill(vtkImageData* segments, vtkPolyData* surfaces,
    const std::vector<trivariate::GivenDomain>& given, trivariate::Chain& chain,
    vtkInformationVector* outputVector);
  void LayOut(vtkPolyData* surfaces, const std::vector<trivariate::GivenDomain>& given,
    trivariate::Chain& chain, vtkPolyData* patches, vtkUnstructuredGrid* polycubes);
  void Warn(const std::vector<std::string>& warnings);

  int Domain = AUTOMATIC;
  int NumberOfSegments = 0;
  int MaximumNumberOfControlPoints = 50000;
  double RMSTolerance = 0.1;
  std::vector<std::string> Attributes;
};

#endif
