# SPDX-License-Identifier: Apache-2.0
"""Reads the scene.glb that sconce writes: float attributes, 32-bit indices, meshes in world space, lamps, textures.

Not Blender's importer: glTF's numbers must arrive as they stand (it converts lamps to watts), nodes must keep their order,
and it fails with numpy 1.24."""

import json
import struct
import numpy as np

WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}


class Glb:
    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        magic, version, _, length, kind = struct.unpack_from("<4sIIII", data)
        if magic != b"glTF" or version != 2 or kind != 0x4E4F534A:
            raise SystemExit(f"{path}: not a glTF 2.0 binary")
        self.root = json.loads(data[20 : 20 + length])
        self.binary = memoryview(data)[20 + length + 8 :]

    def list(self, key):
        return self.root.get(key, [])

    def view(self, index):
        view = self.list("bufferViews")[index]
        start = view.get("byteOffset", 0)
        return self.binary[start : start + view["byteLength"]]

    def array(self, index):
        """(count, width) float32, or (count,) uint32 for indices."""
        accessor = self.list("accessors")[index]
        width = WIDTH[accessor["type"]]
        kind = {5126: np.float32, 5125: np.uint32}[accessor["componentType"]]
        values = np.frombuffer(self.view(accessor["bufferView"]), kind)[: accessor["count"] * width]
        return values.reshape(-1, width) if width > 1 else values

    def mesh(self, node):
        """(attributes by name, triangles (n, 3), material) of a mesh node."""
        primitive = self.list("meshes")[self.list("nodes")[node]["mesh"]]["primitives"][0]
        attributes = {name: self.array(index) for name, index in primitive["attributes"].items()}
        return attributes, self.array(primitive["indices"]).reshape(-1, 3), primitive["material"]

    def lamps(self):
        """(light, 4 x 4 matrix, column vectors) of every KHR_lights_punctual node."""
        lights = self.root.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
        for node in self.list("nodes"):
            if "EXT_lights_ies" in node.get("extensions", {}):
                raise SystemExit(f"{node.get('name')}: measured lamps (EXT_lights_ies) cannot be given to Cycles yet")
            use = node.get("extensions", {}).get("KHR_lights_punctual")
            if use is not None:
                yield lights[use["light"]], matrix(node.get("matrix"))


def matrix(numbers):
    """16 numbers, column-major; None is the identity."""
    return np.eye(4) if numbers is None else np.array(numbers, float).reshape(4, 4).T
