"""For every keyword of every public function, the value None means the default."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any, Callable

import numpy as np

import asdf_vk
import cgal_Segmentation_Module
from asdf_vk import _options
from asdf_vk.compat import cgal, meshparty, trimesh
from shapes import sphere

MESH = sphere(1)
VALUES = np.linspace(0, 1, len(MESH[1]))
TOP = np.array([[0.0, 0.0, 1.0]])


def keywords(function: Callable[..., Any]) -> list[str]:
    """Returns the keywords of a function, including the keywords of **options."""
    names: list[str] = []
    for name, parameter in inspect.signature(function).parameters.items():
        if parameter.kind == parameter.VAR_KEYWORD:
            names += getattr(_options, parameter.annotation[len("Unpack[") : -1]).__annotations__
        elif parameter.default is not parameter.empty and name != "faces":
            names.append(name)
    return names


def value_of(result: Any) -> Any:
    if isinstance(result, asdf_vk.Session):
        return result.backend
    if isinstance(result, asdf_vk.Info):
        return result.fields
    if isinstance(result, asdf_vk.Mesh):
        return result.vertices
    return result.shape_diameter() if isinstance(result, asdf_vk.Scene) else result


def test_none_is_the_default(tmp_path: Path) -> None:
    rows = [*MESH[0].tolist(), *([3, *face] for face in MESH[1].tolist())]
    lines = [f"OFF {len(MESH[0])} {len(MESH[1])} 0", *(" ".join(map(str, row)) for row in rows)]
    off = tmp_path / "neuron.off"
    off.write_text("\n".join(lines))
    scene = asdf_vk.Scene(*MESH)
    calls: list[tuple[Callable[..., Any], tuple[Any, ...]]] = [
        (asdf_vk.compute, MESH),
        (asdf_vk.compare, (MESH, MESH)),
        (asdf_vk.shape_diameter, MESH),
        (asdf_vk.thickness, MESH),
        (asdf_vk.segment, MESH),
        (asdf_vk.skeleton_points, MESH),
        (asdf_vk.radii, (*MESH, TOP / 2)),
        (asdf_vk.write, (tmp_path / "mesh.ply", MESH)),
        (asdf_vk.write_points, (tmp_path / "points.swc", TOP, [1])),
        (asdf_vk.Session, ()),
        (asdf_vk.Scene, MESH),
        (scene.at, (TOP, TOP)),
        (scene.compute, ()),
        (scene.compare, (scene,)),
        (asdf_vk.read_mesh, (off,)),
        (asdf_vk.join_meshes, ([asdf_vk.read_mesh(off)],)),
        (scene.shape_diameter, ()),
        (scene.thickness, ()),
        (scene.segment, ()),
        (scene.skeleton_points, ()),
        (scene.distance, (TOP,)),
        (scene.radii, (TOP / 2,)),
        (cgal.sdf_values, MESH),
        (cgal.sdf_values_postprocessing, (*MESH, VALUES)),
        (cgal.segmentation_from_sdf_values, (*MESH, VALUES)),
        (trimesh.thickness, (asdf_vk.read_mesh(off), TOP)),
        (meshparty.shape_diameter_function, ([0, 1], asdf_vk.read_mesh(off))),
        (cgal_Segmentation_Module.cgal_segmentation, (off.with_suffix(""), 3, 0.2)),
        (cgal_Segmentation_Module.cgal_segmentation_arrays, (*MESH, 3, 0.2)),
    ]
    named = 0
    for function, arguments in calls:
        names = keywords(function)
        named += len(names)
        expected = value_of(function(*arguments))
        np.testing.assert_equal(value_of(function(*arguments, **dict.fromkeys(names))), expected, str(function))
    assert named > 250
    public = {getattr(asdf_vk, name) for name in asdf_vk.__all__}
    functions = {item for item in public if inspect.isfunction(item) and keywords(item)}
    assert functions <= {function for function, _ in calls}


def test_none_beside_a_session_is_no_conflict(reference: asdf_vk.Session) -> None:
    options: Any = dict.fromkeys(("backend", "device", "require_gpu", "threads"))
    asdf_vk.shape_diameter(*MESH, session=reference, **options)
