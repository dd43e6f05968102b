from __future__ import annotations

import math
import multiprocessing
import os
import subprocess
from pathlib import Path
from typing import Any, Callable

import asdf_vk
import cgal_Segmentation_Module
import numpy as np
import pytest
from asdf_vk.compat import cgal
from numpy.typing import NDArray

PROGRAM = os.environ.get("ASDF_VK_PROGRAM")  # The program asdf-vk.
CGAL_ORACLE = os.environ.get("ASDF_VK_CGAL_ORACLE")  # The program asdfvk-bench-cgal-oracle.

Arrays = tuple[NDArray[np.float64], NDArray[np.int32]]
STEPS: list[Callable[..., Any]] = [
    cgal.sdf_values_postprocessing,
    cgal.segmentation_from_sdf_values,
]


def torus(rows: int, columns: int) -> Arrays:
    """A tube with varying radius around a circle, with 2 * rows * columns faces."""
    u, v = np.meshgrid(
        2 * np.pi * np.arange(rows) / rows, 2 * np.pi * np.arange(columns) / columns, indexing="ij"
    )
    radius = 0.6 + 0.25 * np.cos(3 * u) + 0.05 * np.sin(2 * u + v)
    distance = 2 + radius * np.cos(v)
    points = np.stack([distance * np.cos(u), distance * np.sin(u), radius * np.sin(v)], axis=-1)
    row, column = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    a = row * columns + column
    b = (row + 1) % rows * columns + column
    c = (row + 1) % rows * columns + (column + 1) % columns
    d = row * columns + (column + 1) % columns
    faces = np.stack([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)], axis=2)
    return points.reshape(-1, 3), faces.reshape(-1, 3).astype(np.int32)


def dirty_mesh() -> Arrays:
    """A torus of 80,000 faces, with the defects that meshes made from volumes have."""
    vertices, faces = torus(200, 200)
    random = np.random.default_rng(1)
    doubled = faces[random.choice(len(faces), 500, replace=False)]
    fins = faces[random.choice(len(faces), 300, replace=False)].copy()  # Edges of three faces.
    tips = vertices[fins].mean(axis=1) * 1.05
    fins[:, 2] = len(vertices) + np.arange(300)
    small, of_small = torus(20, 10)
    inverted = of_small[:, ::-1] + len(vertices) + 300
    flat = faces[:20].copy()
    flat[:, 1] = flat[:, 0]
    all_faces = np.concatenate([faces, doubled[:, ::-1], doubled[:100], fins, inverted, flat])
    pinched = np.array([17, 20_017])  # Two distant places of the surface share a vertex.
    all_faces[all_faces == pinched[1]] = pinched[0]
    return np.concatenate([vertices, tips, small * 0.1]), all_faces.astype(np.int32)


