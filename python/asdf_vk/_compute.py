"""Runs one computation. The free functions and Scene call this module."""

from __future__ import annotations

import warnings
from numbers import Integral
from typing import Any, Callable, Collection

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._errors import MeshWarning, error_of
from ._options import Progress, check_names, checked_progress

_STACK_LEVEL = 4  # A warning names the line of the caller's code that calls the public function.


def split_progress(options: dict[str, Any], allowed: Collection[str]) -> Progress | None:
    """Removes `progress` from the options and returns it. Raises UsageError for an option name that is not allowed."""
    progress = checked_progress(options.pop("progress", None))
    check_names(options, [*allowed, "progress"])
    return progress


def method_of(method: Any) -> str:
    if method is not None and (not isinstance(method, str) or method not in ("parts", "cgal")):
        raise error_of("unknownName", f"method={method!r} is unknown; the names are parts, cgal")
    return method or "parts"


def _merged(options: dict[str, Any], implied: dict[str, Any]) -> dict[str, Any]:
    for name, value in implied.items():
        if options.get(name) is not None and not (isinstance(options[name], type(value)) and options[name] == value):
            hint = "use compute()"
            if name == "segment":
                is_count = isinstance(options[name], Integral)
                hint = "parts=N sets the number of parts" if is_count else "method= selects the method"
            raise error_of("optionConflict", f"{name}={options[name]!r} contradicts this function: {hint}")
    return {**options, **implied}


def computed(
    compute: Callable[[dict[str, Any], Progress | None], _core.ComputedFields],
    options: dict[str, Any],
    implied: dict[str, Any],
) -> _core.ComputedFields:
    """Calls `compute` with the options of the caller and the implied options. Issues the warnings of the report."""
    progress = split_progress(options, _core.option_names())
    result = compute(_merged(options, implied), progress)
    for warning in result.warnings():
        warnings.warn(MeshWarning(warning.message, warning.code), stacklevel=_STACK_LEVEL)
    return result


def values_of(result: _core.ComputedFields, name: str, options: dict[str, Any]) -> NDArray[Any]:
    """Returns the values of a field per face, or per vertex if the options have per="vertex"."""
    return result.array(name, options.get("per") == "vertex")


def with_diameter(options: dict[str, Any]) -> dict[str, Any]:
    """Returns the options; measure="thickness" becomes measure="both", and "gap" becomes "sdf,gap"."""
    measure = options.get("measure")
    if measure is None:
        implied = {"thickness": ("thinner_than", "thicker_than"), "gap": ("closer_than",)}
        measured = [name for name, limits in implied.items() if any(options.get(limit) is not None for limit in limits)]
    else:
        measured = [name for name in ("thickness", "gap") if isinstance(measure, str) and name in measure.split(",")]
    if not measured:
        return options
    names = ",".join(["sdf", *measured])
    return {**options, "measure": "both" if names == "sdf,thickness" else names}


def skeleton_of(
    result: _core.ComputedFields, options: dict[str, Any]
) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
    radii: NDArray[np.float32] = np.divide(values_of(result, "sdf", options), 2, dtype=np.float32)
    return values_of(result, "centre", options), radii
