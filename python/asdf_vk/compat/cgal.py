"""CGAL's package Triangulated Surface Mesh Segmentation, on arrays.

    from asdf_vk.compat import cgal
    values, (low, high) = cgal.sdf_values(vertices, faces)
    labels, count = cgal.segmentation_from_sdf_values(vertices, faces, values)

The functions have CGAL's names of parameters and CGAL's defaults. They follow the manual and the outputs of CGAL 5.5.1,
and contain no code of CGAL. Differences:

- In results, a missing value is NaN; in CGAL it is -1. In arguments, NaN and -1 are missing values.
- The graph cut of segmentation_from_sdf_values() expands all clusters by default. CGAL 5.5.1 expands the first cluster
  only; expansion="first" does the same. Some other versions of CGAL expand all clusters.
- Meshes need not be manifold. Two faces are neighbours across an edge if they traverse it in opposite directions and
  no third face has this edge. An edge of more faces is divided into several edges, as in CGAL's readers. CGAL's
  readers also reverse faces of such meshes; these functions do not.
- Two cases raise an InputError: fewer different values than clusters (code "tooFewValues"), and no face with a value
  (code "noValues"). CGAL crashes or does not end in these cases.
- The value None of a keyword means its default.
- Ranges: number_of_clusters 2 to 100, smoothing_lambda 0 to 1000, number_of_rays 1 to 1024.
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

_MISSING = -1  # In CGAL, the value of a face without a value.
_ANGLE_DIGITS = 9  # Degrees are rounded, so that 2/3 pi becomes exactly 120.


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
    """CGAL's sdf_values(): the shape diameter of each face. By default the values are post-processed.

    vertices, faces: (n, 3) and (m, 3), or an object with `vertices` and `faces`; see asdf_vk.shape_diameter().
    cone_angle: full opening angle in radians, above 0 and below pi; rounded to 1e-9 degrees.
    number_of_rays: per face, 1 to 1024.
    postprocess: apply sdf_values_postprocessing().
    seeds: faces from which rays start: "all" as in CGAL, a share such as 0.1, or a count. The values of the other faces
        are interpolated; then segments differ from CGAL's segments.
    progress: called with the finished fraction of the whole call (0 to 1) and the name of the current stage, or ""
        before the first stage. The return value False cancels.
    options: backend, device, require_gpu, threads, session; see asdf_vk.Session.

    Returns the values, float64 (m,), and a pair of numbers in the unit of the mesh. Post-processed values are in [0,
    1], without NaN. The pair then has the least and the greatest smoothed value before the mapping to [0, 1]. Without
    post-processing, the values are in the unit of the mesh; NaN means no value. The pair then has the least and the
    greatest value, or NaN if no face has a value. Raises InputError, UsageError, DeviceError, CancelledError. Issues
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
    threads: number of CPU threads; 0 means the number of cores. progress: as for sdf_values().

    Returns float64 (m,) in [0, 1], and a pair: the least and the greatest smoothed value, in the unit of `sdf_values`.
    If all smoothed values are equal, they are not mapped to [0, 1]. Raises InputError, CancelledError.
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
    """CGAL's segmentation_from_sdf_values(): clusters the values, and finds segments by a graph cut.

    vertices, faces: as for sdf_values_postprocessing().
    sdf_values: (m,), post-processed values from 0 to 1. Missing values (NaN, -1) are filled as in
        sdf_values_postprocessing(). The array is not changed.
    number_of_clusters: 2 to 100. A cluster has any number of segments.
    smoothing_lambda: weight of the boundaries, 0 to 1000. The range in CGAL's manual is 0 to 1.
    output_cluster_ids: return the clusters instead of the segments.
    expansion: which clusters the graph cut expands: "all", or only the "first" as in CGAL 5.5.1.
    threads, progress: as for sdf_values_postprocessing().

    Returns labels, int32 (m,), from 0 to k - 1, ascending by mean value; and k, the number of segments. With
    output_cluster_ids, returns the clusters and `number_of_clusters`. If the values agree with CGAL's values to about
    1e-5 of their range, the labels equal CGAL's labels. Noise of 1e-3 of the range may change many labels. Raises
    InputError, UsageError, CancelledError.
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
    """Returns values, (m,), with NaN for missing values."""
    count = mesh.face_count if isinstance(mesh, _core.Mesh) else len(mesh[1])
    values = values_array(sdf_values, "sdf_values", count)
    return np.where(values == _MISSING, np.nan, values) if (values == _MISSING).any() else values