def write_off(path: Path, vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> None:
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += [" ".join(map(repr, point.tolist())) for point in vertices]
    lines += ["3 " + " ".join(map(str, face.tolist())) for face in faces]
    path.write_text("\n".join(lines) + "\n")


@pytest.fixture(scope="module")
def mesh() -> Arrays:
    return torus(40, 20)


@pytest.fixture(scope="module")
def values(mesh: Arrays) -> NDArray[np.float64]:
    return cgal.sdf_values(*mesh, backend="reference")[0]


def test_postprocess_is_a_step_of_its_own(mesh: Arrays) -> None:
    raw, limits = cgal.sdf_values(*mesh, postprocess=False, backend="reference")
    assert raw.dtype == np.float64 and raw.shape == (1600,)
    assert limits == (raw.min(), raw.max())
    both, (low, high) = cgal.sdf_values(*mesh, backend="reference")
    separate = cgal.sdf_values_postprocessing(*mesh, raw)
    assert np.array_equal(both, separate[0]) and (low, high) == separate[1]
    assert both.min() == 0 and both.max() == 1
    assert limits[0] < low < high < limits[1]


def test_defaults_are_those_of_cgal(mesh: Arrays) -> None:
    default = cgal.sdf_values(*mesh, postprocess=False, backend="reference")[0]
    named = cgal.sdf_values(
        *mesh, cone_angle=2 / 3 * math.pi, number_of_rays=25, postprocess=False, backend="reference"
    )[0]
    field = asdf_vk.shape_diameter(*mesh, definition="cgal", cone_angle=120, backend="reference")
    assert np.array_equal(default, named)
    assert np.array_equal(default.astype(np.float32), field)
    fewer = cgal.sdf_values(*mesh, number_of_rays=12, postprocess=False, backend="reference")[0]
    assert not np.array_equal(default, fewer)


def test_segments_and_clusters(mesh: Arrays, values: NDArray[np.float64]) -> None:
    labels, count = cgal.segmentation_from_sdf_values(
        *mesh, values, number_of_clusters=3, smoothing_lambda=0.02
    )
    assert labels.dtype == np.int32
    assert np.array_equal(np.unique(labels), np.arange(count))
    means = [values[labels == label].mean() for label in range(count)]
    assert means == sorted(means)
    clusters, cluster_count = cgal.segmentation_from_sdf_values(
        *mesh, values, number_of_clusters=3, smoothing_lambda=0.02, output_cluster_ids=True
    )
    assert cluster_count == 3 and clusters.max() <= 2
    assert count == 12  # Three thick places, three thin places, and six places between them.
    for label in range(count):
        assert len(set(clusters[labels == label].tolist())) == 1


def test_arguments_are_not_changed(mesh: Arrays, values: NDArray[np.float64]) -> None:
    given = values.copy()
    given[5] = -1
    kept = given.copy()
    given.flags.writeable = False
    cgal.sdf_values_postprocessing(*mesh, given)
    assert np.array_equal(given, kept)
    single = cgal.segmentation_from_sdf_values(*mesh, values.astype(np.float32))[0]
    assert single.shape == (1600,)


def test_minus_one_and_nan_are_missing(mesh: Arrays, values: NDArray[np.float64]) -> None:
    with_nan, with_mark = values.copy(), values.copy()
    with_nan[[3, 400]] = np.nan
    with_mark[[3, 400]] = -1
    expected = cgal.sdf_values_postprocessing(*mesh, with_nan)
    result = cgal.sdf_values_postprocessing(*mesh, with_mark)
    assert np.array_equal(expected[0], result[0]) and expected[1] == result[1]
    assert not np.array_equal(expected[0], cgal.sdf_values_postprocessing(*mesh, values)[0])
    assert not np.isnan(expected[0]).any()
    labels, count = cgal.segmentation_from_sdf_values(*mesh, with_nan)
    assert labels.min() == 0 and labels.max() == count - 1
    assert np.array_equal(labels, cgal.segmentation_from_sdf_values(*mesh, with_mark)[0])
    assert (labels == cgal.segmentation_from_sdf_values(*mesh, values)[0]).mean() > 0.99


def test_objects_with_vertices_and_faces(mesh: Arrays, values: NDArray[np.float64]) -> None:
    class Object:
        vertices, faces = mesh

    labels = cgal.segmentation_from_sdf_values(Object(), None, values)[0]
    assert np.array_equal(labels, cgal.segmentation_from_sdf_values(*mesh, values)[0])


@pytest.mark.parametrize(
    ("change", "code"),
    [
        (lambda v: v[:-1], "arraySize"),
        (lambda v: v[:, None], "arraySize"),
        (lambda v: np.where(np.arange(len(v)) == 3, np.inf, v), "valueOutOfRange"),
        (lambda v: np.where(np.arange(len(v)) == 3, -0.5, v), "valueOutOfRange"),
        (lambda v: np.full(len(v), "x"), "arrayType"),
        (lambda v: v.astype(complex), "arrayType"),
    ],
)
def test_wrong_values(mesh: Arrays, values: NDArray[np.float64], change: Any, code: str) -> None:
    for function in STEPS:
        with pytest.raises(asdf_vk.InputError) as raised:
            function(*mesh, change(values))
        assert raised.value.code == code


@pytest.mark.parametrize(
    ("value", "options", "code"),
    [
        (-0.5, {}, "valueOutOfRange"),
        (1.5, {}, "valueOutOfRange"),
        (0.5, {"number_of_clusters": 1}, "optionOutOfRange"),
        (0.5, {"number_of_clusters": 2.5}, "optionOutOfRange"),
        (0.5, {"number_of_clusters": -3}, "optionOutOfRange"),
        (0.5, {"smoothing_lambda": -0.1}, "optionOutOfRange"),
        (0.5, {"smoothing_lambda": "high"}, "optionOutOfRange"),
        (0.5, {"smoothing_lambda": np.nan}, "optionOutOfRange"),
        (0.5, {"expansion": "second"}, "unknownName"),
    ],
)
def test_wrong_options(
    mesh: Arrays, values: NDArray[np.float64], value: float, options: Any, code: str
) -> None:
    changed = values.copy()
    changed[7] = value
    with pytest.raises(asdf_vk.Error) as raised:
        cgal.segmentation_from_sdf_values(*mesh, changed, **options)
    assert raised.value.code == code


def test_no_and_few_values(mesh: Arrays) -> None:
    with pytest.raises(asdf_vk.InputError) as raised:
        cgal.sdf_values_postprocessing(*mesh, np.full(1600, -1))
    assert raised.value.code == "noValues"
    with pytest.raises(asdf_vk.InputError) as raised:
        cgal.segmentation_from_sdf_values(*mesh, np.arange(1600) % 4 / 4)
    assert raised.value.code == "tooFewValues"


def test_cancelling() -> None:
    for function in STEPS:
        with pytest.raises(asdf_vk.CancelledError):
            large = torus(600, 300)
            values = np.linspace(0, 1, len(large[1]))
            function(*large, values, progress=lambda fraction, stage: False)


@pytest.mark.skipif(PROGRAM is None, reason="ASDF_VK_PROGRAM is not set")
def test_same_bits_as_the_command_line(tmp_path: Path, mesh: Arrays) -> None:
    write_off(tmp_path / "mesh.off", *mesh)
    arguments = "--definition cgal --segment cgal --clusters 5 --smoothness 0.08 --quiet".split()
    arguments += ["--backend", "reference", "--fields", "sdf,normalized,segment"]
    arguments += ["-o", str(tmp_path / "mesh.npz")]
    subprocess.run([str(PROGRAM), str(tmp_path / "mesh.off"), *arguments], check=True)
    with np.load(tmp_path / "mesh.npz") as expected:
        raw = cgal.sdf_values(*mesh, postprocess=False, backend="reference")[0]
        assert np.array_equal(raw.astype(expected["sdf"].dtype), expected["sdf"])
        labels, values = cgal_Segmentation_Module.cgal_segmentation_arrays(
            *mesh, 5, 0.08, backend="reference"
        )
        assert labels.max() > 2
        assert np.array_equal(values.astype(expected["normalized"].dtype), expected["normalized"])
        assert np.array_equal(labels, expected["segment"])


@pytest.mark.skipif(not CGAL_ORACLE, reason="ASDF_VK_CGAL_ORACLE is not set")
@pytest.mark.parametrize(("clusters", "smoothness"), [(2, 0.05), (3, 0.02), (3, 0.05), (5, 0.08)])
def test_values_and_labels_of_cgal(
    tmp_path: Path, mesh: Arrays, clusters: int, smoothness: float
) -> None:
    write_off(tmp_path / "mesh.off", *mesh)
    command = [str(CGAL_ORACLE), str(tmp_path / "mesh.off")]
    command += [f"--clusters={clusters}", f"--smoothness={smoothness}"]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    expected = np.loadtxt(output.splitlines())
    labels, values = cgal_Segmentation_Module.cgal_segmentation_arrays(
        *mesh, clusters, smoothness, expansion="first", backend="reference"
    )
    assert np.abs(values - expected[:, 0]).max() < 1e-9
    assert np.array_equal(labels, expected[:, 1])


def test_files_of_the_module(
    tmp_path: Path, mesh: Arrays, capfd: pytest.CaptureFixture[str]
) -> None:
    write_off(tmp_path / "cell.off", *mesh)
    path = str(tmp_path / "cell")
    assert cgal_Segmentation_Module.cgal_segmentation(path, 5, 0.1, backend="reference") == 1
    assert capfd.readouterr() == ("", "")
    segments, numbers = tmp_path / "cell-cgal_5_0.10.csv", tmp_path / "cell-cgal_5_0.10_sdf.csv"
    assert sorted(tmp_path.iterdir()) == [segments, numbers, tmp_path / "cell.off"]
    labels, values = cgal_Segmentation_Module.cgal_segmentation_arrays(
        *mesh, 5, 0.1, backend="reference"
    )
    assert segments.read_text().splitlines() == [str(label) for label in labels]
    assert numbers.read_text().splitlines() == ["%g" % value for value in values]
    assert np.genfromtxt(numbers).shape == (1600,)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (None, 2),
        ("", 3),
        ("ply\nformat ascii 1.0\n", 3),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n", 3),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", 3),
        ("OFF\n3 1 0\n0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n", 3),
        ("OFF\n0 0 0\n", 4),
        ("OFF # nothing\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", 4),
        ("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", 6),
        ("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n", 6),
    ],
)
def test_return_codes_of_the_module(tmp_path: Path, text: str | None, code: int) -> None:
    if text is not None:
        (tmp_path / "cell.off").write_text(text)
    before = os.listdir(tmp_path)
    assert cgal_Segmentation_Module.cgal_segmentation(tmp_path / "cell", 3, 0.2) == code
    assert os.listdir(tmp_path) == before


