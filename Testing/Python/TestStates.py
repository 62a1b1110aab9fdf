# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""A state file brings back every property of the steps from a volume to surfaces, and what they
make of it."""
from paraview.simple import *

SETTINGS = {
    "all": dict(Scalars=["POINTS", "Other"], NumberOfSegments=3, WindowRadius=3, DirectionRange=1,
                DensityWeight=1.5, GradientWeight=0.5, GreyLevels=32, AutomaticGreyLevelRange=0,
                GreyLevelRange=[-9.0, 8.0], MinimumSegmentSize=7, MergeDirections=1,
                TextureAttributes=["Contrast", "Correlation"], DirectionResolved=1,
                OutputAttributes=1),
    "none": dict(TextureAttributes=[]),
    "default": {},
    "topology": dict(Labels=["POINTS", "Segment"], Segments=[2, 1], LargestSheet=5,
                     LargestCavity=6),
    "boundary": dict(Labels=["POINTS", "Segment"], Density=["POINTS", "Other"], Segments=[2, 1],
                     UseDensity=0, SmoothingIterations=11),
    "automatic": {},
}
GETTERS = ["Get" + name for settings in SETTINGS.values() for name in settings] + [
    "GetNumberOfTextureAttributes", "GetNumberOfSegments"]


def values(proxy):
    return {name: str(proxy.GetPropertyValue(name)) for name in proxy.ListProperties()
            if name != "Input"}


def seen(name):
    """The properties of the proxy, those of its VTK object, and the size of its output."""
    proxy = FindSource(name)
    proxy.UpdatePipeline()
    algorithm = proxy.GetClientSideObject()
    cxx = [getattr(algorithm, getter)() for getter in dir(algorithm) if getter in GETTERS]
    information = proxy.GetDataInformation()
    return values(proxy), cxx, information.GetNumberOfPoints(), information.GetNumberOfCells()


volume = Calculator(Input=Wavelet(WholeExtent=[-10, 9] * 3), ResultArrayName="Other",
                    Function="coordsX")
for name in ("all", "none", "default"):
    TextureSegmentation(registrationName=name, Input=volume, **SETTINGS[name])
for name, step in (("topology", SegmentTopology), ("boundary", SegmentBoundary),
                   ("automatic", SegmentBoundary)):
    step(registrationName=name, Input=FindSource("all"), **SETTINGS[name])

before = {name: seen(name) for name in SETTINGS}
SaveState("steps.pvsm")
ResetSession()
assert FindSource("all") is None
LoadState("steps.pvsm")
for name, expected in before.items():
    assert seen(name) == expected, (name, seen(name), expected)
print(len(before), "sources with all of their properties")
