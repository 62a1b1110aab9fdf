// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * volume [FILE]: fits a T-spline to a hydrogen orbital, stores it if FILE is given, and prints how
 * many control points it has and the volume of the hexahedra on it, which is that of the box.
 */
#include "vtkCellSizeFilter.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkHydrogenOrbitalSource.h"
#include "vtkNew.h"
#include "vtkTSplineFit.h"
#include "vtkTSplineReader.h"
#include "vtkTSplineSource.h"
#include "vtkTSplineWriter.h"
#include "vtkUnstructuredGrid.h"

#include <cstdlib>
#include <iostream>

int main(int argc, char* argv[])
{
  vtkNew<vtkHydrogenOrbitalSource> orbital;
  orbital->SetDimensions(32, 32, 32);
  orbital->SetHalfWidth(40.0);

  vtkNew<vtkTSplineFit> fit;
  fit->SetInputConnection(orbital->GetOutputPort());
  fit->SetMaximumNumberOfControlPoints(1000);

  vtkNew<vtkTSplineSource> hexes;
  hexes->SetInputConnection(fit->GetOutputPort());
  hexes->SetOutputType(vtkTSplineSource::LINEAR_HEXES);

  vtkNew<vtkTSplineWriter> writer;
  vtkNew<vtkTSplineReader> reader;
  if (argc > 1)
  {
    writer->SetInputConnection(fit->GetOutputPort());
    writer->SetFileName(argv[1]);
    writer->Write();
    reader->SetFileName(argv[1]);
    hexes->SetInputConnection(reader->GetOutputPort());
  }

  vtkNew<vtkCellSizeFilter> size;
  size->SetInputConnection(hexes->GetOutputPort());
  size->ComputeSumOn();
  size->Update();
  vtkDataArray* sum = size->GetOutputDataObject(0)->GetFieldData()->GetArray("Volume");
  if (!sum)
  {
    return EXIT_FAILURE;
  }
  std::cout << fit->GetOutput()->GetNumberOfPoints() << " control points, volume "
            << sum->GetComponent(0, 0) << "\n";
  return EXIT_SUCCESS;
}
