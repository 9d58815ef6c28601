#!/usr/bin/python3
"""write_volumes.py FOLDER: writes one volume in many formats, each by a program that is not burin.

FOLDER/cases.txt has a line for each: file, option, dims, type, expected, geometry, divided by tabs.
"option" is component=N, series=N or "-"; "expected" names a file with the values that burin is to
deliver, converted by NumPy; "geometry" is anatomical (0 or 1), spacing, origin and the direction of each
axis, or "-" where the writer has no say in it. FOLDER/refused.txt has files that are broken: file, and
texts that the message must have; FOLDER/pairs.txt pairs of files with the same volume. What is not installed is named in FOLDER/missing.txt.
"""
import importlib
import os
import subprocess
import sys

try:
    import numpy as np
except ImportError:
    with open(os.path.join(sys.argv[1], "missing.txt"), "w") as out:
        out.write("numpy\n")
    sys.exit()

SHAPE = (6, 5, 7)  # z, y, x
SPACING = (0.5, 2.0, 1.25)  # x, y, z
ORIGIN = (-3.0, 10.5, 4.0)
IDENTITY = (1, 0, 0, 0, 1, 0, 0, 0, 1)
TYPES = {"u8": "u1", "i8": "i1", "u16": "u2", "i16": "i2", "u32": "u4", "i32": "i4", "u64": "u8",
         "i64": "i8", "f32": "f4", "f64": "f8"}
DELIVERED = {"u8": "u8", "i8": "i16", "u16": "u16", "i16": "i16"}  # the others: f32

folder = sys.argv[1]
cases = []
refused = []
pairs = []
missing = []


def sample(name, components=1):
    """Numbers over the whole range of a type, its extremes among them."""
    random = np.random.default_rng(7)
    dtype = np.dtype(TYPES[name])
    shape = SHAPE if components == 1 else SHAPE + (components,)
    if dtype.kind == "f":
        return (random.standard_normal(shape) * 1000).astype(dtype)
    limits = np.iinfo(dtype)
    values = random.integers(limits.min, limits.max, shape, dtype=dtype, endpoint=True)
    values.flat[:2] = limits.min, limits.max
    return values


def path(name):
    return os.path.join(folder, name)


def case(name, values, delivered, geometry, component=None, series=None):
    """`values` in data units, z slowest."""
    option = f"component={component}" if component is not None else f"series={series}" if series else "-"
    expected = f"expected{len(cases)}.raw"
    values.astype(TYPES[delivered]).tofile(path(expected))
    dims = " ".join(str(n) for n in reversed(values.shape))
    shown = "-" if geometry is None else " ".join(repr(float(n)) for n in geometry)
    cases.append(f"{name}\t{option}\t{dims}\t{delivered}\t{expected}\t{shown}")


def refuse(name, *parts):
    refused.append("\t".join((name,) + parts))


def cut(name, shorter, part):
    """The first `part` of a file."""
    with open(path(name), "rb") as whole, open(path(shorter), "wb") as out:
        data = whole.read()
        out.write(data[:int(len(data) * part)])


def edit(name, edited, old, new):
    with open(path(name), "rb") as whole, open(path(edited), "wb") as out:
        data = whole.read()
        assert old in data, (name, old)
        out.write(data.replace(old, new, 1))


def delivered_type(name):
    return DELIVERED.get(name, "f32")


def plain(origin=(0, 0, 0), spacing=SPACING):
    return (0,) + tuple(spacing) + tuple(origin) + IDENTITY


def section(*modules_or_programs):
    """Runs the decorated function if all these are installed."""
    def run(write):
        found = {}
        for name in modules_or_programs:
            if name.startswith("/"):
                if not os.path.exists(name):
                    missing.append(name)
                continue
            try:
                found[name] = importlib.import_module(name)
            except ImportError:
                missing.append(name)
        if not set(modules_or_programs) & set(missing):
            write(*found.values())
    return run


