"""What is drawn: volumes, transfer functions, cameras; the same numbers for burin and its peers.

Every program reads the same bare voxels (NAME.raw); for burin a NAME.nhdr describes them.
"""

import dataclasses
import gzip
import json
import math
import pathlib
import subprocess

import numpy

FOV_DEG = 30
TYPES = {"uint8": "u1", "unsigned char": "u1", "uchar": "u1", "short": "<i2", "int16": "<i2",
         "unsigned short": "<u2", "uint16": "<u2", "float": "<f4"}
NRRD_NAMES = {"|u1": "uint8", "<i2": "int16", "<u2": "uint16", "<f4": "float"}


@dataclasses.dataclass
class Look:
    """A transfer function (value, sRGB colour, opacity per smallest spacing) and a point of view."""
    points: list
    azimuth_deg: float = 30
    elevation_deg: float = 20
    up: str = "y"
    zoom: float = 1.2
    source: str = ""  # file in the folder of real data; without it, procedural: see volume()


LOOKS = {
    "foot": Look([(40, "#d9a07a", 0), (70, "#d9a07a", 0.03), (90, "#e8d0b0", 0.02),
                  (110, "#f4ead8", 0.1), (160, "#fff7e6", 0.6)],
                 source="foot_256x256x256_uint8.nrrd"),
    "bonsai": Look([(25, "#6f9a4a", 0), (50, "#6f9a4a", 0.08), (90, "#8a6a45", 0.1),
                    (140, "#9a7a55", 0.4), (220, "#d8d0c0", 0.6)],
                   source="bonsai_256x256x256_uint8.nrrd"),
    "engine": Look([(60, "#8090a8", 0), (110, "#8090a8", 0.03), (150, "#9aa0b0", 0.05),
                    (190, "#d8b070", 0.5), (240, "#ffe0a0", 0.9)],
                   source="engine_256x256x128_uint8.nrrd"),
    "ctcranium": Look([(-400, "#e8b49a", 0), (-200, "#e8b49a", 0.02), (50, "#f0c7b0", 0.01),
                       (250, "#e8dcc0", 0), (700, "#fff7e6", 0.6)],
                      up="z", source="ctcranium_256x256x108_int16.nrrd"),
    "head512": Look([(50, "#e8b49a", 0), (80, "#e8b49a", 0.02), (110, "#f0c7b0", 0.01),
                     (125, "#e8dcc0", 0), (170, "#fff7e6", 0.6)],
                    up="z", source="head512_512x512x262_uint8.nrrd"),
    "wavelet": Look([(40, "#3b4cc0", 0.005), (150, "#dddddd", 0.01), (270, "#b40426", 0.06)]),
    # Stand-ins where there are no real data.
    "ct-phantom": Look([(-700, "#e8b49a", 0), (-400, "#e8b49a", 0.02), (150, "#f0c7b0", 0.01),
                        (300, "#e8dcc0", 0), (700, "#fff7e6", 0.6)]),
    # For a first picture: opaque rays end early, others see most of the volume.
    "shells": Look([(60, "#3b5b8c", 0), (130, "#7a9ac8", 0.02), (255, "#fff0e0", 0.3)]),
    "vessels": Look([(60, "#b43030", 0), (160, "#e06050", 0.3), (255, "#fff0e0", 0.6)]),
}


@dataclasses.dataclass
class Volume:
    name: str
    voxels: numpy.ndarray  # z, y, x
    spacing: tuple


def read_nrrd(path):
    """One attached or detached NRRD file, raw or gzip, as (voxels, spacing)."""
    header, _, data = path.read_bytes().partition(b"\n\n")
    fields = dict(line.split(": ", 1) for line in header.decode("ascii", "replace").splitlines()
                  if ": " in line and not line.startswith("#"))
    if "data file" in fields:
        data = (path.parent / fields["data file"]).read_bytes()
    if fields["encoding"] in ("gzip", "gz"):
        data = gzip.decompress(data)
    shape = [int(n) for n in fields["sizes"].split()][::-1]
    if "spacings" in fields:
        spacing = tuple(float(s) for s in fields["spacings"].split())
    elif "space directions" in fields:
        axes = [a.strip("()").split(",") for a in fields["space directions"].split()]
        spacing = tuple(math.hypot(*map(float, axis)) for axis in axes)
    else:
        spacing = (1.0, 1.0, 1.0)
    kind = numpy.dtype(TYPES[fields["type"]])
    if fields.get("endian") == "big":
        kind = kind.newbyteorder(">")
    voxels = numpy.frombuffer(data, kind, math.prod(shape)).reshape(shape)
    return voxels.astype(kind.newbyteorder("<")), spacing


