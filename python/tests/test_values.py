"""Values, segments and thickness are right on shapes with known values, and equal to the values of the program."""

from __future__ import annotations

import dataclasses
import importlib
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import asdf_vk
from asdf_vk import _core, _keywords, _report
from shapes import cube, dumbbell, joined, sphere

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests/support"))
kept_json = importlib.import_module("kept_json")


def bits(values: NDArray[Any]) -> NDArray[Any]:
    return values.view(np.uint32)


def by_program(program: Path, mesh: Path, result: Path, *options: str) -> NDArray[Any]:
    subprocess.run([program, mesh, "-o", result, "--quiet", *options], check=True)
    return np.load(result)


def test_the_diameter_of_a_sphere() -> None:
    values = asdf_vk.shape_diameter(*sphere(4), seeds="all")
    assert values.dtype == np.float32 and values.shape == (20 * 4**4,)
    # 30 rays within 60 degrees of the axis, weighted by 1 / angle (docs/method.md).
    np.testing.assert_allclose(values, 1.717, rtol=0.01)


def test_the_thickness_of_a_sphere_and_of_a_cube() -> None:
    np.testing.assert_allclose(asdf_vk.thickness(*sphere(4)), 2, rtol=0.01)
    np.testing.assert_allclose(asdf_vk.thickness(*cube()), 1, rtol=1e-6)


def test_gaps_voids_and_thick_bodies() -> None:
    vertices, faces = cube()
    two = np.concatenate([vertices, vertices + [1.25, 0, 0]]), np.concatenate([faces, faces + len(vertices)])
    info = asdf_vk.compute(*two, closer_than=0.5, thicker_than=0.9)
    assert info.gap is not None and info.gap.verdict == "failed" and info.gap.is_of_gaps
    (region,) = info.gap.regions
    assert region.kind == "gap" and region.min == pytest.approx(0.25, rel=1e-6)
    assert sorted(region.bodies) == ["component 0", "component 1"] and region.opposite_face is not None
    assert np.nanmin(info.fields["least_gap"]) == pytest.approx(0.25, rel=1e-6)
    assert info.thickness is not None and info.thickness.verdict is None and info.thickness.thick is not None
    assert info.thickness.thick.verdict == "failed" and len(info.thickness.thick.bodies) == 2
    assert info.thickness.thick.ratio == pytest.approx(1, rel=2e-3)
    assert "sdf" not in info.fields and info.voids == () and info.contacts == ()
    hollow = np.concatenate([vertices, 0.5 * vertices + 0.25]), np.concatenate([faces, faces[:, ::-1] + len(vertices)])
    (void,) = asdf_vk.compute(*hollow, measure="gap").voids
    assert void.volume == pytest.approx(0.125, rel=1e-6) and void.face >= len(faces)
    expected = asdf_vk.shape_diameter(vertices, faces)
    np.testing.assert_array_equal(asdf_vk.shape_diameter(vertices, faces, closer_than=1), expected)
    np.testing.assert_array_equal(asdf_vk.shape_diameter(vertices, faces, measure="gap"), expected)
    np.testing.assert_array_equal(asdf_vk.shape_diameter(vertices, faces, measure="thickness,gap"), expected)


def test_a_comparison_with_a_former_version() -> None:
    vertices, faces = cube()
    plate = vertices * [10, 10, 0.5]
    info = asdf_vk.compare((plate, faces), (vertices * [10, 10, 2], faces), thinner_than=0.8)
    assert info.comparison is not None and info.comparison.verdict == "failed" and info.comparison.new_count == 1
    assert info.thickness is not None and info.thickness.regions[0].change == "new" and "sdf" not in info.fields
    assert info.comparison.thinner[0].former_thickness == pytest.approx(2, rel=2e-3)
    change = info.fields["thickness_change"]
    assert change.shape == (len(faces),) and np.nanmin(change) == pytest.approx(-1.5, rel=2e-3)
    with asdf_vk.Scene(plate, faces) as now, asdf_vk.Scene(plate * [1, 1, 4], faces) as other:
        same = now.compare(now, thinner_than=0.8).comparison
        assert same is not None and same.verdict == "passed" and same.kept_count == 1
        region = now.compare(other, thinner_than=0.8, faces=[0]).comparison
        assert region is not None and region.verdict == "failed"
    with pytest.raises(asdf_vk.UsageError, match="a comparison needs measure='thickness'"):
        asdf_vk.compare((plate, faces), (plate, faces), measure="sdf")


