"""meshparty.ray_tracing.shape_diameter_function(), without pyembree, vtk or multiwrapper.

    from asdf_vk.compat import meshparty
    values = meshparty.shape_diameter_function(mesh_inds, mesh)

The function has MeshParty's parameters and defaults (CAVEconnectome/MeshParty, meshparty/ray_tracing.py). MeshParty is
not imported. The function computes MeshParty's definition:

- A ray starts one unit of length below its vertex, at vertex - vertex normal. MeshParty's meshes are in nanometres.
  Scale a mesh first if its size is about one unit.
- The num_points rays go from the start to the points of a Vogel disk of radius 1. The axis of the disk is the reversed
  vertex normal, and its distance from the start is 1 / tan(cone_angle). cone_angle is half of the opening angle, in
  radians.
- The length of a ray is the distance from its start to its first hit. The angle of a ray is the angle between the ray
  and the normal of the hit face; the weight of the ray is 1 / angle. A ray is dropped if its angle is below median -
  deviation. A ray is also dropped if its angle is above median + deviation and above 90 degrees. Median and standard
  deviation are computed over the angles of all rays of the cone.
- The value is the weighted mean of the lengths. The value is NaN if no ray hits anything.

Differences: hits are computed in double precision; MeshParty uses Embree, which computes in float32. If no ray of any
cone hits anything, all values are NaN; MeshParty fails in this case.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._arrays import as_array, float_points
from .._errors import error_of
from .._options import BackendOptions
from .._scene import Scene
from ._normals import face_normals, unit, vertex_normals

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["shape_diameter_function"]

_RAYS_AT_ONCE = 1 << 20  # About 150 MB.


def shape_diameter_function(
    mesh_inds: ArrayLike,
    mesh: Any,
    num_points: int | None = 30,
    cone_angle: float | None = math.pi / 3,
    **options: Unpack[BackendOptions],
) -> NDArray[np.float64]:
    """Weighted mean of ray lengths below vertices of a mesh, by MeshParty's definition.

    mesh_inds: (k,) indices of vertices.
    mesh: a meshparty.trimesh_io.Mesh, a trimesh.Trimesh, or any object with `vertices` and `faces`;
        its `vertex_normals` and `face_normals` are used if they exist.
    num_points: rays per vertex. cone_angle: half of the opening angle, in radians, above 0 and below pi.
    options: backend, device, require_gpu, threads, session; see asdf_vk.Session.

    Returns float64 (k,), in the unit of the mesh. NaN means no value. Raises InputError, UsageError.
    """
    num_points = 30 if num_points is None else num_points
    cone_angle = math.pi / 3 if cone_angle is None else cone_angle
    if isinstance(num_points, bool) or not isinstance(num_points, (int, np.integer)) or not 1 <= num_points <= 1 << 16:
        raise error_of("optionOutOfRange", f"num_points={num_points!r} is not an integer from 1 to {1 << 16}")
    if not isinstance(cone_angle, (int, float, np.floating)) or not 0 < cone_angle < math.pi:
        raise error_of("optionOutOfRange", f"cone_angle={cone_angle!r} is not an angle above 0 and below pi")
    with Scene(getattr(mesh, "vertices", mesh), getattr(mesh, "faces", None), **options) as scene:
        vertices = float_points(mesh.vertices, "vertices")
        inds = as_array(mesh_inds, "mesh_inds", "iu", "indices of vertices")
        if inds.ndim != 1:
            raise error_of("arraySize", f"mesh_inds has the shape {inds.shape}, not (k,)")
        if inds.size and not (-len(vertices) <= inds.min() and inds.max() < len(vertices)):
            raise error_of("indexOutOfRange", f"mesh_inds reach from {inds.min()} to {inds.max()}; there are "
                           f"{len(vertices)} vertices")
        inds = inds.astype(np.int64)
        normals, of_faces = vertex_normals(mesh)[inds], face_normals(mesh)
        if not hasattr(mesh, "face_normals"):
            of_faces = unit(of_faces)
        disk = _directions(int(num_points), float(cone_angle))
        values = np.full(len(inds), np.nan)
        step = max(1, _RAYS_AT_ONCE // int(num_points))
        for begin in range(0, len(inds), step):
            part = slice(begin, begin + step)
            values[part] = _values(scene, vertices[inds[part]] - normals[part], -normals[part], disk, of_faces)
    return values


def _directions(count: int, cone_angle: float) -> NDArray[np.float64]:
    """Returns directions of length 1 around the z axis, (count, 3)."""
    turn = math.pi * (3 - math.sqrt(5)) * np.arange(count)  # The golden angle.
    radius = np.sqrt(np.arange(count) / count)
    return unit(np.stack([radius * np.cos(turn), radius * np.sin(turn), np.full(count, 1 / math.tan(cone_angle))], axis=1))


def _frames(axes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Returns (k, 3, 3): rotations of z to each axis. First the polar angle around y, then the azimuth."""
    x, y, cos_theta = axes.T
    theta, phi = np.arccos(np.clip(cos_theta, -1, 1)), np.arctan2(y, x)
    sin_theta, sin_phi, cos_phi = np.sin(theta), np.sin(phi), np.cos(phi)
    rows = [
        [cos_phi * cos_theta, -sin_phi, cos_phi * sin_theta],
        [sin_phi * cos_theta, cos_phi, sin_phi * sin_theta],
        [-sin_theta, np.zeros_like(phi), cos_theta],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def _values(
    scene: Scene,
    starts: NDArray[np.float64],
    axes: NDArray[np.float64],
    disk: NDArray[np.float64],
    of_faces: NDArray[np.float64],
) -> NDArray[np.float64]:
    values = np.full(len(starts), np.nan)
    with np.errstate(invalid="ignore"):
        frames = _frames(axes)
    usable = np.isfinite(frames).all(axis=(1, 2)) & np.isfinite(starts).all(axis=1)
    rays = np.einsum("kij,rj->kri", frames[usable], disk).reshape(-1, 3)
    origins = np.repeat(starts[usable], len(disk), axis=0)
    lengths, hits = scene._opened.first_hits(float_points(origins), float_points(rays), None)
    with np.errstate(divide="ignore", invalid="ignore"):
        angles = np.arccos((of_faces[hits] * rays).sum(axis=1))
        weights = 1 / angles
    angles[(hits < 0) | ~np.isfinite(weights)] = np.nan
    values[usable] = _means(*(array.reshape(-1, len(disk)) for array in (lengths, angles, weights)))
    return values


def _means(
    lengths: NDArray[np.float64], angles: NDArray[np.float64], weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Returns the weighted mean of each row without outliers. Ignores rays with the angle NaN."""
    means = np.full(len(angles), np.nan)
    some = np.isfinite(angles).any(axis=1)
    lengths, angles, weights = lengths[some], angles[some], weights[some]
    median, deviation = np.nanmedian(angles, axis=1)[:, None], np.nanstd(angles, axis=1)[:, None]
    kept = (angles >= median - deviation) & (angles <= np.maximum(median + deviation, np.pi / 2))
    with np.errstate(invalid="ignore", divide="ignore"):
        means[some] = np.where(kept, lengths * weights, 0).sum(axis=1) / np.where(kept, weights, 0).sum(axis=1)
    return means
