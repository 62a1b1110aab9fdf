# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of pictures with their baselines."""
import os

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
