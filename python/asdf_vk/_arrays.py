"""Checks arrays of the caller. Copies an array only if the library needs another type or layout."""

from __future__ import annotations

import os
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._errors import error_of

# An argument of the extension: a Mesh, or vertices and faces.
MeshArgument = Union["_core.Mesh", "tuple[NDArray[Any], NDArray[np.uint32]]"]

_MAX_ROW_COUNT = 2**32 - 1  # Indices have 32 bits.


def mesh_argument(mesh: Any, faces: Any = None) -> MeshArgument:
    """Returns an argument for the extension. Accepts two arrays, a Mesh, or an object with `vertices` and `faces`."""
    if faces is None:
        if isinstance(mesh, _core.Mesh):
            return mesh
        if isinstance(mesh, (str, os.PathLike)):
            path = os.fspath(mesh)
            raise error_of("arrayType", f"{path!r} is a path, not a mesh; pass asdf_vk.read_mesh({path!r})")
        if not (hasattr(mesh, "vertices") and hasattr(mesh, "faces")):
            raise error_of(
                "arrayType",
                f"an object of type {type(mesh).__name__} is no mesh: it has no `vertices` and `faces`; "
                "pass vertices (n, 3) and faces (m, 3)",
            )
        mesh, faces = mesh.vertices, mesh.faces
    vertices = points_array(mesh, "vertices")
    triangles = _indices(faces, len(vertices))
    _require_finite(vertices, triangles)
    return vertices, triangles


def polygon_arrays(
    vertices: Any, corners: Any, first_corner: Any
) -> tuple[NDArray[np.float64], NDArray[np.uint32], NDArray[np.uint32]]:
    points = _native(points_array(vertices, "vertices"), np.float64, "vertices")
    arrays = []
    for value, name, allowed in ((corners, "corners", len(points) - 1), (first_corner, "first_corner", np.size(corners))):
        array = as_array(value, name, "iu", "integers")
        if array.ndim != 1:
            raise error_of("arraySize", f"{name} has the shape {array.shape}, not (k,)")
        _require_range(array, allowed, f"{name} reaches")
        arrays.append(_native(array, np.uint32, name))
    first = arrays[1]
    if first.size == 0 or first[0] != 0 or first[-1] != len(arrays[0]) or (first[1:] < first[:-1]).any():
        raise error_of("arraySize", f"first_corner does not ascend from 0 to {len(arrays[0])}, the number of corners")
    return points, arrays[0], first


def points_array(value: Any, name: str) -> NDArray[Any]:
    """Returns (n, 3), C-contiguous. float16 and float32 become float32, all other types float64. NaN is allowed."""
    array = _rows(as_array(value, name, "fiu", "real numbers"), name)
    return _native(array, np.float32 if array.dtype in (np.float32, np.float16) else np.float64, name)


def float_points(value: Any, name: str = "points") -> NDArray[np.float64]:
    """Returns (n, 3) float64, C-contiguous."""
    return _native(points_array(value, name), np.float64, name)


