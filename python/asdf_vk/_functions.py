"""The free functions: one mesh, one call."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import mesh_argument
from ._compute import computed, method_of, skeleton_of, values_of, with_diameter
from ._info import Info, info_of
from ._options import BackendOptions, FunctionOptions, Progress
from ._scene import Scene
from ._session import session_of

if TYPE_CHECKING:
    from typing_extensions import Unpack


def _computed(vertices: Any, faces: Any, options: dict[str, Any], **implied: Any) -> _core.ComputedFields:
    """Computes on the session of the backend options, and removes these options."""
    session = session_of(options)
    mesh = mesh_argument(vertices, faces)
    return computed(lambda own, progress: session._opened.compute(mesh, own, progress), options, implied)


def compute(vertices: Any, faces: ArrayLike | None = None, **options: Unpack[FunctionOptions]) -> Info:
    """Computes fields and report for all given options in one pass.

    vertices: (n, 3) float32 or float64, or an object with `vertices` and `faces` (Mesh, trimesh.Trimesh).
    faces: (m, 3) int32, uint32 or int64 indices, counter-clockwise seen from outside. Other integer types are
        converted. float64 and 32-bit integers are used in place.
    options: measure="thickness" or "both", segment="parts" or "cgal", centres=True and per="vertex" add fields;
        docs/python.md explains all options.

    Returns the report with all fields by name, for example info.fields["sdf"]. Raises InputError, UsageError,
    DeviceError, CancelledError. Issues MeshWarning.
    """
    return info_of(_computed(vertices, faces, dict(options)))


def shape_diameter(
    vertices: Any, faces: ArrayLike | None = None, **options: Unpack[FunctionOptions]
) -> NDArray[np.float32]:
    """Shape diameter function: how thick the shape is behind each face.

    vertices, faces: as for compute(), which also returns the report.
    options: seeds (faces that cast rays: 0.1, 5000, "10%", "all" or "auto"), rays, cone_angle, recipe, max_error, orient,
        backend, threads, progress, ... (docs/python.md). per="vertex": the mean over the faces of each vertex.

    Returns float32 (m,) or (n,), in the unit of the mesh, NaN = no value. Raises and warns like compute().
    """
    given = dict(options)
    return values_of(_computed(vertices, faces, with_diameter(given)), "sdf", given)


def thickness(
    vertices: Any, faces: ArrayLike | None = None, **options: Unpack[FunctionOptions]
) -> NDArray[np.float32]:
    """Wall thickness: diameter of the largest ball that touches a face from inside and crosses no opposing wall.

    vertices, faces: as for compute(). All faces are measured; `seeds` has no effect. Further options:
    thinner_than: judge whether any point of the surface is thinner than this length (unit of the mesh), and find the
        thin regions. compute(..., measure="thickness", thinner_than=X).thickness has the verdict and the regions.
    allow_sharp_edges: leave thin regions with a sharp edge or tip out of the verdict. Needs thinner_than.

    Returns float32 (m,) at the barycentres, or (n,) with per="vertex", in the unit of the mesh, NaN = no value. Raises
    and warns like compute().
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
    """Segments of the surface: parts by shape diameter and line of sight, or CGAL's segmentation.

    vertices, faces: as for compute().
    method="parts" has the options parts (number of parts, 1 to 100; None: automatic) and detail (0.1 to 10; greater
        values give more parts).
    method="cgal" has the options clusters (of values, 2 to 100, default 5), smoothness (default 0.26) and expansion
        ("all" clusters, or only the "first" as in CGAL 5.5.1). Segments of CGAL's values need definition="cgal" too;
        see asdf_vk.compat.cgal.

    Returns int32 (m,) or (n,), labels 0 to k - 1 ascending by mean value, -1 for a face without a triangle. Raises and
    warns like compute().
    """
    given = dict(options)
    return values_of(_computed(vertices, faces, given, segment=method_of(method)), "segment", given)


def skeleton_points(
    vertices: Any, faces: ArrayLike | None = None, **options: Unpack[FunctionOptions]
) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
    """Points half-way through the shape: each barycentre moved inwards by half of the shape diameter.

    vertices, faces, options: as for shape_diameter().

    Returns points, float64 (m, 3), and radii, float32 (m,), half of the shape diameters. Both are NaN if a face has no
    value. Raises and warns like compute().
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
    """Radius of the largest ball in the shape that is centred at each point, for example at nodes of a skeleton.

    vertices, faces: as for shape_diameter(); faces is None if `vertices` is an object with both.
    points: (k, 3). orient: as for asdf_vk.Scene. Scene.radii() saves time for several calls.
    options: session, or backend, device, require_gpu and threads.

    Returns float64 (k,), in the unit of the mesh: the distance to the nearest face. NaN for a point in front of this
    face or outside of the bounding box. Surfaces inside of the shape, for example of overlapping parts, also limit the
    ball. Raises InputError, UsageError, DeviceError, CancelledError.
    """
    with Scene(vertices, faces, orient=orient, **options) as scene:
        return scene.radii(points, progress=progress)
