# SPDX-License-Identifier: Apache-2.0
"""One light group baked by Cycles: blender -b -P bake.py -- [--times FILE] job.json. See docs/external-solvers.md."""

import json
import math
import os
import sys
import time

import bpy

try:
    import numpy as np
except ModuleNotFoundError:  # another python3 comes first in PATH, and Debian's Blender looks for packages beside it
    sys.path.append("/usr/lib/python3/dist-packages")
    import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from exr import write_exr  # noqa: E402
from glb import Glb  # noqa: E402
from lamps import add_lamp, set_sky  # noqa: E402
from materials import Materials  # noqa: E402

MARGIN = 2  # texels around charts that Cycles fills: it bakes a texel only where the chart covers its centre


def coincident(glb, instances):
    """Per instance, per triangle: how many triangles lie in the same place, and which of them this is. Twins do, and so may
    careless copies."""
    faces = []
    for instance in instances:
        attributes, indices, _ = glb.mesh(instance["node"])
        faces.append(attributes["POSITION"][indices])
    every = np.concatenate(faces).reshape(-1, 3) + np.float32(0)  # -0 is 0
    _, corner = np.unique(every, axis=0, return_inverse=True)
    _, place, counts = np.unique(np.sort(corner.reshape(-1, 3), axis=1), axis=0, return_inverse=True, return_counts=True)
    place = place.ravel()
    order = np.argsort(place, kind="stable")
    begin = np.cumsum(counts) - counts
    rank = np.empty(len(place), int)
    rank[order] = np.arange(len(place)) - np.repeat(begin, counts)
    ends = np.cumsum([len(f) for f in faces])[:-1]
    return list(zip(np.split(counts[place], ends), np.split(rank, ends)))


def build_object(name, glb, pieces, materials, targets, lightmap_set):
    """pieces: (instance, which of its triangles), as one mesh, because Cycles bakes object by object, each from the beginning.
    World space as in the file, y up: nothing in a bake knows where up is."""
    slots, positions, normals, triangles, indices = {}, [], [], [], []
    sets = {}
    count = 0
    for instance, chosen in pieces:
        attributes, faces, material = glb.mesh(instance["node"])
        faces = faces[chosen]
        slot = slots.setdefault((material, instance["page"]), len(slots))
        position = attributes["POSITION"]
        corner = position[faces]
        face = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        flat = np.repeat(face / np.maximum(np.linalg.norm(face, axis=1, keepdims=True), 1e-30), 3, axis=0)
        normals.append(attributes["NORMAL"][faces.ravel()] if "NORMAL" in attributes else flat)
        for key, values in attributes.items():
            if key.startswith("TEXCOORD_"):
                sets.setdefault(int(key[9:]), []).append(values[faces.ravel()])
        positions.append(position)
        triangles.append(faces.astype(np.int64) + count)
        indices.append(np.full(len(faces), slot, np.int32))
        count += len(position)
    positions, normals = np.concatenate(positions), np.concatenate(normals)
    triangles, indices = np.concatenate(triangles), np.concatenate(indices)

    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(count)
    mesh.vertices.foreach_set("co", positions.ravel())
    mesh.loops.add(3 * len(triangles))
    mesh.loops.foreach_set("vertex_index", triangles.astype(np.int32).ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * len(triangles), 3, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(len(triangles), 3, np.int32))
    mesh.polygons.foreach_set("material_index", indices)
    mesh.polygons.foreach_set("use_smooth", np.ones(len(triangles), bool))
    for index in sorted(sets):
        layer = mesh.uv_layers.new(name=f"TEXCOORD_{index}")
        values = np.concatenate(sets[index]).astype(np.float32)
        if index != lightmap_set:
            values = values * np.float32([1, -1]) + np.float32([0, 1])  # pictures begin below in Blender
        layer.data.foreach_set("uv", values.ravel())
    for (material, page), _ in sorted(slots.items(), key=lambda item: item[1]):
        mesh.materials.append(materials.make(material, targets[page] if page >= 0 else None))
    mesh.update()
    mesh.use_auto_smooth = True
    mesh.auto_smooth_angle = math.pi
    mesh.normals_split_custom_set(normals.tolist())
    mesh.uv_layers.active = mesh.uv_layers[f"TEXCOORD_{lightmap_set}"]

    thing = bpy.data.objects.new(name, mesh)
    thing.cycles.shadow_terminator_offset = 0
    thing.cycles.shadow_terminator_geometry_offset = 0
    bpy.context.scene.collection.objects.link(thing)
    return thing


