"""CGAL's package Triangulated Surface Mesh Segmentation, on arrays.

    from asdf_vk.compat import cgal
    values, (low, high) = cgal.sdf_values(vertices, faces)
    labels, count = cgal.segmentation_from_sdf_values(vertices, faces, values)

Names of parameters and defaults are those of CGAL. The functions follow the manual and the outputs of CGAL 5.5.1 and
contain none of its code. Differences:

- A missing value is NaN in results; CGAL has -1. Both are accepted in arguments.
- All clusters are expanded by default, as in some versions of CGAL; expansion="first" is the rule of CGAL 5.5.1.
- Meshes need not be manifold. Two faces of equal orientation are neighbours across an edge that no other face has. An
  edge of more faces is divided into several edges, as if CGAL's readers had split its vertices. CGAL's readers also
  reverse faces of such meshes.
- It is an error (InputError) if there are fewer different values than clusters (code "tooFewValues"), or if no face has
  a value (code "noValues"). CGAL then crashes or does not end.
- None stands for the default of each keyword.
- number_of_clusters is 2 to 100, smoothing_lambda 0 to 1000, number_of_rays 1 to 1024.
"""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from .._arrays import MeshArgument, mesh_argument, values_array
from .._errors import MeshWarning, error_of
from .._options import BackendOptions, Progress, checked_progress
from .._session import flag_of, session_of, thread_count

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["sdf_values", "sdf_values_postprocessing", "segmentation_from_sdf_values"]

_MISSING = -1  # CGAL's mark of a face without a value.
_ANGLE_DIGITS = 9  # Degrees are rounded, so that 2/3 pi is 120.


def sdf_values(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    cone_angle: float | None = 2 / 3 * math.pi,
    number_of_rays: int | None = 25,
    postprocess: bool | None = True,
    seeds: int | float | str | None = "all",
    progress: Progress | None = None,
    **options: Unpack[BackendOptions],
) -> tuple[NDArray[np.float64], tuple[float, float]]:
    """CGAL's sdf_values(): the shape diameter of each face, by default post-processed.

    vertices, faces: (n, 3) and (m, 3), or an object with `vertices` and `faces`; see asdf_vk.shape_diameter().
    cone_angle: full opening angle in radians, above 0 and below pi; rounded to 1e-9 degrees.
    number_of_rays: per face, 1 to 1024.
    postprocess: apply sdf_values_postprocessing().
    seeds: faces that cast rays: "all" as in CGAL, a share such as 0.1, or a count. The values of the other faces are
        interpolated; segments then differ from those of CGAL.
    progress: called with a fraction from 0 to 1 and the name of the stage; False cancels.
    options: backend, device, require_gpu, threads, session; see asdf_vk.Session.

    Returns the values, float64 (m,), and a pair of numbers in the unit of the mesh. Post-processed values are
    in [0, 1], without NaN; the pair is the least and the greatest smoothed value before the mapping to [0, 1]. Without
    post-processing, the values are in the unit of the mesh, NaN = no value; the pair is the least and the greatest
    value, or NaN if no face has a value. Raises InputError, UsageError, DeviceError, CancelledError. Issues
    MeshWarning.
    """
    try:
        if isinstance(cone_angle, (bool, np.bool_)):
            raise TypeError("a flag")
        degrees = None if cone_angle is None else round(math.degrees(cone_angle), _ANGLE_DIGITS)
    except (TypeError, ValueError, OverflowError) as error:
        message = f"cone_angle={cone_angle!r} is not an angle in radians"
        raise error_of("optionOutOfRange", message) from error
    seeds = "all" if seeds is None else seeds
    postprocess = True if postprocess is None else flag_of(postprocess, "postprocess")
    described: dict[str, Any] = {"cone_angle": degrees, "rays": number_of_rays, "seeds": seeds}
    if postprocess:
        described["postprocess"] = "cgal"
    computed = _computed(vertices, faces, described, {**options}, progress)
    for warning in computed.warnings():
        warnings.warn(MeshWarning(warning.message, warning.code), stacklevel=2)
    if postprocess:
        smoothed = computed.report().postprocess
        assert smoothed is not None
        return computed.array("normalized", single=False), (smoothed.min, smoothed.max)
    values: NDArray[np.float64] = computed.array("sdf", single=False)
    present = values[~np.isnan(values)]
    if present.size == 0:
        return values, (math.nan, math.nan)
    return values, (float(present.min()), float(present.max()))


