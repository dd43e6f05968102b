#!/usr/bin/env python3
"""Writes the files of tests/io/assembly_corpus: small GLB, glTF and 3MF files, valid, damaged and hostile.

tests/io/assembly_corpus_test.cpp has the expected outcome of each. Usage: write_assembly_corpus.py FOLDER
"""
import base64
import copy
import io
import json
import pathlib
import struct
import sys
import zipfile
import zlib

FOLDER = pathlib.Path(sys.argv[1])

# A tetrahedron, outward.
CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
FLAT = [i for face in FACES for i in face]


def floats(points):
    return b"".join(struct.pack("<3f", *p) for p in points)


def gltf(positions, indices, primitive=None, count=None, component=5123):
    """A document of one mesh and one node, and its binary data: indices, then positions."""
    code = {5121: "B", 5123: "H", 5125: "I"}[component]
    index_bytes = struct.pack(f"<{len(indices)}{code}", *indices)
    index_bytes += b"\0" * (-len(index_bytes) % 4)
    data = index_bytes + floats(positions)
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0, **(primitive or {})}]}],
        "accessors": [
            {"bufferView": 0, "componentType": component, "count": len(indices), "type": "SCALAR"},
            {"bufferView": 1, "componentType": 5126, "count": count or len(positions), "type": "VEC3",
             "min": [0, 0, 0], "max": [1, 1, 1]},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(indices) * struct.calcsize(code)},
            {"buffer": 0, "byteOffset": len(index_bytes), "byteLength": 12 * len(positions)},
        ],
        "buffers": [{"byteLength": len(data)}],
    }
    return document, data


def glb(document, data, version=2, pad=b" ", extra=b"", magic=b"glTF"):
    text = document if isinstance(document, bytes) else json.dumps(document, separators=(",", ":")).encode()
    text += pad * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    if data is not None:
        data += b"\0" * (-len(data) % 4)
        chunks += struct.pack("<I4s", len(data), b"BIN\0") + data
    chunks += extra
    return struct.pack("<4sII", magic, version, 12 + len(chunks)) + chunks


def write(name, contents):
    (FOLDER / name).write_bytes(contents if isinstance(contents, bytes) else contents.encode())


def embedded(document, data):
    document = copy.deepcopy(document)
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(document)


def changed(change, indices=FLAT, positions=CORNERS, **arguments):
    document, data = gltf(positions, indices, **arguments)
    document = copy.deepcopy(document)
    change(document)
    return glb(document, data)


def set_at(*path):
    *way, key, value = path

    def change(document):
        at = document
        for step in way:
            at = at[step]
        at[key] = value

    return change