@section("/usr/bin/teem-unu")
def nrrd():
    unu_types = dict(zip(TYPES, ("uint8", "int8", "uint16", "int16", "uint32", "int32", "uint64",
                                 "int64", "float", "double")))
    unu = "/usr/bin/teem-unu"
    for name, unu_type in unu_types.items():
        values = sample(name)
        values.tofile(path("unu.raw"))
        make = [unu, "make", "-i", path("unu.raw"), "-t", unu_type, "-s", "7", "5", "6", "-sp",
                *map(str, SPACING), "-en", "little", "-e", "raw", "-o"]
        subprocess.run(make + [path("unu.nrrd")], check=True)
        for extension, encoding, endian in (("nrrd", "raw", "little"), ("nrrd", "raw", "big"),
                                            ("nhdr", "raw", "big"), ("nrrd", "gzip", "big"),
                                            ("nhdr", "gzip", "little"), ("nrrd", "ascii", "little")):
            if encoding == "ascii" and name in ("f32", "f64"):
                continue  # unu writes eight digits
            file = f"unu_{name}_{encoding}_{endian}.{extension}"
            subprocess.run([unu, "save", "-f", "nrrd", "-e", encoding, "-en", endian, "-i",
                            path("unu.nrrd"), "-o", path(file)], check=True)
            case(file, values, delivered_type(name), plain())
    values = sample("u8", 3)
    values.tofile(path("unu.raw"))
    subprocess.run([unu, "make", "-i", path("unu.raw"), "-t", "uchar", "-s", "3", "7", "5", "6",
                    "-k", "RGB-color", "space", "space", "space", "-e", "raw", "-o",
                    path("unu_rgb.nrrd")], check=True)
    for component in range(3):
        case("unu_rgb.nrrd", values[..., component], "u8", plain(spacing=(1, 1, 1)), component)
    # Segmentations as 3D Slicer saves them; the second one's segments overlap.
    segments = [("liver", "0.867 0.51 0.396", 5, 0), ("left \"kidney\"", "0.5 1 0", 2, 1)]
    for file, values, axes in (("unu_one.seg.nrrd", sample("u8") % 6, []),
                               ("unu_two.seg.nrrd", sample("u8", 2) % 6, ["2"])):
        values.tofile(path("unu.raw"))
        kinds = ["list"] * len(axes) + ["domain"] * 3
        subprocess.run([unu, "make", "-i", path("unu.raw"), "-t", "uchar", "-s", *axes, "7", "5", "6",
                        "-k", *kinds, "-e", "raw", "-kv", "Segmentation_ContainedRepresentationNames:=x",
                        "-o", path("unu.nrrd")], check=True)
        # unu takes no values with blanks.
        keys = "".join(f"Segment{i}_{key}:={value}\n" for i, segment in enumerate(segments)
                       for key, value in zip(("Name", "Color", "LabelValue", "Layer"), segment))
        edit("unu.nrrd", file, b"Segmentation_C", keys.encode() + b"Segmentation_C")
        for component in range(len(axes) and 2):
            case(file, values[..., component], "u8", plain(spacing=(1, 1, 1)), component)
    case("unu_one.seg.nrrd", sample("u8") % 6, "u8", plain(spacing=(1, 1, 1)))


