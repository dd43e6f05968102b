from __future__ import annotations

import math
import operator
import os
from typing import Any, BinaryIO, Mapping, Sequence

from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import field_array, float_points, mesh_argument, polygon_arrays, values_array
from ._errors import error_of
from ._info import Info
from ._session import flag_of

Mesh = _core.Mesh


def read_mesh(
    source: str | os.PathLike[str] | bytes | bytearray | memoryview | BinaryIO,
    *,
    format: str | None = "",
    max_faces: int | None = None,
    chord_error: float | None = None,
) -> Mesh:
    """Reads a PLY, OFF, OBJ, STL, GLB, glTF, 3MF or STEP file. Keeps all faces, in the order of the file.

    source: a path; or the mesh file as bytes, or a binary file object, which is read to its end. Bytes are never a path.
    format: "ply", "off", "obj", "stl", "glb", "gltf", "3mf" or "step", if the content is ambiguous (OBJ, binary STL). Empty:
        the extension of the path.
    max_faces: refuse a mesh with more faces. None: 100 per byte of the file, and at least 100,000.
    chord_error: greatest distance between the triangles and the curved surfaces of a STEP file, in the unit of the
        file. None: 1/1000 of the diagonal of the bounding box.

    The result has `vertices` (n, 3) float64 and `faces` (m, 3) int32, both read-only views. If a face of the file is
    not a triangle, `faces` has the triangles into which the faces are cut. `face_of_triangle` (m,) then has the index
    of the file's face for each triangle, and functions return a value per face of the file (`face_count` values).
    Raises InputError.
    """
    name = "" if format is None else format
    if not isinstance(name, str) or (name and name.lower() not in _core.mesh_extensions()):
        known = ", ".join(_core.mesh_extensions())
        raise error_of("unknownFormat", f"format={format!r} is not one of {known}")
    options = (name, 0 if max_faces is None else _face_limit(max_faces), _chord_error(chord_error))
    if not isinstance(source, (str, os.PathLike, bytes, bytearray, memoryview)):
        read = getattr(source, "read", None)
        if not callable(read):
            raise error_of("optionOutOfRange", f"{type(source).__name__} is not a path, bytes or a binary file object")
        source = read()
        if not isinstance(source, (bytes, bytearray, memoryview)):
            raise error_of("optionOutOfRange", "the file object returns text; open it in binary mode")
    if isinstance(source, (bytes, bytearray, memoryview)):
        return _core.parse_mesh(bytes(source), *options)
    if isinstance(source, str) and (len(source) > 1000 or "\n" in source) and not os.path.exists(source):
        start = source.lstrip()[:20]
        raise error_of("unreadableInput", f"{start!r}... is not the path of a file; give a mesh in memory as bytes")
    return _core.read_mesh(_path(source), *options)


def join_meshes(meshes: Sequence[Mesh], names: Sequence[str] | None = None) -> Mesh:
    """Joins meshes into one: the faces of all meshes in their order, for example the parts of an assembly.

    names: a name per mesh for `objects`, for the faces before the first object of the mesh. The meshes share no
    vertices. Compute a part among the others by a region: Scene(joined).compute(faces=range(meshes[0].face_count)).
    Raises InputError if the meshes state different units; a mesh without a unit may be in mm.
    """
    given = list(meshes)
    if not all(isinstance(mesh, Mesh) for mesh in given):
        raise error_of("arrayType", "meshes has an item that is not a Mesh; read_mesh and mesh_of_polygons return them")
    return _core.join_meshes(given, [""] * len(given) if names is None else [str(name) for name in names])


def mesh_of_polygons(vertices: ArrayLike, corners: ArrayLike, first_corner: ArrayLike) -> Mesh:
    """Makes a Mesh of faces with any number of corners, for example from Blender or VTK.

    vertices: (n, 3). corners: (k,) indices of vertices, for each face counter-clockwise seen from outside.
    first_corner: (m + 1,), ascending from 0 to k: face i has the corners corners[first_corner[i]:first_corner[i + 1]].

    Functions return a value per face. The thickness of a face is the least thickness of its triangles. Other values of
    a face are area-weighted means over its triangles. Arrays are copied. Raises InputError.
    """
    return _core.mesh_of_polygons(*polygon_arrays(vertices, corners, first_corner))


