# SPDX-License-Identifier: Apache-2.0
"""blender -b --factory-startup -P room.py -- FILE.blend: a furnished room with two lamps, as a modeller leaves it."""

import sys

import bpy

bpy.ops.wm.read_factory_settings(use_empty=True)


def material(name, color):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*color, 1)
    return made


def box(name, center, size, color):
    bpy.ops.mesh.primitive_cube_add(size=1, location=center)
    thing = bpy.context.object
    thing.name, thing.scale = name, size
    thing.data.materials.append(material(name, color))


def lamp(name, position, watts):
    data = bpy.data.lights.new(name, "POINT")
    data.energy = watts
    thing = bpy.data.objects.new(name, data)
    thing.location = position
    bpy.context.scene.collection.objects.link(thing)
    return thing


# Walls of 10 cm around 5 x 4 x 2.6 m; z is up.
box("floor", (0, 0, -0.05), (5.2, 4.2, 0.1), (0.35, 0.22, 0.12))
box("roof", (0, 0, 2.65), (5.2, 4.2, 0.1), (0.8, 0.8, 0.8))
for side in (-1, 1):
    box("wall x", (2.55 * side, 0, 1.3), (0.1, 4.2, 2.6), (0.75, 0.72, 0.65))
    box("wall y", (0, 2.05 * side, 1.3), (5, 0.1, 2.6), (0.75, 0.72, 0.65))
box("table", (1.2, 0.8, 0.37), (1.6, 0.8, 0.74), (0.5, 0.3, 0.15))
box("shelf", (-2.2, 1, 0.9), (0.5, 1.6, 1.8), (0.2, 0.3, 0.4))
lamp("ceiling", (0, 0, 2.4), 100)
lamp("desk", (1.4, 0.9, 1.3), 10)

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location, camera.rotation_euler = (-2.2, -1.7, 1.6), (1.45, 0, -0.85)
camera.data.lens = 22
bpy.context.scene.collection.objects.link(camera)
bpy.context.scene.camera = camera
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[sys.argv.index("--") + 1])
