"""pvbatch --sym paraview_peer.py CASE.json JOBS.json: ParaView, run by bench.py on any ranks.

Jobs and output as of vtk_peer.py. Every rank runs this script, as the sample distance, which
ParaView does not offer as a property, is set in each rank's own mapper.
"""

import json
import sys
import time

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkMultiThreader, vtkSMPTools, vtkUnsignedCharArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from vtk_peer import make_mapper

SCALARS = {"|u1": "unsigned char", "<i2": "short", "<u2": "unsigned short", "<f4": "float"}


def read(case):
    dims = case["dims"]
    return simple.ImageReader(
        FileNames=[case["raw"]], DataScalarType=SCALARS[case["dtype"]], FileDimensionality=3,
        DataByteOrder="LittleEndian", FileLowerLeft=1, DataSpacing=case["spacing"],
        DataExtent=[0, dims[0] - 1, 0, dims[1] - 1, 0, dims[2] - 1], ScalarArrayName="values")


def make_view(case):
    view = simple.CreateRenderView()
    view.ViewSize = [case["size"], case["size"]]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0, 0, 0]
    view.MultiSamples = 0
    view.UseLight = 0  # instead of its kit of four, one light at the eye as for the others
    simple.AddLight(view).Coords = "Headlight"
    view.RemoteRenderThreshold = 0
    view.StillRenderImageReductionFactor = 1
    view.CameraPosition = case["eye"]
    view.CameraFocalPoint = case["target"]
    view.CameraViewUp = case["up"]
    view.CameraViewAngle = case["angle_deg"]
    return view


def show(source, view, case):
    shown = simple.Show(source, view)
    shown.SetRepresentationType("Volume")
    simple.ColorBy(shown, ("POINTS", "values"))
    shown.SetScalarBarVisibility(view, False)
    colour = simple.GetColorTransferFunction("values")
    opacity = simple.GetOpacityTransferFunction("values")
    colour.ColorSpace = "RGB"
    colour.RGBPoints = [x for point in case["points"] for x in point[:4]]
    opacity.Points = [x for point in case["points"] for x in (point[0], point[4], 0.5, 0)]
    shown.ScalarOpacityUnitDistance = case["unit_length"]
    shown.VolumeRenderingMode = "GPU Based"
    shown.Ambient, shown.Diffuse, shown.Specular, shown.SpecularPower = 0.3, 0.7, 0.2, 20
    return shown


def own_mapper(view):
    """ParaView's GPU mapper with a step of our choice, which its representation does not offer. The
    representation puts its own mapper back before each frame, so ours enters as a frame starts."""
    renderer = view.GetClientSideObject().GetRenderer()
    volume = renderer.GetVolumes().GetItemAsObject(0)
    mapper = make_mapper("gpu")
    mapper.SetInputDataObject(volume.GetMapper().GetInputDataObject(0, 0))
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectScalarArray("values")
    renderer.AddObserver("StartEvent", lambda *_: volume.SetMapper(mapper))
    return mapper


def main():
    case_file, jobs_file = sys.argv[1:]
    with open(case_file, encoding="utf-8") as file:
        case = json.load(file)
    with open(jobs_file, encoding="utf-8") as file:
        jobs = json.load(file)
    controller = vtkMultiProcessController.GetGlobalController()
    threads = max(1, 2 // controller.GetNumberOfProcesses())
    vtkMultiThreader.SetGlobalMaximumNumberOfThreads(threads)
    vtkSMPTools.Initialize(threads)
    simple._DisableFirstRenderCameraReset()

    view = make_view(case)
    shown = show(read(case), view, case)
    simple.Render(view)
    mapper = own_mapper(view)
    window = view.GetClientSideObject().GetRenderWindow()
    pixels, last = vtkUnsignedCharArray(), case["size"] - 1
    for job in jobs:
        mapper.SetSampleDistance(job["step"])
        shown.Shade = int(job["style"] == "shaded")
        camera = view.GetActiveCamera()
        camera.SetPosition(case["eye"])
        camera.SetViewUp(case["up"])
        times = []
        for frame in range(job["frames"]):
            controller.Barrier()
            start = time.perf_counter()
            simple.Render(view)
            if controller.GetLocalProcessId() == 0:
                window.GetRGBACharPixelData(0, 0, last, last, 0, pixels)
                times.append((time.perf_counter() - start) * 1e3)
                if frame == 0:
                    vtk_to_numpy(pixels).tofile(job["picture"])
            camera.Azimuth(0.01)
        if controller.GetLocalProcessId() == 0:
            print(json.dumps({"times": times, "version": str(simple.GetParaViewSourceVersion())}),
                  flush=True)


if __name__ == "__main__":
    main()
