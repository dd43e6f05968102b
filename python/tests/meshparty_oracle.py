"""MeshParty's shape_diameter_function() as a loop over vertices in NumPy; asdf_vk.compat.meshparty defines it."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shapes import Mesh


class TrimeshLike:
    """A mesh with the members that MeshParty reads. Normals of vertices are angle-weighted means over faces."""

    def __init__(self, mesh: Mesh) -> None:
        self.vertices, self.faces = np.asarray(mesh[0], np.float64), np.asarray(mesh[1])
        corners = self.vertices[self.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.face_normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        sums = np.zeros_like(self.vertices)
        for face, at in enumerate(corners):
            for corner in range(3):
                to, other = at[(corner + 1) % 3] - at[corner], at[(corner + 2) % 3] - at[corner]
                cosine = to @ other / np.sqrt((to @ to) * (other @ other))
                sums[self.faces[face, corner]] += np.arccos(np.clip(cosine, -1, 1)) * self.face_normals[face]
        self.vertex_normals = sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), 1e-300)


def first_hit(corners: NDArray[Any], origin: NDArray[Any], axis: NDArray[Any]) -> tuple[float, int]:
    """Returns distance and face of the first hit. Tests all triangles, on both sides (Möller and Trumbore 1997)."""
    a, edge1, edge2 = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = np.cross(axis, edge2)
    t = origin - a
    q = np.cross(t, edge1)
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = 1 / (edge1 * p).sum(axis=1)
        u, v, distance = (t * p).sum(axis=1) * scale, (q @ axis) * scale, (edge2 * q).sum(axis=1) * scale
        distance[~((u >= 0) & (v >= 0) & (u + v <= 1) & (distance >= 0))] = np.inf
    face = int(np.argmin(distance))
    return float(distance[face]), face


def rotation_to(axis: NDArray[Any]) -> NDArray[Any]:
    theta, phi = np.arccos(np.clip(axis[2], -1, 1)), np.arctan2(axis[1], axis[0])
    around_y = np.array([[np.cos(theta), 0, np.sin(theta)], [0, 1, 0], [-np.sin(theta), 0, np.cos(theta)]])
    around_z = np.array([[np.cos(phi), -np.sin(phi), 0], [np.sin(phi), np.cos(phi), 0], [0, 0, 1]])
    turned: NDArray[Any] = around_z @ around_y
    return turned


class Oracle:
    """Sums two times: the seconds for rays, which MeshParty traces with Embree, and the seconds for all other work."""

    def __init__(self) -> None:
        self.ray_seconds = self.other_seconds = 0.0

    def values(self, mesh_inds: Any, mesh: Any, num_points: int = 30, cone_angle: float = np.pi / 3) -> NDArray[Any]:
        begin = time.process_time()
        i = np.arange(num_points)
        turn, radius = np.pi * (3 - np.sqrt(5)) * i, np.sqrt(i / num_points)
        disk = np.stack([radius * np.cos(turn), radius * np.sin(turn), np.full(num_points, 1 / np.tan(cone_angle))], 1)
        disk /= np.linalg.norm(disk, axis=1, keepdims=True)
        corners = np.asarray(mesh.vertices, np.float64)[mesh.faces]
        values, rays_before = np.full(len(mesh_inds), np.nan), self.ray_seconds
        for k, vertex in enumerate(mesh_inds):
            start = mesh.vertices[vertex] - mesh.vertex_normals[vertex]
            rays = disk @ rotation_to(-mesh.vertex_normals[vertex]).T
            ray_begin = time.process_time()
            lengths, faces = (np.array(column) for column in zip(*(first_hit(corners, start, ray) for ray in rays)))
            self.ray_seconds += time.process_time() - ray_begin
            with np.errstate(divide="ignore", invalid="ignore"):
                angles = np.arccos((mesh.face_normals[faces] * rays).sum(axis=1))
                weights = 1 / angles
            good = np.isfinite(lengths) & np.isfinite(weights)
            lengths, angles, weights = lengths[good], angles[good], weights[good]
            if len(angles) == 0:
                continue
            median, deviation = np.median(angles), np.std(angles)
            kept = (angles >= median - deviation) & (angles <= max(median + deviation, np.pi / 2))
            values[k] = (lengths[kept] * weights[kept]).sum() / weights[kept].sum()
        self.other_seconds += time.process_time() - begin - (self.ray_seconds - rays_before)
        return values
