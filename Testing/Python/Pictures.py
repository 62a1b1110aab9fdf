# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of pictures with their baselines."""
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkImagingCore import vtkImageDifference
from vtkmodules.vtkIOImage import vtkPNGReader

THRESHOLD = 15.0  # edges that move by a pixel stay below


def difference(name, folder, baselines):
    """vtkImageDifference's error of name.png in a folder against the one among the baselines."""
    readers = [vtkPNGReader(), vtkPNGReader()]
    for reader, place in zip(readers, (folder, baselines)):
        reader.SetFileName(os.path.join(place, name + ".png"))
    compare = vtkImageDifference()
    compare.SetInputConnection(readers[0].GetOutputPort())
    compare.SetImageConnection(readers[1].GetOutputPort())
    compare.Update()
    return compare.GetThresholdedError()


def mean_difference(first, second):
    """Mean absolute difference of all color values (0 to 255) of two PNG files of one size: for
    pictures of smooth colors without edges, of which every pixel says something."""
    pixels = []
    for path in (first, second):
        reader = vtkPNGReader()
        reader.SetFileName(path)
        reader.Update()
        pixels.append(vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(float))
    return float(numpy.mean(numpy.abs(pixels[0] - pixels[1])))