def pairs_array(points: Any, normals: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Returns points and normals, both (k, 3) float64."""
    pair = float_points(points), float_points(normals, "normals")
    if len(pair[0]) != len(pair[1]):
        raise error_of("arraySize", f"there are {len(pair[0])} points and {len(pair[1])} normals")
    return pair


def values_array(value: Any, name: str, count: int) -> NDArray[np.float64]:
    array = as_array(value, name, "fiu", "real numbers")
    if array.shape != (count,):
        raise error_of("arraySize", f"{name} has the shape {array.shape}, not ({count},)")
    return _native(array, np.float64, name)


def mask_array(value: Any, count: int) -> NDArray[np.uint8]:
    """Returns a mask of faces, (count,) uint8. `value` is a mask, (count,) bool, or an array of face indices."""
    array = as_array(value, "faces", "bfiu", "bool (a mask) or indices of faces")
    if array.size == 0:
        array = np.zeros(0, np.int64)
    if array.dtype.kind == "f":
        raise error_of("arrayType", f"faces has the type {array.dtype}, not bool (a mask) or indices of faces")
    if array.dtype.kind == "b":
        if array.shape != (count,):
            raise error_of("arraySize", f"the mask of faces has the shape {array.shape}, not ({count},)")
        return _native(array, np.bool_, "faces").view(np.uint8)
    if array.ndim != 1:
        raise error_of("arraySize", f"the indices of faces have the shape {array.shape}, not (k,)")
    _require_range(array, count - 1, "the indices of faces reach")
    mask = np.zeros(count, np.uint8)
    mask[array] = 1
    if mask.sum() != array.size:
        raise error_of("optionConflict", f"faces has {array.size} integers, some repeated; a mask has the type bool")
    return mask


def field_array(value: Any, name: str) -> NDArray[Any]:
    """Returns bool and uint8 as uint8, other integers as uint32 (-1 becomes 2**32 - 1), and real numbers as float64."""
    array = as_array(value, f"field {name}", "bfiu", "numbers")
    if array.ndim not in (1, 2):
        raise error_of("arraySize", f"field {name} has the shape {array.shape}, not (items,) or (items, components)")
    if array.dtype.kind == "f":
        return _native(array, np.float64, name)
    if array.dtype.kind == "b":
        return _native(array, np.bool_, name).view(np.uint8)
    if array.dtype == np.uint8:
        return _native(array, np.uint8, name)
    if array.size and not (-1 <= int(array.min()) and int(array.max()) < 2**32):
        raise error_of("optionOutOfRange", f"field {name} has integers outside of -1 to {2**32 - 1}")
    if array.dtype.itemsize < 4:
        array = array.astype(np.int64)
    return _native(array, np.uint32, name)


def as_array(value: Any, name: str, kinds: str, wanted: str) -> NDArray[Any]:
    """Returns an array. kinds: allowed kinds of NumPy types, such as "iu". wanted: name of the kinds in messages."""
    try:
        array = np.asarray(value)
    except (MemoryError, KeyboardInterrupt):
        raise
    except Exception as error:
        raise error_of("arrayType", f"{name} cannot be converted to an array: {error}") from error
    if np.ma.isMaskedArray(value) and np.ma.getmaskarray(value).any():
        raise error_of("arrayType", f"{name} is a masked array with masked entries; fill or remove them")
    if array.dtype.kind not in kinds:
        if array.size == 0:  # An empty array may have any type, because NumPy converts [] to float64.
            return np.zeros(array.shape, np.uint8)
        if array.ndim == 0 and array.dtype == object:
            raise error_of("arrayType", f"{name} is an object of type {type(value).__name__}, not an array of {wanted}")
        raise error_of("arrayType", f"{name} has the type {array.dtype}, not {wanted}")
    return array


def _require_range(array: NDArray[Any], greatest: int, subject: str) -> None:
    if array.size and not (0 <= int(array.min()) and int(array.max()) <= greatest):
        message = f"{subject} from {array.min()} to {array.max()}; allowed are 0 to {greatest}"
        raise error_of("indexOutOfRange", message)


def _rows(array: NDArray[Any], name: str) -> NDArray[Any]:
    """Returns an array of shape (n, 3); [] becomes an array of shape (0, 3)."""
    if array.shape == (0,):
        return array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise error_of("arraySize", f"{name} has the shape {array.shape}, not (n, 3)")
    if len(array) > _MAX_ROW_COUNT:
        raise error_of("meshTooLarge", f"{name} has {len(array)} rows, more than {_MAX_ROW_COUNT}")
    return array


def _native(array: NDArray[Any], dtype: Any, name: str) -> NDArray[Any]:
    """Returns the array itself if its type, byte order, alignment and layout fit. If not, returns a converted copy."""
    try:
        with np.errstate(over="ignore"):
            return np.require(array, dtype, ["C_CONTIGUOUS", "ALIGNED"])
    except MemoryError as error:
        raise error_of("inputTooLarge", f"{name} does not fit into memory as {np.dtype(dtype).name}") from error


def _indices(value: Any, vertex_count: int) -> NDArray[np.uint32]:
    array = _rows(as_array(value, "faces", "iu", "integers"), "faces")
    if array.size:
        least, greatest = int(array.min()), int(array.max())
        if least < 0 or greatest >= vertex_count:
            if vertex_count == 0:
                raise error_of("indexOutOfRange", "there are faces, but no vertices")
            wrong = (array < 0) | (array >= vertex_count)
            face = int(np.flatnonzero(wrong.any(axis=1))[0])
            raise error_of(
                "indexOutOfRange",
                f"face {face} has the vertex indices {array[face].tolist()}; allowed are 0 to {vertex_count - 1}",
                {"face": str(face)},
            )
    if array.dtype == np.int32:
        array = array.view(np.uint32)
    return _native(array, np.uint32, "faces")


def _require_finite(vertices: NDArray[Any], faces: NDArray[np.uint32]) -> None:
    """Raises InputError for a face with a non-finite vertex. Vertices without a face may be non-finite."""
    if np.isfinite(vertices).all():
        return
    wrong = ~np.isfinite(vertices).all(axis=1)
    of_face = wrong[faces].any(axis=1)
    if not of_face.any():
        return
    face = int(np.flatnonzero(of_face)[0])
    vertex = int(faces[face][wrong[faces[face]]][0])
    raise error_of(
        "nonFiniteNumber",
        f"vertex {vertex} of face {face} has the coordinates {vertices[vertex].tolist()}; "
        f"remove the {int(of_face.sum())} faces with such vertices",
        {"vertex": str(vertex), "face": str(face)},
    )
