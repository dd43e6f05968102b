"""Mesh and result files."""

from __future__ import annotations

import os
from typing import Any, Mapping

from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import field_array, float_points, mesh_argument, polygon_arrays, values_array
from ._errors import error_of
from ._session import flag_of

Mesh = _core.Mesh


def read_mesh(path: str | os.PathLike[str]) -> Mesh:
    """Reads PLY, OFF, OBJ, STL, GLB, glTF or 3MF. All faces, in file order.

    The result has `vertices` (n, 3) float64 and `faces` (m, 3) int32, both read-only views. Of a file with other
    faces than triangles, `faces` is a triangulation, `face_of_triangle` (m,) the face of the file of each triangle,
    and functions return a value per face of the file (`face_count`). Raises InputError.
    """
    return _core.read_mesh(_path(path))


def mesh_of_polygons(vertices: ArrayLike, corners: ArrayLike, first_corner: ArrayLike) -> Mesh:
    """A Mesh of faces with any number of corners, for example of Blender or VTK.

    vertices: (n, 3). corners: (k,) indices of vertices, those of a face counter-clockwise seen from outside.
    first_corner: (m + 1,), ascending from 0 to k: face i has the corners corners[first_corner[i]:first_corner[i + 1]].

    Functions return a value per face: of several triangles the least thickness, or the mean by area. Arrays are copied.
    Raises InputError.
    """
    return _core.mesh_of_polygons(*polygon_arrays(vertices, corners, first_corner))


def write(
    path: str | os.PathLike[str],
    mesh: Any,
    fields: Mapping[str, ArrayLike] | None = None,
    *,
    vertex_fields: Mapping[str, ArrayLike] | None = None,
    format: str | None = "",
    ascii: bool | None = False,
) -> None:
    """Writes fields, and in .ply, .vtu, .glb and .obj also the mesh. The file is replaced atomically.

    mesh: a Mesh, an object with `vertices` and `faces`, or a tuple of these two arrays.
    fields, vertex_fields: arrays by name, per face and per vertex: (items,) or (items, 3). Info has them too. The
        first field of real numbers is the quality and the colour of a .ply.
    format: "ply", "obj", "glb", "vtu", "npy", "npz" or "csv"; empty: by the extension.

    Raises OutputError, InputError, UsageError.
    """
    format = "" if format is None else format
    if not isinstance(format, str):
        raise error_of("optionOutOfRange", f"format={format!r} is not a string")
    argument = mesh_argument(*mesh) if isinstance(mesh, tuple) and len(mesh) == 2 else mesh_argument(mesh)
    _core.write(_path(path), argument, _arrays_of(fields), _arrays_of(vertex_fields), format, flag_of(ascii, "ascii"))


def write_points(
    path: str | os.PathLike[str], points: ArrayLike, radii: ArrayLike, *, components: ArrayLike | None = None
) -> None:
    """Writes skeleton points with their radii: trees in .swc, else a point cloud in binary PLY. Replaces atomically.

    points, radii: (k, 3) and (k,), as of skeleton_points(); points with a NaN are left out.
    components: (k,) integers: each component is a tree of .swc, as by info.fields["component"] of
        compute(centres=True); None: one tree.

    A tree is the minimum spanning tree of its points, and its root the one with the greatest radius.
    Raises OutputError, InputError, UsageError.
    """
    places = float_points(points)
    diameters = 2 * values_array(radii, "radii", len(places))
    fields = {"centre": places, "sdf": diameters}
    if components is not None:
        fields["component"] = field_array(components, "components")
    _core.write_points(_path(path), fields)


def _arrays_of(fields: Mapping[str, ArrayLike] | None) -> dict[str, NDArray[Any]]:
    if fields is None:
        return {}
    if not hasattr(fields, "items"):
        raise error_of("optionOutOfRange", f"fields of type {type(fields).__name__} are no mapping of names to arrays")
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
