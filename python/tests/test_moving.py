"""The rows of docs/moving.md whose library is installed: their call and ours on one shape."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import asdf_vk
from shapes import dumbbell, sphere

AXIS_ONLY: dict[str, Any] = {"rays": 1, "cone_angle": 0.01}


def barycentres_and_normals(vertices: NDArray[Any], faces: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    return (a + b + c) / 3, normals / np.linalg.norm(normals, axis=1, keepdims=True)


def test_open3d_ray_casting() -> None:
    open3d = pytest.importorskip("open3d")
    vertices, faces = dumbbell()
    points, normals = barycentres_and_normals(vertices, faces)
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(open3d.core.Tensor(vertices.astype(np.float32)), open3d.core.Tensor(faces.astype(np.uint32)))
    control = np.array([[0, 0, 5, 0, 0, -1]], np.float32)
    if not np.isfinite(scene.cast_rays(open3d.core.Tensor(control))["t_hit"].numpy()).all():
        pytest.skip("this build of Open3D hits nothing")
    rays = np.concatenate([points - 1e-4 * normals, -normals], axis=1).astype(np.float32)
    theirs = scene.cast_rays(open3d.core.Tensor(rays))["t_hit"].numpy()
    ours = asdf_vk.Scene(vertices, faces).at(points, normals, **AXIS_ONLY)
    hit = np.isfinite(ours)
    assert hit.mean() > 0.9
    np.testing.assert_allclose(ours[hit], theirs[hit], atol=1e-3)


def test_trimesh_thickness() -> None:
    trimesh = pytest.importorskip("trimesh")
    vertices, faces = sphere(3)
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    points, normals = barycentres_and_normals(vertices, faces)
    ball = trimesh.proximity.thickness(mesh, points, normals=normals, method="max_sphere")
    np.testing.assert_allclose(asdf_vk.thickness(mesh, seeds="all"), ball, rtol=0.02)
    ray = trimesh.proximity.thickness(mesh, points, normals=normals, method="ray")
    np.testing.assert_allclose(asdf_vk.Scene(mesh).at(points, normals, **AXIS_ONLY), ray, atol=1e-3)


def test_libigl_shape_diameter() -> None:
    embree = pytest.importorskip("igl.embree")
    vertices, faces = sphere(3)
    points, normals = barycentres_and_normals(vertices, faces)
    theirs = embree.shape_diameter_function(vertices, faces, points, normals, 1000)
    ours = asdf_vk.Scene(vertices, faces).at(points, normals, rays=1000)
    # The mean chord over a half-space is 1 on a unit sphere; ours is 1.717 by its cone and weights.
    np.testing.assert_allclose(np.median(theirs), 1, rtol=0.05)
    np.testing.assert_allclose(np.median(ours), 1.717, rtol=0.01)
