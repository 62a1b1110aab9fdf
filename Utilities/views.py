# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of several views side by side, drawn by VTK."""
import numpy
import vtkmodules.vtkInteractionStyle  # noqa: F401 (VTK's factories)
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from PIL import Image
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkGlyph3D, vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkTextActor, vtkTexture, vtkWindowToImageFilter)


class Views:
    """Rows and columns of views, each size[0] x size[1] pixels, on white."""

    def __init__(self, rows, columns, size):
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetSize(columns * size[0], rows * size[1])
        self.renderers = [[vtkRenderer() for _ in range(columns)] for _ in range(rows)]
        for i, row in enumerate(self.renderers):
            for j, renderer in enumerate(row):
                renderer.SetViewport(j / columns, 1 - (i + 1) / rows,
                                     (j + 1) / columns, 1 - i / rows)
                renderer.SetBackground(1.0, 1.0, 1.0)
                self.window.AddRenderer(renderer)

    def save(self, path):
        """As a PNG file with a palette, each pixel the mean of four."""
        grabbed = vtkWindowToImageFilter()
        grabbed.SetInput(self.window)
        grabbed.SetScale(2)
        grabbed.ReadFrontBufferOff()
        grabbed.Update()
        image = grabbed.GetOutput()
        width, height, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
        shown = Image.fromarray(numpy.ascontiguousarray(pixels[::-1, :, :3]))
        save_small(shown.reduce(2), path)


def save_small(picture, path):
    """With a palette, a third of the size."""
    small = picture.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=5, dither=Image.Dither.NONE)
    small.save(path, optimize=True)


def draw(renderer, data, color, texture=None):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.SetTexture(texture)
    actor.GetProperty().SetColor(*color)
    renderer.AddActor(actor)
    return actor


def draw_flat(renderer, data, color):
    """As it is, whatever the light."""
    actor = draw(renderer, data, color)
    actor.GetProperty().LightingOff()
    return actor


def draw_tubes(renderer, lines, color, radius):
    tubes = vtkTubeFilter()
    tubes.SetInputData(lines)
    tubes.SetRadius(radius)
    tubes.SetNumberOfSides(12)
    tubes.Update()
    return draw(renderer, tubes.GetOutput(), color)


def draw_spheres(renderer, points, color, radius):
    """points: vtkPolyData."""
    sphere = vtkSphereSource()
    sphere.SetRadius(radius)
    sphere.SetThetaResolution(24)
    sphere.SetPhiResolution(24)
    glyphs = vtkGlyph3D()
    glyphs.SetInputData(points)
    glyphs.SetSourceConnection(sphere.GetOutputPort())
    glyphs.ScalingOff()
    glyphs.Update()
    return draw(renderer, glyphs.GetOutput(), color)


def checkers(dark):
    """A texture of 2 x 2 squares, white and `dark` (0..1), that repeats."""
    squares = vtkImageData()
    squares.SetDimensions(64, 64, 1)
    black = (numpy.indices((64, 64)) // 32).sum(0) % 2
    values = numpy.where(black, round(255 * dark), 255).astype(numpy.uint8)
    squares.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=1))
    texture = vtkTexture()
    texture.SetInputData(squares)
    texture.RepeatOn()
    texture.InterpolateOn()
    texture.MipmapOn()
    texture.SetMaximumAnisotropicFiltering(8)
    return texture


def look(renderers, direction, up, points, fill=0.9):
    """From `direction`, without perspective; points (n x 3) fill the share `fill` of the views."""
    forward = numpy.array(direction) / numpy.linalg.norm(direction)
    right = numpy.cross(up, forward)
    right /= numpy.linalg.norm(right)
    above = numpy.cross(forward, right)
    seen = points @ numpy.stack((right, above, forward), axis=1)
    low, high = seen.min(axis=0), seen.max(axis=0)
    centre = 0.5 * (low + high) @ numpy.stack((right, above, forward))
    for renderer in renderers:
        width, height = renderer.GetSize()
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(*centre)
        camera.SetPosition(*(centre + 2.0 * forward * (high - low).max()))
        camera.SetViewUp(*above)
        wide, tall = (high - low)[:2]
        camera.SetParallelScale(0.5 / fill * max(tall, wide * height / width))
        renderer.ResetCameraClippingRange()


def write(renderer, text, place, size=20):
    """`place`: from the lower left, 0..1; the text's middle is there."""
    label = vtkTextActor()
    label.SetInput(text)
    label.GetTextProperty().SetColor(0, 0, 0)
    label.GetTextProperty().SetFontSize(size)
    label.GetTextProperty().SetJustificationToCentered()
    label.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    label.SetPosition(*place)
    renderer.AddActor2D(label)
