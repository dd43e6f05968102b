"""Typed reports. Written by scripts/write-report-keys from include/asdf_vk/report.h.

Lengths are in the unit of the mesh; numbers of faces and `face` refer to input faces.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Tuple

Point = Tuple[float, float, float]
WarningCode = Literal[
    "meshDefect", "invertedComponents", "componentsReversed", "missingValues", "finishedOnCpu", "backendReplaced",
    "predictedOnCpu", "solvedOnCpu", "notConverged", "rangeDominated", "thinShell", "partCountDiffers",
    "onlySmallComponents",
]
ThicknessVerdict = Literal["passed", "failed", "notJudged"]


@dataclass(frozen=True)
class TraceVariant:
    """Names of the variant of the Vulkan kernels."""

    kernel: str
    """"seed", "ray" or "packet" """
    bvh: str
    """"wide" or "binary" """
    fetch: str
    """"texel" or "storage" """


@dataclass(frozen=True)
class SolverReport:
    """The solution of the Poisson equation."""

    name: str
    """"none" where nothing was interpolated."""
    iterations: int
    """Iterations of the solver."""
    relative_residual: float
    """Recomputed from the solution: in double, or by a device in float32."""
    converged: bool
    """False: stopped at the limit of the iterations."""
    finished_on_cpu: bool
    """Started on a device in float32 and finished in double."""


@dataclass(frozen=True)
class ValueRange:
    """The values of the faces that have one, each counted once whatever its area; NaN when there is none."""

    min: float
    percentile1: float
    median: float
    percentile99: float
    max: float
    """Least value, 1st percentile, upper median, 99th percentile, greatest value."""


@dataclass(frozen=True)
class PostprocessReport:
    """The smoothed values that are 0 and 1 of the field "normalized", in the unit of the mesh."""

    min: float
    max: float
    """The value that is 0, and the one that is 1."""


@dataclass(frozen=True)
class PartsReport:
    """The parts, and how certain they are."""

    fewest_count: int
    most_count: int
    """Numbers of parts at a detail divided and multiplied by 1.25 (kPartStabilityFactor): the result is stable where
    both are the number of segments.
    """
    agreement: float | None
    """Mean Rand index, weighted by area, of the chosen division with those from other numbers of patches, before small
    parts are merged and boundaries cut: 1 where all are equal. Below about 0.9, other numbers of patches give other
    parts. Unset where nothing is compared (warning onlySmallComponents).
    """
    thin_shell: bool
    """The shape is a thin wall around a cavity (warning thinShell)."""
    area_shares: tuple[float, ...]
    """Per part, of the area of all faces; sum 1."""


@dataclass(frozen=True)
class UnjudgedFaces:
    """Input faces on which a limit cannot be judged, or not with certainty."""

    open_count: int
    """Faces of open components: what would close them may be a thin wall."""
    inverted_count: int
    """Faces of closed components oriented inwards, or inconsistently."""
    degenerate_count: int
    """Faces without a normal or with a corner that is not finite; left out."""
    crossed_count: int
    """Faces that a face of another solid crosses. Each solid is judged on its own: the union is at least as thick."""
    self_crossed_count: int
    """Faces that a face of the same solid crosses: inside and outside are mixed up."""


@dataclass(frozen=True)
class SectionBall:
    """The largest ball inside of a closed component."""

    diameter: float
    """Diameter of the ball."""
    centre: Point
    """Centre of the ball."""


@dataclass(frozen=True)
class SharpEdge:
    """Edges, connected over vertices, at each of which two opposing walls meet; or a vertex at which walls meet that
    share no edge, as at the tip of a cone. The thickness there is 0, whatever the triangulation.
    """

    angle_degrees: float
    """Least inner angle between the walls."""
    length: float
    """Length of all edges; 0 at a tip."""
    edge_count: int
    """Number of the edges; 0 at a tip."""
    place: Point
    """The middle of the edge with the least angle, or the tip."""
    face: int
    """Input face at this place."""


@dataclass(frozen=True)
class ThinRegion:
    """A connected part of the surface below the limit. Lengths in the unit of the mesh."""

    is_sharp: bool
    """Contains a sharp edge or tip; otherwise it is a wall."""
    min: float
    """Least thickness; 0 in a sharp region."""
    min_face: int
    """Input face with the least thickness."""
    place: Point
    opposite: Point
    """The points of this face and of its opposing wall with the least thickness."""
    face_count: int
    """Input faces that have a part in it."""
    area: float
    """Area of the part of these faces that is thin."""
    area_share: float
    """Share of the area of the mesh, or of the region of the scene."""


@dataclass(frozen=True)
class ThicknessReport:
    """The wall thickness (docs/thickness.md). Lengths in the unit of the mesh."""

    verdict: ThicknessVerdict | None
    """Unset without a limit."""
    thinner_than: float | None
    """The limit."""
    allows_sharp_edges: bool
    """Whether regions with a sharp edge are left out of verdict and minimum."""
    min: float
    """The least thickness over all points of the surface, without sharp regions where these are allowed."""
    min_face: int | None
    """Input face with the least thickness; unset without a thickness."""
    min_place: Point | None
    min_opposite: Point | None
    """The points of this face and of its opposing wall that have it."""
    percentile1: float
    percentile5: float
    median: float
    percentile95: float
    max: float
    """Percentiles of the field "thickness", by the area of the triangles."""
    no_value_count: int
    """Input faces without a thickness."""
    unjudged: UnjudgedFaces
    """Input faces on which a limit cannot be judged with certainty."""
    greatest_section: SectionBall | None
    """The largest ball inside of a closed component; unset without one."""
    sharp_edges: tuple[SharpEdge, ...]
    """Sharp edges and tips, by ascending angle."""
    thin_area: float
    thin_area_share: float
    """Area of all thin regions, and its share of the surface. NaN without a limit."""
    regions: tuple[ThinRegion, ...]
    """Connected parts of the surface below the limit: walls before sharp regions, by ascending least thickness. Empty
    without a limit.
    """


@dataclass(frozen=True)
class WorstFace:
    """The error at a held-out face."""

    face: int
    """Input face."""
    error: float
    """Divided by the range of the values."""


@dataclass(frozen=True)
class ErrorEstimate:
    """Estimate of the error of the result, compared with tracing all faces. Held-out faces are sampled at random with a
    probability that increases with the error indicator. They cast rays, but a separate interpolation does not use them;
    its errors at these faces are extrapolated to all faces. The result uses them as seeds, which lowers its error; the
    estimate corrects for that.
    """

    average: float
    """Mean over all faces and seeds, divided by the range of the values (paper, Table 1)."""
    standard_error: float
    """Standard error of the average."""
    robust_average: float
    """Mean error divided by the robust range of the values, from their 1st to their 99th percentile. To be preferred to
    the average where few faces have the extreme values (warning rangeDominated). Not finite without such a range.
    """
    relative_median: float
    relative_percentile90: float
    """Median and 90th percentile of error / value over all faces, seeds included. They are 0 where as many faces are
    seeds, and infinite where the value of such a face is 0.
    """
    relative_median_standard_error: float
    """Standard error of the relative median."""
    held_out_count: int
    """Held-out faces."""
    worst_faces: tuple[WorstFace, ...]
    """Held-out faces with the largest errors, in descending order."""


@dataclass(frozen=True)
class CheckReport:
    """Comparison with the double-precision reference on two random samples: of the traced faces, to verify the device,
    and of all faces that can cast rays, to measure the interpolation error.
    """

    passed: bool | None
    """At least one traced face agrees, and at most the largest of 1 and 0.1 % disagree: a ray that grazes an edge may
    hit either of its faces. Unset without an independent comparison.
    """
    independent: bool
    """False when the reference traced the rays: no traced face is compared, and only the errors below are meaningful.
    """
    traced_count: int
    """Traced faces that were recomputed."""
    agreeing_count: int
    """Traced faces that differ by at most 1e-4 of the bounding-box diagonal."""
    no_value_agree_count: int
    """Traced faces without a value in both computations."""
    median_difference: float
    """In diagonals, over traced faces with a value in one or both computations."""
    worst_difference: float
    """In diagonals; infinite if only one computation has a value."""
    worst_face: int
    """Input face of the worst difference."""
    compared_count: int
    """Random faces, seeds included, with a value in both computations."""
    average_error: float
    """Over compared faces, divided by the range of their reference values."""
    maximum_error: float
    """Over compared faces, divided by the same range."""
    interpolated_count: int
    """Compared faces that were interpolated."""
    interpolated_average_error: float
    """Over interpolated faces, divided by the same range."""
    interpolated_maximum_error: float
    """Over interpolated faces, divided by the same range."""


@dataclass(frozen=True)
class MeshDefects:
    """Defects of a mesh. Faces are triangles, also of a mesh of polygons. Edges are those of triangles with finite
    corners and three distinct vertices; rays ignore all other triangles.
    """

    zero_area_face_count: int
    """Faces without an area."""
    duplicate_face_count: int
    """Faces at the positions of an earlier face, in the same winding."""
    non_finite_vertex_count: int
    """Vertices with a non-finite coordinate."""
    non_finite_face_count: int
    """Faces with a non-finite corner."""
    boundary_edge_count: int
    """Edges of one face."""
    non_manifold_edge_count: int
    """Edges of more than two faces."""
    inconsistent_edge_count: int
    """Edges whose two faces traverse them in the same direction."""
    unreferenced_vertex_count: int
    """Vertices of no triangle."""
    short_polygon_count: int
    """Input faces with fewer than three corners: no triangle, no value."""


@dataclass(frozen=True)
class Warning:
    """A fact about the mesh or the result that a user should know."""

    code: WarningCode
    """Kind of the warning."""
    message: str
    """One sentence."""
    details: dict[str, str]
    """Values of the sentence, by name."""


@dataclass(frozen=True)
class Report:
    """What a computation reports beside its fields."""

    face_count: int
    """Input faces."""
    region_face_count: int
    """Input faces of the region of the scene; without a region all."""
    triangle_count: int
    """Triangles; polygons are cut into them."""
    vertex_count: int
    """Vertices of the input."""
    component_count: int
    """Connected components."""
    size: Point
    """Of the bounding box of the mesh, in its unit: x, y, z."""
    seed_count: int
    """Triangles that cast rays."""
    ray_count: int
    """Rays of all seeds."""
    redone_cone_count: int
    """Cones beyond the limits of the device or of float32, traced by the reference."""
    no_value_count: int
    """Input faces without a value; of the region where there is one."""
    clamped_count: int
    """Interpolated triangles limited to the values of the seeds of their component."""
    reversed_face_count: int
    """Input faces whose orientation was reversed."""
    random_seed: int
    """Of all random numbers."""
    round_count: int
    """Rounds of seeds."""
    backend: str
    """"vulkan", "cpu" or "reference"."""
    device: str
    """Device and driver, or the CPU."""
    runs_on_cpu: bool
    """The CPU traces: reference, Embree, or a CPU device of Vulkan."""
    trace_choice: TraceVariant | None
    """The variant of the Vulkan kernels; unset without Vulkan."""
    stage_seconds: dict[str, float]
    """Seconds by stage; 0 for a stage that did not run."""
    rays_per_second: float
    """Rays over the seconds of the stage "trace"."""
    trace_device_seconds: float | None
    """Part of the stage "trace" in which the Vulkan device was busy with the rays of the seeds, by its timestamps.
    Unset without Vulkan, and where the device has no timestamps.
    """
    solver: SolverReport
    """The solution of the Poisson equation."""
    sdf: ValueRange
    """The shape diameters."""
    postprocess: PostprocessReport | None
    """Set where the result has the field "normalized"."""
    segment_count: int | None
    """Labels of the field "segment", which are 0, 1, ... and each have a face. Set where the result has this field."""
    parts: PartsReport | None
    """Set where the segments are parts."""
    thickness: ThicknessReport | None
    """Set where the result has the field "thickness"."""
    estimated_error: ErrorEstimate | None
    """Unset where every face is a seed, and where it was not requested."""
    check: CheckReport | None
    """Unset where it was not requested."""
    defects: MeshDefects
    """Defects of the mesh."""
    warnings: tuple[Warning, ...]
    """Warnings about the mesh and the result."""
