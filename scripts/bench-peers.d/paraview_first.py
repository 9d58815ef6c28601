"""pvbatch paraview_first.py CASE.json PICTURE: what a ParaView user does for a first picture, run by
first_picture.py on any ranks: reads the file, shows it as a volume, saves the window."""

import json
import sys

from paraview import simple

from paraview_peer import make_view, read, show


def main():
    case_file, picture = sys.argv[1:]
    with open(case_file, encoding="utf-8") as file:
        case = json.load(file)
    simple._DisableFirstRenderCameraReset()
    view = make_view(case)
    show(read(case), view, case)
    simple.SaveScreenshot(picture, view, ImageResolution=[case["size"], case["size"]])


if __name__ == "__main__":
    main()
