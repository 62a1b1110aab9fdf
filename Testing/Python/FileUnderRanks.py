# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch on any number of ranks: saves a T-spline, opens it again, saves it from pieces."""
import pathlib
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

ranks = sys.argv[1]


def rows(grid):
    """All numbers of the control points, one row each, sorted: pieces may come in any order."""
    data = grid.GetPointData()
    names = sorted(data.GetArrayName(i) for i in range(data.GetNumberOfArrays()))
    columns = [vtk_to_numpy(grid.GetPoints().GetData())]
    columns += [vtk_to_numpy(data.GetArray(name)).reshape(len(columns[0]), -1) for name in names]
    table = numpy.hstack(columns)
    return table[numpy.lexsort(table.T)]


def save_and_open(proxy, file, expected, **options):
    SaveData(file, proxy=proxy, **options)
    reader = OpenDataFile(file)
    assert reader.GetXMLName() == "TSplineReader"
    assert numpy.array_equal(rows(servermanager.Fetch(reader)), rows(expected)), file


fit = TSplineFit(Input=Wavelet(WholeExtent=[-12, 11, 3, 22, 0, 15]), MaximumNumberOfControlPoints=600)
save_and_open(fit, f"fit{ranks}.tspline", servermanager.Fetch(fit))

# Every rank makes its own share of the control points.
folder = str(pathlib.Path(__file__).parent)
pieces = ProgrammableSource(OutputDataSetType="vtkUnstructuredGrid")
pieces.ScriptRequestInformation = """
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
self.GetExecutive().GetOutputInformation(0).Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
"""
pieces.Script = f"""
import sys
sys.path.insert(0, {folder!r})
from SplineGrids import tensor_product
executive = self.GetExecutive()
piece = executive.GetOutputInformation(0).Get(executive.UPDATE_PIECE_NUMBER())
share = slice(piece, None, {ranks})
self.GetOutput().ShallowCopy(tensor_product(5, {{"density": lambda p: p[:, 0] / 3}}, part=share))
"""
sys.path.insert(0, folder)
from SplineGrids import tensor_product

whole = tensor_product(5, {"density": lambda p: p[:, 0] / 3})
save_and_open(pieces, f"pieces{ranks}.tspline", whole, CompressionLevel=9)
print("saved")
