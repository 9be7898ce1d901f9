# SPDX-License-Identifier: Apache-2.0
"""sconce's materials in Cycles: Lambert, emission to the front only, backs black unless double-sided.

Blender's Principled BSDF is not Lambertian even at roughness 1, so it is not used."""

import os
import tempfile
import bpy


class Materials:
    def __init__(self, glb):
        self.glb = glb
        self.images = {}

    def image(self, index):
        """An embedded texture as a Blender image."""
        if index not in self.images:
            data = bytes(self.glb.view(self.glb.list("images")[index]["bufferView"]))
            handle, path = tempfile.mkstemp(suffix=".png" if data[:4] == b"\x89PNG" else ".jpg")
            with os.fdopen(handle, "wb") as file:
                file.write(data)
            self.images[index] = bpy.data.images.load(path)
            self.images[index].pack()
            os.unlink(path)
        return self.images[index]

    def make(self, index, target):
        """Material `index` of the file; `target` is the image that its texels are baked into, or None."""
        source = self.glb.list("materials")[index]
        material = bpy.data.materials.new(source.get("name", "material"))
        material.use_nodes = True
        graph = Graph(material.node_tree, self)
        pbr = source.get("pbrMetallicRoughness", {})
        factor = pbr.get("baseColorFactor", [1, 1, 1, 1])
        front = graph.socket("ShaderNodeNewGeometry", "Backfacing", lambda s: graph.math("SUBTRACT", 1.0, s))
        two_sided = source.get("doubleSided", False)

        color, alpha = graph.color(factor[:3], pbr.get("baseColorTexture"))
        # A layer is without the receiver's albedo: where light is gathered (the bake's own hit counts as the camera's) the
        # surface is white, so that black and textured receivers need no division afterwards.
        receiver = graph.socket("ShaderNodeLightPath", "Is Camera Ray")
        color = graph.mix(receiver, color, (1, 1, 1))
        if not two_sided:
            color = graph.scale(color, front)
        diffuse = graph.node("ShaderNodeBsdfDiffuse")
        diffuse.inputs["Roughness"].default_value = 0
        graph.put(color, diffuse.inputs["Color"])
        shader = diffuse.outputs[0]

        strength = source.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
        emissive = [strength * c for c in source.get("emissiveFactor", [0, 0, 0])]
        if any(emissive):
            emission = graph.node("ShaderNodeEmission")
            light, _ = graph.color(emissive, source.get("emissiveTexture"))
            graph.put(light, emission.inputs["Color"])
            graph.put(1.0 if two_sided else front, emission.inputs["Strength"])
            shader = graph.shader("ShaderNodeAddShader", shader, emission.outputs[0])
        if source.get("alphaMode") == "MASK":
            clear = graph.node("ShaderNodeBsdfTransparent")
            opacity = graph.math("MULTIPLY", factor[3], alpha)
            keep = graph.math("GREATER_THAN", opacity, source.get("alphaCutoff", 0.5) - 1e-6)
            keep = graph.math("MAXIMUM", keep, receiver)  # a hole is no receiver, but its texels have a value
            shader = graph.shader("ShaderNodeMixShader", clear.outputs[0], shader, keep)
        graph.put(shader, graph.node("ShaderNodeOutputMaterial").inputs["Surface"])

        if target is not None:
            node = graph.node("ShaderNodeTexImage")
            node.image = target
            graph.tree.nodes.active = node
        return material


