# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Volume images as smooth trivariate T-splines: the classes of Trivariate for VTK and ParaView."""
from .vtkTrivariateFilters import *
from .vtkTrivariateReaders import *
from .vtkTrivariateWriters import *
