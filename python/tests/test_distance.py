from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import asdf_vk
from shapes import Mesh, cube, sphere, tube


def brute_distance(mesh: Mesh, point: NDArray[Any]) -> float:
    """Returns the least distance to all edges, and to all triangles that contain the foot of the perpendicular."""
    a, b, c = mesh[0][mesh[1]].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    height = ((point - a) * normal).sum(axis=1)
    inside = np.ones(len(a), bool)
    least = np.inf
    for p, q in ((a, b), (b, c), (c, a)):
        edge = q - p
        inside &= (np.cross(edge, point - p) * normal).sum(axis=1) >= 0
        share = np.clip(((point - p) * edge).sum(axis=1) / (edge**2).sum(axis=1), 0, 1)
        least = min(least, np.linalg.norm(point - p - share[:, None] * edge, axis=1).min())
    return float(min(least, np.abs(height[inside]).min(initial=np.inf)))


@pytest.mark.parametrize("side_count", [12, 24, 96])
def test_radii_in_a_tube(side_count: int, reference: asdf_vk.Session) -> None:
    mesh = tube(side_count, 0.5, 6)
    points = np.array([[0, 0, z] for z in np.linspace(-2, 2, 9)] + [[0.1, 0.2, 0.3], [1, 0, 0]])
    radii = asdf_vk.radii(*mesh, points, session=reference)
    assert radii.dtype == np.float64
    np.testing.assert_allclose(radii[:-1], [brute_distance(mesh, point) for point in points[:-1]], rtol=1e-6)
    np.testing.assert_allclose(radii[:9], 0.5 * np.cos(np.pi / side_count), rtol=1e-9)
    assert np.isnan(radii[-1])
    distances = asdf_vk.Scene(*mesh, session=reference).distance(points)
    np.testing.assert_array_equal(distances[:-1], radii[:-1])
    assert distances[-1] == pytest.approx(brute_distance(mesh, points[-1]), rel=1e-6)


def test_radii_of_skeleton_points(reference: asdf_vk.Session) -> None:
    mesh = sphere(3)
    with asdf_vk.Scene(*mesh, session=reference) as scene:
        points, half = scene.skeleton_points(seeds="all")
        radii = scene.radii(points)
    assert (radii <= 1).all() and (radii > 0.8).all()
    np.testing.assert_array_equal(radii, asdf_vk.radii(*mesh, points.tolist(), session=reference))


def test_an_inverted_mesh(reference: asdf_vk.Session) -> None:
    vertices, faces = cube()
    inverted = vertices, faces[:, ::-1]
    assert np.isnan(asdf_vk.radii(*inverted, [[0.5, 0.5, 0.4]], session=reference))
    assert asdf_vk.radii(*inverted, [[0.5, 0.5, 0.4]], orient="auto", session=reference) == pytest.approx(0.4)


def test_wrong_points(reference: asdf_vk.Session) -> None:
    scene = asdf_vk.Scene(*cube(), session=reference)
    assert scene.distance([]).shape == scene.radii(np.zeros((0, 3))).shape == (0,)
    for function in (scene.distance, scene.radii):
        with pytest.raises(asdf_vk.InputError, match="point 1 has a coordinate that is not finite"):
            function(np.array([[0, 0, 0], [0, np.nan, 0]]))
        with pytest.raises(asdf_vk.InputError, match="shape"):
            function(np.zeros(3))
    with pytest.raises(asdf_vk.InputError, match="no face with an area"):
        asdf_vk.radii(np.zeros((3, 3)), [[0, 1, 2]], [[0, 0, 0]], session=reference)
    with pytest.raises(asdf_vk.CancelledError):
        scene.distance(np.zeros((1000000, 3)), progress=lambda fraction, stage: False)