def sdf_values_postprocessing(
    vertices: Any,
    faces: ArrayLike | None,
    sdf_values: ArrayLike,
    *,
    threads: int | None = 0,
    progress: Progress | None = None,
) -> tuple[NDArray[np.float64], tuple[float, float]]:
    """CGAL's sdf_values_postprocessing(): fills missing values, smooths, and maps to [0, 1].

    vertices, faces: as for sdf_values(); faces is None if `vertices` is an object with both.
    sdf_values: (m,), at least 0 and finite; NaN and -1 are missing values. The array is not changed.
    threads: CPU threads; 0: the number of cores. progress: as for sdf_values().

    Returns float64 (m,) in [0, 1], and a pair of the least and the greatest smoothed value, in the unit of
    `sdf_values`. Smoothed values that are all equal are not mapped to [0, 1]. Raises InputError, CancelledError.
    """
    mesh = mesh_argument(vertices, faces)
    values = _values_of(sdf_values, mesh)
    normalized, low, high = _core.postprocess_sdf(mesh, values, thread_count(threads), checked_progress(progress))
    return normalized, (low, high)


def segmentation_from_sdf_values(
    vertices: Any,
    faces: ArrayLike | None,
    sdf_values: ArrayLike,
    *,
    number_of_clusters: int | None = 5,
    smoothing_lambda: float | None = 0.26,
    output_cluster_ids: bool | None = False,
    expansion: Literal["all", "first"] | None = "all",
    threads: int | None = 0,
    progress: Progress | None = None,
) -> tuple[NDArray[np.int32], int]:
    """CGAL's segmentation_from_sdf_values(): clusters of values, and a graph cut into segments.

    vertices, faces: as for sdf_values_postprocessing().
    sdf_values: (m,), post-processed: 0 to 1. Missing values, NaN and -1, are filled as by sdf_values_postprocessing().
        The array is not changed.
    number_of_clusters: 2 to 100. A cluster has any number of segments.
    smoothing_lambda: weight of the boundaries, 0 to 1000; CGAL's manual has 0 to 1.
    output_cluster_ids: return the clusters instead of the segments.
    expansion: clusters that the graph cut expands: "all", or only the "first" as in CGAL 5.5.1.
    threads, progress: as for sdf_values_postprocessing().

    Returns int32 (m,), labels 0 to k - 1 ascending by mean value, and k, the number of segments. With
    output_cluster_ids, returns the clusters and `number_of_clusters`. The labels equal those of CGAL if the values
    agree with those of CGAL to about 1e-5 of the range. Noise of 1e-3 may change many labels. Raises InputError,
    UsageError, CancelledError.
    """
    mesh = mesh_argument(vertices, faces)
    values = _values_of(sdf_values, mesh)
    options = {
        "segment": "cgal",
        "clusters": number_of_clusters,
        "smoothness": smoothing_lambda,
        "expansion": expansion,
    }
    returns_clusters = flag_of(output_cluster_ids, "output_cluster_ids")
    return _core.segment_sdf(
        mesh, values, options, returns_clusters, thread_count(threads), checked_progress(progress)
    )


def values_and_segments(
    vertices: Any, faces: ArrayLike | None, segmentation: dict[str, Any], options: dict[str, Any]
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Returns post-processed values and segments, without warnings. options: as for sdf_values()."""
    computed = _computed(vertices, faces, {"segment": "cgal", **segmentation}, options, None)
    return computed.array("normalized", single=False), computed.array("segment")


def _computed(
    vertices: Any,
    faces: ArrayLike | None,
    described: dict[str, Any],
    options: dict[str, Any],
    progress: Progress | None,
) -> _core.ComputedFields:
    session = session_of(options)
    if options:
        raise error_of("unknownName", f"there is no option '{next(iter(options))}' here")
    implied = {"definition": "cgal", "estimate": False}
    mesh = mesh_argument(vertices, faces)
    return session._opened.compute(mesh, {**implied, **described}, checked_progress(progress))


def _values_of(sdf_values: ArrayLike, mesh: MeshArgument) -> NDArray[np.float64]:
    """Returns (m,) values with NaN for missing values."""
    count = mesh.face_count if isinstance(mesh, _core.Mesh) else len(mesh[1])
    values = values_array(sdf_values, "sdf_values", count)
    return np.where(values == _MISSING, np.nan, values) if (values == _MISSING).any() else values
