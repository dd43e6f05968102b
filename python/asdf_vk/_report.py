"""Typed results. Lengths are in the unit of the mesh; `face` and counts of faces refer to input faces."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from typing import Any, Literal, Tuple, cast

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class ValueRange:
    """Over the faces with a value; NaN when there is none."""

    min: float
    percentile1: float
    median: float
    percentile99: float
    max: float


@dataclass(frozen=True)
class SolverReport:
    name: str
    iterations: int
    relative_residual: float
    converged: bool
    finished_on_cpu: bool


@dataclass(frozen=True)
class WorstFace:
    face: int
    error: float
    """Divided by the range of the values."""


@dataclass(frozen=True)
class ErrorEstimate:
    """Estimated error, compared with tracing all faces. Shares of the range unless called relative (error / value)."""

    average: float
    standard_error: float
    robust_average: float
    relative_median: float
    relative_percentile90: float
    relative_median_standard_error: float
    held_out_count: int
    worst_faces: tuple[WorstFace, ...]


@dataclass(frozen=True)
class CheckReport:
    """Comparison with the double-precision reference: traced faces, then all faces."""

    passed: bool
    is_independent: bool
    traced_count: int
    agreeing_count: int
    no_value_agree_count: int
    median_difference: float
    worst_difference: float
    worst_face: int
    compared_count: int
    average_error: float
    maximum_error: float
    interpolated_count: int
    interpolated_average_error: float
    interpolated_maximum_error: float


@dataclass(frozen=True)
class PartsReport:
    fewest_count: int
    most_count: int
    agreement: float | None
    is_thin_shell: bool
    area_shares: tuple[float, ...]
    """Per part; sum 1."""


Point = Tuple[float, float, float]


@dataclass(frozen=True)
class ThinRegion:
    """A connected part of the surface thinner than `thinner_than`."""

    is_sharp: bool
    """Contains a sharp edge or tip; otherwise it is a wall."""
    min: float
    min_face: int
    place: Point
    """The point of `min_face` with the least thickness; `opposite` is that of its opposing wall."""
    opposite: Point
    face_count: int
    area: float
    """Of the part of these faces that is thin."""
    area_share: float


@dataclass(frozen=True)
class SharpEdge:
    """Connected edges at which two opposing walls meet, or a tip. The thickness there is 0."""

    angle_degrees: float
    length: float
    """0 at a tip, as `edge_count`."""
    edge_count: int
    place: Point
    face: int


@dataclass(frozen=True)
class SectionBall:
    """The largest ball inside of a closed component."""

    diameter: float
    centre: Point


@dataclass(frozen=True)
class UnjudgedFaces:
    """Faces on which a limit cannot be judged, or not with certainty."""

    open_count: int
    inverted_count: int
    degenerate_count: int
    crossed_count: int
    self_crossed_count: int


@dataclass(frozen=True)
class ThicknessReport:
    """`min` is the least thickness of the surface; the percentiles are of the field "thickness", by area."""

    min: float
    min_face: int | None
    """None without a thickness, as the two points."""
    min_place: Point | None
    min_opposite: Point | None
    percentile1: float
    percentile5: float
    median: float
    percentile95: float
    max: float
    verdict: Literal["passed", "failed", "notJudged"] | None
    """None without `thinner_than`. "notJudged": nothing thinner was found, but parts could not be judged."""
    thinner_than: float | None
    allow_sharp_edges: bool
    no_value_count: int
    unjudged: UnjudgedFaces
    greatest_section: SectionBall | None
    sharp_edges: tuple[SharpEdge, ...]
    """By ascending angle."""
    thin_area: float
    thin_area_share: float
    regions: tuple[ThinRegion, ...]
    """Walls before sharp regions, by ascending least thickness; empty without `thinner_than`."""


@dataclass(frozen=True)
class MeshDefects:
    zero_area_face_count: int
    duplicate_face_count: int
    non_finite_vertex_count: int
    non_finite_face_count: int
    boundary_edge_count: int
    non_manifold_edge_count: int
    inconsistent_edge_count: int
    unreferenced_vertex_count: int
    short_polygon_count: int


@dataclass(frozen=True)
class Warning:
    code: str
    """For example "missingValues"."""
    message: str
    details: dict[str, str]


@dataclass(frozen=True, eq=False)
class Info:
    """Report of a computation, and its fields."""

    face_count: int
    region_face_count: int
    """Faces of the region; without one all."""
    triangle_count: int
    vertex_count: int
    component_count: int
    size: Point
    """Of the bounding box, in the unit of the mesh."""
    seed_count: int
    ray_count: int
    redone_cone_count: int
    no_value_count: int
    clamped_count: int
    """Interpolated triangles limited to the values of the seeds of their component."""
    random_seed: int
    round_count: int
    backend: str
    device: str
    runs_on_cpu: bool
    stage_seconds: dict[str, float]
    rays_per_second: float
    trace_device_seconds: float | None
    """Part of the stage "trace" in which the Vulkan device was busy; None without timestamps."""
    solver: SolverReport
    sdf: ValueRange
    normalized_range: tuple[float, float] | None
    segment_count: int | None
    parts: PartsReport | None
    thickness: ThicknessReport | None
    defects: MeshDefects
    reversed_faces: tuple[int, ...] = field(repr=False)
    warnings: tuple[Warning, ...]
    estimated_error: ErrorEstimate | None
    """None where every face is a seed."""
    check: CheckReport | None
    fields: dict[str, NDArray[Any]] = field(repr=False)
    """Per face: "sdf" float32, "seed" uint8 (1 where rays were cast), "error" float32 (expected error), ..."""
    vertex_fields: dict[str, NDArray[Any]] = field(repr=False)
    """Per vertex, with per="vertex"."""

    @property
    def seed(self) -> NDArray[np.uint8]:
        """(m,), 1 where rays were cast."""
        return self.fields["seed"]

    @property
    def error(self) -> NDArray[np.float32] | None:
        """(m,), expected error in the unit of the mesh; None without an estimate."""
        return self.fields.get("error")


_NESTED: dict[str, type] = {
    "solver": SolverReport,
    "sdf": ValueRange,
    "parts": PartsReport,
    "thickness": ThicknessReport,
    "unjudged": UnjudgedFaces,
    "greatest_section": SectionBall,
    "defects": MeshDefects,
    "estimated_error": ErrorEstimate,
    "check": CheckReport,
}
_LISTED: dict[str, type] = {
    "worst_faces": WorstFace,
    "sharp_edges": SharpEdge,
    "regions": ThinRegion,
    "warnings": Warning,
}


def _typed(name: str, value: Any) -> Any:
    if isinstance(value, list):
        item = _LISTED.get(name)
        return tuple(_structured(item, entry) if item else entry for entry in value)
    return _structured(_NESTED[name], value) if name in _NESTED and value is not None else value


def _structured(structure: type, values: dict[str, Any]) -> Any:
    return structure(**{name: _typed(name, value) for name, value in values.items()})


def info_of(
    report: dict[str, Any], fields: dict[str, NDArray[Any]], vertex_fields: dict[str, NDArray[Any]]
) -> Info:
    """The report of the extension as an Info."""
    return cast(Info, _structured(Info, {**report, "fields": fields, "vertex_fields": vertex_fields}))


def field_names(structure: type) -> list[str]:
    return [entry.name for entry in dataclasses.fields(structure)]
