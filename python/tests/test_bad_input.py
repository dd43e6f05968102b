"""Wrong arguments of every kind raise an exception of asdf_vk with an error code, and never crash."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable, Iterator

import numpy as np
import pytest

import asdf_vk
import cgal_Segmentation_Module
from asdf_vk import _core
from asdf_vk.compat import cgal, trimesh
from shapes import cube

VERTICES, FACES = cube()

OBJECTS: list[Any] = [
    None,
    True,
    0,
    1.5,
    1j,
    "text",
    b"bytes",
    object(),
    {},
    {1: 2},
    set(),
    [],
    [[]],
    [[1, 2], [3]],
    [["a", "b", "c"]],
    [[None, None, None]],
    np.float64(1),
    np.zeros(3),
    np.zeros((8, 3, 1)),
    np.zeros((8, 2)),
    np.zeros((8, 4)),
    np.zeros((3, 8)),
    np.zeros((8, 3), complex),
    np.zeros((8, 3), "datetime64[s]"),
    np.zeros((8, 3), "U4"),
    np.zeros((8, 3), "V8"),
    np.zeros((8, 3), object),
    np.zeros((8, 3), [("a", float)]),
    np.ma.masked_all((8, 3)),
    range(3),
    lambda: None,
    SimpleNamespace(vertices=VERTICES),
]
NUMBERS: list[Any] = [np.array([0.1, 0.2]), np.array(0.5j), np.array("x"), np.True_, "\ud800", float("nan"), float("inf"), -float("inf"), -1, -0.5, 0, 2**64, 10**400, "x", "", [], 1j, object()]
TEXTS: list[Any] = ["\ud800", np.array(["all"]), 1, 1.5, "", "unknown", b"all", object(), "\0", "x" * 10000]


def with_corner(value: Any, dtype: Any) -> Any:
    faces = FACES.astype(dtype)
    faces[5, 1] = value
    return faces


def with_coordinate(value: float) -> Any:
    vertices = VERTICES.copy()
    vertices[3, 1] = value
    return vertices


def wrong_meshes() -> Iterator[tuple[Any, Any]]:
    for wrong in OBJECTS:
        yield wrong, FACES
        if wrong is not None:
            yield VERTICES, wrong
        if wrong is not None:
            yield wrong, wrong
    yield VERTICES, FACES.astype(np.float64)
    yield VERTICES, FACES + 0.5
    yield VERTICES, FACES.astype(bool)
    for value, dtype in ((-1, np.int32), (8, np.int32), (-1, np.int64), (2**32, np.int64), (2**63 - 1, np.int64)):
        yield VERTICES, with_corner(value, dtype)
    yield VERTICES, with_corner(2**64 - 1, np.uint64)
    yield VERTICES, with_corner(2**32 - 1, np.uint32)
    yield VERTICES, with_corner(-128, np.int8)
    for number in (np.nan, np.inf, -np.inf):
        yield with_coordinate(number), FACES
        yield with_coordinate(number).astype(np.float32), FACES
    yield VERTICES[:0], FACES
    yield VERTICES, FACES[:0]
    yield VERTICES[:0], FACES[:0]
    yield np.broadcast_to(np.float32(0), (2**33, 3)), FACES
    yield VERTICES, np.broadcast_to(np.int8(0), (2**40, 3))
    yield np.broadcast_to(np.int8(0), (2**32 - 1, 3)), FACES


NUMERIC = ["max_error", "max_relative_error", "rays", "cone_angle", "random_seed", "max_iterations"]
NUMERIC += ["false_hit_angle", "outlier_deviations", "pooling", "tolerance", "check"]
TEXTUAL = ["recipe", "definition", "sampler", "cone_rotation", "orient", "smooth", "weights", "guidance", "solver"]
VALID = {
    ("random_seed", 0),
    ("pooling", 0),
    ("false_hit_angle", 0),
    ("outlier_deviations", 2**64),
}


def wrong_options() -> Iterator[dict[str, Any]]:
    for name in NUMERIC:
        for number in NUMBERS:
            if not (isinstance(number, int) and (name, number) in VALID):
                yield {name: number}
    for name in TEXTUAL:
        for text in TEXTS:
            yield {name: text}
    wrong_seeds: list[Any] = [0, -1, 0.0, 1.5, float("nan"), "x%", "%", "200%", "nan%", "all ", "", 2**64, [], b"all", 1j]
    for seeds in wrong_seeds:
        yield {"seeds": seeds}
    for smooth in ((1,), (0, 1), (1, 2, 3), (9, 1), ("a", 1), [2, 1], (2.0, 1)):
        yield {"smooth": smooth}
    yield {"estimate": 1}
    yield {"estimate": False, "max_error": 0.1}
    yield {"seeds": "all", "max_error": 0.1}
    yield {"progress": 1}
    yield {"unknown": 1}
    yield {"measure": "length"}
    yield {"threads": -1}
    yield {"threads": 1.5}
    yield {"threads": 10**9}
    yield {"backend": "gpu"}
    yield {"backend": 1}
    yield {"device": "no such device"}
    yield {"device": 99}
    yield {"device": 1.5}
    yield {"device": "\ud800"}
    yield {"device": np.float64(0)}
    yield {"threads": np.True_}
    yield {"per": np.array(["face"])}
    yield {"require_gpu": 1}
    for name in ("cone_angle", "seeds", "threads", "backend", "progress", "check", "smooth"):
        yield {name: np.zeros((3, 3))}  # The repr() of this array has three lines.
    yield {"return_info": True}
    yield {"parts": 3}
    yield {"detail": 2, "segment": "cgal"}
    yield {"wall_angle": 100}
    yield {"centres": "no"}
    yield {"session": 1}
    yield {"session": None, "per": "edge"}
    yield {"definition": "cgal", "false_hit_angle": 10}


def fails(call: Callable[[], Any]) -> bool:
    try:
        call()
    except asdf_vk.Error as error:
        assert error.code in _core.error_kinds
        assert str(error) and "\n" not in str(error)
        return True
    return False


def test_wrong_meshes() -> None:
    accepted = [
        (type(v), type(f))
        for v, f in wrong_meshes()
        if not fails(lambda: asdf_vk.shape_diameter(v, f, backend="reference"))
    ]
    assert accepted == []


def test_wrong_options() -> None:
    function: Any = asdf_vk.shape_diameter
    accepted = [
        options
        for options in wrong_options()
        if not fails(lambda: function(VERTICES, FACES, **{"backend": "reference", **options}))
    ]
    assert accepted == []


def test_kinds_of_wrong_input_are_many() -> None:
    assert len(list(wrong_meshes())) + len(list(wrong_options())) >= 200


def test_wrong_arguments_of_the_other_functions(reference: asdf_vk.Session) -> None:
    def segment(**options: Any) -> Callable[[], Any]:
        return lambda: asdf_vk.segment(VERTICES, FACES, session=reference, **options)

    def thickness(**options: Any) -> Callable[[], Any]:
        return lambda: asdf_vk.thickness(VERTICES, FACES, session=reference, **options)

    assert fails(segment(method="x"))
    assert fails(segment(parts=0)) and fails(segment(parts=101)) and fails(segment(parts=2, detail=2))
    assert fails(segment(clusters=3)) and fails(segment(method="cgal", parts=3))
    assert fails(segment(method="cgal", clusters=1)) and fails(segment(method="cgal", smoothness=-1))
    assert fails(segment(method="cgal", smoothness=float("nan"))) and fails(segment(method="cgal", expansion="x"))
    assert fails(segment(postprocess="x")) and fails(segment(seeds=-1))
    assert fails(thickness(thinner_than=0)) and fails(thickness(thinner_than=float("nan")))
    assert fails(thickness(wall_angle=90)) and fails(thickness(wall_angle=181)) and fails(thickness(per="x"))
    for name in ("count_details", "count_edges"):
        assert fails(thickness(**{name: True})) and fails(thickness(thinner_than=1, **{name: 1}))
    assert fails(thickness(thinner_than=1, allow_sharp_edges=True))


def test_wrong_files(tmp_path: Any) -> None:
    paths: list[Any] = [1, None, object(), np.zeros((3, 3)), "", "\0", tmp_path / "a\nb" / "c", "\ud800.ply", tmp_path, tmp_path / "none"]
    for path in paths:
        assert fails(lambda: asdf_vk.read_mesh(path)), path
        assert fails(lambda: asdf_vk.write(path, cube())), path
    assert fails(lambda: asdf_vk.read_mesh(b"/tmp/\xff.ply"))
    assert fails(lambda: asdf_vk.write(tmp_path / "x.ply", cube(), format=1))  # type: ignore[arg-type]
    assert fails(lambda: asdf_vk.write(tmp_path / "x.ply", cube(), ascii="yes"))  # type: ignore[arg-type]
    garbage = tmp_path / "garbage.ply"
    for text in (b"", b"ply", b"\xff" * 100, b"ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n"):
        garbage.write_bytes(text)
        assert fails(lambda: asdf_vk.read_mesh(garbage))
    target = tmp_path / "x.ply"
    wrong_fields: list[Any] = [1, "x", {"a": 1}, {"a": "text"}, {"a": np.zeros((12, 3, 3))}, {"a": np.zeros(3)}]
    wrong_fields += [{"\ud800": np.zeros(12)}, {1: np.zeros(12)}, {"a\0": np.zeros(12)}, {"": np.zeros(12)}, {"a b": np.zeros(12)}, {"a": np.full(12, 2**40)}, {"a": np.zeros(12, complex)}]
    for fields in wrong_fields:
        assert fails(lambda: asdf_vk.write(target, cube(), fields)), fields
    assert not target.exists()


def test_numpy_scalars_are_numbers_and_flags(reference: asdf_vk.Session) -> None:
    numbers: dict[str, Any] = {"seeds": np.int64(5), "rays": np.int32(7), "cone_angle": np.float32(90)}
    numbers |= {"estimate": np.False_, "random_seed": np.uint64(3)}
    info = asdf_vk.compute(*cube(), session=reference, **numbers)
    assert info.seed_count == 5 and info.ray_count == 35 and info.random_seed == 3
    half: Any = np.float32(0.5)
    assert asdf_vk.compute(*cube(), seeds=half).seed_count == 6
    asdf_vk.Session(backend="reference", threads=np.int64(1), require_gpu=np.False_)  # type: ignore[arg-type]


def test_wrong_arguments_of_the_functions_of_cgal() -> None:
    values = np.linspace(0, 1, 12)

    def segment(**options: Any) -> Callable[[], Any]:
        return lambda: cgal.segmentation_from_sdf_values(VERTICES, FACES, values, **options)

    for wrong in OBJECTS:
        assert fails(lambda: cgal.sdf_values_postprocessing(VERTICES, FACES, wrong)), wrong
        assert fails(lambda: cgal.segmentation_from_sdf_values(VERTICES, FACES, wrong)), wrong
    for number in NUMBERS:
        if not isinstance(number, int) or number != 0:
            assert fails(segment(smoothing_lambda=number)), number
        assert fails(segment(number_of_clusters=number)), number
        assert fails(lambda: cgal.sdf_values(VERTICES, FACES, cone_angle=number)), number
        assert fails(lambda: cgal.sdf_values(VERTICES, FACES, number_of_rays=number)), number
    assert fails(segment(expansion="x")) and fails(segment(threads=-1)) and fails(segment(output_cluster_ids="no"))
    assert fails(lambda: cgal.sdf_values(VERTICES, FACES, postprocess=np.zeros(2)))  # type: ignore[arg-type]
    assert fails(segment(progress=1)) and fails(lambda: cgal.sdf_values(VERTICES, FACES, foo=1))  # type: ignore[call-arg]


def test_wrong_arguments_of_the_function_of_trimesh(reference: asdf_vk.Session) -> None:
    def thickness(**given: Any) -> Callable[[], Any]:
        mesh = SimpleNamespace(vertices=VERTICES, faces=FACES, **given.pop("mesh", {}))
        arguments: dict[str, Any] = {"points": [[0.3, 0.4, 1]], "session": reference, **given}
        return lambda: trimesh.thickness(mesh, **arguments)

    for normals in ("x", np.zeros((3, 3)), np.zeros(12), np.zeros((12, 2))):
        assert fails(thickness(mesh={"face_normals": normals})), normals
    assert fails(thickness(exterior="no")) and fails(thickness(exterior=np.zeros(2))) and fails(thickness(method=["ray"]))
    assert fails(thickness(points=[0.3, 0.4, 1])) and fails(thickness(points=iter([[0.3, 0.4, 1]])))


def test_wrong_arguments_of_the_module_of_neuron_pipelines() -> None:
    arrays: Any = cgal_Segmentation_Module.cgal_segmentation_arrays
    assert fails(lambda: arrays(VERTICES, FACES, None, 0.2)) and fails(lambda: arrays(VERTICES, FACES, 3, None))
    assert cgal_Segmentation_Module.cgal_segmentation("a\0b", 3, 0.2) == cgal_Segmentation_Module.CANNOT_OPEN


def test_the_type_of_what_is_no_array_is_in_the_message() -> None:
    with pytest.raises(asdf_vk.ArrayTypeError, match="faces is an object of type generator, not an array of integers"):
        asdf_vk.shape_diameter(VERTICES, (face for face in FACES))  # type: ignore[arg-type]
    for path in ("mesh.off", Path("mesh.off")):
        with pytest.raises(asdf_vk.ArrayTypeError, match=r"a path, not a mesh; pass asdf_vk.read_mesh\('mesh.off'\)"):
            asdf_vk.shape_diameter(path)
    mesh = SimpleNamespace(vertices=VERTICES, faces=FACES)
    with pytest.raises(asdf_vk.ArrayTypeError, match="vertices is an object of type SimpleNamespace"):
        asdf_vk.shape_diameter(mesh, FACES)


def test_a_wrong_mesh_has_the_position_in_its_message() -> None:
    with pytest.raises(asdf_vk.InputError, match="face 5") as index:
        asdf_vk.shape_diameter(VERTICES, with_corner(-1, np.int64))
    assert index.value.code == "indexOutOfRange" and index.value.details == {"face": "5"}
    with pytest.raises(asdf_vk.InputError, match="vertex 3") as number:
        asdf_vk.shape_diameter(with_coordinate(np.nan), FACES)
    assert number.value.code == "nonFiniteNumber"
    assert isinstance(number.value, ValueError)
