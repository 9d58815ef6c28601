#!/usr/bin/python3
"""write_seeds.py FOLDER [VOLUMES]: writes what the fuzz targets start from, FOLDER/TARGET/FILE.

Volumes are those of tests/node/write_volumes.py, by programs that are not burin, a few of each format;
scenes are those of configs/. VOLUMES: a folder into which write_volumes.py has written already.
"""
import glob
import os
import shutil
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
root = os.path.dirname(os.path.dirname(here))

# Of each target, files that take different ways through its reader.
VOLUMES = {
    "nrrd": ("unu_u16_raw_big.nrrd", "unu_i8_gzip_big.nrrd", "unu_i32_ascii_little.nrrd", "unu_rgb.nrrd"),
    "nifti": ("vtk_i16.nii", "vtk_f64.nii", "vtk_u8.nii.gz"),
    "metaimage": ("vtk_i16_raw.mha", "vtk_u16_zlib.mha", "vtk_two.mha"),
    "vtk": ("vtk_i16_binary.vtk", "vtk_u16_ascii.vtk", "vtk_two.vtk", "vtk_cells.vtk"),
    "vti": ("vtk_i16_ascii_plain_little.vti", "vtk_u16_base64_zlib_big.vti", "vtk_u8_raw_plain_little.vti",
            "vtk_f32_raw_zlib_big.vti", "vtk_i8_appended64_zlib_little.vti", "vtk_turned.vti"),
    "hdf5": ("one.h5",),
    "dicom": ("dicom_u16/0.dcm", "dicom_ImplicitVRLittleEndian/1.dcm", "dicom_ExplicitVRBigEndian/1.dcm",
              "dicom_dcmcrle/2.dcm", "dicom_dcmcjpeg/2.dcm", "dicom_dcmcjpls/2.dcm", "dicom_frames.dcm",
              "dicom_slopes.dcm", "dicom_planes/0.dcm"),
}
TEXTS = {
    "raw_name": {"plain": "bonsai_256x256x256_uint8.raw", "gzip": "a_b_1x2x3_float64.raw.gz"},
    "paraview": {
        "map.json": """[{"ColorSpace": "Diverging", "Name": "cool", "NanColor": [1, 1, 0],
            "RGBPoints": [0, 0.2, 0.3, 0.8, 0.5, 0.9, 0.9, 0.9, 1, 0.7, 0, 0.1],
            "Points": [0, 0, 0.5, 0, 1, 1, 0.25, 0.5]}]""",
        "indexed.json": """[{"Name": "a", "ColorSpace": "HSV", "RGBPoints": [1, 0, 0, 0, 2, 1, 1, 1]},
            {"Name": "b", "ColorSpace": "Lab", "RGBPoints": [1, 0, 0, 0, 2, 1, 1, 1]}]"""},
    "slicer": {"ct.vp": "1\n1\n0.1\n0.9\n0.2\n1\n6 -1000 0 100 0.1 3000 1\n4 0 1 255 1\n"
                        "12 -1000 0 0 0 100 0.5 0.25 0.125 3000 1 1 1\n"},
}

folder = sys.argv[1]


def take(target, file):
    os.makedirs(os.path.join(folder, target), exist_ok=True)
    shutil.copy(file, os.path.join(folder, target, os.path.basename(os.path.dirname(file)) + "_"
                                   + os.path.basename(file)))


def take_volumes(volumes):
    for target, files in VOLUMES.items():
        for file in files:
            take(target, os.path.join(volumes, file))


if len(sys.argv) > 2:
    take_volumes(sys.argv[2])
else:
    with tempfile.TemporaryDirectory() as written:
        writer = os.path.join(root, "tests/node/write_volumes.py")
        subprocess.run(["/usr/bin/python3", writer, written], check=True, stdout=subprocess.DEVNULL)
        take_volumes(written)
for file in glob.glob(os.path.join(root, "configs/scenes/*.json")):
    take("scene", file)
for target, texts in TEXTS.items():
    for name, text in texts.items():
        os.makedirs(os.path.join(folder, target), exist_ok=True)
        with open(os.path.join(folder, target, name), "w") as out:
            out.write(text)
