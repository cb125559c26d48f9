"""Small files in formats of instruments, written by their layout."""

import io
import struct
import zipfile
from collections.abc import Mapping

import numpy as np

NX, NY = 20, 12
STEP_M = 1e-6
X, Y = np.meshgrid(np.arange(NX), np.arange(NY))
HEIGHT_M = 1e-7 * np.sin(0.5 * X) + 2e-8 * np.cos(0.7 * Y)
"""Rows of constant y."""


def _gwy_object(name: str, content: bytes) -> bytes:
    return name.encode() + b"\0" + struct.pack("<I", len(content)) + content


def gwyddion(channels: Mapping[str, np.ndarray]) -> bytes:
    """Return a file of Gwyddion; channels in metres by their titles."""

    def item(key: str, kind: bytes, value: bytes) -> bytes:
        return key.encode() + b"\0" + kind + value

    def unit(key: str) -> bytes:
        return item(key, b"o", _gwy_object("GwySIUnit", item("unitstr", b"s", b"m\0")))

    content = b""
    for number, (title, heights) in enumerate(channels.items()):
        ny, nx = heights.shape
        sizes = item("xres", b"i", struct.pack("<i", nx)) + item(
            "yres", b"i", struct.pack("<i", ny)
        )
        sizes += item("xreal", b"d", struct.pack("<d", nx * STEP_M))
        sizes += item("yreal", b"d", struct.pack("<d", ny * STEP_M))
        data = struct.pack("<I", heights.size) + heights.astype("<f8").tobytes()
        field = sizes + unit("si_unit_xy") + unit("si_unit_z") + item("data", b"D", data)
        content += item(f"/{number}/data/title", b"s", title.encode() + b"\0")
        content += item(f"/{number}/data", b"o", _gwy_object("GwyDataField", field))
    return b"GWYP" + _gwy_object("GwyContainer", content)


def x3p(folder: str = "", step: float = STEP_M) -> bytes:
    """Return an X3P file, its parts in a folder of the archive."""
    axis = "<AxisType>I</AxisType><DataType>D</DataType>"
    places = f"{axis}<Increment>{step}</Increment><Offset>0</Offset>"
    main = (
        '<?xml version="1.0" encoding="UTF-8"?>'
        '<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2"><Record1>'
        "<Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>"
        f"<CX>{places}</CX><CY>{places}</CY>"
        "<CZ><AxisType>A</AxisType><DataType>D</DataType></CZ></Axes></Record1><Record3>"
        f"<MatrixDimension><SizeX>{NX}</SizeX><SizeY>{NY}</SizeY><SizeZ>1</SizeZ></MatrixDimension>"
        "<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3>"
        "</p:ISO5436_2>"
    )
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        archive.writestr(f"{folder}main.xml", main)
        archive.writestr(f"{folder}bindata/data.bin", HEIGHT_M.astype("<f8").tobytes())
    return made.getvalue()


def sdf(magic: str) -> bytes:
    """Return an SDF file in text."""
    head = (
        f"{magic}\nManufacID  = test\nCreateDate = 010120200000\nModDate    = 010120200000\n"
        f"NumPoints  = {NX}\nNumProfiles = {NY}\nXscale     = {STEP_M}\nYscale     = {STEP_M}\n"
        "Zscale     = 1.0E-9\nZresolution = -1\nCompression = 0\nDataType   = 7\n"
        "CheckType  = 0\n*\n"
    )
    rows = "\n".join(" ".join(f"{1e9 * cell:.9g}" for cell in row) for row in HEIGHT_M)
    return f"{head}{rows}\n*\n".encode()


def metropro(lateral: float) -> bytes:
    """Return a file of MetroPro with a lateral resolution of `lateral` m; 0: not calibrated."""
    head = bytearray(834)
    head[0:10] = struct.pack(">4sHI", b"\x88\x1b\x03\x6f", 1, len(head))
    head[68:72] = struct.pack(">2H", NX, NY)
    head[164:188] = struct.pack(">6f", 1, 633e-9, 0.5, 1, 20, lateral)
    head[218:220] = struct.pack(">h", 2)
    return bytes(head) + np.rint(HEIGHT_M / 633e-9 * 2**17).astype(">i4").tobytes()


def nanofocus(step: float) -> bytes:
    """Return a file of NanoFocus, which has no mark: steps of `step` mm, heights in um."""
    head = bytearray(3468)
    low, high = 1e6 * HEIGHT_M.min(), 1e6 * HEIGHT_M.max()
    head[16:32] = struct.pack("<2d", low, high)
    head[1368:1392] = struct.pack("<2I2d", NX, NY, step, step)
    numbers = np.rint((1e6 * HEIGHT_M - low) / (high - low) * (2**16 - 2)).astype("<u2")
    return bytes(head) + numbers.tobytes()