def wavelet(n):
    """ParaView's Wavelet source with its default parameters, on n^3 points."""
    x = numpy.linspace(-0.5, 0.5, n)
    z, y = x[:, None, None], x[None, :, None]
    gauss = 255 * numpy.exp(-(x * x + y * y + z * z) / (2 * 0.5**2))
    waves = 10 * numpy.sin(60 * x) + 18 * numpy.sin(30 * y) + 5 * numpy.cos(40 * z)
    return (gauss + waves).astype("<f4")


def volume(name, data, work, burin, edge=256):
    """The voxels of `name`: real ones from the folder `data`, otherwise made up."""
    look = LOOKS[name]
    if look.source:
        return Volume(name, *read_nrrd(data / look.source))
    if name == "wavelet":
        return Volume(name, wavelet(edge), (1.0, 1.0, 1.0))
    path = work / f"made-{name}.nrrd"
    kind = "i16" if name == "ct-phantom" else "u8"
    subprocess.run([burin, "make-volume", name, "--dims", f"{edge},{edge},{edge}", "--type", kind,
                    "-o", path], check=True, stdout=subprocess.DEVNULL)
    voxels, spacing = read_nrrd(path)
    path.unlink()
    return Volume(name, voxels, spacing)


def linear(colour):
    """Linear RGB of "#rrggbb"."""
    srgb = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055)**2.4 for c in srgb]


def camera(look, volume_):
    """burin's orbit camera as eye, target, up and vertical view angle."""
    dims = volume_.voxels.shape[::-1]
    target = [(n - 1) * s / 2 for n, s in zip(dims, volume_.spacing)]
    az, el = math.radians(look.azimuth_deg), math.radians(look.elevation_deg)
    side, ahead = math.sin(az), math.cos(az)
    if look.up == "z":
        to_eye = (side * math.cos(el), -ahead * math.cos(el), math.sin(el))
        up = (-side * math.sin(el), ahead * math.sin(el), math.cos(el))
    else:
        to_eye = (side * math.cos(el), math.sin(el), ahead * math.cos(el))
        up = (-side * math.sin(el), math.cos(el), -ahead * math.sin(el))
    half = math.radians(FOV_DEG / 2)
    distance = math.hypot(*target) / math.sin(half)
    return {"eye": [t + distance * d for t, d in zip(target, to_eye)], "target": target, "up": up,
            "angle_deg": 2 * math.degrees(math.atan(math.tan(half) / look.zoom))}


def write_case(volume_, size, work):
    """Writes the voxels, burin's scenes and the peers' description; returns the latter."""
    name, voxels, look = volume_.name, volume_.voxels, LOOKS[volume_.name]
    voxels.tofile(work / f"{name}.raw")
    dims = voxels.shape[::-1]
    kind = NRRD_NAMES[voxels.dtype.str]
    (work / f"{name}.nhdr").write_text(
        f"NRRD0004\ntype: {kind}\ndimension: 3\nsizes: {dims[0]} {dims[1]} {dims[2]}\n"
        f"spacings: {' '.join(map(repr, volume_.spacing))}\nendian: little\nencoding: raw\n"
        f"data file: {name}.raw\n")
    unit = min(volume_.spacing)
    for style, effects in (("plain", {}), ("shaded", {"tone": {}, "edges": {}})):
        scene = {
            "schema_version": 1,
            "volume": {"file": f"{name}.nhdr"},
            "camera": {"azimuth_deg": look.azimuth_deg, "elevation_deg": look.elevation_deg,
                       "up": look.up, "vertical_fov_deg": FOV_DEG, "zoom": look.zoom},
            "image": {"size": [size, size], "background": "#000000"},
            "lights": [{"direction": [0, 0, 1], "space": "eye"}],
            "layers": [{
                "name": name,
                "transfer_function": {
                    "points": [{"value": v, "color": c, "opacity": o} for v, c, o in look.points],
                    "opacity_unit_length": unit},
                "style": effects}]}
        (work / f"{name}-{style}.json").write_text(json.dumps(scene, indent=1))
    return {"name": name, "raw": str((work / f"{name}.raw").resolve()), "dims": dims,
            "dtype": voxels.dtype.str, "spacing": volume_.spacing, "size": size,
            "points": [(v, *linear(c), o) for v, c, o in look.points],
            "range": [float(voxels.min()), float(voxels.max())],
            "unit_length": unit, **camera(look, volume_)}