@section("vtk", "vtk.util.numpy_support")
def vtk_formats(vtk, support):
    def image(values, is_of_cells=False):
        data = vtk.vtkImageData()
        components = 1 if values.ndim == 3 else values.shape[3]
        array = support.numpy_to_vtk(values.reshape(-1, components) if components > 1
                                     else values.ravel(), deep=True)
        array.SetName("values")
        data.SetDimensions(*(n + is_of_cells for n in reversed(values.shape[:3])))
        data.SetSpacing(*SPACING)
        data.SetOrigin(*ORIGIN)
        (data.GetCellData() if is_of_cells else data.GetPointData()).SetScalars(array)
        return data

    def write(writer, file, data):
        writer.SetFileName(path(file))
        writer.SetInputData(data)
        writer.Write()

    for name in TYPES:
        values = sample(name)
        data = image(values)
        geometry = plain(ORIGIN)
        for packed in (False, True) if name not in ("u64", "i64") else ():
            for extension in ("mha", "mhd"):
                file = f"vtk_{name}_{'zlib' if packed else 'raw'}.{extension}"
                writer = vtk.vtkMetaImageWriter()
                writer.SetCompression(packed)
                write(writer, file, data)
                case(file, values, delivered_type(name), geometry)
        for is_text in (False, True):
            if is_text and name in ("u8", "f32", "f64"):
                continue  # fewer digits than it takes; u8 as colours from 0 to 1
            writer = vtk.vtkStructuredPointsWriter()
            writer.SetFileType(vtk.VTK_ASCII if is_text else vtk.VTK_BINARY)
            file = f"vtk_{name}_{'ascii' if is_text else 'binary'}.vtk"
            write(writer, file, data)
            case(file, values, delivered_type(name), geometry)
        for mode in ("ascii", "base64", "raw", "appended64"):
            for packed in (False, True):
                for is_big in (False, True):
                    writer = vtk.vtkXMLImageDataWriter()
                    writer.SetCompressorTypeToZLib() if packed else writer.SetCompressorTypeToNone()
                    writer.SetBlockSize(256)  # several blocks, the last one smaller
                    {"ascii": writer.SetDataModeToAscii, "base64": writer.SetDataModeToBinary}.get(
                        mode, writer.SetDataModeToAppended)()
                    writer.SetEncodeAppendedData(mode == "appended64")
                    writer.SetByteOrderToBigEndian() if is_big else writer.SetByteOrderToLittleEndian()
                    writer.SetHeaderTypeToUInt64() if is_big else writer.SetHeaderTypeToUInt32()
                    file = f"vtk_{name}_{mode}_{'zlib' if packed else 'plain'}_{'big' if is_big else 'little'}.vti"
                    write(writer, file, data)
                    case(file, values, delivered_type(name), geometry)
    values = sample("i16", 2)
    for writer, file in ((vtk.vtkMetaImageWriter(), "vtk_two.mha"),
                         (vtk.vtkStructuredPointsWriter(), "vtk_two.vtk"),
                         (vtk.vtkXMLImageDataWriter(), "vtk_two.vti")):
        write(writer, file, image(values))
        case(file, values[..., 1], "i16", plain(ORIGIN), 1)
    values = sample("u16")
    middle = tuple(o + s / 2 for o, s in zip(ORIGIN, SPACING))
    for writer, file in ((vtk.vtkStructuredPointsWriter(), "vtk_cells.vtk"),
                         (vtk.vtkXMLImageDataWriter(), "vtk_cells.vti")):
        write(writer, file, image(values, True))
        case(file, values, "u16", plain(middle))
    turned = image(values)
    turned.SetDirectionMatrix(0, -1, 0, 0, 0, 1, -1, 0, 0)
    write(vtk.vtkXMLImageDataWriter(), "vtk_turned.vti", turned)
    case("vtk_turned.vti", values, "u16",
         (0,) + SPACING + ORIGIN + (0, 0, -1, -1, 0, 0, 0, 1, 0))

    for name in ("u8", "i8", "u16", "i16", "u32", "i32", "f32", "f64"):
        for extension in ("nii", "nii.gz"):
            file = f"vtk_{name}.{extension}"
            write(vtk.vtkNIFTIImageWriter(), file, image(sample(name)))
            case(file, sample(name), delivered_type(name), None)

    for name in ("u8", "u16"):
        values = sample(name)
        os.mkdir(path(f"png_{name}"))
        for z in range(SHAPE[0]):
            # VTK's first row is at the bottom of a picture.
            write(vtk.vtkPNGWriter(), f"png_{name}/slice{z + 8}.png",
                  image(np.ascontiguousarray(values[z:z + 1, ::-1, :])))
        case(f"png_{name}", values, name, plain(spacing=(1, 1, 1)))
        case(f"png_{name}/slice%d.png", values, name, plain(spacing=(1, 1, 1)))


    large = np.tile(sample("i32"), (4, 4, 4))  # enough for compressed data to have a middle
    for mode, name in ((False, "cut_raw"), (True, "cut_zlib")):
        writer = vtk.vtkXMLImageDataWriter()
        writer.SetCompressorTypeToZLib() if mode else writer.SetCompressorTypeToNone()
        writer.SetEncodeAppendedData(False)
        write(writer, "large.vti", image(large))
        cut("large.vti", f"{name}.vti", 0.6)
        refuse(f"{name}.vti", f"{name}.vti", "truncated")
    writer.SetDataModeToBinary()
    write(writer, "large.vti", image(large))
    cut("large.vti", "cut_64.vti", 0.6)
    refuse("cut_64.vti", "cut_64.vti", "truncated")
    edit("large.vti", "pieces.vti", b'<Piece Extent="0 27', b'<Piece Extent="0 13')
    refuse("pieces.vti", "one piece of the whole")
    edit("large.vti", "dims.vti", b'0 23"', b'0 22"')
    refuse("dims.vti", "one piece of the whole")
    edit("large.vti", "type.vti", b'type="Int32"', b'type="Bit"')
    refuse("type.vti", '"Bit"', "u8, i8")
    edit("large.vti", "xml.vti", b"<ImageData", b"<<ImageData")
    refuse("xml.vti", "bad XML in line")
    edit("large.vti", "kind.vti", b'type="ImageData"', b'type="PolyData"')
    refuse("kind.vti", "PolyData", "expected ImageData")
    writer.SetCompressorTypeToLZ4()
    write(writer, "lz4.vti", image(large))
    refuse("lz4.vti", "vtkLZ4DataCompressor", "vtkZLibDataCompressor")
    for is_text in (False, True):
        writer = vtk.vtkStructuredPointsWriter()
        writer.SetFileType(vtk.VTK_ASCII if is_text else vtk.VTK_BINARY)
        write(writer, "large.vtk", image(large))
        cut("large.vtk", f"cut_{int(is_text)}.vtk", 0.6)
        refuse(f"cut_{int(is_text)}.vtk", "ends early" if is_text else "truncated")
    edit("large.vtk", "grid.vtk", b"STRUCTURED_POINTS", b"RECTILINEAR_GRID")
    refuse("grid.vtk", "RECTILINEAR_GRID", "STRUCTURED_POINTS")
    edit("large.vtk", "count.vtk", b"DIMENSIONS 28", b"DIMENSIONS 27")
    refuse("count.vtk", "POINT_DATA", "expected for DIMENSIONS")
    edit("large.vtk", "negative.vtk", b"DIMENSIONS 28", b"DIMENSIONS -8")
    refuse("negative.vtk", "-8 x 20 x 24")
    refuse("vtk_two.vtk", "2 components per voxel", "--component 0 ... 1")
    refuse("vtk_two.vti", "2 components per voxel")
    edit("vtk_u16_raw.mhd", "nowhere.mhd", b"vtk_u16_raw.raw", b"nowhere.raw")
    refuse("nowhere.mhd", "nowhere.raw", "no such file")

    refuse("png_u8/slice8.png", "one picture is no volume", "slice%03d.png")
    refuse("png_u8/other%d.png", "no such files")
    os.mkdir(path("png_gap"))
    os.mkdir(path("png_sizes"))
    for number in (1, 2, 4):
        write(vtk.vtkPNGWriter(), f"png_gap/{number}.png", image(sample("u8")[:1]))
        write(vtk.vtkPNGWriter(), f"png_sizes/{min(number, 3)}.png", image(sample("u8")[:1, :, :number]))
    refuse("png_gap", "number 3 is missing before 4.png")
    refuse("png_sizes", "2.png", "2 x 5 x 1 voxels", "1 x 5 x 1")


