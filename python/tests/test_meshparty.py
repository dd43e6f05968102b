"""Compares asdf_vk.compat.meshparty with the definition in NumPy."""

from __future__ import annotations

import inspect
import math
from typing import Any

import numpy as np
import pytest

import asdf_vk
from asdf_vk.compat import meshparty
from meshparty_oracle import Oracle, TrimeshLike
from shapes import Mesh, cube, dumbbell, joined, sphere, tube


def scaled(mesh: Mesh, factor: float) -> Mesh:
    return mesh[0] * factor, mesh[1]


def wobbling(mesh: Mesh, amount: float, seed: int) -> Mesh:
    return mesh[0] + np.random.default_rng(seed).normal(0, amount, mesh[0].shape), mesh[1]


def test_the_signature_is_that_of_meshparty() -> None:
    parameters = list(inspect.signature(meshparty.shape_diameter_function).parameters.values())
    assert [parameter.name for parameter in parameters[:4]] == ["mesh_inds", "mesh", "num_points", "cone_angle"]
    assert [parameter.default for parameter in parameters[2:4]] == [30, math.pi / 3]


MESHES: dict[str, Mesh] = {
    "sphere": scaled(sphere(3), 50),
    "wobbling sphere": wobbling(scaled(sphere(3), 50), 1, 1),
    "dumbbell": scaled(dumbbell(), 40),
    "wobbling dumbbell": wobbling(scaled(dumbbell(), 40), 0.3, 2),
    "tube": tube(40, 20, 200),
    "sphere in a sphere": joined(scaled(sphere(3), 50), (scaled(sphere(2), 20)[0], sphere(2)[1][:, ::-1])),
    "open sphere": (scaled(sphere(3), 50)[0], sphere(3)[1][200:]),
    "two spheres": joined(scaled(sphere(2), 30), (scaled(sphere(2), 30)[0] + [70, 0, 0], sphere(2)[1])),
    "inverted sphere": (scaled(sphere(2), 50)[0], sphere(2)[1][:, ::-1]),
    "small sphere": scaled(sphere(3), 0.8),  # The rays start outside of the shape.
}


@pytest.mark.parametrize("name", MESHES)
def test_values_are_those_of_the_definition(name: str, reference: asdf_vk.Session) -> None:
    mesh = TrimeshLike(MESHES[name])
    used = np.unique(mesh.faces)
    inds = used[:: max(1, len(used) // 25)]
    expected = Oracle().values(inds, mesh)
    found = meshparty.shape_diameter_function(inds, mesh, session=reference)
    assert found.dtype == np.float64
    np.testing.assert_array_equal(np.isnan(found), np.isnan(expected))
    # If a ray hits a vertex, the ray of the oracle may pass between triangles.
    different = ~np.isclose(found, expected, rtol=1e-9, equal_nan=True)
    assert different.sum() <= 1, (found[different], expected[different])


def test_rays_and_angle(reference: asdf_vk.Session) -> None:
    mesh = TrimeshLike(MESHES["wobbling dumbbell"])
    inds = np.arange(0, len(mesh.vertices), 300)
    for count, angle in ((1, 0.1), (7, 1.5), (40, 1.2)):
        expected = Oracle().values(inds, mesh, count, angle)
        found = meshparty.shape_diameter_function(inds.tolist(), mesh, count, angle, session=reference)
        np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_normals_are_computed_where_the_mesh_has_none(reference: asdf_vk.Session) -> None:
    mesh = TrimeshLike(MESHES["wobbling sphere"])

    class Plain:
        vertices, faces = mesh.vertices, mesh.faces

    inds = np.arange(0, 600, 50)
    np.testing.assert_allclose(
        meshparty.shape_diameter_function(inds, Plain, session=reference),
        meshparty.shape_diameter_function(inds, mesh, session=reference), rtol=1e-6)
    many = np.tile(inds, 4000)  # More rays than one batch of rays has.
    found = meshparty.shape_diameter_function(many, Plain, 30, session=reference)
    np.testing.assert_array_equal(found, np.tile(found[:12], 4000))


def test_no_value(reference: asdf_vk.Session) -> None:
    vertices, faces = scaled(cube(), 10)
    lonely = np.append(vertices, [[5, 5, 50]], axis=0), faces  # The last vertex has no face.
    class Plain:
        vertices, faces = lonely

    assert np.isnan(meshparty.shape_diameter_function([8], Plain, session=reference)).all()
    assert meshparty.shape_diameter_function([], Plain, session=reference).shape == (0,)


def test_wrong_arguments(reference: asdf_vk.Session) -> None:
    mesh = TrimeshLike(cube())
    wrong: list[dict[str, Any]] = [
        {"mesh_inds": [8]}, {"mesh_inds": [-9]}, {"mesh_inds": [[0]]}, {"mesh_inds": [0.5]}, {"mesh_inds": [[0], [0, 1]]}, {"num_points": 0},
        {"num_points": 2.5}, {"cone_angle": 0}, {"cone_angle": math.pi}, {"cone_angle": "wide"}, {"mesh": object()},
        {"unknown": 1}, {"mesh": type("Short", (), {**vars(mesh), "vertex_normals": mesh.vertex_normals[1:]})},
    ]  # fmt: skip
    for arguments in wrong:
        given: dict[str, Any] = {"mesh_inds": [0], "mesh": mesh, "session": reference, **arguments}
        with pytest.raises(asdf_vk.Error):
            meshparty.shape_diameter_function(**given)
