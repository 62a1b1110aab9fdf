# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Domains under 1, 2 and 3 ranks: the same, and a warning that the pieces are gathered."""
from Ranks import alone, same, says

reference, output = alone("DomainUnderRanks.py")
fault = says("Segment 9: There is none such", 1)
fault(output)
assert "corners that it has itself" not in output


def asks_for_an_update(output):
    assert "corners that it has itself" in output, output


assert len(reference["Block1"]) == 13 and len(reference["SphereCorners"]) == 16
for name in ("Shared", "Spread"):  # picked corners are used: automatic ones are moved nowhere
    assert len(reference[f"{name}Corners"]) == 16 and reference[f"{name}Snaps"].max() > 0.3
same(reference, "DomainUnderRanks.py",
     lambda output: (fault(output), asks_for_an_update(output),
                     says("Domains are made on one process", 5)(output)),
     lengths_only=["SphereCorners"])  # pieces of the sphere: other numbers of points
print(len(reference["Points0"]), "points under 1, 2, 3 ranks")
