# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch --symmetric on several ranks, one of which runs out of memory, or is stopped. The
argument: which step, which rank, and how many MB it has left or at which progress it stops."""
import resource
import sys

from paraview.simple import *
from vtkmodules.vtkParallelCore import vtkMultiProcessController

step, rank, limit = sys.argv[1].split(",")
wavelet = Wavelet(WholeExtent=[-80, 80] * 3)
image = Calculator(Input=wavelet, ResultArrayName="Segment",
                   Function="if(mag(coords) < 40, 1, 0)")
image.UpdatePipeline()
makers = {
    "fit": lambda: TSplineFit(Input=image, Scalars=["POINTS", "RTData"],
                              MaximumNumberOfControlPoints=200),
    "boundary": lambda: SegmentBoundary(Input=image, UseDensity=0),
    "segmentation": lambda: TextureSegmentation(Input=wavelet, Scalars=["POINTS", "RTData"])}
limited = makers[step]()
if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == int(rank):
    if float(limit) < 1.0:
        algorithm = limited.GetClientSideObject()
        algorithm.AddObserver("ProgressEvent", lambda *_: algorithm.SetAbortExecute(
            algorithm.GetProgress() >= float(limit)))
    else:
        with open("/proc/self/statm", encoding="ascii") as file:
            used = int(file.read().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS,
                           (used + (int(limit) << 20), resource.RLIM_INFINITY))
limited.UpdatePipeline()
voxels = limited.GetClientSideObject().GetOutputDataObject(0).GetNumberOfPoints()
print(f"went on with {voxels} points", flush=True)