@section("tifffile")
def tiff(tifffile):
    for name in TYPES:
        if name in ("u64", "i64"):
            continue  # OpenImageIO has no such pixels
        values = sample(name)
        for endian in "<>":
            for packing in (None, "zlib"):
                file = f"tifffile_{name}_{'big' if endian == '>' else 'little'}_{packing or 'raw'}.tif"
                tifffile.imwrite(path(file), values, byteorder=endian, compression=packing,
                                 photometric="minisblack")
                case(file, values, delivered_type(name), plain(spacing=(1, 1, 1)))
    values = sample("u16")
    tifffile.imwrite(path("imagej.tif"), values, imagej=True, resolution=(1 / 0.5, 1 / 2.0),
                     metadata={"spacing": 1.25, "unit": "um", "axes": "ZYX"})
    case("imagej.tif", values, "u16", plain())
    tifffile.imwrite(path("tiled.tif"), values, tile=(16, 16), photometric="minisblack")
    case("tiled.tif", values, "u16", plain(spacing=(1, 1, 1)))
    values = sample("u8", 3)
    tifffile.imwrite(path("rgb.tif"), values, photometric="rgb")
    case("rgb.tif", values[..., 2], "u8", plain(spacing=(1, 1, 1)), 2)
    refuse("rgb.tif", "3 components per voxel", "--component 0 ... 2")
    cut("tifffile_u16_little_raw.tif", "cut.tif", 0.5)
    refuse("cut.tif", "cut.tif")
    tifffile.imwrite(path("page.tif"), sample("u8")[0], photometric="minisblack")
    refuse("page.tif", "one picture is no volume")