def set_up_cycles(job):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = job["samples"]
    cycles.seed = job["seed"] & 0x7FFFFFFF
    bounces = 32 if job["bounces"] < 0 else job["bounces"]
    cycles.max_bounces = cycles.diffuse_bounces = bounces
    cycles.min_light_bounces = cycles.min_transparent_bounces = 0
    cycles.transparent_max_bounces = 64
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_fast_gi = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    bake = scene.render.bake
    bake.use_pass_direct = bake.use_pass_indirect = True
    bake.use_pass_color = False
    bake.margin = MARGIN
    bake.margin_type = "EXTEND"
    bake.use_clear = False
    bake.target = "IMAGE_TEXTURES"


def bake_object(thing):
    bpy.context.view_layer.update()  # what was just linked cannot be selected before
    for other in bpy.context.view_layer.objects:
        other.select_set(other == thing)
    bpy.context.view_layer.objects.active = thing
    result = bpy.ops.object.bake(type="DIFFUSE")
    if "FINISHED" not in result:
        raise SystemExit(f"Cycles did not bake '{thing.name}'")


def clocks():
    """Seconds: wall, CPU of all threads."""
    return time.monotonic(), time.process_time()


def main(arguments):
    times = None
    if arguments[:1] == ["--times"]:
        times, arguments = arguments[1], arguments[2:]
    if len(arguments) != 1:
        raise SystemExit("usage: sconce-cycles [--times FILE] job.json")
    start = clocks()
    with open(arguments[0], encoding="utf-8") as file:
        job = json.load(file)
    if job["version"] != 1:
        raise SystemExit(f"{arguments[0]}: version {job['version']} is unknown (allowed: 1)")

    bpy.ops.wm.read_factory_settings(use_empty=True)
    glb = Glb(job["scene"])
    targets = []
    for page in range(job["pages"]):
        image = bpy.data.images.new(f"page {page}", job["width"], job["height"], float_buffer=True, alpha=False)
        image.colorspace_settings.name = "Non-Color"
        targets.append(image)
    set_up_cycles(job)
    set_sky(job["sky"])
    for index, (light, frame) in enumerate(glb.lamps()):
        add_lamp(light, frame, index)

    # What lies in the same place would shade itself, so only one may be there at a time: objects by number and rank.
    parts = {}
    for instance, (counts, ranks) in zip(job["instances"], coincident(glb, job["instances"])):
        for count, rank in sorted(set(zip(counts.tolist(), ranks.tolist()))):
            part = parts.setdefault((count, rank, instance["page"] >= 0), [])
            part.append((instance, (counts == count) & (ranks == rank)))
    materials = Materials(glb)
    things = {
        key: build_object("part " + "-".join(map(str, key)), glb, pieces, materials, targets, job["lightmap_set"])
        for key, pieces in sorted(parts.items())
    }
    ready = clocks()
    for now in sorted(things, key=lambda key: key[1]):
        if not now[2]:
            continue
        for (count, rank, _), thing in things.items():
            thing.hide_render = rank != (now[1] if now[1] < count else 0)
        bake_object(things[now])
    baked = clocks()

    for image, path in zip(targets, job["outputs"]):
        pixels = np.empty(job["width"] * job["height"] * 4, np.float32)
        image.pixels.foreach_get(pixels)
        # Cycles bakes the radiosity of a white surface over pi. Its first row is v = 0, as is sconce's.
        write_exr(path, pixels.reshape(job["height"], job["width"], 4)[:, :, :3] * np.float32(math.pi))
    if times is not None:
        row = {"group": job["group"], "samples": job["samples"], "seed": job["seed"]}
        for stage, (begin, end) in {"setup": (start, ready), "bake": (ready, baked)}.items():
            row |= {f"{stage}_s": end[0] - begin[0], f"{stage}_cpu_s": end[1] - begin[1]}
        with open(times, "a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")


main(sys.argv[sys.argv.index("--") + 1 :])
