# SPDX-License-Identifier: Apache-2.0
"""Writes float R, G, B as an uncompressed OpenEXR file (openexr.com, "OpenEXR File Layout")."""

import os
import struct
import numpy as np


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def write_exr(path, pixels):
    """pixels: (height, width, 3) in lux; row 0 comes first. Written beside, then renamed."""
    height, width, _ = pixels.shape
    channels = b"".join(name + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2)
    header += attribute("channels", "chlist", channels)
    header += attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", window)
    header += attribute("displayWindow", "box2i", window)
    header += attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("sconce:unit", "string", b"lux")
    header += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    header += b"\0"
    line = 8 + 12 * width
    first = len(header) + 8 * height
    planar = np.ascontiguousarray(pixels[:, :, ::-1].transpose(0, 2, 1), "<f4")  # row by row: all B, all G, all R
    with open(path + ".part", "wb") as file:
        file.write(header)
        file.write(struct.pack(f"<{height}Q", *(first + y * line for y in range(height))))
        for y in range(height):
            file.write(struct.pack("<ii", y, 12 * width))
            file.write(planar[y].tobytes())
    os.replace(path + ".part", path)
