"""Tests asdf_vk.compat.trimesh with an object that replaces trimesh.Trimesh."""

from __future__ import annotations

import inspect
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import asdf_vk
from asdf_vk.compat import trimesh
from shapes import Mesh, cube, joined, sphere


class Trimesh:
    """An object with the members of trimesh.Trimesh that the function reads."""

    def __init__(self, mesh: Mesh) -> None:
        self.vertices, self.faces = mesh
        a, b, c = (self.vertices[self.faces[:, corner]] for corner in range(3))
        normals = np.cross(b - a, c - a)
        self.triangles_center = (a + b + c) / 3
        self.face_normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)


def two_cubes() -> Trimesh:
    """Unit cubes with gaps of 0.5 along x."""
    vertices, faces = cube()
    return Trimesh(joined((vertices, faces), (vertices + [1.5, 0, 0], faces)))


TOP: NDArray[Any] = np.array([[0.3, 0.4, 1], [0.6, 0.2, 1]])  # Points of the upper side of the cube.


def test_the_signature_is_that_of_trimesh() -> None:
    parameters = list(inspect.signature(trimesh.thickness).parameters.values())
    assert [parameter.name for parameter in parameters[:5]] == ["mesh", "points", "exterior", "normals", "method"]
    assert [parameter.default for parameter in parameters[2:5]] == [False, None, "max_sphere"]


@pytest.mark.parametrize("method", ["max_sphere", "ray"])
def test_the_thickness_of_a_cube(method: Any, reference: asdf_vk.Session) -> None:
    mesh = Trimesh(cube())
    values = trimesh.thickness(mesh, TOP, method=method, session=reference)
    assert values.dtype == np.float64
    np.testing.assert_allclose(values, 1, rtol=1e-4)
    given = trimesh.thickness(mesh, TOP, normals=[[0, 0, 5]] * 2, method=method, session=reference)
    np.testing.assert_array_equal(given, values)


@pytest.mark.parametrize("method", ["max_sphere", "ray"])
def test_the_exterior_is_the_gap(method: Any, reference: asdf_vk.Session) -> None:
    sides = np.array([[1, 0.5, 0.5], [0, 0.5, 0.5]])  # On the gap, and opposite to it.
    values = trimesh.thickness(two_cubes(), sides, True, [[1, 0, 0], [-1, 0, 0]], method, session=reference)
    np.testing.assert_allclose(values, [0.5, np.inf], rtol=1e-4)


def test_at_the_barycentres_it_is_the_thickness_of_the_faces(reference: asdf_vk.Session) -> None:
    mesh = Trimesh(sphere(3))
    values = trimesh.thickness(mesh, mesh.triangles_center, session=reference)
    np.testing.assert_allclose(values, asdf_vk.thickness(mesh, session=reference), rtol=1e-5)


def test_normals_of_the_nearest_face(reference: asdf_vk.Session) -> None:
    mesh = Trimesh(sphere(2))
    points = mesh.triangles_center + 0.01 * mesh.face_normals
    given = trimesh.thickness(mesh, points, normals=mesh.face_normals, session=reference)
    np.testing.assert_array_equal(trimesh.thickness(mesh, points, session=reference), given)

    class Plain:
        vertices, faces = mesh.vertices, mesh.faces

    np.testing.assert_allclose(trimesh.thickness(Plain, points, session=reference), given, rtol=1e-9)


def test_wrong_arguments(reference: asdf_vk.Session) -> None:
    mesh = Trimesh(cube())
    wrong: list[dict[str, Any]] = [
        {"method": "sphere"},
        {"normals": [[0, 0, 1]]},
        {"normals": [[0, 0, 0]] * 2},
        {"points": [1, 2, 3]},
        {"mesh": object()},
        {"unknown": 1},
    ]
    for arguments in wrong:
        given: dict[str, Any] = {"mesh": mesh, "points": TOP, "session": reference, **arguments}
        with pytest.raises(asdf_vk.Error):
            trimesh.thickness(**given)