def write_gltf():
    document, data = gltf(CORNERS, FLAT)
    good = glb(document, data)
    write("glb_tetrahedron.glb", good)
    write("gltf_tetrahedron.gltf", embedded(document, data))
    write("gltf_without_extension", embedded(document, data))
    for component, name in ((5121, "bytes"), (5125, "words")):
        write(f"glb_indices_as_{name}.glb", glb(*gltf(CORNERS, FLAT, component=component)))
    # Normals and texture coordinates split vertices: every triangle has corners of its own.
    split = [CORNERS[i] for i in FLAT]
    write("glb_split_vertices.glb", glb(*gltf(split, list(range(12)))))

    def without_indices(d):
        del d["meshes"][0]["primitives"][0]["indices"]

    write("glb_without_indices.glb", changed(without_indices, positions=split, indices=[0, 0, 0]))
    write("glb_strip.glb", changed(set_at("meshes", 0, "primitives", 0, "mode", 5), indices=[0, 1, 2, 3]))
    write("glb_strip_with_restart.glb",
          changed(set_at("meshes", 0, "primitives", 0, "mode", 5), indices=[0, 1, 2, 2, 3, 3, 1, 0]))
    write("glb_fan.glb", changed(set_at("meshes", 0, "primitives", 0, "mode", 6), indices=[0, 1, 2, 3]))
    write("glb_points_only.glb", changed(set_at("meshes", 0, "primitives", 0, "mode", 0)))
    write("glb_lines_only.glb", changed(set_at("meshes", 0, "primitives", 0, "mode", 1)))
    write("glb_mode_7.glb", changed(set_at("meshes", 0, "primitives", 0, "mode", 7)))

    def points_too(d):
        d["meshes"][0]["primitives"].append({"attributes": {"POSITION": 1}, "mode": 0})

    write("glb_points_too.glb", changed(points_too))

    def instances(d):
        d["nodes"] = [{"children": [1, 2], "translation": [10, 0, 0]}, {"mesh": 0, "scale": [2, 2, 2]},
                      {"mesh": 0, "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "translation": [0, 5, 0]}]

    write("glb_instances.glb", changed(instances))
    write("glb_matrix.glb",
          changed(set_at("nodes", 0, "matrix", [0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1])))
    write("glb_projective_matrix.glb",
          changed(set_at("nodes", 0, "matrix", [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])))
    write("glb_mirrored.glb", changed(set_at("nodes", 0, "scale", [-1, 1, 1])))
    write("glb_rotation_zero.glb", changed(set_at("nodes", 0, "rotation", [0, 0, 0, 0])))
    write("glb_transform_overflow.glb",
          changed(lambda d: d.update(nodes=[{"children": [1], "scale": [1e300] * 3}, {"mesh": 0, "scale": [1e300] * 3}])))
    write("glb_short_translation.glb", changed(set_at("nodes", 0, "translation", [1, 2])))
    write("glb_node_cycle.glb",
          changed(lambda d: d.update(nodes=[{"children": [1]}, {"children": [0], "mesh": 0}])))
    write("glb_node_with_two_parents.glb",
          changed(lambda d: d.update(nodes=[{"children": [1, 1]}, {"mesh": 0}])))
    write("glb_without_scenes.glb", changed(lambda d: (d.pop("scenes"), d.pop("scene"))))
    write("glb_scene_out_of_range.glb", changed(set_at("scene", 3)))
    write("glb_node_out_of_range.glb", changed(set_at("scenes", 0, "nodes", [7])))
    write("glb_mesh_out_of_range.glb", changed(set_at("nodes", 0, "mesh", 7)))
    write("glb_mesh_not_in_scene.glb", changed(set_at("nodes", 0, {})))
    write("glb_further_scene.glb", changed(lambda d: d["scenes"].append({"nodes": []})))
    write("glb_skin.glb", changed(lambda d: d["nodes"][0].update(skin=0, scale=[100, 100, 100])))
    write("glb_index_out_of_range.glb", changed(lambda d: None, indices=FLAT[:-1] + [4]))
    write("glb_eleven_indices.glb", changed(lambda d: None, indices=FLAT[:-1]))
    write("glb_huge_count.glb", changed(set_at("accessors", 1, "count", 4000000000)))
    write("glb_huge_offset.glb", changed(set_at("accessors", 1, "byteOffset", 18446744073709551615)))
    write("glb_count_zero.glb", changed(set_at("accessors", 0, "count", 0)))
    write("glb_count_negative.glb", changed(set_at("accessors", 0, "count", -3)))
    write("glb_view_beyond_buffer.glb", changed(set_at("bufferViews", 1, "byteLength", 1000)))
    write("glb_view_stride_1.glb", changed(set_at("bufferViews", 1, "byteStride", 1)))
    write("glb_buffer_longer_than_chunk.glb", changed(set_at("buffers", 0, "byteLength", 1000)))
    write("glb_float_indices.glb", changed(set_at("accessors", 0, "componentType", 5126)))
    write("glb_position_of_two.glb", changed(set_at("accessors", 1, "type", "VEC2")))
    write("glb_without_positions.glb", changed(set_at("meshes", 0, "primitives", 0, "attributes", {})))
    write("glb_other_file.glb", changed(lambda d: d["buffers"][0].update(uri="../../etc/passwd")))
    write("gltf_other_file.gltf", json.dumps({**document, "buffers": [{"byteLength": 72, "uri": "mesh.bin"}]}))
    write("gltf_bad_base64.gltf", json.dumps(
        {**document, "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,@@@@"}]}))
    write("gltf_plain_data_uri.gltf", json.dumps({**document, "buffers": [{"byteLength": 72, "uri": "data:,abc"}]}))

    def draco(d):
        d["extensionsRequired"] = ["KHR_draco_mesh_compression"]
        d["meshes"][0]["primitives"][0]["extensions"] = {
            "KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}

    def meshopt(d):
        d["extensionsRequired"] = ["KHR_mesh_quantization", "EXT_meshopt_compression"]
        d["bufferViews"][1]["extensions"] = {"EXT_meshopt_compression": {
            "buffer": 0, "byteLength": 24, "byteStride": 12, "count": 4, "mode": "ATTRIBUTES"}}

    write("glb_draco.glb", changed(draco))
    write("glb_meshopt.glb", changed(meshopt))
    write("glb_unknown_extension.glb", changed(set_at("extensionsRequired", ["VENDOR_shape"])))
    write("glb_material_extension.glb", changed(set_at("extensionsRequired", ["KHR_materials_unlit"])))
    write("glb_gpu_instances.glb", changed(lambda d: d["nodes"][0].update(
        extensions={"EXT_mesh_gpu_instancing": {"attributes": {}}})))
    quantised = struct.pack("<12H", *FLAT) + b"".join(struct.pack("<3hh", *(32767 * c for c in p), 0) for p in CORNERS)

    def quantise(d):
        d["extensionsRequired"] = ["KHR_mesh_quantization"]
        d["accessors"][1].update(componentType=5122, normalized=True)
        d["bufferViews"][1].update(byteStride=8, byteLength=32)
        d["buffers"][0]["byteLength"] = len(quantised)

    quantised_document = copy.deepcopy(document)
    quantise(quantised_document)
    write("glb_quantised.glb", glb(quantised_document, quantised))
    sparse_data = data + struct.pack("<HH3f", 3, 0, 0, 0, 2)

    def sparse(d):
        d["buffers"][0]["byteLength"] = len(sparse_data)
        d["bufferViews"] += [{"buffer": 0, "byteOffset": len(data), "byteLength": 2},
                             {"buffer": 0, "byteOffset": len(data) + 4, "byteLength": 12}]
        d["accessors"][1]["sparse"] = {"count": 1, "indices": {"bufferView": 2, "componentType": 5123},
                                       "values": {"bufferView": 3}}

    sparse_document = copy.deepcopy(document)
    sparse(sparse_document)
    write("glb_sparse.glb", glb(sparse_document, sparse_data))
    zeros_document = copy.deepcopy(sparse_document)  # All but the fourth position are 0.
    zeros_document["accessors"][1].pop("bufferView")
    write("glb_sparse_without_view.glb", glb(zeros_document, sparse_data))
    zeros_document["accessors"][1]["count"] = 4000000000
    write("glb_sparse_without_view_huge.glb", glb(zeros_document, sparse_data))
    sparse_document["accessors"][1]["sparse"]["count"] = 4000000000
    write("glb_sparse_huge.glb", glb(sparse_document, sparse_data))
    write("glb_truncated.glb", good[:-5])
    write("glb_trailing_bytes.glb", good + b"rubbish")
    write("glb_header_only.glb", good[:12])
    write("glb_four_bytes.glb", good[:4])
    write("glb_version_1.glb", glb(document, data, version=1))
    write("glb_asset_version_1.glb", changed(set_at("asset", "version", "1.0")))
    write("glb_without_asset.glb", changed(lambda d: d.pop("asset")))
    write("glb_zero_padded.glb", glb(document, data, pad=b"\0"))
    write("glb_unknown_chunk.glb", glb(document, data, extra=struct.pack("<I4s", 4, b"ABCD") + b"1234"))
    write("glb_chunk_too_long.glb", good[:12] + struct.pack("<I", 0x7fffffff) + good[16:])
    write("glb_json_damaged.glb", glb(b'{"asset":{"version":"2.0"},', None))
    write("glb_json_deep.glb", glb(b'{"asset":{"version":"2.0"},"extras":' + b"[" * 500 + b"]" * 500 + b"}", None))
    write("glb_json_array.glb", glb(b"[1,2,3]", None))
    write("glb_nodes_no_array.glb", changed(set_at("nodes", {})))
    # A mesh of 40 primitives on one accessor, 4000 times: more faces than memory.
    indices = FLAT * 200

    def bomb(d):
        primitive = d["meshes"][0]["primitives"][0]
        d["meshes"] = [{"primitives": [primitive] * 40}]
        d["nodes"] = [{"mesh": 0}] * 4000
        d["scenes"] = [{"nodes": list(range(4000))}]

    write("glb_instance_bomb.glb", changed(bomb, indices=indices))


CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
RELATIONSHIPS = ('<?xml version="1.0" encoding="UTF-8"?>\n<Relationships xmlns="http://schemas.openxmlformats.org/package/'
                 '2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type='
                 '"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')

CONTENT_TYPES = ('<?xml version="1.0" encoding="UTF-8"?>\n<Types xmlns="http://schemas.openxmlformats.org/package/2006/'
                 'content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.'
                 'relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.'
                 '3dmanufacturing-3dmodel+xml"/></Types>')


def mesh(corners=CORNERS, faces=FACES):
    vertices = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in corners)
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in faces)
    return f"<mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh>"