def write(
    path: str | os.PathLike[str],
    mesh: Any,
    fields: Mapping[str, ArrayLike] | Info | None = None,
    *further: Mapping[str, ArrayLike] | Info,
    vertex_fields: Mapping[str, ArrayLike] | None = None,
    format: str | None = "",
    ascii: bool | None = False,
    labels: Sequence[str] | None = None,
    picture_of: str | None = "",
) -> None:
    """Writes results: data in .ply, .vtu, .glb, .obj, .npy, .npz, .csv, a page in .html, or a picture in .png.

    mesh: a Mesh, an object with `vertices` and `faces`, or a tuple of these two arrays.
    fields: a result of compute(), or a mapping from names to arrays per face, (items,) or (items, 3). The first field
        of real numbers is the property `quality` of a .ply. If there are no segments, this field also determines the
        colours.
    further: further results of the same mesh; for pages only, because all other formats hold one result.
    vertex_fields: a mapping from names to arrays per vertex. None: if `fields` is an Info, its vertex fields are used.
    format: "ply", "obj", "glb", "vtu", "npy", "npz", "csv", "html" or "png". Empty: the extension decides the format.
    ascii: write a .ply as text.
    labels: names of the results on a page. Default: the name of the file; several results are also numbered.
    picture_of: the field that a picture shows. Empty: the places of an Info that are thinner than the limit. Without a
        limit: the thickness, or else the segments, or else the first field.

    The file is replaced atomically. Raises OutputError, InputError, UsageError.
    """
    format = "" if format is None else format
    if not isinstance(format, str):
        raise error_of("optionOutOfRange", f"format={format!r} is not a string")
    argument = mesh_argument(*mesh) if isinstance(mesh, tuple) and len(mesh) == 2 else mesh_argument(mesh)
    target = _path(path)
    kind = (format or os.path.splitext(target)[1]).lower().removeprefix(".")
    results = [{} if fields is None else fields, *further]
    if flag_of(ascii, "ascii") and not _core.has_text(kind):
        raise error_of("optionConflict", "ascii is for PLY only; remove ascii=True")
    if picture_of and kind != "png":
        raise error_of("optionConflict", "picture_of names the field of a picture (.png); drop it")
    if vertex_fields and kind in ("html", "png"):
        raise error_of("optionConflict", "pages and pictures show fields per face; remove vertex_fields")
    if kind == "html":
        name = "mesh" if target == "-" else os.path.splitext(os.path.basename(target))[0]
        name = os.fsencode(name).decode(errors="replace")  # The name of a file need not be valid UTF-8.
        layers = zip(map(_arrays_of, results), _labels_of(results, labels, name), map(_report_of, results))
        _core.write_page(target, argument, name, list(layers))
        return
    if labels is not None:
        raise error_of("optionConflict", "labels name the results of a page (.html); drop them")
    if len(results) > 1:
        raise error_of("optionConflict", f"{target!r} holds one result and {len(results)} are given; a page (.html) "
                       "shows several")
    per_face, per_vertex = _arrays_of(results[0]), _arrays_of(vertex_fields)
    if kind == "png":
        if not isinstance(picture_of or "", str):
            raise error_of("optionOutOfRange", f"picture_of={picture_of!r} is not the name of a field")
        _core.write_picture(target, argument, per_face, picture_of or "", _report_of(results[0]))
        return
    if vertex_fields is None and isinstance(fields, Info):
        per_vertex = _arrays_of(fields.vertex_fields)
    _core.write(target, argument, per_face, per_vertex, format, bool(ascii))


def _face_limit(value: Any) -> int:
    try:
        count = operator.index(value)
    except TypeError:
        count = 0
    if isinstance(value, bool) or not 1 <= count < 2**32:
        raise error_of("optionOutOfRange", f"max_faces={value!r} is not a whole number from 1 to 4294967295")
    return count


def _chord_error(value: Any) -> float:
    try:
        length = 0.0 if value is None else float(value)
    except (TypeError, ValueError):
        length = -1.0
    if isinstance(value, bool) or not 0 <= length < math.inf or (value is not None and length == 0):
        raise error_of("optionOutOfRange", f"chord_error={value!r} is not a length above 0")
    return length


def _report_of(result: Any) -> _core.ShownReport | None:
    return result._shown if isinstance(result, Info) else None


def _labels_of(results: list[Any], labels: Sequence[str] | None, name: str) -> Sequence[str]:
    if labels is None:
        return [f"{name}, result {i + 1}" for i in range(len(results))] if len(results) > 1 else [name]
    if (
        not isinstance(labels, Sequence)
        or isinstance(labels, str)
        or len(labels) != len(results)
        or not all(isinstance(label, str) and label.isprintable() for label in labels)
    ):
        raise error_of("optionConflict", f"labels={labels!r} are not {len(results)} printable strings, one per result")
    return labels


def write_points(
    path: str | os.PathLike[str], points: ArrayLike, radii: ArrayLike, *, components: ArrayLike | None = None
) -> None:
    """Writes skeleton points with radii: trees in .swc, a point cloud in binary .ply. Replaces the file atomically.

    points, radii: (k, 3) and (k,), for example from skeleton_points(). A point is left out if a number is not finite.
        In .swc, a point is also left out if its radius is not above 0.
    components: (k,) integers, for example info.fields["component"] of compute(centres=True). A .swc has a tree per
        component. None: one tree.

    A tree is the minimum spanning tree of its points. Its root is the point with the greatest radius. Raises
    OutputError, InputError, UsageError.
    """
    target = _path(path)
    if target != "-" and os.path.splitext(target)[1].lower() not in (".swc", ".ply"):
        raise error_of("unknownFormat", f"{target!r} is not a file that ends in .ply or .swc")
    places = float_points(points)
    diameters = 2 * values_array(radii, "radii", len(places))
    fields = {"centre": places, "sdf": diameters}
    if components is not None:
        fields["component"] = field_array(components, "components")
    _core.write_points(target, fields)


def _arrays_of(fields: Mapping[str, ArrayLike] | Info | None) -> dict[str, NDArray[Any]]:
    if fields is None:
        return {}
    if isinstance(fields, Info):
        fields = fields.fields
    if not hasattr(fields, "items"):
        raise error_of("optionOutOfRange", f"fields of type {type(fields).__name__} do not map names to arrays")
    arrays = {}
    for name, array in fields.items():
        if not isinstance(name, str) or not name.isprintable():
            raise error_of("optionOutOfRange", f"{name!r} is not the name of a field")
        arrays[name] = field_array(array, name)
    return arrays


def _path(path: str | os.PathLike[str]) -> str:
    try:
        text = os.fspath(path)
    except TypeError as error:
        raise error_of("optionOutOfRange", f"{path!r} is not a path") from error
    if not isinstance(text, str):
        text = os.fsdecode(text)
    try:
        os.fsencode(text)
    except UnicodeEncodeError:
        is_path = False
    else:
        is_path = "\0" not in text
    if not is_path:
        raise error_of("optionOutOfRange", f"{text!r} is not a path")
    return text
