# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every class of the project is in the package trivariate, with its documentation."""
import pathlib
import sys

import trivariate

source = pathlib.Path(sys.argv[1])
classes = [h.stem for d in ("Filters", "Readers", "Writers") for h in (source / d).glob("vtk*.h")]
assert len(classes) >= 3, classes
for name in classes:
    cls = getattr(trivariate, name)
    assert cls().GetClassName() == name
    assert "Superclass" in cls.__doc__, name + " has no documentation"
print(len(classes), "classes:", *sorted(classes))
