// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTextureSegmentation
 * @brief   splits a volume image into segments of one texture and density each
 *
 * Haralick's co-occurrence attributes of the window around every voxel, the density and, if wanted,
 * the magnitude of its gradient are clustered by k-means. So materials are told apart that have the
 * same density and the same gradients but another texture, and where densities differ, they decide.
 *
 * Attributes are measured by how much they scatter within a region. Every voxel takes those of the
 * most uniform windows around it, so that a window that straddles two materials does not look like
 * a third; what is left of such shells is removed, and every interface is placed to the voxel by
 * the grey levels on either side. Small components are merged into their surroundings.
 *
 * @par Input
 * Port 0: a vtkImageData with a point array of one component and any real type, chosen with
 * SetInputArrayToProcess(0, ...).
 *
 * @par Output
 * Port 0: the image with the point array Segment (int32): 0 to the number of segments less one, by
 * ascending mean density. On request the texture attributes as they are before smoothing, float, in
 * [0, 1]. Field data, one tuple a segment: SegmentCentres (double; one component an attribute, with
 * its name), SegmentMeanDensity (double), SegmentSize (vtkIdType, points); and SegmentCriterion
 * (double x 2): numbers of segments that were tried, with the simplified silhouette of each, 0
 * to 1.
 *
 * @par Cost
 * Time linear in the number of points; see TextureWindow.h for the attributes' part. Memory: 48
 * bytes a point, 4 a point and attribute (8 with OutputAttributes), 8 a segment for each point near
 * an interface (all of them have to fit), 156 GreyLevels^2 a segment, under several processes 25
 * bytes more for each point of the whole volume on every process. Threaded with vtkSMPTools; the
 * result does not depend on the number of threads.
 *
 * @par Distributed data
 * Every process works on its piece, with ghost levels (3 WindowRadius + 1) around it. A sample, the
 * grey levels and the labels are gathered on all, one byte a point each. The labels are those that
 * one process would give.
 *
 * @par Errors
 * An image without points, without the chosen array, with more than one component, one voxel thick,
 * smaller than a window, without spacing where the gradient counts, with NaN or infinity, with more
 * than 2^31 - 1 points or too large for the memory; an unknown attribute, none at all. A constant
 * image is one segment, with a warning; fewer segments than were asked for give a warning.
 *
 * @par Reference
 * R. M. Haralick, K. Shanmugam, I. Dinstein. Textural features for image classification. IEEE
 * Trans. Systems, Man, Cybernetics 3, 1973.
 *
 * @sa vtkSegmentTopology vtkSegmentBoundary
 */
#ifndef vtkTextureSegmentation_h
#define vtkTextureSegmentation_h

#include "vtkImageAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

#include <string> // for TextureAttributes
#include <vector> // for TextureAttributes

class vtkDataArray;
class vtkMultiProcessController;
namespace trivariate
{
struct SegmentationOptions;
}

