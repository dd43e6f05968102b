from __future__ import annotations

import base64
import copy
import io
import pickle
import xml.etree.ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asdf_vk
from ply import fields_of_ply
from shapes import cube, joined, sphere


def test_a_mesh_survives_a_file(tmp_path: Path) -> None:
    vertices, faces = sphere(2)
    for name in ("mesh.ply", "text.ply"):
        asdf_vk.write(tmp_path / name, (vertices, faces), ascii=name != "mesh.ply")
        mesh = asdf_vk.read_mesh(tmp_path / name)
        np.testing.assert_array_equal(mesh.vertices, vertices)
        np.testing.assert_array_equal(mesh.faces, faces)
        assert mesh.face_count == len(faces) and mesh.face_of_triangle is None
        assert not mesh.vertices.flags.writeable


def test_a_mesh_is_read_from_bytes_and_from_binary_files(tmp_path: Path) -> None:
    vertices, faces = cube()
    asdf_vk.write(tmp_path / "mesh.ply", (vertices, faces))
    data = (tmp_path / "mesh.ply").read_bytes()
    with open(tmp_path / "mesh.ply", "rb") as file:
        sources: list[Any] = [data, bytearray(data), memoryview(data), io.BytesIO(data), file]
        for source in sources:
            np.testing.assert_array_equal(asdf_vk.read_mesh(source).faces, faces)
    corners = vertices[faces].astype("<f4")
    facets = np.zeros(len(faces), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    facets["corners"] = corners
    binary = bytes(80) + len(faces).to_bytes(4, "little") + facets.tobytes()
    assert asdf_vk.read_mesh(binary).face_count == len(faces)
    ambiguous = b"# no keyword\n" + b"".join(b"v %g %g %g\n" % tuple(p) for p in vertices) + b"f 1 2 3\n"
    assert asdf_vk.read_mesh(ambiguous, format="obj").face_count == 1
    (tmp_path / "nameless").write_bytes(ambiguous)
    assert asdf_vk.read_mesh(tmp_path / "nameless", format="OBJ", max_faces=1).face_count == 1
    with pytest.raises(asdf_vk.InputError, match="12 faces; the limit is 11"):
        asdf_vk.read_mesh(data, max_faces=11)


def test_what_is_no_mesh_file_is_refused_with_a_short_message(tmp_path: Path) -> None:
    text = "solid x\n" + "facet normal 0 0 1\n" * 1000
    for source, message in (
        (text, "is not the path of a file; give a mesh in memory as bytes"),
        (tmp_path / "absent.stl", "absent.stl: cannot be opened: No such file"),
        (b"", "is empty"),
        (io.StringIO(text), "open it in binary mode"),
        (3, "int is not a path, bytes or a binary file object"),
    ):
        with pytest.raises(asdf_vk.Error) as failure:
            asdf_vk.read_mesh(source)  # type: ignore[arg-type]
        assert message in str(failure.value) and len(str(failure.value)) < 300
    for options in ({"format": "vtu"}, {"format": 3}, {"max_faces": 0}, {"max_faces": True}, {"max_faces": 1.5},
                    {"chord_error": 0}, {"chord_error": "x"}, {"chord_error": float("nan")}):
        with pytest.raises(asdf_vk.UsageError):
            asdf_vk.read_mesh(b"", **options)  # type: ignore[arg-type]


def _vtu_fields(path: Path, element: str) -> dict[str, Any]:
    """Returns the arrays of <CellData> or <PointData>. The binary data of an array begin with the size in bytes."""
    types = {"Float32": np.float32, "UInt8": np.uint8, "UInt32": np.uint32}
    fields = {}
    for array in xml.etree.ElementTree.parse(path).findall(f".//{element}/DataArray"):
        data = base64.b64decode(array.text or "")
        assert int.from_bytes(data[:4], "little") == len(data) - 4
        entries = np.frombuffer(data[4:], types[array.attrib["type"]])
        components = int(array.attrib.get("NumberOfComponents", 1))
        fields[array.attrib["Name"]] = entries if components == 1 else entries.reshape(-1, components)
    return fields


def _fields_of(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    if path.suffix == ".ply":
        return fields_of_ply(path)
    if path.suffix == ".vtu":
        return _vtu_fields(path, "CellData"), _vtu_fields(path, "PointData")
    arrays = dict(np.load(path))
    names = {name for name in arrays if name.startswith("vertex_")}
    return ({name: arrays[name] for name in arrays.keys() - names},
            {name.removeprefix("vertex_"): arrays[name] for name in names})


@pytest.mark.parametrize("name", ["result.ply", "result.vtu", "result.npz"])
def test_fields_survive_a_file(tmp_path: Path, name: str) -> None:
    vertices, faces = sphere(3)
    info = asdf_vk.compute(vertices, faces, segment="parts")
    count = len(faces)
    own: dict[str, Any] = {"area": np.arange(count), "flag": np.arange(count) % 2 == 0}
    own |= {"word": np.arange(count, dtype=np.uint32) + 2**30, "axis": vertices[faces[:, 0]].astype(np.float32)}
    per_vertex = {"area": vertices[:, 2].astype(np.float32), "word": np.arange(len(vertices), dtype=np.uint32)}
    asdf_vk.write(tmp_path / name, (vertices, faces), {**info.fields, **own}, vertex_fields=per_vertex)
    fields, vertex_fields = _fields_of(tmp_path / name)
    computed = {key: info.fields[key] for key in ("segment", "sdf")}
    for expected, read in ((own | computed, fields), (per_vertex, vertex_fields)):
        for key, values in expected.items():
            np.testing.assert_array_equal(read[key], values)
    assert set(fields) == set(info.fields) | set(own) and set(vertex_fields) == set(per_vertex)


def test_arrays_and_tables_hold_every_type(tmp_path: Path) -> None:
    vertices, faces = sphere(1)
    real = np.linspace(-1, 1, len(faces))
    real[1] = np.nan
    fields: dict[str, Any] = {"real": real, "byte": np.arange(len(faces), dtype=np.uint8)}
    fields |= {"word": np.arange(len(faces), dtype=np.uint32) + 2**31, "axis": vertices[faces[:, 0]]}
    for name, values in fields.items():
        asdf_vk.write(tmp_path / "x.npy", (vertices, faces), {name: values})
        read = np.load(tmp_path / "x.npy")
        assert read.dtype == (np.float32 if values.dtype == np.float64 else values.dtype)
        np.testing.assert_array_equal(read, values.astype(read.dtype))
    asdf_vk.write(tmp_path / "x.csv", (vertices, faces), fields)
    rows: Any = np.genfromtxt(tmp_path / "x.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(rows["face"], np.arange(len(faces)))
    for name in ("real", "byte", "word"):
        np.testing.assert_array_equal(rows[name], fields[name])
    np.testing.assert_array_equal(np.stack([rows[f"axis_{c}"] for c in "xyz"], axis=1), fields["axis"])


def test_polygons_have_a_value_each(tmp_path: Path) -> None:
    path = tmp_path / "cube.off"
    quads = "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n"
    path.write_text("OFF\n8 6 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in cube()[0]) + quads)
    mesh = asdf_vk.read_mesh(path)
    assert mesh.faces.shape == (12, 3) and mesh.face_count == 6
    assert mesh.face_of_triangle is not None
    np.testing.assert_array_equal(mesh.face_of_triangle, np.repeat(np.arange(6), 2))
    values = asdf_vk.shape_diameter(mesh, seeds="all")
    assert values.shape == (6,)
    asdf_vk.write(tmp_path / "quads.ply", mesh, {"sdf": values})
    assert asdf_vk.read_mesh(tmp_path / "quads.ply").face_count == 6


def test_objects_are_named_in_reports(tmp_path: Path) -> None:
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    text = ""
    for index, name in enumerate(("lid", "base plate")):
        text += f"o {name}\n" + "".join(f"v {x + 1.25 * index} {y} {z}\n" for x, y, z in corners)
        text += "".join("f " + " ".join(str(i + 8 * index) for i in quad) + "\n" for quad in quads)
    (tmp_path / "two.obj").write_text(text)
    mesh = asdf_vk.read_mesh(tmp_path / "two.obj")
    assert mesh.objects == ((0, "lid"), (6, "base plate"))
    for copied in (mesh, pickle.loads(pickle.dumps(mesh))):
        assert copied.objects == mesh.objects
        gap = asdf_vk.compute(copied, closer_than=0.5).gap
        assert gap is not None and set(gap.regions[0].bodies) == {"lid", "base plate"}


def test_a_mesh_can_be_pickled(tmp_path: Path) -> None:
    path = tmp_path / "quads.off"
    path.write_text("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n4 3 2 1 0\n")
    mesh = asdf_vk.read_mesh(path)
    copies = pickle.loads(pickle.dumps(mesh)), copy.deepcopy(mesh)
    for other in copies:
        np.testing.assert_array_equal(other.vertices, mesh.vertices)
        np.testing.assert_array_equal(other.faces, mesh.faces)
        assert other.face_count == 2 and repr(other) == repr(mesh) == "<asdf_vk.Mesh, 4 vertices, 2 faces>"


def test_skeleton_points_are_trees_of_components(tmp_path: Path) -> None:
    mesh = joined(sphere(2), (sphere(1)[0] + [5, 0, 0], sphere(1)[1]))
    info = asdf_vk.compute(*mesh, centres=True, seeds="all")
    components = info.fields["component"]
    np.testing.assert_array_equal(components, np.repeat([0, 1], [320, 80]))
    points, radii = info.fields["centre"], info.fields["sdf"] / 2
    asdf_vk.write_points(tmp_path / "x.swc", points, radii, components=components)
    rows = np.loadtxt(tmp_path / "x.swc")
    assert rows.shape == (400, 7)
    parents = rows[:, 6].astype(int)
    roots = np.flatnonzero(parents == -1)
    np.testing.assert_array_equal(roots, [0, 320])
    np.testing.assert_array_equal(rows[:, 0], np.arange(1, 401))
    assert (parents < rows[:, 0]).all()
    np.testing.assert_array_equal(rows[:, 2] > 2.5, np.arange(400) >= 320)
    np.testing.assert_allclose(rows[roots, 5], [radii[:320].max(), radii[320:].max()])
    asdf_vk.write_points(tmp_path / "one.swc", points, radii)
    assert (np.loadtxt(tmp_path / "one.swc")[:, 6] == -1).sum() == 1
    asdf_vk.write_points(tmp_path / "x.ply", points, radii)
    assert b"element vertex 400" in (tmp_path / "x.ply").read_bytes()
    wrong: list[dict[str, Any]] = [{"components": np.zeros(400)}, {"components": [1]}, {"radii": radii[1:]}]
    for arguments in wrong:
        given: dict[str, Any] = {"points": points, "radii": radii, **arguments}
        with pytest.raises(asdf_vk.Error):
            asdf_vk.write_points(tmp_path / "no.swc", **given)
    with pytest.raises(asdf_vk.UsageError, match="ends in .ply or .swc"):
        asdf_vk.write_points(tmp_path / "no.csv", points, radii)
    assert not list(tmp_path.glob("no.*"))


def test_failures_leave_nothing_behind(tmp_path: Path) -> None:
    mesh = cube()
    with pytest.raises(asdf_vk.OutputError) as caught:
        asdf_vk.write(tmp_path / "missing" / "x.ply", mesh)
    assert caught.value.code == "outputNotWritable" and "missing" in str(caught.value)
    with pytest.raises(asdf_vk.UsageError):
        asdf_vk.write(tmp_path / "x.unknown", mesh)
    with pytest.raises(asdf_vk.UsageError):
        asdf_vk.write(tmp_path / "x.ply", mesh, {"sdf": np.zeros(5)})
    with pytest.raises(asdf_vk.InputError) as unreadable:
        asdf_vk.read_mesh(tmp_path / "none.ply")
    assert unreadable.value.code == "unreadableInput"
    assert list(tmp_path.iterdir()) == []


def test_polygons_are_those_of_a_file(tmp_path: Path) -> None:
    """A box of six quads. One quad is divided into a triangle and a polygon of five corners."""
    corners = [0, 2, 8, 2, 3, 1, 0, 8, 4, 5, 7, 6, 0, 1, 5, 4, 3, 2, 6, 7, 2, 0, 4, 6, 1, 3, 7, 5]
    first = [0, 3, 8, 12, 16, 20, 24, 28]
    vertices = [(x, y, z) for z in (0, 1) for y in (0, 2) for x in (0, 3)] + [(1.0, 1.0, 0)]
    lines = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}", *(f"property double {axis}" for axis in "xyz")]
    lines += [f"element face {len(first) - 1}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(str, vertex)) for vertex in vertices]
    for begin, end in zip(first, first[1:]):
        lines.append(" ".join(map(str, [end - begin, *corners[begin:end]])))
    (tmp_path / "box.ply").write_text("\n".join(lines) + "\n")
    read = asdf_vk.read_mesh(tmp_path / "box.ply")
    mesh = asdf_vk.mesh_of_polygons(vertices, corners, first)
    assert mesh.face_count == read.face_count == 7
    assert mesh.face_of_triangle is not None and read.face_of_triangle is not None
    np.testing.assert_array_equal(mesh.face_of_triangle, read.face_of_triangle)
    np.testing.assert_array_equal(mesh.faces, read.faces)
    values = asdf_vk.shape_diameter(mesh, false_hit_angle=0)
    np.testing.assert_array_equal(values, asdf_vk.shape_diameter(read, false_hit_angle=0))
    assert values.shape == (7,) and len(np.unique(values)) >= 3


def test_wrong_polygons_are_refused() -> None:
    vertices, faces = cube()
    first = np.arange(len(faces) + 1) * 3
    assert asdf_vk.mesh_of_polygons(vertices, faces.ravel(), first).face_of_triangle is None
    cases: list[tuple[Any, Any, str]] = [
        (faces.ravel(), first[:-1], "arraySize"), (faces.ravel(), first + 1, "indexOutOfRange"), (faces.ravel(), [], "arraySize"),
        (faces.ravel() + len(vertices), first, "indexOutOfRange"), (faces, first, "arraySize"), ([0.5], [0, 1], "arrayType"),
        (faces.ravel(), [0, 6, 3, faces.size], "arraySize"), ([], [0], "unreadableInput"), ([0, 1], [0, 2], "unreadableInput"),
    ]  # fmt: skip
    for corners, begins, code in cases:
        with pytest.raises(asdf_vk.InputError) as caught:
            asdf_vk.mesh_of_polygons(vertices, corners, begins)
        assert caught.value.code == code
