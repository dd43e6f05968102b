"""The free functions, which compute one mesh in one call."""

from __future__ import annotations

from numbers import Integral
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import mesh_argument
from ._compute import computed, method_of, skeleton_of, values_of, with_diameter
from ._errors import error_of
from ._info import Info, info_of
from ._options import BackendOptions, FunctionOptions, Progress
from ._scene import Scene
from ._session import session_of

if TYPE_CHECKING:
    from typing_extensions import Unpack


def _computed(vertices: Any, faces: Any, options: dict[str, Any], **implied: Any) -> _core.ComputedFields:
    """Computes on the session that the backend options describe, and removes these options."""
    session = session_of(options)
    mesh = mesh_argument(vertices, faces)
    return computed(lambda own, progress: session._opened.compute(mesh, own, progress), options, implied)


def compute(vertices: Any, faces: ArrayLike | None = None, **options: Unpack[FunctionOptions]) -> Info:
    """Computes the fields that the options request, and the report.

    vertices: (n, 3) float32 or float64, or an object with `vertices` and `faces` (Mesh, trimesh.Trimesh).
    faces: (m, 3) indices of any integer type, counter-clockwise seen from outside. float64 vertices and 32-bit indices
        are used without a copy.
    options: measure="thickness", "both" or "gap", segment="parts" or "cgal", centres=True and per="vertex" add fields;
        docs/python.md explains all options.

    Returns the report with all fields by name, for example info.fields["sdf"]. Raises InputError, UsageError,
    DeviceError, CancelledError. Issues MeshWarning.
    """
    return info_of(_computed(vertices, faces, dict(options)))


def compare(mesh: Any, former: Any, **options: Unpack[FunctionOptions]) -> Info:
    """Compares the wall thickness of a mesh with a former version of it, which may be triangulated differently.

    mesh, former: objects with `vertices` and `faces` (Mesh, trimesh.Trimesh), or tuples (vertices, faces).
    options: as for compute(). With thinner_than=X, `comparison` of the result counts the walls that are new, thinner,
        kept and gone, and its verdict is "failed" if a wall is new or thinner.

    Returns the report with the fields, among them "thickness_change": the thickness minus that of the former version at
    the same place, NaN if it has no wall there. Raises and warns like compute().
    """
    given: dict[str, Any] = dict(options)
    common: dict[str, Any] = {"session": session_of(given), "orient": given.get("orient") or "keep"}
    before, now = (each if isinstance(each, tuple) else (each,) for each in (former, mesh))
    with Scene(*before, **common) as old, Scene(*now, **common) as new:
        return new.compare(old, **given)


def shape_diameter(
    vertices: Any, faces: ArrayLike | None = None, **options: Unpack[FunctionOptions]
) -> NDArray[np.float32]:
    """Shape diameter function: the local diameter of the shape at each face.

    vertices, faces: as for compute(). To get the report too, use compute().
    options: seeds (faces from which rays start: 0.1, 5000, "10%", "all" or "auto"), rays, cone_angle, recipe,
        max_error, orient, backend, threads, progress, ... (docs/python.md).
    per="vertex" in the options: a value per vertex, the mean over its faces.

    Returns float32 (m,) per face, or (n,) per vertex, in the unit of the mesh. NaN means no value. Raises and warns
    like compute().
    """
    given = dict(options)
    return values_of(_computed(vertices, faces, with_diameter(given)), "sdf", given)


def thickness(
    vertices: Any, faces: ArrayLike | None = None, **options: Unpack[FunctionOptions]
) -> NDArray[np.float32]:
    """Wall thickness: diameter of the largest ball that touches a face from inside and does not cross an opposing wall.

    vertices, faces: as for compute(). All faces are measured; `seeds` has no effect. Further options:
    thinner_than: a limit in the unit of the mesh. compute(..., measure="thickness", thinner_than=X).thickness then has
        the verdict and the regions that are thinner than the limit.
    count_details: thin places that are too small for a wall fail, too. Needs thinner_than.
    count_edges: details and thin edges fail, too. Needs thinner_than.

    Returns float32 (m,) at the barycentres, or (n,) with per="vertex", in the unit of the mesh. NaN means no value.
    Raises and warns like compute().
    """
    given = dict(options)
    return values_of(_computed(vertices, faces, given, measure="thickness"), "thickness", given)


def segment(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    method: Literal["parts", "cgal"] | None = "parts",
    **options: Unpack[FunctionOptions],
) -> NDArray[np.int32]:
    """Segments of the surface: parts such as limbs and handles, or the segments of CGAL.

    vertices, faces: as for compute().
    method="parts" has the options parts (number of parts, 1 to 100; None: automatic) and detail (0.1 to 10; greater
        values give more parts).
    method="cgal" has the options clusters (number of clusters of values, 2 to 100, default 5), smoothness (default
        0.26) and expansion ("all" clusters, or only the "first" as in CGAL 5.5.1). To segment CGAL's values, add
        definition="cgal"; see asdf_vk.compat.cgal.

    Returns int32 (m,) per face, or (n,) per vertex: labels 0 to k - 1, ascending by mean value. A face without a
    triangle has the label -1. Raises and warns like compute().
    """
    if isinstance(faces, Integral) and not isinstance(faces, bool):
        raise error_of("arrayType", f"faces={faces} is a number, not an array; parts={faces} sets the number of parts")
    given = dict(options)
    return values_of(_computed(vertices, faces, given, segment=method_of(method)), "segment", given)


def skeleton_points(
    vertices: Any, faces: ArrayLike | None = None, **options: Unpack[FunctionOptions]
) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
    """Skeleton points: each barycentre, moved inwards by half of the shape diameter of its face.

    vertices, faces, options: as for shape_diameter().

    Returns points, float64 (m, 3), and radii, float32 (m,). A radius is half of the shape diameter. If a face has no
    value, its point and radius are NaN. Raises and warns like compute().
    """
    given = dict(options)
    return skeleton_of(_computed(vertices, faces, given, centres=True), given)


def radii(
    vertices: Any,
    faces: ArrayLike | None,
    points: ArrayLike,
    *,
    orient: Literal["keep", "auto", "flip"] | None = "keep",
    progress: Progress | None = None,
    **options: Unpack[BackendOptions],
) -> NDArray[np.float64]:
    """Radii of the largest balls in the shape around given points, for example around nodes of a skeleton.

    vertices, faces: as for shape_diameter(); faces is None if `vertices` is an object with both.
    points: (k, 3). orient: as for asdf_vk.Scene. For several calls on one mesh, Scene.radii() is faster.
    options: session, or backend, device, require_gpu and threads.

    Returns float64 (k,), in the unit of the mesh: the distance of each point to its nearest face. The radius is NaN if
    the point is in front of this face or outside of the bounding box. Surfaces inside of the shape, for example of
    overlapping parts, also limit the ball. Raises InputError, UsageError, DeviceError, CancelledError.
    """
    with Scene(vertices, faces, orient=orient, **options) as scene:
        return scene.radii(points, progress=progress)
