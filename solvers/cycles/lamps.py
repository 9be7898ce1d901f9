# SPDX-License-Identifier: Apache-2.0
"""Lamps without surface, and skies. Cycles is radiometric; sconce's numbers go in as they stand, so what comes out has
sconce's unit: cd and lux here are W/sr and W/m2 there."""

import math
import bpy
import mathutils
import numpy as np
from glb import matrix


def add_lamp(light, frame, index):
    kind = light["type"]
    name = f"lamp {index}"
    data = bpy.data.lights.new(name, "SUN" if kind == "directional" else "POINT")
    intensity = light.get("intensity", 1)
    data.color = light.get("color", [1, 1, 1])
    if kind == "directional":
        data.energy = intensity  # irradiance on a facing surface
        data.angle = 0
    else:
        data.energy = 1
        data.shadow_soft_size = 0
        shape_by_nodes(data, light, intensity, frame)
    data.cycles.max_bounces = 1024
    data.cycles.cast_shadow = True
    object_ = bpy.data.objects.new(name, data)
    object_.matrix_world = mathutils.Matrix(frame.tolist())
    bpy.context.scene.collection.objects.link(object_)


def shape_by_nodes(data, light, intensity, frame):
    """Cone and range of KHR_lights_punctual, which Blender's own lamps do not have (its spot dims by the cosine, too)."""
    data.use_nodes = True
    tree = data.node_tree
    tree.nodes.clear()

    def math_node(operation, *values, clamp=False):
        node = tree.nodes.new("ShaderNodeMath")
        node.operation = operation
        node.use_clamp = clamp
        for value, socket in zip(values, node.inputs):
            if isinstance(value, float):
                socket.default_value = value
            else:
                tree.links.new(value, socket)
        return node.outputs[0]

    # Found by a lamp over a plane (tests/cycles_test.cpp): by nodes, strength 1 is 1 / (4 pi) W/sr.
    strength = float(intensity) * 4 * math.pi
    if light["type"] == "spot":
        cone = light.get("spot", {})
        outer = math.cos(cone.get("outerConeAngle", math.pi / 4))
        inner = max(math.cos(cone.get("innerConeAngle", 0)), outer + 1e-4)
        geometry = tree.nodes.new("ShaderNodeNewGeometry")
        dot = tree.nodes.new("ShaderNodeVectorMath")
        dot.operation = "DOT_PRODUCT"
        tree.links.new(geometry.outputs["Incoming"], dot.inputs[0])
        dot.inputs[1].default_value = tuple(-frame[:3, 2] / np.linalg.norm(frame[:3, 2]))
        scaled = math_node("DIVIDE", math_node("SUBTRACT", dot.outputs["Value"], outer), inner - outer, clamp=True)
        strength = math_node("MULTIPLY", math_node("MULTIPLY", scaled, scaled), strength)
    if light.get("range", 0) > 0:
        ray = tree.nodes.new("ShaderNodeLightPath")
        ratio = math_node("DIVIDE", ray.outputs["Ray Length"], float(light["range"]))
        window = math_node("SUBTRACT", 1.0, math_node("POWER", ratio, 4.0), clamp=True)
        strength = math_node("MULTIPLY", window, strength)
    emission = tree.nodes.new("ShaderNodeEmission")
    if isinstance(strength, float):
        emission.inputs["Strength"].default_value = strength
    else:
        tree.links.new(strength, emission.inputs["Strength"])
    output = tree.nodes.new("ShaderNodeOutputLight")
    tree.links.new(emission.outputs[0], output.inputs[0])


def set_sky(skies):
    """Black, or the sum of the skies: constant, or lat-long images (row 0 up, centre column -z)."""
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    total = None
    for sky in skies:
        scale = tree.nodes.new("ShaderNodeVectorMath")
        scale.operation = "MULTIPLY"
        scale.inputs[1].default_value = sky["radiance"]
        scale.inputs[0].default_value = (1, 1, 1)
        if sky["image"]:
            tree.links.new(sky_texture(tree, sky), scale.inputs[0])
        value = scale.outputs[0]
        if total is not None:
            add = tree.nodes.new("ShaderNodeVectorMath")
            tree.links.new(total, add.inputs[0])
            tree.links.new(value, add.inputs[1])
            value = add.outputs[0]
        total = value
    background = tree.nodes.new("ShaderNodeBackground")
    background.inputs["Color"].default_value = (0, 0, 0, 1)
    if total is not None:
        tree.links.new(total, background.inputs["Color"])
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(background.outputs[0], output.inputs[0])


def sky_texture(tree, sky):
    image = tree.nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(sky["image"])
    image.image.colorspace_settings.name = "Linear"
    image.interpolation = "Closest"
    frame = matrix(sky["frame"])[:3, :3]
    # Blender's picture has +x in its centre, -y to the right of it and z up; sconce's -z, +x and y, in the sky's frame.
    axes = (-frame[:, 2], -frame[:, 0], frame[:, 1])
    join = tree.nodes.new("ShaderNodeCombineXYZ")
    where = tree.nodes.new("ShaderNodeTexCoord")
    for axis, socket in zip(axes, join.inputs):
        dot = tree.nodes.new("ShaderNodeVectorMath")
        dot.operation = "DOT_PRODUCT"
        tree.links.new(where.outputs["Generated"], dot.inputs[0])
        dot.inputs[1].default_value = tuple(axis)
        tree.links.new(dot.outputs["Value"], socket)
    tree.links.new(join.outputs[0], image.inputs["Vector"])
    return image.outputs["Color"]
