"""Tests Scene: many queries on one mesh, values at points, regions."""

from __future__ import annotations

import gc
import threading
import time
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import asdf_vk
from shapes import cube, dumbbell, sphere


def barycentres_and_normals(vertices: NDArray[Any], faces: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    return (a + b + c) / 3, normals / np.linalg.norm(normals, axis=1, keepdims=True)


@pytest.fixture(scope="module", params=["vulkan", "reference"])
def scene(request: pytest.FixtureRequest) -> asdf_vk.Scene:
    return asdf_vk.Scene(*dumbbell(), backend=request.param)


def test_a_scene_has_the_values_of_the_functions() -> None:
    mesh = dumbbell()
    scene = asdf_vk.Scene(*mesh)
    assert scene.face_count == len(mesh[1])
    all_given: list[dict[str, Any]] = [{}, {"seeds": "all"}, {"recipe": "paper"}, {"definition": "cgal"}]
    for given in all_given:
        np.testing.assert_array_equal(scene.shape_diameter(**given), asdf_vk.shape_diameter(*mesh, **given))
    np.testing.assert_array_equal(scene.thickness(), asdf_vk.thickness(*mesh))
    np.testing.assert_array_equal(scene.segment(), asdf_vk.segment(*mesh))
    points, radii = scene.skeleton_points()
    expected_points, expected_radii = asdf_vk.skeleton_points(*mesh)
    np.testing.assert_array_equal(points, expected_points)
    np.testing.assert_array_equal(radii, expected_radii)


def test_values_at_barycentres_are_those_of_the_faces(scene: asdf_vk.Scene) -> None:
    vertices, faces = dumbbell()
    points, normals = barycentres_and_normals(vertices, faces)
    values = scene.shape_diameter(seeds="all")
    at = scene.at(points, 3 * normals)
    assert at.dtype == np.float32 and at.shape == values.shape
    diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
    assert (np.abs(at - values) < 1e-4 * diagonal).mean() > 0.97
    np.testing.assert_array_equal(scene.at(points.astype(np.float32), normals, rays=1), scene.at(
        points.astype(np.float32).astype(np.float64), normals, rays=1))


def test_values_at_other_points() -> None:
    scene = asdf_vk.Scene(*cube())
    along_x = np.array([[0.0, 0.5, 0.5], [0.25, 0.5, 0.5], [2, 0.5, 0.5]]), np.array([[-1.0, 0, 0]] * 2 + [[-1, 0, 0]])
    np.testing.assert_allclose(scene.at(*along_x, rays=1, cone_angle=0.01)[:2], [1, 0.75], rtol=1e-4)
    assert np.isnan(scene.at(*along_x)[2])
    assert scene.at(np.zeros((0, 3)), np.zeros((0, 3))).shape == (0,)


def test_regions(scene: asdf_vk.Scene) -> None:
    faces = dumbbell()[1]
    mask = np.arange(len(faces)) % 4 == 0
    whole = scene.shape_diameter(seeds="all")
    values = scene.shape_diameter(faces=mask, seeds="all")
    info = scene.compute(faces=mask, seeds="all")
    np.testing.assert_array_equal(values[mask], whole[mask])
    assert np.isnan(values[~mask]).all()
    assert info.region_face_count == info.seed_count == mask.sum() and info.face_count == len(faces)
    np.testing.assert_array_equal(scene.shape_diameter(faces=np.flatnonzero(mask), seeds="all"), values)
    everything = np.ones(len(faces), bool)
    np.testing.assert_array_equal(scene.shape_diameter(faces=everything), scene.shape_diameter())
    assert scene.compute(faces=[5], seeds="all").seed_count == 1
    walls = scene.thickness(faces=mask)
    np.testing.assert_array_equal(walls[mask], scene.thickness()[mask])
    assert np.isnan(scene.skeleton_points(faces=mask)[1][~mask]).all()


def test_wrong_arguments() -> None:
    scene = asdf_vk.Scene(*cube(), backend="reference")
    ones = np.ones((2, 3))
    calls: list[Any] = [
        lambda: scene.at(ones, ones[:1]),
        lambda: scene.at(ones[:, :2], ones[:, :2]),
        lambda: scene.at(ones, 0 * ones),
        lambda: scene.at(ones, np.nan * ones),
        lambda: scene.at(np.inf * ones, ones),
        lambda: scene.at(ones, ones, rays=0),
        lambda: scene.at(ones, ones, seeds=1),  # type: ignore[call-arg]
        lambda: scene.at("ab", ones),
        lambda: scene.shape_diameter(faces=np.zeros(12, bool)),
        lambda: scene.shape_diameter(faces=np.ones(11, bool)),
        lambda: scene.shape_diameter(faces=[12]),
        lambda: scene.shape_diameter(faces=[-1]),
        lambda: scene.shape_diameter(faces=np.ones(12)),
        lambda: scene.shape_diameter(faces=[[1]]),
        lambda: scene.shape_diameter(faces=[1, 2, 1]),
        lambda: scene.shape_diameter(faces=np.ones(12, int)),
        lambda: scene.shape_diameter(faces=np.ones(12, np.uint8)),
        lambda: scene.shape_diameter(faces=[]),
        lambda: scene.shape_diameter(faces="all"),
        lambda: asdf_vk.Scene(*cube(), progress=3),  # type: ignore[arg-type]
        lambda: scene.shape_diameter(backend="cpu"),  # type: ignore[call-arg]
        lambda: scene.shape_diameter(orient="flip"),
        lambda: asdf_vk.Scene(*cube(), orient="x"),  # type: ignore[arg-type]
        lambda: asdf_vk.Scene(*cube(), seeds=1),  # type: ignore[call-arg]
        lambda: asdf_vk.Scene(1),
    ]
    for i, call in enumerate(calls):
        with pytest.raises(asdf_vk.Error):
            call()
            pytest.fail(f"call {i} succeeded")


def test_a_scene_keeps_what_it_needs() -> None:
    def make() -> asdf_vk.Scene:
        vertices, faces = sphere(3)
        with asdf_vk.Session(backend="vulkan") as session:
            return asdf_vk.Scene(vertices.copy(), faces.copy(), session=session)

    scene = make()
    gc.collect()
    np.testing.assert_array_equal(scene.shape_diameter(), asdf_vk.shape_diameter(*sphere(3), backend="vulkan"))


def test_a_scene_does_not_follow_changes_of_the_arrays() -> None:
    vertices, faces = sphere(2)
    scene = asdf_vk.Scene(vertices, faces)
    expected = asdf_vk.shape_diameter(vertices, faces, seeds="all")
    faces[:] = 2**30
    vertices[:] = np.nan
    np.testing.assert_array_equal(scene.shape_diameter(seeds="all"), expected)


def test_close() -> None:
    with asdf_vk.Scene(*cube()) as scene:
        assert "12 faces" in repr(scene)
    with pytest.raises(asdf_vk.UsageError, match="closed"):
        scene.shape_diameter()
    assert "closed" in repr(scene)


def test_scenes_are_released_while_another_thread_computes() -> None:
    session = asdf_vk.Session()
    worker = threading.Thread(
        target=lambda: asdf_vk.shape_diameter(*sphere(5), seeds="all", rays=100, session=session)
    )
    scenes = [asdf_vk.Scene(*sphere(2), session=session) for _ in range(20)]
    for scene in scenes:
        scene.shape_diameter()
    worker.start()
    begin = time.monotonic()
    scenes.clear()
    gc.collect()
    assert time.monotonic() - begin < 0.5  # The destruction did not wait for the other thread.
    worker.join()
    asdf_vk.shape_diameter(*cube(), session=session)


def test_orientation() -> None:
    vertices, faces = sphere(2)
    inverted = faces[:, ::-1]
    with pytest.warns(asdf_vk.MeshWarning):
        values = asdf_vk.Scene(vertices, inverted, orient="auto").shape_diameter(seeds="all")
    np.testing.assert_allclose(values, 1.7, rtol=0.05)
