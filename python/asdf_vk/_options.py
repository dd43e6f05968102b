"""Keyword options, with the names of the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Literal, Optional, TypedDict, Union

from ._errors import error_of

if TYPE_CHECKING:
    from ._session import Session

Progress = Callable[[float, str], Optional[bool]]


def checked_progress(progress: Any) -> Progress | None:
    """The callback, or None."""
    if progress is not None and not callable(progress):
        raise error_of("optionOutOfRange", f"progress={progress!r} is not callable")
    return progress


class ComputeOptions(TypedDict, total=False):
    """Options of the computation. None, as well as leaving an option out, is its default."""

    recipe: Literal["paper", "balanced", "quality"] | None
    definition: Literal["paper", "cgal"] | None
    seeds: Union[int, float, str, None]
    """Faces that cast rays: a share (float, above 0, at most 1; or "10%"), a count (int), "all" or "auto"."""
    sampler: str | None
    random_seed: int | None
    max_error: float | None
    """Add seeds until the estimated average error is at most this share of the range, above 0 and below 1."""
    max_relative_error: float | None
    """Add seeds until the estimated median of error / value is at most this, above 0 and below 1."""
    time_budget: float | None
    """Add seeds until this many seconds have passed. The result is not reproducible."""
    estimate: bool | None
    """Estimate the error; default True."""
    rays: int | None
    """Rays per cone, 1 to 1024."""
    cone_angle: float | None
    """Full opening angle of the cone in degrees, above 0 and below 180."""
    false_hit_angle: float | None
    outlier_deviations: float | None
    cone_rotation: Literal["fixed", "hashed"] | None
    per: Literal["face", "vertex"] | None
    """"vertex": fields per vertex, too, which the functions then return."""
    measure: Literal["sdf", "thickness", "both"] | None
    """"thickness": the fields "thickness" and "least_thickness"."""
    thinner_than: float | None
    allow_sharp_edges: bool | None
    wall_angle: float | None
    segment: Literal["none", "parts", "cgal"] | None
    """The field "segment"."""
    parts: int | None
    detail: float | None
    clusters: int | None
    smoothness: float | None
    expansion: Literal["all", "first"] | None
    postprocess: Literal["none", "cgal"] | None
    """"cgal": the field "normalized"."""
    centres: bool | None
    """The field "centre", skeleton points."""
    orient: Literal["keep", "auto", "flip"] | None
    """Inverted closed components: report them, reverse them, or reverse all faces."""
    smooth: Union[str, tuple[int, int], None]
    """Bilateral filter: "off", "auto" or (rings, passes)."""
    weights: Literal["distance", "feature"] | None
    guidance: Literal["none", "curvature", "prediction"] | None
    pooling: float | None
    solver: str | None
    tolerance: float | None
    max_iterations: int | None
    check: Union[int, str, None]
    """Recompute this many traced faces ("all": all) with the reference, for info.check."""


class ConeOptions(TypedDict, total=False):
    """Options of Scene.at(): those of the cone of rays, as in ComputeOptions."""

    definition: Literal["paper", "cgal"] | None
    rays: int | None
    cone_angle: float | None
    false_hit_angle: float | None
    outlier_deviations: float | None
    cone_rotation: Literal["fixed", "hashed"] | None


class CallOptions(TypedDict, total=False):
    """Options of every call."""

    progress: Progress | None
    """Called with a fraction from 0 to 1 and the name of the stage; False cancels (CancelledError)."""


class PointOptions(ConeOptions, CallOptions, total=False):
    """Options of Scene.at()."""


class SceneOptions(ComputeOptions, CallOptions, total=False):
    """Options of the other methods of Scene."""


class BackendOptions(TypedDict, total=False):
    """The backend of a call: a session, or that of the free functions for these options. None is the default."""

    session: Session | None
    backend: Literal["auto", "vulkan", "cpu", "reference"] | None
    device: str | int | None
    """Vulkan device: an index or a part of a name."""
    require_gpu: bool | None
    threads: int | None
    """CPU threads; 0: the number of cores. Results do not depend on it."""


class FunctionOptions(SceneOptions, BackendOptions, total=False):
    """Options of the free functions."""
