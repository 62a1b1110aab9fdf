# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch --symmetric on any number of ranks: each saves its own piece of a segmentation."""
import sys

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkParallelCore import vtkMultiProcessController

rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
wavelet = Wavelet(WholeExtent=[-14, 15, 3, 26, 0, 27])
layered, checkered = "cos(3.14159265*coordsZ)", "cos(3.14159265*(coordsX+coordsY+coordsZ))"
volume = Calculator(Input=wavelet, ResultArrayName="Density",
                    Function=f"0.02*RTData + if(coordsX+0.3*coordsZ>2, {layered}, {checkered})")
segmentation = TextureSegmentation(Input=volume, Scalars=["POINTS", "Density"], GradientWeight=0.2,
                                   NumberOfSegments=2, OutputAttributes=1)
segmentation.UpdatePipeline()
image = segmentation.GetClientSideObject().GetOutputDataObject(0)
fields = image.GetPointData(), image.GetFieldData()
arrays = [{data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
           for i in range(data.GetNumberOfArrays()) if data.GetArrayName(i) != "vtkGhostType"}
          for data in fields]
numpy.savez(f"{sys.argv[1]}-{rank}.npz", extent=image.GetExtent(),
            **{"point " + name: array for name, array in arrays[0].items()},
            **{"field " + name: array for name, array in arrays[1].items()})

# One error, and no rank waits for another.
thin = Wavelet(WholeExtent=[-14, 15, 3, 26, 0, 11])
TextureSegmentation(Input=thin, WindowRadius=6).UpdatePipeline()
TextureSegmentation(Input=thin, TextureAttributes=["Roughness"]).UpdatePipeline()