@section("h5py")
def hdf5(h5py):
    with h5py.File(path("many.h5"), "w") as many:
        for name, dtype in TYPES.items():
            values = sample(name)
            for endian in "<>":
                for packing in ("raw", "gzip", "shuffle"):
                    options = {} if packing == "raw" else {
                        "chunks": (2, 3, 4), "compression": "gzip", "shuffle": packing == "shuffle"}
                    dataset = f"{name}/{'big' if endian == '>' else 'little'}/{packing}"
                    many.create_dataset(dataset, data=values.astype(endian + dtype), **options)
                    many[dataset].attrs["element_size_um"] = tuple(reversed(SPACING))
                    case(f"many.h5:/{dataset}", values, delivered_type(name), plain())
        values = sample("f32", 2)
        many["vectors"] = values
        case("many.h5:/vectors", values[..., 1], "f32", plain(spacing=(1, 1, 1)), 1)
    values = sample("f64")
    with h5py.File(path("one.h5"), "w") as one:
        one["a/volume"] = values[np.newaxis]
        one["a/volume"].attrs["spacing"] = tuple(reversed(SPACING))
        one["a/volume"].attrs["origin"] = tuple(reversed(ORIGIN))
        one["names"] = [1, 2, 3]
    case("one.h5", values, "f32", plain(ORIGIN))
    refuse("many.h5", "datasets with 3 dimensions", "many.h5:/PATH", "/f32/big/gzip")
    refuse("many.h5:/nothing", "no dataset /nothing", "/f32/big/gzip")
    refuse("one.h5:/names", "3 (expected a volume")
    refuse("many.h5:/vectors", "2 components per voxel")
    cut("one.h5", "cut.h5", 0.7)
    refuse("cut.h5", "bad HDF5 file", "truncated")
    with h5py.File(path("odd.h5"), "w") as odd:
        odd.create_dataset("text", data=np.full(SHAPE, b"word"))
        odd.create_dataset("five", data=np.zeros((2, 2, 2, 2, 2)))
        odd.create_dataset("outside", SHAPE, "u1", external=[(path("outside.raw"), 0, 210)])
        odd.create_dataset("empty", (0, 4, 4), "u1")
        layout = h5py.VirtualLayout(SHAPE, "u1")
        layout[...] = h5py.VirtualSource("absent.h5", "volume", SHAPE)
        odd.create_virtual_dataset("virtual", layout)
        for name, source in (("loop", (".", "loop")), ("there", (".", "back")),
                             ("back", ("odd.h5", "there")), ("nothing", ("odd.h5", "nowhere"))):
            layout = h5py.VirtualLayout(SHAPE, "u1")
            layout[...] = h5py.VirtualSource(source[0], source[1], SHAPE)
            odd.create_virtual_dataset(name, layout)
        odd["fifo"] = h5py.ExternalLink("fifo.h5", "/volume")
    os.mkfifo(path("fifo.h5"))
    refuse("odd.h5:/text", "not supported", "u8, i8")
    refuse("odd.h5:/five", "2 x 2 x 2 x 2 x 2", "3 dimensions")
    refuse("odd.h5:/outside", "outside.raw", "no such file")
    refuse("odd.h5:/virtual", "absent.h5", "no such file")
    refuse("odd.h5:/empty", "4 x 4 x 0")
    refuse("odd.h5:/loop", "/loop is made of itself")
    refuse("odd.h5:/there", "/there is made of itself")
    refuse("odd.h5:/nothing", "no dataset /nowhere")
    refuse("odd.h5:/fifo", "no dataset /fifo")


