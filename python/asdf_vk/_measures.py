"""Shared implementation of the free functions and of Scene."""

from __future__ import annotations

import warnings
from typing import Any, Collection, Protocol

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._errors import MeshWarning, error_of
from ._info import info_of
from ._options import ComputeOptions, Progress, checked_progress
from ._session import flag_of

_STACK_LEVEL = 4  # The caller of the public function.


class Target(Protocol):
    """A mesh on a session."""

    def compute(self, options: dict[str, Any], progress: Progress | None) -> _core.ComputedFields: ...


def split_progress(options: dict[str, Any], allowed: Collection[str]) -> Progress | None:
    """Removes `progress` from the options and returns it. Only the names of `allowed` may be left."""
    progress = checked_progress(options.pop("progress", None))
    for name in options:
        if name not in allowed:
            raise error_of("unknownName", f"there is no option '{name}'", {"option": name})
    return progress


def _computed(target: Target, options: dict[str, Any], implied: dict[str, Any]) -> _core.ComputedFields:
    """Computes with the caller's options and those that the function implies."""
    progress = split_progress(options, ComputeOptions.__annotations__)
    computed = target.compute({**options, **implied}, progress)
    for warning in computed.warnings():
        warnings.warn(MeshWarning(warning.message, warning.code), stacklevel=_STACK_LEVEL)
    return computed


def _per_vertex(per: str | None) -> bool:
    if per is None:
        return False
    if not isinstance(per, str) or per not in ("face", "vertex"):
        raise error_of("unknownName", f"per={per!r} is unknown; the names are face, vertex")
    return per == "vertex"


def shape_diameter(target: Target, per: str | None, return_info: bool | None, options: dict[str, Any]) -> Any:
    per_vertex = _per_vertex(per)
    returns_info = flag_of(return_info, "return_info")
    computed = _computed(target, options, {"per": per})
    values = computed.array("sdf", per_vertex, True)
    return (values, info_of(computed)) if returns_info else values


def thickness_options(
    thinner_than: float | None, allow_sharp_edges: bool | None, wall_angle: float | None
) -> dict[str, Any]:
    """The options of thickness() by name."""
    return {"thinner_than": thinner_than, "allow_sharp_edges": allow_sharp_edges, "wall_angle": wall_angle}


def thickness(
    target: Target,
    of_measure: dict[str, Any],
    per: str | None,
    return_info: bool | None,
    options: dict[str, Any],
) -> Any:
    per_vertex = _per_vertex(per)
    returns_info = flag_of(return_info, "return_info")
    computed = _computed(target, options, {"measure": "thickness", **of_measure, "per": per})
    values = computed.array("thickness", per_vertex, True)
    return (values, info_of(computed)) if returns_info else values


_METHOD_OF = {"parts": "parts", "detail": "parts", "clusters": "cgal", "smoothness": "cgal", "expansion": "cgal"}


def method_options(
    parts: int | None,
    detail: float | None,
    clusters: int | None,
    smoothness: float | None,
    expansion: str | None,
) -> dict[str, Any]:
    """The options of segment() by name."""
    return {
        "parts": parts,
        "detail": detail,
        "clusters": clusters,
        "smoothness": smoothness,
        "expansion": expansion,
    }


def segment(
    target: Target,
    method: str | None,
    of_method: dict[str, Any],
    return_info: bool | None,
    options: dict[str, Any],
) -> Any:
    method = "parts" if method is None else method
    returns_info = flag_of(return_info, "return_info")
    if not isinstance(method, str) or method not in ("parts", "cgal"):
        raise error_of("unknownName", f"method={method!r} is unknown; the names are parts, cgal")
    for name, value in of_method.items():
        if value is not None and _METHOD_OF[name] != method:
            raise error_of("optionConflict", f"{name} belongs to method={_METHOD_OF[name]!r}, not {method!r}")
    computed = _computed(target, options, {"segmentation": method, **of_method})
    labels = computed.array("segment", False, True)
    return (labels, info_of(computed)) if returns_info else labels


def skeleton_points(target: Target, return_info: bool | None, options: dict[str, Any]) -> Any:
    returns_info = flag_of(return_info, "return_info")
    computed = _computed(target, options, {"centres": True})
    points = computed.array("centre", False, True)
    radii = computed.array("sdf", False, True) / np.float32(2)
    return (points, radii, info_of(computed)) if returns_info else (points, radii)
