# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Segments of volumes by thresholds. The volumes are the .vti files of TRIVARIATE_DATA_DIR (default:
../shared/data)."""
import os
import pathlib

data = pathlib.Path(os.environ.get("TRIVARIATE_DATA_DIR",
                                   pathlib.Path(__file__).resolve().parents[2] / "shared" / "data"))


def volume_of(name):
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader
    from vtkmodules.util.numpy_support import vtk_to_numpy
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(data / f"{name}.vti"))
    reader.Update()
    image = reader.GetOutput()
    return image, vtk_to_numpy(image.GetPointData().GetArray(0))


def labelled(run):
    """The image of VOLUME=THRESHOLD[,THRESHOLD ...][+] with its segments, not yet made whole."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from trivariate import vtkSegmentTopology
    name, thresholds = run.split("=")
    image, density = volume_of(name)
    values = [float(t) for t in thresholds.rstrip("+").split(",")]

    def set_labels(labels):
        array = numpy_to_vtk(labels.astype(numpy.int32), deep=1)
        array.SetName("Segment")
        image.GetPointData().AddArray(array)
    inside = density > values[0]
    if thresholds.endswith("+"):
        set_labels(inside)
        filled = vtkSegmentTopology()
        filled.SetInputData(image)
        filled.SetLargestCavity(2**31 - 1)
        filled.Update()
        inside = vtk_to_numpy(filled.GetOutput().GetPointData().GetArray("Segment")) > 0
    set_labels(inside * (1 + sum((density > value).astype(int) for value in values[1:])))
    return image
