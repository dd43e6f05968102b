"""Run by blender -b: writes a GLB with transforms, and reads the GLB and OBJ of asdf-vk.

    blender -b --factory-startup --python blender_exchange.py -- FOLDER
"""

import json
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

if not hasattr(np, "bool"):
    np.bool = bool  # For the importer of glTF of Debian 12, which is older than its NumPy.

folder = Path(sys.argv[sys.argv.index("--") + 1])


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)


# Written by Blender: an object and a child of it with the same mesh, each with a transform of its own.
clear()
vertices, faces = np.load(folder / "animal.vertices.npy"), np.load(folder / "animal.faces.npy")
mesh = bpy.data.meshes.new("animal")
mesh.from_pydata(vertices.tolist(), [], faces.tolist())
parent, child = (bpy.data.objects.new(name, mesh) for name in ("parent", "child"))
child.parent = parent
parent.matrix_world = Matrix.Translation((1, 2, 3)) @ Matrix.Rotation(0.5, 4, (1, 1, 0)) @ Matrix.Scale(2, 4)
child.matrix_local = Matrix.Translation((4, 0, 0)) @ Matrix.Diagonal((1, 0.5, 1.5, 1))
for obj in (parent, child):
    bpy.context.collection.objects.link(obj)
bpy.context.view_layer.update()
world = [np.array(obj.matrix_world) for obj in (parent, child)]
np.save(folder / "blender.matrices.npy", world)
bpy.ops.export_scene.gltf(filepath=str(folder / "blender.glb"), export_format="GLB")
if bpy.app.version < (4,):
    bpy.ops.export_scene.gltf(filepath=str(folder / "blender.gltf"), export_format="GLTF_EMBEDDED")

# Read by Blender: what asdf-vk writes.
found = {}
for name, read in (
    ("parts.glb", lambda path: bpy.ops.import_scene.gltf(filepath=path)),
    ("values.glb", lambda path: bpy.ops.import_scene.gltf(filepath=path)),
    ("parts.obj", lambda path: bpy.ops.wm.obj_import(filepath=path)),
    ("values.obj", lambda path: bpy.ops.wm.obj_import(filepath=path)),
):
    clear()
    read(str(folder / name))
    (obj,) = [obj for obj in bpy.data.objects if obj.type == "MESH"]
    data = obj.data
    counts = np.bincount([polygon.material_index for polygon in data.polygons], minlength=len(data.materials))
    colours = set()
    for attribute in data.color_attributes:
        colours |= {tuple(round(c, 3) for c in item.color) for item in attribute.data}
    nodes = []
    for material in data.materials:
        shader = next((n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED"), None) if material.use_nodes else None
        nodes.append(list(shader.inputs["Base Color"].default_value)[:3] if shader else None)
    found[name] = {
        "face_count": len(data.polygons),
        "materials": {material.name: int(count) for material, count in zip(data.materials, counts)},
        "viewport": [list(material.diffuse_color)[:3] for material in data.materials],
        "nodes": nodes,
        "colour_count": len(colours),
        "size": list(obj.dimensions),
    }
(folder / "blender.found.json").write_text(json.dumps(found))