def test_joined_meshes(tmp_path: Path) -> None:
    vertices, faces = cube()
    path = tmp_path / "cube.off"
    rows = [" ".join(map(str, row)) for row in vertices] + ["3 " + " ".join(map(str, face)) for face in faces]
    path.write_text("\n".join(["OFF", f"{len(vertices)} {len(faces)} 0", *rows]))
    first = asdf_vk.read_mesh(path)
    corners = [index for face in faces for index in face]
    second = asdf_vk.mesh_of_polygons(vertices + [1.2, 0, 0], corners, range(0, 3 * len(faces) + 1, 3))
    joined = asdf_vk.join_meshes([first, second], ["lid", "base"])
    assert joined.face_count == 2 * len(faces) and joined.objects == ((0, "lid"), (len(faces), "base"))
    gap = asdf_vk.Scene(joined).compute(faces=range(len(faces)), closer_than=0.3).gap
    assert gap is not None and gap.regions[0].bodies == ("lid", "base") and gap.regions[0].min_face < len(faces)
    with pytest.raises(asdf_vk.InputError, match="a name per mesh"):
        asdf_vk.join_meshes([first], [])
    with pytest.raises(asdf_vk.InputError, match="is not a Mesh"):
        asdf_vk.join_meshes([(vertices, faces)])  # type: ignore[list-item]


def test_the_verdict_of_the_thickness() -> None:
    vertices, faces = cube()
    info = asdf_vk.compute(vertices * [60, 1, 20], faces, measure="thickness", thinner_than=1.5)
    values = info.fields["thickness"]
    report = info.thickness
    assert report is not None and report.verdict == "failed" and report.thinner_than == 1.5
    assert info.size == (60, 1, 20) and report.min == pytest.approx(1, rel=1e-6)
    assert report.min_face is not None and values[report.min_face] == pytest.approx(1, rel=1e-6)
    assert report.min_place is not None and report.min_opposite is not None
    assert abs(report.min_place[1] - report.min_opposite[1]) == pytest.approx(1, rel=1e-6)
    assert report.sentence.startswith("FAIL: 1 wall thinner than 1.5: 1 at (")
    assert [region.kind for region in report.regions] == ["wall"] and report.regions[0].least == report.min
    assert report.regions[0].min == report.min and len(report.regions[0].opposite) == 3
    assert report.greatest_section is not None
    assert report.greatest_section.diameter == pytest.approx(1, rel=2e-3)
    assert report.unjudged.open_count == report.unjudged.inverted_count == 0
    np.testing.assert_allclose(info.fields["least_thickness"].min(), report.min, rtol=1e-6)
    # `seeds` does not change which faces are measured. A limit does not change the values.
    given: tuple[int | str, ...] = (1, "all")
    for seeds in given:
        np.testing.assert_array_equal(asdf_vk.thickness(vertices * [60, 1, 20], faces, seeds=seeds), values)
    sound = asdf_vk.compute(
        vertices, faces, measure="thickness", thinner_than=0.5, count_edges=True
    ).thickness
    assert sound is not None and sound.verdict == "passed" and sound.regions == () and sound.counts_edges
    assert "sdf" not in info.fields and info.ray_count == 0
    both = asdf_vk.compute(vertices, faces, measure="both", thinner_than=0.5)
    np.testing.assert_array_equal(both.fields["sdf"], asdf_vk.shape_diameter(vertices, faces))
    np.testing.assert_array_equal(
        asdf_vk.shape_diameter(vertices, faces, measure="thickness", thinner_than=0.5), both.fields["sdf"]
    )
    unlimited = asdf_vk.compute(vertices, faces, measure="thickness").thickness
    assert unlimited is not None and unlimited.verdict is None and unlimited.thinner_than is None


