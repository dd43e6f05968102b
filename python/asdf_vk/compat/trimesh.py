"""trimesh.proximity.thickness(), without rtree and embreex.

    from asdf_vk.compat import trimesh
    values = trimesh.thickness(mesh, points)

The function has the parameters and defaults of trimesh 4. trimesh is not imported. As in trimesh, a value is
infinite without a hit or an opposing wall. Differences:

- "max_sphere": only opposing walls stop the ball (docs/thickness.md). In trimesh any wall stops the ball, so that
  values fall to 0 at every convex edge. In a closed component, a value is at most the diameter of the largest ball
  inside. The values are exact for the facets; trimesh iterates until the radius changes by less than 1e-6 of the
  diagonal.
- "ray": the ray starts below the point, at a depth of 1e-5 of the diagonal of the bounding box. The length of the ray
  is measured from its start.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._arrays import pairs_array, points_array
from .._errors import error_of
from .._options import BackendOptions
from .._scene import Scene
from .._session import flag_of
from ._normals import face_normals

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["thickness"]


def thickness(
    mesh: Any,
    points: ArrayLike,
    exterior: bool | None = False,
    normals: ArrayLike | None = None,
    method: Literal["max_sphere", "ray"] | None = "max_sphere",
    **options: Unpack[BackendOptions],
) -> NDArray[np.float64]:
    """Thickness of a mesh at points of its surface.

    mesh: a trimesh.Trimesh, or any object with `vertices` (n, 3) and `faces` (m, 3).
    points: (k, 3). exterior: measure outside of the mesh instead of inside; trimesh calls this "reach".
    normals: (k, 3), outwards, of any length above 0. None: each point has the normal of its nearest face, from
        `mesh.face_normals` if it exists.
    method: "max_sphere" is the diameter of the largest ball that touches the surface at the point. "ray" is the length
        of the ray along the reversed normal.
    options: backend, device, require_gpu, threads, session; see asdf_vk.Session.

    Returns float64 (k,), in the unit of the mesh. Raises InputError, UsageError, DeviceError.
    """
    method = "max_sphere" if method is None else method
    if not isinstance(method, str) or method not in ("max_sphere", "ray"):
        raise error_of("unknownName", f"method={method!r} is unknown; the names are max_sphere, ray")
    exterior = flag_of(exterior, "exterior")
    places = points_array(points, "points").astype(np.float64)
    # The scene is made from triangles, because normals belong to triangles. A Mesh can have polygons.
    triangles = getattr(mesh, "vertices", mesh), getattr(mesh, "faces", None)
    with Scene(*triangles, orient="flip" if exterior else "keep", **options) as scene:
        if normals is None:
            normals = face_normals(mesh)[scene._opened.nearest_faces(places, None)]
        places, axes = pairs_array(places, normals)
        if exterior:
            axes = -axes
        if method == "max_sphere":
            values = scene._opened.thickness_at(places, axes, {}, None)
        else:  # One ray on the axis. false_hit_angle=0 keeps every hit.
            values = scene.at(places, axes, rays=1, cone_angle=0.01, false_hit_angle=0).astype(np.float64)
    return np.where(np.isnan(values), np.inf, values)
