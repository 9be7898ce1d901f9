# SPDX-License-Identifier: Apache-2.0
"""A room with four lights by Cycles, for tests/light_groups_test.cpp:

    blender -b --factory-startup -P light_groups.py -- FOLDER SAMPLES GROUP=STRENGTH ...

FOLDER/groups.exr has the light groups `key`, `fill` and `world` (and a lamp that is in none); FOLDER/again.exr is
another render with the groups' lights at these strengths.
"""

import sys
import bpy


def box(name, center, size, color):
    bpy.ops.mesh.primitive_cube_add(size=1, location=center)
    thing = bpy.context.object
    thing.name, thing.scale = name, size
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*color, 1)
    material.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.5
    thing.data.materials.append(material)


def lamp(name, position, power, color, group, strengths):
    data = bpy.data.lights.new(name, "AREA")
    data.size, data.color = 0.4, color
    data.energy = power * strengths.get(group, 1)
    thing = bpy.data.objects.new(name, data)
    thing.location, thing.lightgroup = position, group
    bpy.context.scene.collection.objects.link(thing)


def build(strengths, samples):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene, layer = bpy.context.scene, bpy.context.view_layer
    for group in ("key", "fill", "world"):
        bpy.ops.scene.view_layer_add_lightgroup(name=group)
    box("floor", (0, 0, -0.05), (4, 4, 0.1), (0.7, 0.7, 0.7))
    box("wall", (-2, 0, 1.5), (0.1, 4, 3), (0.7, 0.2, 0.1))
    box("back", (0, 2, 1.5), (4, 0.1, 3), (0.6, 0.6, 0.6))
    box("block", (0.2, 0.4, 0.5), (0.8, 0.8, 1), (0.2, 0.4, 0.7))
    lamp("key", (1, -0.5, 2.6), 60, (1, 0.8, 0.6), "key", strengths)
    lamp("fill", (-1, -1, 2.6), 30, (0.5, 0.7, 1), "fill", strengths)
    lamp("lost", (0.5, 1.2, 2.4), 10, (1, 1, 1), "", strengths)
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"].inputs
    background["Color"].default_value = (0.4, 0.5, 0.7, 1)
    background["Strength"].default_value = 0.3 * strengths.get("world", 1)
    scene.world.lightgroup = "world"
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (1.6, -4.2, 2.2), (1.25, 0, 0.33)
    scene.collection.objects.link(camera)
    scene.camera = camera

    layer.use_pass_z = True
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.seed = samples, 2 if strengths else 1
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 160, 120, 100
    scene.render.film_transparent = False
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"


def main(arguments):
    folder, samples = arguments[0], int(arguments[1])
    strengths = {name: float(value) for name, value in (word.split("=") for word in arguments[2:])}
    for name, given in (("groups", {}), ("again", strengths)):
        build(given, samples)
        bpy.context.scene.render.filepath = f"{folder}/{name}.exr"
        bpy.ops.render.render(write_still=True)


main(sys.argv[sys.argv.index("--") + 1:])