def test_skeleton_points_of_a_cube_lie_on_its_middle_planes() -> None:
    points, radii = asdf_vk.skeleton_points(*cube(), seeds="all")
    info = asdf_vk.compute(*cube(), seeds="all", centres=True)
    assert points.dtype == np.float64 and points.shape == (12, 3)
    vertices, faces = cube()
    centres = vertices[faces].mean(axis=1)
    np.testing.assert_allclose(np.linalg.norm(points - centres, axis=1), radii, rtol=1e-6)
    np.testing.assert_array_equal(radii * 2, info.fields["sdf"])


def test_parts_and_clusters() -> None:
    mesh = joined(sphere(3), (sphere(2)[0] * 0.4 + [3, 0, 0], sphere(2)[1]))
    labels = asdf_vk.segment(*mesh)
    info = asdf_vk.compute(*mesh, segment="parts")
    np.testing.assert_array_equal(info.fields["segment"], labels)
    assert labels.dtype == np.int32 and info.segment_count == labels.max() + 1 == 2
    assert info.parts is not None and sum(info.parts.area_shares) == pytest.approx(1)
    assert len(set(labels[:1280])) == len(set(labels[1280:])) == 1
    info = asdf_vk.compute(*dumbbell(), segment="cgal", clusters=2)
    clusters = info.fields["segment"]
    assert info.parts is None and info.segment_count == clusters.max() + 1 >= 2


def test_fields_and_report() -> None:
    vertices, faces = sphere(4)
    values = asdf_vk.shape_diameter(vertices, faces, seeds=0.2)
    info = asdf_vk.compute(vertices, faces, seeds=0.2)
    assert info.seed_count == info.seed.sum() == round(0.2 * len(faces))
    assert info.face_count == len(faces) and info.vertex_count == len(vertices)
    np.testing.assert_array_equal(info.fields["sdf"], values)
    assert info.error is not None and (info.error[info.seed == 1] == 0).all() and info.error.max() > 0
    assert info.estimated_error is not None and info.estimated_error.held_out_count > 0
    assert info.sdf.min == pytest.approx(values.min())
    assert info.stage_seconds["trace"] > 0 and info.warnings == ()
    assert info.check is None
    info = asdf_vk.compute(vertices, faces, seeds="all", check="all")
    assert info.check is not None and info.check.passed and info.estimated_error is None


def test_per_vertex() -> None:
    vertices, faces = dumbbell()
    values = asdf_vk.shape_diameter(vertices, faces, per="vertex")
    info = asdf_vk.compute(vertices, faces, per="vertex")
    assert values.shape == (len(vertices),)
    vertex = int(faces[100, 0])
    around = info.fields["sdf"][(faces == vertex).any(axis=1)]
    assert around.min() <= values[vertex] <= around.max()


def test_no_value_is_nan() -> None:
    vertices, faces = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]])
    with pytest.warns(asdf_vk.MeshWarning) as caught:
        values = asdf_vk.shape_diameter(vertices, faces)
    assert np.isnan(values).all()
    assert "missingValues" in [getattr(warning.message, "code") for warning in caught]
    assert {Path(warning.filename) for warning in caught} == {Path(__file__)}


def test_options_reach_the_library() -> None:
    mesh = dumbbell()
    paper = asdf_vk.shape_diameter(*mesh, recipe="paper")
    assert (paper != asdf_vk.shape_diameter(*mesh)).any()
    assert asdf_vk.compute(*mesh, seeds=50).seed_count == 50
    assert asdf_vk.compute(*mesh).seed_count == asdf_vk.compute(*mesh, seeds="auto").seed_count == 3000
    assert asdf_vk.compute(*mesh, seeds="5%").seed_count == 256
    assert asdf_vk.compute(*mesh, definition="cgal").seed_count == 5120
    assert asdf_vk.compute(*mesh, rays=7, seeds=100).ray_count == 700
    first = asdf_vk.compute(*mesh, max_error=0.5)
    assert first.seed_count == 102  # a share of 2 %, as in the program
    assert asdf_vk.compute(*mesh, random_seed=None).random_seed == 1


def test_names_of_options_agree_with_the_extension() -> None:
    assert set(_keywords.ComputeOptions.__annotations__) == set(_core.option_names())


