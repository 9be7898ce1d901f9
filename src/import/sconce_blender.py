# SPDX-License-Identifier: Apache-2.0
"""Blender scenes for sconce. One file, two uses:

    blender -b ROOM.blend -P sconce_blender.py -- ROOM.glb      # writes ROOM.glb, and ROOM.toml where there is a sky

or as an add-on (Edit > Preferences > Add-ons > Install): the panel `sconce` in the render properties bakes the scene and
gives a mix of the light groups back to the lamps. Checked with Blender 3.4.
"""

import array
import json
import math
import os
import struct
import subprocess
import sys
import tempfile

import bpy
from mathutils import Matrix, Vector

bl_info = {
    "name": "sconce",
    "description": "Bake light groups with sconce; apply a mix to the lamps",
    "author": "the sconce authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Render properties > sconce",
    "category": "Render",
}

# Blender counts in watts. 683 lm/W is what its own glTF files use between the two.
LUMENS_PER_WATT = 683.0
Y_UP = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
DISK = 32  # corners of a round area lamp


def light_group(thing):
    """Blender's own light group, else the collection that holds the object; "" = named by its object."""
    if getattr(thing, "lightgroup", ""):
        return thing.lightgroup
    known = [c.name for c in thing.users_collection if c != bpy.context.scene.collection and c.name != "Collection"]
    return known[0] if known else ""


class Surface:
    """What of a node material can be said in glTF: the diffuse colour, glass, and emission in W/(sr m2)."""

    def __init__(self, material):
        self.color, self.image, self.emission = [0.8, 0.8, 0.8], None, [0.0, 0.0, 0.0]
        self.glass = self.metallic = 0.0
        self.seen = False
        if material is None:
            return
        if not material.use_nodes:
            self.color = list(material.diffuse_color[:3])
            return
        output = material.node_tree.get_output_node("CYCLES") or material.node_tree.get_output_node("ALL")
        self.color = [0.0, 0.0, 0.0]
        if output is not None and output.inputs["Surface"].is_linked:
            self.walk(output.inputs["Surface"].links[0].from_node, 1.0)

    def walk(self, node, share):
        inputs = node.inputs
        if node.type == "BSDF_PRINCIPLED":
            self.reflect(inputs["Base Color"], share)
            self.glass = max(self.glass, inputs["Transmission"].default_value, 1 - inputs["Alpha"].default_value)
            self.metallic = inputs["Metallic"].default_value
            self.shine(inputs["Emission"], share * inputs["Emission Strength"].default_value)
        elif node.type in ("BSDF_DIFFUSE", "BSDF_GLOSSY", "BSDF_VELVET", "SUBSURFACE_SCATTERING"):
            self.reflect(inputs["Color"], share)
            self.metallic = 1.0 if node.type == "BSDF_GLOSSY" and share == 1 else self.metallic
        elif node.type in ("BSDF_GLASS", "BSDF_REFRACTION", "BSDF_TRANSPARENT"):
            self.reflect(inputs["Color"], share)
            self.glass = max(self.glass, share)
        elif node.type == "EMISSION":
            self.shine(inputs["Color"], share * inputs["Strength"].default_value)
        elif node.type in ("MIX_SHADER", "ADD_SHADER"):
            t = 0.5 if node.type == "ADD_SHADER" or inputs[0].is_linked else inputs[0].default_value
            shares = (1, 1) if node.type == "ADD_SHADER" else (1 - t, t)
            for socket, part in zip([s for s in inputs if s.type == "SHADER"], shares):
                if socket.is_linked and part > 0:
                    self.walk(socket.links[0].from_node, share * part)

    def reflect(self, socket, share):
        if socket.is_linked and socket.links[0].from_node.type == "TEX_IMAGE" and socket.links[0].from_node.image:
            self.image = socket.links[0].from_node.image
            self.color = [1.0, 1.0, 1.0]
        else:
            self.color = [a + share * b for a, b in zip(self.color, socket.default_value[:3])]

    def shine(self, socket, strength):
        self.emission = [a + strength * b for a, b in zip(self.emission, socket.default_value[:3])]


