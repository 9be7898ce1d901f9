# SPDX-License-Identifier: Apache-2.0
"""Rooms for tests/blend_test.cpp:

    blender -b --factory-startup -P blend_room.py -- render FOLDER KIND     FOLDER/KIND.blend and Cycles' picture KIND.exr
    blender -b --factory-startup -P blend_room.py -- operators FOLDER ADDON SCONCE   the add-on's two buttons on a saved file
"""

import json
import sys

import bpy


def matt(name, color):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse, output = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (*color, 1)
    tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    return material


def box(name, center, size, material):
    bpy.ops.mesh.primitive_cube_add(size=1, location=center)
    thing = bpy.context.object
    thing.name, thing.scale = name, size
    thing.data.materials.append(material)
    return thing


def lamp(name, kind, position, energy, turned=(0, 0, 0), **more):
    data = bpy.data.lights.new(name, kind)
    data.energy, data.color = energy, (1, 0.8, 0.6)
    for key, value in more.items():
        setattr(data, key, value)
    thing = bpy.data.objects.new(name, data)
    thing.location, thing.rotation_euler = position, turned
    bpy.context.scene.collection.objects.link(thing)
    return thing


LAMPS = {
    "square": lambda: lamp("key", "AREA", (1, -0.5, 2.6), 60, size=0.5),
    "ellipse": lambda: lamp("key", "AREA", (1, -0.5, 2.6), 60, (0.3, -0.2, 0), shape="ELLIPSE", size=0.8, size_y=0.4),
    "point": lambda: lamp("key", "POINT", (1, -0.5, 2), 60, shadow_soft_size=0),
    "spot": lambda: lamp("key", "SPOT", (1, -0.5, 2.6), 60, shadow_soft_size=0, spot_blend=0.3),
    "sun": lambda: lamp("key", "SUN", (1, -0.5, 2.6), 3, (0.5, 0.4, 0), angle=0),
    "world": lambda: None,
}


def room(kind):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    grey = matt("grey", (0.6, 0.6, 0.6))
    box("floor", (0, 0, -0.05), (4, 4, 0.1), grey)
    box("back", (0, 2.05, 1.5), (4, 0.1, 3), grey)
    box("left", (-2.05, 0, 1.5), (0.1, 4, 3), matt("red", (0.7, 0.1, 0.1)))
    box("block", (0.4, 0.3, 0.5), (0.8, 0.8, 1), matt("blue", (0.2, 0.3, 0.7)))
    LAMPS[kind]()
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"].inputs
    background["Color"].default_value = (0.4, 0.5, 0.7, 1)
    background["Strength"].default_value = 0.5 if kind == "world" else 0
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (1.6, -4.2, 2.2), (1.25, 0, 0.33)
    scene.collection.objects.link(camera)
    scene.camera = camera


def render(folder, kind):
    room(kind)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.max_bounces, cycles.diffuse_bounces = 48, 32, 32
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 160, 120, 100
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = f"{folder}/{kind}.exr"
    bpy.ops.wm.save_as_mainfile(filepath=f"{folder}/{kind}.blend")
    bpy.ops.render.render(write_still=True)


def furnish():
    """Groups by both ways, and a pane of glass."""
    bpy.ops.scene.view_layer_add_lightgroup(name="desk")
    bpy.data.objects["key"].lightgroup = "desk"
    wall = bpy.data.collections.new("wall lamps")
    bpy.context.scene.collection.children.link(wall)
    other = lamp("sconce", "POINT", (-1, 0, 1.5), 20, shadow_soft_size=0)
    bpy.context.scene.collection.objects.unlink(other)
    wall.objects.link(other)
    glass = bpy.data.materials.new("pane")
    glass.use_nodes = True
    tree = glass.node_tree
    tree.nodes.clear()
    shader, output = tree.nodes.new("ShaderNodeBsdfGlass"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    box("window", (1.8, 0, 1), (0.02, 1, 1), glass)


def operators(folder, addon, program):
    room("square")
    furnish()
    bpy.ops.wm.save_as_mainfile(filepath=f"{folder}/groups.blend")
    bpy.ops.preferences.addon_install(filepath=addon)
    bpy.ops.preferences.addon_enable(module="sconce_blender")
    scene = bpy.context.scene
    scene.sconce_program, scene.sconce_quality = program, "draft"
    with open(f"{folder}/mood.toml", "w", encoding="utf-8") as file:
        file.write('others = "off"\n[mix]\ndesk = "50%"\n')
    scene.sconce_preset = f"{folder}/mood.toml"
    results = [list(bpy.ops.sconce.bake()), list(bpy.ops.sconce.apply_mix()), list(bpy.ops.sconce.apply_mix())]
    lamps = {o.name: [c * o.data.energy for c in o.data.color] for o in scene.objects if o.type == "LIGHT"}
    with open(f"{folder}/operators.json", "w", encoding="utf-8") as file:
        json.dump({"results": results, "lamps": lamps}, file)


words = sys.argv[sys.argv.index("--") + 1 :]
{"render": render, "operators": operators}[words[0]](*words[1:])