class Graph:
    """Nodes by function calls; a value is a socket, a number or a colour."""

    def __init__(self, tree, materials):
        self.tree = tree
        self.materials = materials
        tree.nodes.clear()

    def node(self, kind):
        return self.tree.nodes.new(kind)

    def put(self, value, socket):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = (*value, 1) if isinstance(value, (tuple, list)) else value

    def socket(self, kind, name, then=lambda s: s):
        return then(self.node(kind).outputs[name])

    def math(self, operation, a, b=0.0):
        node = self.node("ShaderNodeMath")
        node.operation = operation
        self.put(a, node.inputs[0])
        self.put(b, node.inputs[1])
        return node.outputs[0]

    def scale(self, color, factor):
        """color x number"""
        node = self.node("ShaderNodeVectorMath")
        node.operation = "SCALE"
        if isinstance(color, bpy.types.NodeSocket):
            self.put(color, node.inputs[0])
        else:
            node.inputs[0].default_value = color
        self.put(factor, node.inputs["Scale"])
        return node.outputs[0]

    def times(self, color, constant):
        node = self.node("ShaderNodeVectorMath")
        node.operation = "MULTIPLY"
        self.put(color, node.inputs[0])
        node.inputs[1].default_value = constant
        return node.outputs[0]

    def mix(self, factor, a, b):
        node = self.node("ShaderNodeMixRGB")
        for value, name in ((factor, "Fac"), (a, "Color1"), (b, "Color2")):
            self.put(value, node.inputs[name])
        return node.outputs[0]

    def shader(self, kind, a, b, factor=None):
        node = self.node(kind)
        sockets = [s for s in node.inputs if s.type == "SHADER"]
        self.put(a, sockets[0])
        self.put(b, sockets[1])
        if factor is not None:
            self.put(factor, node.inputs[0])
        return node.outputs[0]

    def color(self, factor, use):
        """(factor x texture, alpha of the texture): linear Rec. 709."""
        index = None if use is None else self.materials.glb.list("textures")[use["index"]].get("source")
        if index is None:
            return tuple(factor), 1.0
        image = self.node("ShaderNodeTexImage")
        image.image = self.materials.image(index)
        image.image.alpha_mode = "CHANNEL_PACKED"  # glTF's alpha is not premultiplied and never darkens the colour
        sampler = self.materials.glb.list("samplers")[self.materials.glb.list("textures")[use["index"]]["sampler"]]
        image.interpolation = "Closest" if sampler.get("magFilter") == 9728 else "Linear"
        self.put(self.texture_place(use, sampler, image), image.inputs["Vector"])
        return self.times(image.outputs["Color"], tuple(factor)), image.outputs["Alpha"]

    def texture_place(self, use, sampler, image):
        """KHR_texture_transform and the wrap modes; Blender counts v from below."""
        uv = self.node("ShaderNodeUVMap")
        uv.uv_map = f"TEXCOORD_{use.get('texCoord', 0)}"  # stored as (u, 1 - v)
        place = uv.outputs[0]
        change = use.get("extensions", {}).get("KHR_texture_transform")
        if change:
            # In glTF's own coordinates: uv' = offset + rotate(scale uv).
            node = self.node("ShaderNodeMapping")
            sx, sy = change.get("scale", [1, 1])
            node.inputs["Scale"].default_value = (sx, sy, 1)
            node.inputs["Rotation"].default_value = (0, 0, -change.get("rotation", 0))
            node.inputs["Location"].default_value = (*change.get("offset", [0, 0]), 0)
            self.put(self.flip(place), node.inputs["Vector"])
            place = self.flip(node.outputs[0])
        wraps = (sampler.get("wrapS", 10497), sampler.get("wrapT", 10497))
        if wraps == (33071, 33071):
            image.extension = "EXTEND"
            return place
        image.extension = "REPEAT"
        if wraps == (10497, 10497):
            return place
        split = self.node("ShaderNodeSeparateXYZ")
        self.put(place, split.inputs[0])
        join = self.node("ShaderNodeCombineXYZ")
        for axis, wrap in enumerate(wraps):
            value = split.outputs[axis]
            if wrap == 33648:
                value = self.math("PINGPONG", value, 1.0)
            elif wrap == 33071:
                value = self.math("MINIMUM", self.math("MAXIMUM", value, 1e-4), 1 - 1e-4)
            self.put(value, join.inputs[axis])
        return join.outputs[0]

    def flip(self, uv):
        """(u, v) -> (u, 1 - v)"""
        node = self.node("ShaderNodeVectorMath")
        node.operation = "MULTIPLY_ADD"
        self.put(uv, node.inputs[0])
        node.inputs[1].default_value = (1, -1, 1)
        node.inputs[2].default_value = (0, 1, 0)
        return node.outputs[0]