class Glb:
    """A binary glTF 2.0 file, made piece by piece."""

    def __init__(self):
        self.binary = bytearray()
        self.json = {"asset": {"version": "2.0", "generator": "sconce_blender"}, "scene": 0, "scenes": [{"nodes": []}]}

    def add(self, key, value):
        entries = self.json.setdefault(key, [])
        entries.append(value)
        return len(entries) - 1

    def use(self, extension):
        if extension not in self.json.setdefault("extensionsUsed", []):
            self.json["extensionsUsed"].append(extension)

    def node(self, node):
        self.json["scenes"][0]["nodes"].append(self.add("nodes", node))

    def view(self, data):
        view = self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        self.binary += bytes(-len(self.binary) % 4)
        return view

    def floats(self, values, width):
        accessor = {
            "bufferView": self.view(array.array("f", values).tobytes()),
            "componentType": 5126,
            "count": len(values) // width,
            "type": ("SCALAR", "VEC2", "VEC3")[width - 1],
        }
        if width == 3:
            accessor["min"] = [min(values[k::3]) for k in range(3)]
            accessor["max"] = [max(values[k::3]) for k in range(3)]
        return self.add("accessors", accessor)

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        with open(path + ".part", "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(self.binary)))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary)
        os.replace(path + ".part", path)


def image_file(image):
    """PNG bytes of an image, whatever it is stored as."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "image.png")
        settings = bpy.context.scene.render.image_settings
        kept = settings.file_format
        settings.file_format = "PNG"
        image.save_render(path) if image.is_float else image.copy().save(filepath=path)
        settings.file_format = kept
        with open(path, "rb") as file:
            return file.read()


class Exporter:
    def __init__(self):
        self.glb = Glb()
        self.materials, self.images = {}, {}

    def material(self, material):
        if material in self.materials:
            return self.materials[material]
        surface = Surface(material)
        pbr = {"baseColorFactor": [*(min(1, max(0, c)) for c in surface.color), 1], "metallicFactor": surface.metallic, "roughnessFactor": 1}
        if surface.image is not None:
            pbr["baseColorTexture"] = {"index": self.texture(surface.image)}
        # Blender shades both sides, and lets both shine.
        out = {"name": material.name if material else "none", "pbrMetallicRoughness": pbr, "doubleSided": True}
        if surface.glass > 0.5:
            self.glb.use("KHR_materials_transmission")
            out["extensions"] = {"KHR_materials_transmission": {"transmissionFactor": surface.glass}}
        self.shine(out, surface.emission)
        self.materials[material] = self.glb.add("materials", out)
        return self.materials[material]

    def shine(self, out, radiance):
        strongest = max(radiance)
        if strongest <= 0:
            return
        self.glb.use("KHR_materials_emissive_strength")
        out["emissiveFactor"] = [c / strongest for c in radiance]
        strength = {"emissiveStrength": strongest * LUMENS_PER_WATT}
        out.setdefault("extensions", {})["KHR_materials_emissive_strength"] = strength

    def texture(self, image):
        if image not in self.images:
            source = self.glb.add("images", {"name": image.name, "mimeType": "image/png", "bufferView": self.glb.view(image_file(image))})
            self.images[image] = self.glb.add("textures", {"source": source})
        return self.images[image]

    def extras(self, thing):
        group = light_group(thing)
        return {"extras": {"light_group": group}} if group else {}

    def mesh(self, instance, original):
        """Corner by corner, in world space: instances are made real by the bake anyway."""
        thing = instance.object
        mesh = thing.to_mesh()
        mesh.calc_loop_triangles()
        mesh.calc_normals_split()
        to_world = Y_UP @ instance.matrix_world
        to_normal = to_world.to_3x3().inverted_safe().transposed()
        mirrored = to_world.determinant() < 0
        uv = mesh.uv_layers.active.data if mesh.uv_layers.active else None
        parts = {}
        for triangle in mesh.loop_triangles:
            positions, normals, uvs = parts.setdefault(triangle.material_index, ([], [], []))
            corners = list(zip(triangle.loops, triangle.vertices, triangle.split_normals))
            for loop, vertex, normal in reversed(corners) if mirrored else corners:
                positions.extend(to_world @ mesh.vertices[vertex].co)
                normals.extend((to_normal @ Vector(normal)).normalized())
                if uv:
                    uvs += (uv[loop].uv[0], 1 - uv[loop].uv[1])
        primitives = []
        slots = thing.material_slots
        for slot, (positions, normals, uvs) in sorted(parts.items()):
            attributes = {"POSITION": self.glb.floats(positions, 3), "NORMAL": self.glb.floats(normals, 3)}
            if uvs:
                attributes["TEXCOORD_0"] = self.glb.floats(uvs, 2)
            material = slots[min(slot, len(slots) - 1)].material if slots else None
            primitives.append({"attributes": attributes, "material": self.material(material)})
        thing.to_mesh_clear()
        if primitives:
            mesh_index = self.glb.add("meshes", {"name": original.name, "primitives": primitives})
            self.glb.node({"name": original.name, "mesh": mesh_index, **self.extras(original)})

    def frame(self, matrix):
        position, rotation, _ = (Y_UP @ matrix).decompose()
        return {"translation": list(position), "rotation": [rotation.x, rotation.y, rotation.z, rotation.w]}

    def area_lamp(self, instance, original):
        """A sheet of the lamp's shape that shines to its front. Cycles gives a lamp of P watts the radiance P / (4 area)."""
        lamp = instance.object.data
        a, b = lamp.size, lamp.size_y if lamp.shape in ("RECTANGLE", "ELLIPSE") else lamp.size
        if lamp.shape in ("SQUARE", "RECTANGLE"):
            outline = [(-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5)]
        else:
            # As large as the ellipse, though it has corners.
            grow = math.sqrt(2 * math.pi / DISK / math.sin(2 * math.pi / DISK)) / 2
            turns = [-2 * math.pi * k / DISK for k in range(DISK)]
            outline = [(grow * math.cos(t), grow * math.sin(t)) for t in turns]
        to_world = Y_UP @ instance.matrix_world
        corners = [to_world @ Vector((x * a, y * b, 0)) for x, y in outline]
        edge, other = corners[1] - corners[0], corners[2] - corners[0]
        normal = edge.cross(other).normalized()
        area = sum((p - corners[0]).cross(q - corners[0]).dot(normal) / 2 for p, q in zip(corners[1:], corners[2:]))
        positions, normals = [], []
        for k in range(1, len(corners) - 1):
            for p in (corners[0], corners[k], corners[k + 1]):
                positions.extend(p)
                normals.extend(normal)
        material = {"name": original.name, "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}}
        self.shine(material, [c * lamp.energy / (4 * abs(area)) for c in lamp.color])
        primitive = {
            "attributes": {"POSITION": self.glb.floats(positions, 3), "NORMAL": self.glb.floats(normals, 3)},
            "material": self.glb.add("materials", material),
        }
        mesh = self.glb.add("meshes", {"name": original.name, "primitives": [primitive]})
        self.glb.node({"name": original.name, "mesh": mesh, **self.extras(original)})

    def lamp(self, instance, original):
        lamp = instance.object.data
        if lamp.type == "AREA":
            self.area_lamp(instance, original)
            return
        self.glb.use("KHR_lights_punctual")
        out = {"name": original.name, "color": [min(1, c) for c in lamp.color]}
        if lamp.type == "SUN":
            out |= {"type": "directional", "intensity": lamp.energy * LUMENS_PER_WATT}
        else:
            out |= {"type": "point", "intensity": lamp.energy / (4 * math.pi) * LUMENS_PER_WATT}
        if lamp.type == "SPOT":
            # Blender's edge is a smooth step over a share of the cone's cosines, glTF's a square: three quarters as wide it
            # lets the same flux through. Cycles' spot dims with its angle's cosine, too; its mean is taken.
            outer = math.cos(lamp.spot_size / 2)
            inner = outer + 0.75 * lamp.spot_blend * (1 - outer)
            out["intensity"] *= (1 + outer) / 2
            out |= {"type": "spot", "spot": {"outerConeAngle": lamp.spot_size / 2, "innerConeAngle": math.acos(inner)}}
        lamps = self.glb.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lamps.append(out)
        place = self.frame(instance.matrix_world)
        light = {"KHR_lights_punctual": {"light": len(lamps) - 1}}
        self.glb.node({"name": original.name, **place, "extensions": light, **self.extras(original)})

    def camera(self, thing):
        scene = bpy.context.scene
        if thing.data.type != "PERSP":
            print(f"sconce: camera '{thing.name}' is not perspective and left out")
            return
        corners = thing.data.view_frame(scene=scene)
        wide = max(c.x for c in corners) - min(c.x for c in corners)
        tall = max(c.y for c in corners) - min(c.y for c in corners)
        perspective = {"aspectRatio": wide / tall, "yfov": 2 * math.atan(tall / 2 / abs(corners[0].z)), "znear": thing.data.clip_start}
        index = self.glb.add("cameras", {"name": thing.name, "type": "perspective", "perspective": perspective})
        self.glb.node({"name": thing.name, "camera": index, **self.frame(thing.matrix_world)})

    def scene(self):
        graph = bpy.context.evaluated_depsgraph_get()
        for instance in graph.object_instances:
            thing = instance.object
            original = thing.original
            if original.hide_render:
                continue
            if thing.type == "LIGHT":
                self.lamp(instance, original)
            elif thing.type in ("MESH", "CURVE", "SURFACE", "FONT", "META"):
                self.mesh(instance, original)
        cameras = [o for o in bpy.context.scene.objects if o.type == "CAMERA"]
        for thing in sorted(cameras, key=lambda o: o != bpy.context.scene.camera):
            self.camera(thing)


def sky_of(world, folder, name):
    """[sky] of the side file, or nothing: a constant background or a lat-long picture."""
    if world is None:
        return ""
    strength, color, picture = 1.0, list(world.color), None
    if world.use_nodes:
        node = next((n for n in world.node_tree.nodes if n.type == "BACKGROUND"), None)
        if node is None:
            return ""
        strength, color = node.inputs["Strength"].default_value, list(node.inputs["Color"].default_value[:3])
        if node.inputs["Color"].is_linked:
            source = node.inputs["Color"].links[0].from_node
            picture = source.image if source.type == "TEX_ENVIRONMENT" else None
            if picture is None:
                print(f"sconce: the world's colour comes from '{source.name}', which is left out")
                return ""
    group = getattr(world, "lightgroup", "") or "sky"
    lines = ["[sky]", f"group = {json.dumps(group)}"]
    if picture is not None:
        path = f"{name}-sky.exr"
        settings = bpy.context.scene.render.image_settings
        settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
        picture.save_render(os.path.join(folder, path))
        # The middle of Blender's picture is +x, which stays +x; ours is -z.
        lines += [f"file = {json.dumps(path)}", f"intensity = {strength * LUMENS_PER_WATT}", "rotate = -90"]
    else:
        luminance = (0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]) * strength * LUMENS_PER_WATT
        if luminance <= 0:
            return ""
        lines += [f"luminance = {luminance}", f"color = {[round(c, 6) for c in color]}"]
    return "\n".join(lines) + "\n"


def export(path):
    """Writes `path` and, where there is a sky, the .toml beside it."""
    exporter = Exporter()
    exporter.scene()
    folder, file = os.path.split(os.path.abspath(path))
    name = os.path.splitext(file)[0]
    sky = sky_of(bpy.context.scene.world, folder, name)
    if sky:
        with open(os.path.join(folder, name + ".toml"), "w", encoding="utf-8") as side:
            side.write(sky)
    exporter.glb.write(path)


def package_of(context):
    return bpy.path.abspath(context.scene.sconce_package) or os.path.splitext(bpy.data.filepath)[0] + ".sconce"


def run_sconce(words):
    """@return what it printed, and what went wrong or None"""
    try:
        done = subprocess.run([bpy.context.scene.sconce_program, *words], capture_output=True, text=True, check=False)
    except OSError as error:
        return "", f"{bpy.context.scene.sconce_program}: {error.strerror}"
    return done.stdout, done.stderr.strip() if done.returncode else None


class SCONCE_OT_bake(bpy.types.Operator):
    """Bake one lightmap per light group with sconce, into a folder beside the file"""

    bl_idname = "sconce.bake"
    bl_label = "Bake with sconce"

    def execute(self, context):
        if not bpy.data.filepath:
            self.report({"ERROR"}, "save the file first: the package lies beside it")
            return {"CANCELLED"}
        package = package_of(context)
        with tempfile.TemporaryDirectory() as folder:
            scene = os.path.join(folder, "scene.glb")
            export(scene)
            _, error = run_sconce(["bake", scene, "-o", package, "--quality", context.scene.sconce_quality, "--quiet"])
        if error:
            self.report({"ERROR"}, error)
            return {"CANCELLED"}
        self.report({"INFO"}, f"baked {package}")
        return {"FINISHED"}


class SCONCE_OT_apply_mix(bpy.types.Operator):
    """Give lamps the strengths and colours of a preset (sconce's .toml); the file's own are kept and used again next time"""

    bl_idname = "sconce.apply_mix"
    bl_label = "Apply mix to lamps"

    def execute(self, context):
        with tempfile.TemporaryDirectory() as folder:
            words = ["mix", package_of(context), "--json", "-o", os.path.join(folder, "mix.exr")]
            if context.scene.sconce_preset:
                words += ["--preset", bpy.path.abspath(context.scene.sconce_preset)]
            report, error = run_sconce(words)
        if error:
            self.report({"ERROR"}, error)
            return {"CANCELLED"}
        weights = {group["name"]: group["weight"] for group in json.loads(report)["groups"]}
        changed = 0
        for thing in bpy.context.scene.objects:
            weight = weights.get(light_group(thing) or thing.name)
            if thing.type != "LIGHT" or weight is None:
                continue
            lamp = thing.data
            if "sconce_own" not in lamp:
                lamp["sconce_own"] = [c * lamp.energy for c in lamp.color]
            light = [a * b for a, b in zip(lamp["sconce_own"], weight)]
            lamp.energy = max(light)
            if lamp.energy > 0:
                lamp.color = [c / lamp.energy for c in light]
            changed += 1
        self.report({"INFO"}, f"{changed} lamps follow the mix")
        return {"FINISHED"}


class SCONCE_PT_panel(bpy.types.Panel):
    bl_label = "sconce"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"

    def draw(self, context):
        for name in PROPERTIES:
            self.layout.prop(context.scene, name)
        self.layout.operator(SCONCE_OT_bake.bl_idname)
        self.layout.operator(SCONCE_OT_apply_mix.bl_idname)


PROPERTIES = {
    "sconce_program": lambda: bpy.props.StringProperty(name="Program", default="sconce", subtype="FILE_PATH"),
    "sconce_package": lambda: bpy.props.StringProperty(name="Package", description="NAME.sconce beside the file unless set", subtype="DIR_PATH"),
    "sconce_preset": lambda: bpy.props.StringProperty(name="Mix", description="preset for Apply mix", subtype="FILE_PATH"),
    "sconce_quality": lambda: bpy.props.EnumProperty(name="Quality", items=[(q, q.capitalize(), "") for q in ("draft", "normal", "final")], default="normal"),
}
CLASSES = (SCONCE_OT_bake, SCONCE_OT_apply_mix, SCONCE_PT_panel)


def register():
    for name, make in PROPERTIES.items():
        setattr(bpy.types.Scene, name, make())
    for kind in CLASSES:
        bpy.utils.register_class(kind)


def unregister():
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
    for name in PROPERTIES:
        delattr(bpy.types.Scene, name)


if __name__ == "__main__":
    if "--" in sys.argv:
        export(sys.argv[sys.argv.index("--") + 1])
    else:
        register()