@pytest.mark.parametrize("limit", [0.3, 5])
def test_the_thickness_report_is_that_of_the_program(program: Path, tmp_path: Path, limit: float) -> None:
    path = tmp_path / "dumbbell.ply"
    asdf_vk.write(path, dumbbell())
    command: list[Any] = [program, path, "-o", tmp_path / "result.npy", "--quiet", "--json", "--thinner-than", str(limit)]
    output = subprocess.run(command, check=True, capture_output=True).stdout
    kept_json.keep(output)
    printed = json.loads(output)
    info = asdf_vk.compute(asdf_vk.read_mesh(path), measure="thickness", thinner_than=limit)
    document, ours = printed["thickness"], info.thickness
    assert ours is not None and document["regions"]
    of_program = {"formatVersion", "mesh", "output", "picture", "points", "with", "withFaceCounts", "former", "fields", "version", "commit", "options"}
    snake = {re.sub(r"(?=[A-Z])", "_", key).lower() for key in printed.keys() - of_program}
    assert snake == {field.name for field in dataclasses.fields(_report.Report)}

    def compare(found: Any, expected: Any) -> None:
        if dataclasses.is_dataclass(found):
            for key, value in expected.items():
                compare(getattr(found, re.sub(r"(?=[A-Z])", "_", key).lower()), value)
        elif isinstance(found, tuple):
            assert len(found) == len(expected)
            for one, other in zip(found, expected):
                compare(one, other)
        else:
            assert found == expected

    compare(ours, document)


CALLS = [
    ((), lambda mesh: asdf_vk.shape_diameter(mesh)),
    (("--recipe", "quality", "--seeds", "all"), lambda mesh: asdf_vk.shape_diameter(mesh, recipe="quality", seeds="all")),
    (("--measure", "thickness", "--fields", "thickness"), lambda mesh: asdf_vk.thickness(mesh)),
    (("--segment", "--fields", "segment"), lambda mesh: asdf_vk.segment(mesh)),
    (
        ("--definition", "cgal", "--segment", "cgal", "--fields", "segment"),
        lambda mesh: asdf_vk.segment(mesh, method="cgal", definition="cgal"),
    ),
]


@pytest.mark.parametrize("options, call", CALLS, ids=["sdf", "quality", "thickness", "parts", "cgal"])
def test_same_bits_as_the_program(program: Path, tmp_path: Path, options: tuple[str, ...], call: Any) -> None:
    vertices, faces = dumbbell()
    path = tmp_path / "dumbbell.ply"
    asdf_vk.write(path, (vertices, faces))
    expected = by_program(program, path, tmp_path / "result.npy", *options)
    of_file = call(asdf_vk.read_mesh(path))
    np.testing.assert_array_equal(bits(of_file), bits(expected))


def test_same_bits_for_arrays_of_any_type() -> None:
    vertices, faces = dumbbell()
    vertices = vertices.astype(np.float32)
    expected = asdf_vk.shape_diameter(vertices, faces)
    for v in (vertices, vertices.astype(np.float64), np.asfortranarray(vertices), vertices.astype(">f8")):
        for f in (faces, faces.astype(np.uint32), faces.astype(np.int64), faces.astype(np.uint64), faces.tolist()):
            np.testing.assert_array_equal(asdf_vk.shape_diameter(v, f), expected)


_MODELS = ["cow", "fandisk", "3holes"]
_FURTHER_MODELS = ["horse-10k", "fertility", "cheburashka"]
_PSB = ["1", "101", "121", "141"]


@pytest.mark.filterwarnings("ignore::asdf_vk.MeshWarning")
@pytest.mark.parametrize(
    "name",
    [f"models/{name}.off" for name in _MODELS]
    + [pytest.param(f"models/{name}.off", marks=pytest.mark.slow) for name in _FURTHER_MODELS]
    + [pytest.param(f"psb/off/{name}.off", marks=pytest.mark.slow) for name in _PSB],
)
def test_real_meshes_have_the_bits_of_the_program(
    program: Path, mesh_folder: Path, tmp_path: Path, name: str
) -> None:
    for options, call in CALLS:
        expected = by_program(program, mesh_folder / name, tmp_path / "result.npy", *options)
        np.testing.assert_array_equal(bits(call(asdf_vk.read_mesh(mesh_folder / name))), bits(expected))