def test_no_file_remains_of_a_failure(tmp_path: Path, mesh: Arrays) -> None:
    write_off(tmp_path / "cell.off", *mesh)
    (tmp_path / "cell-cgal_3_0.20_sdf.csv").mkdir()  # A folder, which the result cannot replace.
    with pytest.raises(OSError):
        cgal_Segmentation_Module.cgal_segmentation(tmp_path / "cell", 3, 0.2, backend="reference")
    assert not [name for name in os.listdir(tmp_path) if name.endswith(".tmp")]
    with pytest.raises(asdf_vk.UsageError):
        cgal_Segmentation_Module.cgal_segmentation(tmp_path / "cell", 1, 0.2, backend="reference")


def _in_child(path: str, results: Any) -> None:
    try:
        results.put(cgal_Segmentation_Module.cgal_segmentation(path, 3, 0.2, backend="reference"))
    except BaseException as error:  # Every failure is reported, so that the parent does not wait for ever.
        results.put(repr(error))


def test_the_module_works_in_a_forked_process(tmp_path: Path, mesh: Arrays) -> None:
    cgal.sdf_values(*mesh, backend="reference")  # Uses asdf_vk before the fork.
    write_off(tmp_path / "cell.off", *mesh)
    context = multiprocessing.get_context("fork")
    results = context.Queue()
    child = context.Process(target=_in_child, args=(str(tmp_path / "cell"), results))
    child.start()
    assert results.get(timeout=60) == 1
    child.join(10)
    assert len((tmp_path / "cell-cgal_3_0.20.csv").read_text().splitlines()) == 1600


def test_a_dirty_mesh_of_80000_faces(tmp_path: Path) -> None:
    vertices, faces = dirty_mesh()
    assert len(faces) > 80_000
    write_off(tmp_path / "cell.off", vertices, faces)
    assert cgal_Segmentation_Module.cgal_segmentation(tmp_path / "cell", 3, 0.2) == 1
    labels = np.loadtxt(tmp_path / "cell-cgal_3_0.20.csv", dtype=np.int64)
    values = np.loadtxt(tmp_path / "cell-cgal_3_0.20_sdf.csv")
    assert labels.shape == values.shape == (len(faces),)
    assert np.array_equal(np.unique(labels), np.arange(labels.max() + 1))
    assert values.min() == 0 and values.max() == 1
    clean = cgal.sdf_values(*torus(200, 200))[0]
    assert np.corrcoef(values[:80_000], clean)[0, 1] > 0.99