def model(resources=None, build='<item objectid="1"/>', attributes='unit="millimeter"', head=""):
    resources = f'<object id="1" type="model">{mesh()}</object>' if resources is None else resources
    return (f'<?xml version="1.0" encoding="UTF-8"?>\n<model {attributes} xml:lang="en-US" xmlns="{CORE}">{head}'
            f"<resources>{resources}</resources><build>{build}</build></model>")


def archive(text, relationships=RELATIONSHIPS, method=zipfile.ZIP_DEFLATED, wide=False, others=()):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", method) as files:
        for name, contents in [("_rels/.rels", relationships), ("3D/3dmodel.model", text), *others,
                               ("[Content_Types].xml", CONTENT_TYPES)]:
            if contents is None:
                continue
            entry = zipfile.ZipInfo(name, (2026, 1, 1, 0, 0, 0))
            entry.compress_type = method
            with files.open(entry, "w", force_zip64=wide) as file:
                file.write(contents if isinstance(contents, bytes) else contents.encode())
    return stream.getvalue()


def object_of(body, number=1, more=""):
    return f'<object id="{number}"{more}>{body}</object>'


def write_3mf():
    good = archive(model())
    write("3mf_tetrahedron.3mf", good)
    write("3mf_without_extension", good)
    write("3mf_stored.3mf", archive(model(), method=zipfile.ZIP_STORED))
    write("3mf_zip64.3mf", archive(model(), wide=True))
    write("3mf_method_bzip2.3mf", archive(model(), method=zipfile.ZIP_BZIP2))
    write("3mf_inch.3mf", archive(model(attributes='unit="inch"')))
    write("3mf_default_unit.3mf", archive(model(attributes="")))
    write("3mf_unknown_unit.3mf", archive(model(attributes='unit="furlong"')))
    write("3mf_prefixed.3mf", archive(
        f'<c:model xmlns:c="{CORE}"><c:resources><c:object id="1">' + mesh().replace("</", "</c:").replace("<v", "<c:v")
        .replace("<t", "<c:t").replace("<m", "<c:m") + '</c:object></c:resources><c:build><c:item objectid="1"/>'
        "</c:build></c:model>"))
    write("3mf_prefixed_twice.3mf", archive(  # The core namespace is the default one, and has a prefix too.
        f'<m:model xmlns="{CORE}" xmlns:m="{CORE}" unit="inch"><resources><m:object id="1">' + mesh()
        + '</m:object></resources><m:build><item objectid="1"/></m:build></m:model>'))
    write("3mf_prefix_of_another.3mf", archive(model(
        object_of(mesh()), attributes='xmlns:o="other"', build='<o:item objectid="1"/>')))
    write("3mf_two_items.3mf", archive(model(
        build='<item objectid="1"/><item objectid="1" transform="2 0 0 0 2 0 0 0 2 10 20 30"/>')))
    write("3mf_mirrored.3mf", archive(model(build='<item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>')))
    write("3mf_components.3mf", archive(model(
        object_of(mesh()) + object_of('<components><component objectid="1"/><component objectid="1" transform='
                                      '"0 1 0 -1 0 0 0 0 1 5 0 0"/></components>', 2),
        '<item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 7"/>')))
    write("3mf_component_cycle.3mf", archive(model(
        object_of('<components><component objectid="1"/></components>'))))
    deep = "".join(object_of(f'<components><component objectid="{n - 1}"/></components>', n) for n in range(2, 100))
    write("3mf_components_deep.3mf", archive(model(object_of(mesh()) + deep, '<item objectid="99"/>')))
    write("3mf_components_deep_from_below.3mf", archive(model(
        object_of(mesh()) + deep, '<item objectid="50"/><item objectid="99"/>')))
    double = "".join(object_of(f'<components><component objectid="{n - 1}"/><component objectid="{n - 1}"/></components>', n)
                     for n in range(2, 60))
    write("3mf_component_bomb.3mf", archive(model(object_of(mesh()) + double, '<item objectid="59"/>')))
    write("3mf_empty_component_bomb.3mf", archive(model(
        object_of(mesh([], [])) + double + object_of(mesh(), 70), '<item objectid="59"/><item objectid="70"/>')))
    write("3mf_missing_object.3mf", archive(model(build='<item objectid="5"/>')))
    write("3mf_missing_component.3mf", archive(model(object_of('<components><component objectid="9"/></components>'))))
    write("3mf_object_twice.3mf", archive(model(object_of(mesh()) * 2)))
    write("3mf_no_items.3mf", archive(model(build="")))
    write("3mf_support_only.3mf", archive(model(object_of(mesh(), more=' type="support"'))))
    write("3mf_support_too.3mf", archive(model(
        object_of(mesh()) + object_of(mesh(), 2, ' type="solidsupport"'), '<item objectid="1"/><item objectid="2"/>')))
    write("3mf_split_vertices.3mf", archive(model(
        object_of(mesh([CORNERS[i] for i in FLAT], [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(4)])))))
    write("3mf_index_out_of_range.3mf", archive(model(object_of(mesh(faces=[(0, 1, 4)])))))
    write("3mf_index_negative.3mf", archive(model(object_of(mesh(faces=[(0, 1, -1)])))))
    write("3mf_coordinate_nan.3mf", archive(model(object_of(mesh([("nan", 0, 0), *CORNERS[1:]])))))
    write("3mf_coordinate_word.3mf", archive(model(object_of(mesh([("1.0abc", 0, 0), *CORNERS[1:]])))))
    write("3mf_coordinate_plus.3mf", archive(model(object_of(mesh([("+0", "0e5", "-0.0"), *CORNERS[1:]])))))
    write("3mf_vertex_without_z.3mf", archive(model(object_of(mesh()).replace(' z="1"', ""))))
    write("3mf_transform_of_11.3mf", archive(model(build='<item objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0"/>')))
    write("3mf_transform_of_13.3mf", archive(model(
        build='<item objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 0 0"/>')))
    write("3mf_beam_lattice.3mf", archive(model(object_of(mesh().replace(
        "</mesh>", '<b:beamlattice xmlns:b="x"><b:beams/></b:beamlattice></mesh>')))))
    write("3mf_requires_lattice.3mf", archive(model(
        attributes='requiredextensions="b" xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"')))
    write("3mf_requires_material.3mf", archive(model(
        attributes='requiredextensions="m" xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"')))
    production = f'requiredextensions="p" xmlns:p="{PRODUCTION}"'
    parts = object_of('<components><component objectid="4" p:path="/3D/Objects/a.model"/></components>')
    write("3mf_production.3mf", archive(
        model(parts, attributes=production),
        others=[("3D/Objects/a.model", model(object_of(mesh(), 4), "", 'unit="centimeter"'))]))
    write("3mf_production_missing.3mf", archive(model(parts, attributes=production)))
    write("3mf_metadata.3mf", archive(model(
        head='<metadata name="Title">a &lt; b <![CDATA[ </model> ]]></metadata><!-- <build> --><?x y?>')))
    write("3mf_document_type.3mf", archive('<!DOCTYPE model [<!ENTITY a "aaaa">]>' + model().split("\n", 1)[1]))
    write("3mf_utf16.3mf", archive(model().encode("utf-16")))
    write("3mf_byte_order_mark.3mf", archive(model().encode("utf-8-sig")))
    write("3mf_other_namespace.3mf", archive(model().replace(CORE, "http://example.com/core")))
    write("3mf_other_root.3mf", archive(model().replace("<model", "<scene").replace("</model", "</scene")))
    write("3mf_xml_truncated.3mf", archive(model()[:-30]))
    write("3mf_xml_wrong_end.3mf", archive(model().replace("</build>", "</resources>")))
    write("3mf_xml_attribute_twice.3mf", archive(model().replace('objectid="1"', 'objectid="1" objectid="1"')))
    write("3mf_xml_attribute_open.3mf", archive(model().replace('objectid="1"', 'objectid="1')))
    write("3mf_xml_deep.3mf", archive(model(head="<a>" * 100 + "</a>" * 100)))
    write("3mf_xml_after_end.3mf", archive(model() + "rubbish"))
    write("3mf_xml_empty.3mf", archive(""))
    write("3mf_long_tag.3mf", archive(model(head='<metadata name="' + "a" * 200000 + '"/>')))
    write("3mf_no_relationships.3mf", archive(model(), relationships=None))
    write("3mf_no_model_relationship.3mf", archive(model(), relationships=RELATIONSHIPS.replace("3dmodel\"", "x\"")))
    write("3mf_no_model.3mf", archive(None))
    write("3mf_truncated.3mf", good[:-40])
    write("3mf_cut_in_half.3mf", good[:len(good) // 2])
    write("3mf_four_bytes.3mf", good[:4])
    at = good.index(b"PK\x01\x02")
    write("3mf_directory_count.3mf", good[:-12] + struct.pack("<H", 60000) + good[-10:])
    write("3mf_directory_offset.3mf", good[:-6] + struct.pack("<I", 0xfffffff0) + good[-2:])
    checksum = at + 16 + good[at:].index(b"PK\x01\x02", 4)
    write("3mf_wrong_checksum.3mf", good[:checksum] + b"\0\0\0\0" + good[checksum + 4:])
    write("3mf_encrypted.3mf", good[:at + 8] + b"\1\0" + good[at + 10:])
    data = bytearray(good)
    data[good.index(b"3D/3dmodel.model") + 60] ^= 0x55
    write("3mf_damaged_data.3mf", bytes(data))
    # 100,000 triangles in 8 KB: memory grows with what is read, up to its wrong index.
    write("3mf_deflate_bomb.3mf", archive(model(object_of(
        mesh().replace("</triangles>", '<triangle v1="0" v2="1" v3="2"/>' * 100000 + '<triangle v1="0" v2="1" v3="9"/>'
                       "</triangles>")))))


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    assert zlib.ZLIB_VERSION
    write_gltf()
    write_3mf()