class VTKTRIVARIATEFILTERS_EXPORT vtkTextureSegmentation : public vtkImageAlgorithm
{
public:
  static vtkTextureSegmentation* New();
  vtkTypeMacro(vtkTextureSegmentation, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many segments. 0 tries 2 to 8 and takes the least number whose simplified silhouette is
   * within 0.01 of the best. Valid range [0, 64]. Default is 0.
   */
  vtkSetClampMacro(NumberOfSegments, int, 0, 64);
  vtkGetMacro(NumberOfSegments, int);
  ///@}

  ///@{
  /**
   * Half width r of the window of (2 r + 1)^3 voxels, in voxels. A larger window tells noisy
   * textures apart more surely, a smaller one sees smaller parts. Valid range [1, 6]. Default is 2.
   */
  vtkSetClampMacro(WindowRadius, int, 1, 6);
  vtkGetMacro(WindowRadius, int);
  ///@}

  ///@{
  /**
   * Number of grey levels. Integers of fewer distinct values than that are kept as they are. Valid
   * range [2, 256]. Default is 16.
   */
  vtkSetClampMacro(GreyLevels, int, 2, 256);
  vtkGetMacro(GreyLevels, int);
  ///@}

  ///@{
  /**
   * Whether the grey levels span the values but the lowest and the highest 0.1 %; otherwise
   * GreyLevelRange, in equal bins. Default is true.
   */
  vtkSetMacro(AutomaticGreyLevelRange, bool);
  vtkGetMacro(AutomaticGreyLevelRange, bool);
  vtkBooleanMacro(AutomaticGreyLevelRange, bool);
  ///@}

  ///@{
  /**
   * Densities up to the first value are the lowest grey level, those from the second on the
   * highest. Used only without AutomaticGreyLevelRange. Default is (0, 1).
   */
  vtkSetVector2Macro(GreyLevelRange, double);
  vtkGetVector2Macro(GreyLevelRange, double);
  ///@}

  ///@{
  /**
   * Connected parts with fewer voxels are merged into the neighbour with which they share most
   * faces. 0 is the number of voxels of the window. Valid range [0, VTK_INT_MAX]. Default is 0.
   */
  vtkSetClampMacro(MinimumSegmentSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(MinimumSegmentSize, int);
  ///@}

  ///@{
  /**
   * Weight of the density against all texture attributes together; it counts as far as the density
   * belongs to regions rather than to the texture. 0 leaves it out. Valid range [0, 100]. Default
   * is 6.
   */
  vtkSetClampMacro(DensityWeight, double, 0.0, 100.0);
  vtkGetMacro(DensityWeight, double);
  ///@}

  ///@{
  /**
   * Weight of the magnitude of the gradient, likewise. Valid range [0, 100]. Default is 0.
   */
  vtkSetClampMacro(GradientWeight, double, 0.0, 100.0);
  vtkGetMacro(GradientWeight, double);
  ///@}

  ///@{
  /**
   * Names of the texture attributes (TextureAttributes.h lists them). Default are the 22 that do
   * not repeat another one and need no eigenvalues. Without any, density and gradient decide alone.
   */
  void AddTextureAttribute(const char* name);
  void ClearTextureAttributes();
  int GetNumberOfTextureAttributes() const
  {
    return static_cast<int>(this->TextureAttributes.size());
  }
  const char* GetTextureAttribute(int i) const;
  ///@}

  ///@{
  /**
   * Whether attributes are those of one co-occurrence matrix summed over the 13 directions;
   * otherwise their mean over the directions' matrices. Default is false.
   */
  vtkSetMacro(MergeDirections, bool);
  vtkGetMacro(MergeDirections, bool);
  vtkBooleanMacro(MergeDirections, bool);
  ///@}

  ///@{
  /**
   * Whether the range of each attribute over the directions is an attribute too: it tells fibres
   * from grains. Twice the memory. Default is false.
   */
  vtkSetMacro(DirectionRange, bool);
  vtkGetMacro(DirectionRange, bool);
  vtkBooleanMacro(DirectionRange, bool);
  ///@}

  ///@{
  /**
   * Whether each attribute's dependence on the direction counts too (six numbers, a tensor): it
   * tells a texture from the same texture rotated. Seven times the memory. Default is false.
   */
  vtkSetMacro(DirectionResolved, bool);
  vtkGetMacro(DirectionResolved, bool);
  vtkBooleanMacro(DirectionResolved, bool);
  ///@}

  ///@{
  /**
   * Whether the texture attributes are point arrays of the output. Default is false.
   */
  vtkSetMacro(OutputAttributes, bool);
  vtkGetMacro(OutputAttributes, bool);
  vtkBooleanMacro(OutputAttributes, bool);
  ///@}

  ///@{
  /**
   * Processes that share distributed data. Default is the global controller.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const { return this->Controller; }
  ///@}

protected:
  vtkTextureSegmentation();
  ~vtkTextureSegmentation() override;

  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkTextureSegmentation(const vtkTextureSegmentation&) = delete;
  void operator=(const vtkTextureSegmentation&) = delete;

  vtkDataArray* ChosenArray(vtkImageData* image);
  trivariate::SegmentationOptions Options() const;

  int NumberOfSegments = 0;
  int WindowRadius = 2;
  int GreyLevels = 16;
  bool AutomaticGreyLevelRange = true;
  double GreyLevelRange[2] = { 0.0, 1.0 };
  int MinimumSegmentSize = 0;
  double DensityWeight = 6.0;
  double GradientWeight = 0.0;
  std::vector<std::string> TextureAttributes;
  bool MergeDirections = false;
  bool DirectionRange = false;
  bool DirectionResolved = false;
  bool OutputAttributes = false;
  vtkMultiProcessController* Controller = nullptr;
};

#endif
