"""Compares calls of other libraries with the calls of asdf_vk in docs/moving.md, for libraries that are installed."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import pytest
from numpy.typing import NDArray

import asdf_vk
import asdf_vk.compat.trimesh
from shapes import dumbbell, sphere

AXIS_ONLY: dict[str, Any] = {"rays": 1, "cone_angle": 0.01}


def barycentres_and_normals(vertices: NDArray[Any], faces: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    return (a + b + c) / 3, normals / np.linalg.norm(normals, axis=1, keepdims=True)


def first_hits(vertices: NDArray[Any], faces: NDArray[Any], origins: NDArray[Any], axes: NDArray[Any]) -> NDArray[Any]:
    """Returns the distance to the first triangle on each ray, or inf. Ignores hits below 1e-6 (Möller, Trumbore)."""
    a = vertices[faces[:, 0]]
    edge1, edge2 = vertices[faces[:, 1]] - a, vertices[faces[:, 2]] - a
    found = np.full(len(origins), np.inf)
    for i, (origin, axis) in enumerate(zip(origins, axes)):
        p = np.cross(axis, edge2)
        det = (edge1 * p).sum(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            t = origin - a
            u = (t * p).sum(axis=1) / det
            q = np.cross(t, edge1)
            v = (q @ axis) / det
            distance = (edge2 * q).sum(axis=1) / det
        inside = (u >= 0) & (v >= 0) & (u + v <= 1) & (distance > 1e-6)
        if inside.any():
            found[i] = distance[inside].min()
    return found


def largest_balls(vertices: NDArray[Any], faces: NDArray[Any], points: NDArray[Any], normals: NDArray[Any]) -> Any:
    """Returns diameters of the largest balls that touch the points from inside and contain no vertex."""
    diameters = np.full(len(points), np.inf)
    for i, (point, normal) in enumerate(zip(points, normals)):
        to_vertices = vertices - point
        depth = -(to_vertices @ normal)
        below = depth > 1e-9
        diameters[i] = ((to_vertices[below] ** 2).sum(axis=1) / depth[below]).min()
    return diameters


def test_one_ray_by_numpy() -> None:
    """The definition of trimesh `ray` and of Open3D."""
    vertices, faces = dumbbell()
    chosen = np.arange(0, len(faces), 37)
    points, normals = (array[chosen] for array in barycentres_and_normals(vertices, faces))
    theirs = first_hits(vertices, faces, points, -normals)
    # One ray along the axis. With false_hit_angle=0, no hit is dropped because of the direction of its face.
    ours = asdf_vk.Scene(vertices, faces).at(points, normals, false_hit_angle=0, **AXIS_ONLY)
    np.testing.assert_array_equal(np.isfinite(ours), np.isfinite(theirs))
    close = np.isclose(ours, theirs, atol=1e-3)
    assert close.mean() > 0.97  # The rays differ by up to 0.005 degrees, so that they may hit different faces.


def test_the_largest_ball_by_numpy() -> None:
    """The definition of trimesh `max_sphere`, on a convex shape, because there asdf_vk has the same definition."""
    vertices, faces = sphere(4)
    points, normals = barycentres_and_normals(vertices, faces)
    chosen = np.arange(0, len(faces), 41)
    theirs = largest_balls(vertices, faces, points[chosen], normals[chosen])
    np.testing.assert_allclose(asdf_vk.thickness(vertices, faces)[chosen], theirs, rtol=0.02)


def test_the_mean_over_a_half_space_by_numpy() -> None:
    """The definition of libigl: the unweighted mean over uniform directions within 180 degrees."""
    vertices, faces = sphere(4)
    points, normals = (array[:1] for array in barycentres_and_normals(vertices, faces))
    random = np.random.default_rng(1).normal(size=(400, 3))
    axes = random / np.linalg.norm(random, axis=1, keepdims=True)
    axes *= -np.sign(axes @ normals[0])[:, None]
    theirs = first_hits(vertices, faces, np.repeat(points, len(axes), axis=0), axes)
    assert np.mean(theirs[np.isfinite(theirs)]) == pytest.approx(1, rel=0.06)
    assert asdf_vk.Scene(vertices, faces).at(points, normals, rays=1000)[0] == pytest.approx(1.717, rel=0.01)


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
    cases: list[tuple[Literal["max_sphere", "ray"], float]] = [("max_sphere", 0.02), ("ray", 1e-3)]
    for method, tolerance in cases:
        theirs = trimesh.proximity.thickness(mesh, points, normals=normals, method=method)
        ours = asdf_vk.compat.trimesh.thickness(mesh, points, normals=normals, method=method)
        np.testing.assert_allclose(ours, theirs, rtol=tolerance)
    np.testing.assert_allclose(asdf_vk.thickness(mesh), trimesh.proximity.thickness(mesh, points, normals=normals), rtol=0.02)


def test_libigl_shape_diameter() -> None:
    embree = pytest.importorskip("igl.embree")
    vertices, faces = sphere(3)
    points, normals = barycentres_and_normals(vertices, faces)
    theirs = embree.shape_diameter_function(vertices, faces, points, normals, 1000)
    ours = asdf_vk.Scene(vertices, faces).at(points, normals, rays=1000)
    # On a sphere of radius 1, the mean chord over a half-space is 1. asdf_vk has 1.717 because of its cone and weights.
    np.testing.assert_allclose(np.median(theirs), 1, rtol=0.05)
    np.testing.assert_allclose(np.median(ours), 1.717, rtol=0.01)
