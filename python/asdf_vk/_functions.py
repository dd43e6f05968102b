"""The free functions: one mesh, one call."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _measures
from ._arrays import mesh_argument
from ._info import Info
from ._options import FunctionOptions, Progress
from ._session import session_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

class _OneMesh:
    """A mesh that is computed once."""

    def __init__(self, mesh: Any, faces: Any, options: dict[str, Any]) -> None:
        """Removes the options of the backend from `options`."""
        self._session = session_of(options)
        self._mesh = mesh_argument(mesh, faces)

    def compute(self, options: dict[str, Any], progress: Progress | None) -> _core.ComputedFields:
        return self._session._compute(self._mesh, options, progress)


@overload
def shape_diameter(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    per: Literal["face", "vertex"] | None = "face",
    return_info: Literal[False] | None = False,
    **options: Unpack[FunctionOptions],
) -> NDArray[np.float32]: ...
@overload
def shape_diameter(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    per: Literal["face", "vertex"] | None = "face",
    return_info: Literal[True],
    **options: Unpack[FunctionOptions],
) -> tuple[NDArray[np.float32], Info]: ...
def shape_diameter(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    per: Literal["face", "vertex"] | None = "face",
    return_info: bool | None = False,
    **options: Any,
) -> Any:
    """Shape diameter function: how thick the shape is behind each face.

    vertices: (n, 3) float32 or float64, or an object with `vertices` and `faces` (Mesh, trimesh.Trimesh).
    faces: (m, 3) int32, uint32 or int64 indices, counter-clockwise seen from outside. Other integer types are
        converted. float64 and 32-bit integers are used in place.
    per: "face", or "vertex" for the means over the faces of each vertex by area.
    options: seeds (faces that cast rays: 0.1, 5000, "10%" or "all"), rays, cone_angle, recipe, definition, max_error,
        max_relative_error, time_budget, random_seed, sampler, estimate, orient, smooth, check, false_hit_angle,
        outlier_deviations, cone_rotation, weights, guidance, pooling, solver, tolerance, max_iterations; backend,
        device, require_gpu, threads or session; progress. docs/python.md explains them.

    Returns float32 (m,) or (n,), in the unit of the mesh, NaN = no value; with return_info=True also an Info.
    Raises InputError, UsageError, DeviceError, CancelledError. Issues MeshWarning.
    """
    target = _OneMesh(vertices, faces, options)
    return _measures.shape_diameter(target, per, return_info, options)


@overload
def thickness(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    thinner_than: float | None = None,
    allow_sharp_edges: bool | None = None,
    wall_angle: float | None = None,
    per: Literal["face", "vertex"] | None = "face",
    return_info: Literal[False] | None = False,
    **options: Unpack[FunctionOptions],
) -> NDArray[np.float32]: ...
@overload
def thickness(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    thinner_than: float | None = None,
    allow_sharp_edges: bool | None = None,
    wall_angle: float | None = None,
    per: Literal["face", "vertex"] | None = "face",
    return_info: Literal[True],
    **options: Unpack[FunctionOptions],
) -> tuple[NDArray[np.float32], Info]: ...
def thickness(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    thinner_than: float | None = None,
    allow_sharp_edges: bool | None = None,
    wall_angle: float | None = None,
    per: Literal["face", "vertex"] | None = "face",
    return_info: bool | None = False,
    **options: Any,
) -> Any:
    """Wall thickness: diameter of the largest ball that touches a face from inside, clear of opposing walls.

    vertices, faces, per, options: as for shape_diameter(). All faces are measured, whatever `seeds` is.
    thinner_than: judge whether any point of the surface is thinner than this (unit of the mesh), and list the thin
        regions: info.thickness.verdict and info.thickness.regions.
    allow_sharp_edges: leave thin regions with a sharp edge or tip out of the verdict. Needs thinner_than.
    wall_angle: faces whose normals differ by at least this many degrees are opposing walls, above 90 to 180;
        default 120.

    Returns float32 (m,) or (n,), at the barycentres, in the unit of the mesh, NaN = no value; with return_info=True
    also an Info: info.fields["least_thickness"] has the least value over all points of each face, which the verdict
    is from. Raises and warns as shape_diameter().
    """
    target = _OneMesh(vertices, faces, options)
    of_measure = _measures.thickness_options(thinner_than, allow_sharp_edges, wall_angle)
    return _measures.thickness(target, of_measure, per, return_info, options)


@overload
def segment(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    method: Literal["parts", "cgal"] | None = "parts",
    parts: int | None = None,
    detail: float | None = None,
    clusters: int | None = None,
    smoothness: float | None = None,
    expansion: Literal["all", "first"] | None = None,
    return_info: Literal[False] | None = False,
    **options: Unpack[FunctionOptions],
) -> NDArray[np.int32]: ...
@overload
def segment(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    method: Literal["parts", "cgal"] | None = "parts",
    parts: int | None = None,
    detail: float | None = None,
    clusters: int | None = None,
    smoothness: float | None = None,
    expansion: Literal["all", "first"] | None = None,
    return_info: Literal[True],
    **options: Unpack[FunctionOptions],
) -> tuple[NDArray[np.int32], Info]: ...
def segment(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    method: Literal["parts", "cgal"] | None = "parts",
    parts: int | None = None,
    detail: float | None = None,
    clusters: int | None = None,
    smoothness: float | None = None,
    expansion: Literal["all", "first"] | None = None,
    return_info: bool | None = False,
    **options: Any,
) -> Any:
    """Segments of the surface: parts by shape diameter and line of sight, or CGAL's segmentation.

    vertices, faces, options: as for shape_diameter().
    method="parts": parts: that many, 1 to 100; None finds the number. detail: 0.1 to 10, more means more parts.
    method="cgal": clusters of values, 2 to 100, default 5; smoothness, default 0.26; expansion of "all" clusters,
        or of the "first" as CGAL 5.5.1. CGAL's values need definition="cgal" too; see asdf_vk.compat.cgal.

    Returns int32 (m,), labels 0 to k - 1 ascending by mean value, -1 for a face without a triangle; with
    return_info=True also an Info. Raises and warns as shape_diameter().
    """
    target = _OneMesh(vertices, faces, options)
    of_method = _measures.method_options(parts, detail, clusters, smoothness, expansion)
    return _measures.segment(target, method, of_method, return_info, options)


@overload
def skeleton_points(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    return_info: Literal[False] | None = False,
    **options: Unpack[FunctionOptions],
) -> tuple[NDArray[np.float64], NDArray[np.float32]]: ...
@overload
def skeleton_points(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    return_info: Literal[True],
    **options: Unpack[FunctionOptions],
) -> tuple[NDArray[np.float64], NDArray[np.float32], Info]: ...
def skeleton_points(
    vertices: Any, faces: ArrayLike | None = None, *, return_info: bool | None = False, **options: Any
) -> Any:
    """Points half-way through the shape: each barycentre moved inwards by half of the shape diameter.

    vertices, faces, options: as for shape_diameter().

    Returns points, float64 (m, 3), and radii, float32 (m,), half of the shape diameters, both NaN where a face
    has no value; with return_info=True also an Info. Raises and warns as shape_diameter().
    """
    target = _OneMesh(vertices, faces, options)
    return _measures.skeleton_points(target, return_info, options)
