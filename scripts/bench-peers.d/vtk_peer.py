"""vtk_peer.py CASE.json gpu|cpu JOBS.json: VTK's volume mappers, run by bench.py.

JOBS: a list of {style, step, frames, picture}; step in world units. Prints a line of JSON per job
with the milliseconds of every frame, from the call of Render to the pixels in an array; the first
frame's pixels (bottom row first, as RGBA bytes) go to the file `picture`.
"""

import json
import sys
import time

import numpy
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  the backend of the classes below
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import (vtkMultiThreader, vtkSMPTools, vtkUnsignedCharArray,
                                      vtkVersion)
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import (vtkColorTransferFunction, vtkRenderer, vtkRenderWindow,
                                         vtkVolume)
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkOpenGLGPUVolumeRayCastMapper

THREADS = 2


def make_mapper(kind):
    if kind == "gpu":
        mapper = vtkOpenGLGPUVolumeRayCastMapper()
        mapper.UseJitteringOff()
    else:
        mapper = vtkFixedPointVolumeRayCastMapper()
        mapper.SetNumberOfThreads(THREADS)
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetImageSampleDistance(1)
    mapper.LockSampleDistanceToInputSpacingOff()
    return mapper


def image(case):
    data = vtkImageData()
    data.SetDimensions(case["dims"])
    data.SetSpacing(case["spacing"])
    voxels = numpy.fromfile(case["raw"], case["dtype"])
    data.GetPointData().SetScalars(numpy_to_vtk(voxels))
    data.voxels = voxels  # which VTK only refers to
    return data


def set_look(prop, case):
    """The transfer function and the light of `case`, for a vtkVolumeProperty."""
    colour, opacity = vtkColorTransferFunction(), vtkPiecewiseFunction()
    colour.SetColorSpaceToRGB()
    for value, r, g, b, a in case["points"]:
        colour.AddRGBPoint(value, r, g, b)
        opacity.AddPoint(value, a)
    prop.SetColor(colour)
    prop.SetScalarOpacity(opacity)
    prop.SetScalarOpacityUnitDistance(case["unit_length"])
    prop.SetInterpolationTypeToLinear()
    prop.SetAmbient(0.3)
    prop.SetDiffuse(0.7)
    prop.SetSpecular(0.2)
    prop.SetSpecularPower(20)


def set_camera(camera, case):
    camera.SetPosition(case["eye"])
    camera.SetFocalPoint(case["target"])
    camera.SetViewUp(case["up"])
    camera.SetViewAngle(case["angle_deg"])


def main():
    case_file, kind, jobs_file = sys.argv[1:]
    with open(case_file, encoding="utf-8") as file:
        case = json.load(file)
    with open(jobs_file, encoding="utf-8") as file:
        jobs = json.load(file)
    vtkMultiThreader.SetGlobalMaximumNumberOfThreads(THREADS)
    vtkSMPTools.Initialize(THREADS)

    data, mapper, actor = image(case), make_mapper(kind), vtkVolume()
    mapper.SetInputData(data)
    actor.SetMapper(mapper)
    set_look(actor.GetProperty(), case)
    renderer, window = vtkRenderer(), vtkRenderWindow()
    renderer.AddVolume(actor)
    renderer.SetBackgroundAlpha(0)
    window.SetOffScreenRendering(1)
    window.SetAlphaBitPlanes(1)
    window.SetMultiSamples(0)
    window.SetSize(case["size"], case["size"])
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    pixels, last = vtkUnsignedCharArray(), case["size"] - 1
    for job in jobs:
        mapper.SetSampleDistance(job["step"])
        actor.GetProperty().SetShade(job["style"] == "shaded")
        set_camera(camera, case)
        renderer.ResetCameraClippingRange()
        times = []
        for frame in range(job["frames"]):
            start = time.perf_counter()
            window.Render()
            window.GetRGBACharPixelData(0, 0, last, last, 0, pixels)
            times.append((time.perf_counter() - start) * 1e3)
            if frame == 0:
                vtk_to_numpy(pixels).tofile(job["picture"])
            camera.Azimuth(0.01)
        print(json.dumps({"times": times, "version": vtkVersion().GetVTKVersion()}), flush=True)


if __name__ == "__main__":
    main()