@section("pydicom", "pydicom.uid", "pydicom.encaps", "/usr/bin/dcmcrle", "/usr/bin/dcmcjpeg", "/usr/bin/dcmcjpls")
def dicom(pydicom, uid, _):
    from pydicom.dataset import Dataset, FileDataset, FileMetaDataset

    def write_slice(file, pixels, position, orientation, syntax=uid.ExplicitVRLittleEndian,
                    series="1.2.826.0.1.3680043.8.498.1", slope=1, intercept=0, number=1, bits=16,
                    photometric="MONOCHROME2", planar=False):
        meta = FileMetaDataset()
        meta.TransferSyntaxUID = syntax
        meta.MediaStorageSOPClassUID = "1.2.840.10008.5.1.4.1.1.2"  # CT
        meta.MediaStorageSOPInstanceUID = f"{series}.{number}"
        set_ = FileDataset(file, {}, file_meta=meta, preamble=b"\0" * 128)
        set_.is_little_endian = syntax != uid.ExplicitVRBigEndian
        set_.is_implicit_VR = syntax == uid.ImplicitVRLittleEndian
        set_.SOPClassUID, set_.SOPInstanceUID = meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID
        set_.Modality, set_.SeriesDescription, set_.SeriesInstanceUID = "CT", "head", series
        set_.StudyInstanceUID, set_.InstanceNumber = "1.2.826.0.1.3680043.8.498.0", number
        set_.ImagePositionPatient = [f"{p:.6f}" for p in position]
        set_.ImageOrientationPatient = [f"{o:.6f}" for o in orientation]
        set_.PixelSpacing = [SPACING[1], SPACING[0]]
        set_.SliceThickness = 3
        set_.Rows, set_.Columns = pixels.shape[:2]
        set_.SamplesPerPixel, set_.PhotometricInterpretation = 1, photometric
        if pixels.ndim == 3:
            set_.SamplesPerPixel, set_.PlanarConfiguration = pixels.shape[2], int(planar)
            pixels = np.moveaxis(pixels, 2, 0) if planar else pixels
        set_.BitsAllocated = pixels.dtype.itemsize * 8
        set_.BitsStored = min(bits, set_.BitsAllocated)
        set_.HighBit = set_.BitsStored - 1
        set_.PixelRepresentation = int(pixels.dtype.kind == "i")
        set_.RescaleSlope, set_.RescaleIntercept = slope, intercept
        if not set_.is_little_endian:
            pixels = pixels.byteswap()
        raw = pixels.tobytes()
        set_.PixelData = raw + b"\0" * (len(raw) % 2)
        set_.save_as(file, write_like_original=False)

    def write_series(name, values, normal=(0, 0, 1), orientation=(1, 0, 0, 0, 1, 0), **more):
        os.mkdir(path(name))
        for z in range(SHAPE[0]):
            position = [o + z * SPACING[2] * n for o, n in zip(ORIGIN, normal)]
            # In an order of names that is not that of positions.
            write_slice(path(f"{name}/{(z * 5 + 2) % 6}.dcm"), values[z], position, orientation,
                        number=z + 1, **more)

    axial = (1,) + SPACING + ORIGIN + IDENTITY
    for name in ("u8", "i8", "u16", "i16"):
        write_series(f"dicom_{name}", sample(name))
        case(f"dicom_{name}", sample(name), delivered_type(name), axial)
    for syntax in ("ImplicitVRLittleEndian", "ExplicitVRBigEndian"):
        write_series(f"dicom_{syntax}", sample("i16"), syntax=getattr(uid, syntax))
        case(f"dicom_{syntax}", sample("i16"), "i16", axial)
    twelve = sample("u16") & 0xfff
    write_series("dicom_hu", twelve, intercept=-1024, bits=12)
    case("dicom_hu", twelve.astype("i4") - 1024, "i16", axial)
    write_series("dicom_scaled", sample("i16"), slope=0.5, intercept=-3)
    case("dicom_scaled", sample("i16") * 0.5 - 3, "f32", axial)
    # Coronal: rows to the left, columns down, slices from the front to the back would be left-handed.
    write_series("dicom_coronal", sample("u16"), normal=(0, 1, 0), orientation=(1, 0, 0, 0, 0, -1))
    case("dicom_coronal", sample("u16"), "u16",
         (1,) + SPACING + ORIGIN + (1, 0, 0, 0, 0, -1, 0, 1, 0))
    tilt = (0, 0.6, 0.8)
    write_series("dicom_tilted", sample("u16"), normal=tilt)
    case("dicom_tilted", sample("u16"), "u16",
         (1,) + SPACING + ORIGIN + (1, 0, 0, 0, 1, 0) + tilt)
    for program, option in (("dcmcrle", []), ("dcmcjpeg", ["+e1"]), ("dcmcjpls", ["+el"])):
        os.mkdir(path(f"dicom_{program}"))
        for z in range(SHAPE[0]):
            subprocess.run([f"/usr/bin/{program}", *option, path(f"dicom_hu/{z}.dcm"),
                            path(f"dicom_{program}/{z}.dcm")], check=True)
        case(f"dicom_{program}", twelve.astype("i4") - 1024, "i16", axial)

    # Bits above the pixel's own, where overlays once lay; of numbers with a sign, too.
    other_bits = sample("u16") & 0xf000
    write_series("dicom_overlay", twelve | other_bits, bits=12)
    case("dicom_overlay", twelve, "u16", axial)
    signed = (twelve.astype("i4") - 2048).astype("i2")
    write_series("dicom_sign", ((signed & 0xfff) | other_bits.view("i2")).astype("i2"), bits=12)
    case("dicom_sign", signed, "i16", axial)

    colours = sample("u8", 3)
    for name, options in (("rgb", {"photometric": "RGB"}),
                          ("planes", {"photometric": "RGB", "planar": True}),
                          ("ybr", {"photometric": "YBR_FULL"})):
        write_series(f"dicom_{name}", colours, **options)
    for source, program, option in (("planes", "dcmcrle", []), ("rgb", "dcmcjpeg", ["+e1"]),
                                    ("rgb", "dcmcjpls", ["+el"])):
        os.mkdir(path(f"dicom_{source}_{program}"))
        for z in range(SHAPE[0]):
            subprocess.run([f"/usr/bin/{program}", *option, path(f"dicom_{source}/{z}.dcm"),
                            path(f"dicom_{source}_{program}/{z}.dcm")], check=True)
    for name in ("rgb", "planes", "ybr", "planes_dcmcrle", "rgb_dcmcjpeg", "rgb_dcmcjpls"):
        case(f"dicom_{name}", colours[..., 1], "u8", axial, 1)
    refuse("dicom_rgb", "3 components per voxel", "--component 0 ... 2")
    write_slice(path("dicom_422.dcm"), colours[0], ORIGIN, (1, 0, 0, 0, 1, 0), photometric="YBR_FULL_422")
    refuse("dicom_422.dcm", "YBR_FULL_422", "RGB or YBR_FULL")
    packed = pydicom.dcmread(path("dicom_u16/0.dcm"))
    packed.file_meta.TransferSyntaxUID = uid.JPEG2000Lossless
    packed.PixelData = pydicom.encaps.encapsulate([b"any code stream"])
    packed["PixelData"].is_undefined_length = True
    packed.save_as(path("dicom_2000.dcm"))
    refuse("dicom_2000.dcm", "1.2.840.10008.1.2.4.90", "JPEG 2000", "gdcmconv --raw")

    def enhance(file, enhanced, values, normal, slopes=None):
        """From a slice to an enhanced CT of several frames, which may have slopes of their own."""
        set_ = pydicom.dcmread(file)
        set_.SOPClassUID = set_.file_meta.MediaStorageSOPClassUID = "1.2.840.10008.5.1.4.1.1.2.1"
        set_.NumberOfFrames = len(values)
        set_.PixelData = values.tobytes()
        shared = Dataset()
        shared.PlaneOrientationSequence = [Dataset()]
        shared.PlaneOrientationSequence[0].ImageOrientationPatient = set_.ImageOrientationPatient
        shared.PixelMeasuresSequence = [Dataset()]
        shared.PixelMeasuresSequence[0].PixelSpacing = set_.PixelSpacing
        shared.PixelMeasuresSequence[0].SliceThickness = SPACING[2]
        shared.PixelValueTransformationSequence = [Dataset()]
        shared.PixelValueTransformationSequence[0].RescaleSlope = 1
        shared.PixelValueTransformationSequence[0].RescaleIntercept = 0
        set_.SharedFunctionalGroupsSequence = [shared]
        set_.PerFrameFunctionalGroupsSequence = []
        for z in range(len(values)):
            frame = Dataset()
            frame.PlanePositionSequence = [Dataset()]
            frame.PlanePositionSequence[0].ImagePositionPatient = [
                o + z * SPACING[2] * n for o, n in zip(ORIGIN, normal)]
            if slopes is not None:
                frame.PixelValueTransformationSequence = [Dataset()]
                frame.PixelValueTransformationSequence[0].RescaleSlope = slopes[z]
                frame.PixelValueTransformationSequence[0].RescaleIntercept = 0
            set_.PerFrameFunctionalGroupsSequence.append(frame)
        for name in ("ImagePositionPatient", "ImageOrientationPatient", "PixelSpacing",
                     "SliceThickness", "RescaleSlope", "RescaleIntercept"):
            delattr(set_, name)
        set_.save_as(enhanced)

    for name, normal in (("dicom_frames.dcm", (0, 0, 1)), ("dicom_frames_down.dcm", (0, 0, -1))):
        enhance(path("dicom_u16/0.dcm"), path(name), sample("u16"), normal)
        case(name, sample("u16"), "u16", (1,) + SPACING + ORIGIN + (1, 0, 0, 0, 1, 0) + normal)
    slopes = [0.5 + z for z in range(SHAPE[0])]
    enhance(path("dicom_u16/0.dcm"), path("dicom_slopes.dcm"), sample("u16"), (0, 0, 1), slopes)
    case("dicom_slopes.dcm", sample("u16") * np.array(slopes)[:, None, None], "f32", axial)
    cut("dicom_frames.dcm", "cut_frames.dcm", 0.9)
    refuse("cut_frames.dcm", "truncated")

    def copies(name, of, numbers):
        os.mkdir(path(name))
        for z in numbers:
            cut(f"{of}/{z}.dcm", f"{name}/{z}.dcm", 1)

    other = "1.2.826.0.1.3680043.8.498.2"
    write_series("dicom_mixed", sample("u16"))
    os.mkdir(path("dicom_mixed/more"))
    for z in range(SHAPE[0]):
        write_slice(path(f"dicom_mixed/more/{z}"), sample("i16")[z],
                    (ORIGIN[0], ORIGIN[1], ORIGIN[2] + SPACING[2] * z), (1, 0, 0, 0, 1, 0),
                    series=other, number=z)
    case("dicom_mixed", sample("u16"), "u16", axial, series=1)
    case("dicom_mixed", sample("i16"), "i16", axial, series=other)
    refuse("dicom_mixed", "2 DICOM series", "--series", "1: CT head (6 images", other)
    copies("dicom_gap", "dicom_u16", (0, 1, 2, 3, 5))  # 4 holds the last but one
    refuse("dicom_gap", "slices are missing", "2.5 mm", "1.25 mm elsewhere")
    copies("dicom_twice", "dicom_u16", range(6))
    write_slice(path("dicom_twice/again.dcm"), sample("u16")[0], ORIGIN, (1, 0, 0, 0, 1, 0), number=9)
    refuse("dicom_twice", "two slices at one position", "again.dcm")
    os.mkdir(path("dicom_times"))
    for number in range(3):
        write_slice(path(f"dicom_times/{number}.dcm"), sample("u16")[0], ORIGIN, (1, 0, 0, 0, 1, 0),
                    number=number)
    refuse("dicom_times", "two slices at one position")
    copies("dicom_sizes", "dicom_u16", range(6))
    write_slice(path("dicom_sizes/7.dcm"), sample("u16")[0, :4], (0, 0, 20), (1, 0, 0, 0, 1, 0), number=9)
    refuse("dicom_sizes", "differ", "7 x 4 x 1")
    copies("dicom_turned", "dicom_u16", range(6))
    write_slice(path("dicom_turned/7.dcm"), sample("u16")[0], (0, 0, 20), (0, 1, 0, 1, 0, 0), number=9)
    refuse("dicom_turned", "not parallel", "7.dcm")
    copies("dicom_cut", "dicom_u16", range(6))
    cut("dicom_u16/3.dcm", "dicom_cut/3.dcm", 0.95)
    refuse("dicom_cut", "3.dcm", "truncated")
    copies("dicom_cut_jpeg", "dicom_dcmcjpeg", range(6))
    cut("dicom_dcmcjpeg/3.dcm", "dicom_cut_jpeg/3.dcm", 0.9)
    refuse("dicom_cut_jpeg", "3.dcm", "truncated")
    copies("dicom_cut_header", "dicom_u16", range(6))
    with open(path("dicom_u16/5.dcm"), "rb") as whole, open(path("dicom_cut_header/5.dcm"), "wb") as out:
        out.write(whole.read()[:300])
    refuse("dicom_cut_header", "5.dcm", "truncated")
    os.mkdir(path("dicom_empty"))
    refuse("dicom_empty", "without DICOM images")


@section("pydicom", "/usr/bin/dcm2niix")
def converted(_):
    os.mkdir(path("one_file"))
    os.symlink("../dicom_frames_down.dcm", path("one_file/frames.dcm"))
    for series in ("dicom_hu", "dicom_coronal", "one_file"):
        if not os.listdir(path(series)):
            continue
        subprocess.run(["/usr/bin/dcm2niix", "-b", "n", "-z", "n", "-f", series, "-o", folder,
                        path(series)], check=True)
        pairs.append(f"{series}\t{series}.nii")


with open(path("pairs.txt"), "w") as out:
    out.write("".join(line + "\n" for line in pairs))
with open(path("cases.txt"), "w") as out:
    out.write("".join(line + "\n" for line in cases))
with open(path("refused.txt"), "w") as out:
    out.write("".join(line + "\n" for line in refused))
with open(path("missing.txt"), "w") as out:
    out.write("".join(name + "\n" for name in missing))
