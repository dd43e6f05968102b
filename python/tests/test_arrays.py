"""Arrays of the caller: accepted types, copied types, and arguments that must not change."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import asdf_vk
from asdf_vk import _arrays
from shapes import cube, sphere

SLOW_TYPES = (np.int8, np.int16, np.uint16, np.int64, np.uint64)


def address(array: NDArray[Any]) -> int:
    return int(array.__array_interface__["data"][0])


def test_fitting_arrays_are_used_in_place() -> None:
    vertices, faces = cube()
    for vertex_type in (np.float64, np.float32):
        for face_type in (np.int32, np.uint32):
            given = vertices.astype(vertex_type), faces.astype(face_type)
            used: Any = _arrays.mesh_argument(*given)
            assert [address(array) for array in used] == [address(array) for array in given]


def test_other_layouts_are_copied() -> None:
    vertices, faces = cube()
    given = np.asfortranarray(vertices), faces[::-1]
    used: Any = _arrays.mesh_argument(*given)
    for array, original in zip(used, given):
        assert array.flags.c_contiguous
        np.testing.assert_array_equal(array, original)


def test_inputs_are_never_changed(reference: asdf_vk.Session) -> None:
    vertices, faces = sphere(2)
    vertices.setflags(write=False)
    faces.setflags(write=False)
    before = vertices.copy(), faces.copy()
    with pytest.warns(asdf_vk.MeshWarning, match="inverted"):
        asdf_vk.shape_diameter(vertices, faces, orient="flip", session=reference)
    np.testing.assert_array_equal(vertices, before[0])
    np.testing.assert_array_equal(faces, before[1])


def test_accepted_arrays(reference: asdf_vk.Session) -> None:
    vertices, faces = cube()

    def values(v: Any, f: Any = None) -> NDArray[Any]:
        return asdf_vk.shape_diameter(v, f, seeds="all", session=reference)

    expected = values(vertices, faces)
    unaligned = np.zeros(vertices.nbytes + 1, np.uint8)[1:].view(np.float64).reshape(vertices.shape)
    unaligned[:] = vertices
    for v in (unaligned, vertices[::-1][::-1], vertices.astype(np.float16), vertices.astype(np.longdouble)):
        np.testing.assert_array_equal(values(v, faces), expected)
    np.testing.assert_array_equal(values(vertices.astype(np.int64), faces), expected)
    for integer in SLOW_TYPES:
        np.testing.assert_array_equal(values(vertices, faces.astype(integer)), expected)
    np.testing.assert_array_equal(values(vertices, np.asfortranarray(faces)), expected)
    np.testing.assert_array_equal(values(vertices.tolist(), faces.tolist()), expected)
    np.testing.assert_array_equal(values(SimpleNamespace(vertices=vertices, faces=faces)), expected)
    np.testing.assert_array_equal(values(np.ma.MaskedArray(vertices), faces), expected)
    spread = np.zeros((len(vertices), 6))[:, ::2]
    spread[:] = vertices
    np.testing.assert_array_equal(values(spread, faces), expected)


def test_reversed_rows_are_other_faces(reference: asdf_vk.Session) -> None:
    vertices, faces = sphere(2)
    forwards = asdf_vk.shape_diameter(vertices, faces, seeds="all", session=reference)
    backwards = asdf_vk.shape_diameter(vertices, faces[::-1], seeds="all", session=reference)
    np.testing.assert_allclose(backwards, forwards[::-1], rtol=1e-5)


def test_vertices_of_no_face_may_be_nan(reference: asdf_vk.Session) -> None:
    vertices, faces = cube()
    with_nan = np.concatenate([vertices, [[np.nan, 0, 0]]])
    with pytest.warns(asdf_vk.MeshWarning) as caught:
        info = asdf_vk.compute(with_nan, faces, seeds="all", session=reference)
    warned = [str(warning.message) for warning in caught]
    assert len(warned) == 2, warned
    assert any("1 vertex has a coordinate that is not a finite number" in message for message in warned), warned
    assert any("1 vertex belongs to no triangle" in message for message in warned), warned
    assert np.isfinite(info.fields["sdf"]).all() and info.defects.unreferenced_vertex_count == 1


def test_arrays_outlive_what_they_came_from() -> None:
    vertices, faces = sphere(2)
    info = asdf_vk.compute(vertices, faces)
    seed = info.seed
    count = int(seed.sum())
    del info, vertices, faces
    for _ in range(10):
        asdf_vk.shape_diameter(*sphere(2))
    assert int(seed.sum()) == count


def test_values_beyond_float32() -> None:
    vertices, faces = cube()
    for scale in (1e39, 1e-50):
        with pytest.raises(asdf_vk.InputError, match="float32") as caught:
            asdf_vk.shape_diameter(vertices * scale, faces)
        assert caught.value.code == "valueOutOfRange"


def test_fields_beyond_float32(tmp_path: Path) -> None:
    mesh = cube()
    for name in ("x.ply", "x.npy"):
        with pytest.raises(asdf_vk.InputError, match="'height'.*float32") as caught:
            asdf_vk.write(tmp_path / name, mesh, {"height": np.full(len(mesh[1]), 1e39)})
        assert caught.value.code == "valueOutOfRange"
        assert not (tmp_path / name).exists()
    asdf_vk.write(tmp_path / "x.csv", mesh, {"height": np.full(len(mesh[1]), 1e39)})


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_extreme_units(dtype: Any) -> None:
    vertices, faces = sphere(3)
    vertices = vertices.astype(dtype)
    expected = asdf_vk.shape_diameter(vertices, faces)
    for scale in (dtype(2.0**-60), dtype(2.0**60)):
        np.testing.assert_allclose(asdf_vk.shape_diameter(vertices * scale, faces) / scale, expected, rtol=1e-6)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_split_vertices_are_welded(dtype: Any, reference: asdf_vk.Session) -> None:
    vertices, faces = cube()
    soup = vertices[faces.ravel()].astype(dtype)
    apart = soup + dtype(2e-6) * np.random.default_rng(1).uniform(-1, 1, soup.shape).astype(dtype)
    for corners, limit, verdict in ((soup, 0.9, "passed"), (soup, 1.1, "failed"), (apart, 0.9, "passed")):
        with pytest.warns(asdf_vk.MeshWarning, match="28 vertices were welded"):
            info = asdf_vk.compute(corners, np.arange(36).reshape(12, 3), thinner_than=limit, session=reference)
        assert info.thickness is not None and info.thickness.verdict == verdict
        assert info.defects.welded_vertex_count == 28 and info.component_count == 1
        assert len(info.fields["thickness"]) == 12
    with pytest.warns(asdf_vk.MeshWarning):
        per_vertex = asdf_vk.compute(soup, np.arange(36).reshape(12, 3), seeds="all", per="vertex", session=reference)
    assert len(per_vertex.vertex_fields["sdf"]) == 36 and np.isfinite(per_vertex.vertex_fields["sdf"]).all()


@pytest.mark.parametrize("orient", ["keep", "flip"])
def test_open_and_inconsistent_meshes_have_no_verdict(orient: Any, reference: asdf_vk.Session) -> None:
    vertices, faces = cube()
    mixed = faces.copy()
    mixed[5] = mixed[5][::-1]
    for given in (faces[:-1], faces[:-1, ::-1], mixed, mixed[:, ::-1]):
        with pytest.warns(asdf_vk.MeshWarning):
            report = asdf_vk.compute(vertices, given, thinner_than=0.5, orient=orient, session=reference).thickness
        assert report is not None and report.verdict == "notJudged"


@pytest.mark.parametrize("empty", [[], (), np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3), int), np.zeros(0, object)])
def test_empty_faces_are_named(empty: Any, reference: asdf_vk.Session) -> None:
    with pytest.raises(asdf_vk.InputError, match="no faces") as caught:
        asdf_vk.shape_diameter(cube()[0], empty, session=reference)
    assert caught.value.code == "emptyMesh"


def test_other_empty_arrays(reference: asdf_vk.Session) -> None:
    vertices, faces = cube()
    with pytest.raises(asdf_vk.InputError, match="no vertices"):
        asdf_vk.shape_diameter([], faces, session=reference)
    with pytest.raises(asdf_vk.InputError, match="no faces"):
        asdf_vk.shape_diameter([], [], session=reference)
    with pytest.raises(asdf_vk.InputError, match=r"faces has the shape \(1, 0\), not \(n, 3\)"):
        asdf_vk.shape_diameter(vertices, [[]], session=reference)
    scene = asdf_vk.Scene(vertices, faces, session=reference)
    assert scene.at([], []).shape == (0,)
    with pytest.raises(asdf_vk.InputError, match="no face"):
        scene.shape_diameter(faces=[])
