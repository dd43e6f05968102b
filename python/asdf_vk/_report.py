"""Typed reports. Written by asdfvk-write-documents from the headers of the library.

Lengths are in the unit of the mesh; numbers of faces and `face` refer to input faces.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Tuple

Point = Tuple[float, float, float]
TraceKernel = Literal["seed", "ray", "packet"]
BvhFetch = Literal["texel", "storage"]
ThicknessVerdict = Literal["passed", "failed", "notJudged"]
UnjudgedCause = Literal[
    "border", "branching", "woundAgainst", "inverted", "doubleSided", "negativeVolumes", "coarseCoordinates",
]
ThinKind = Literal["wall", "gap", "detail", "edge"]
WallChange = Literal["new", "thinner", "kept", "gone"]
FindingKind = Literal[
    "thinWall", "thinDetail", "thinEdge", "narrowGap", "thickBody", "sealedVoid", "bodiesInContact", "unjudged",
]
FindingLevel = Literal["failure", "notJudged", "note"]
WarningCode = Literal[
    "meshDefect", "invertedComponents", "componentsReversed", "facesReversed", "missingValues", "finishedOnCpu",
    "backendReplaced", "predictedOnCpu", "solvedOnCpu", "notConverged", "rangeDominated", "thinShell",
    "partCountDiffers", "onlySmallComponents", "skippedContent", "negativeVolumes", "coarseCoordinates",
    "uncertainParts", "coarseParts",
]


@dataclass(frozen=True)
class TraceVariant:
    """Variant of the Vulkan kernels. All variants compute the same values."""

    kernel: TraceKernel | None
    """Assignment of rays to lanes; unset in options: the default of the device."""
    fetch: BvhFetch | None
    """Kind of buffers that the kernels read; unset in options: the default of the device."""


@dataclass(frozen=True)
class DeviceTimes:
    """Times of a Vulkan device, by its own clock."""

    kernels: dict[str, float]
    """Seconds of kernels by the stage that waits for them."""
    copies: dict[str, float]
    """Seconds of copies and fills by the stage that waits for them."""
    rays_per_second: float
    """Rays divided by the seconds of kernels in the stage "trace"."""


@dataclass(frozen=True)
class SolverReport:
    """The solution of the Poisson equation."""

    name: str
    """Name of the solver; "none" if no value was interpolated."""
    iterations: int
    """Iterations of the solver."""
    relative_residual: float
    """Relative residual of the solution, recomputed in float32 on a device, else in double."""
    converged: bool
    """False if the solver stopped at its iteration limit."""
    finished_on_cpu: bool
    """The solver started on a device in float32 and the CPU finished in double."""


@dataclass(frozen=True)
class ValueRange:
    """Range and quantiles of the values; NaN if no face has a value. Each input face with a value counts once."""

    min: float
    percentile1: float
    median: float
    percentile99: float
    max: float
    """Least value, 1st percentile, upper median, 99th percentile, greatest value."""


@dataclass(frozen=True)
class PostprocessReport:
    """Range of the smoothed values, in the unit of the mesh. The field "normalized" maps this range to 0 .. 1."""

    min: float
    max: float
    """The smoothed values that are mapped to 0 and 1."""


@dataclass(frozen=True)
class PartBoundary:
    """Two adjacent parts, first < second."""

    first: int
    second: int
    """Labels of the field "segment"."""
    stability: float
    """How often the boundary remains, from 0 to 1: the parts are found with five numbers of patches and with thresholds
    from 1 / e to e times the threshold of the options. The number is the share of these variants that separate the
    parts, as a mean over pairs of patches. Near 0.5 a small change of the mesh may remove the boundary.
    """


@dataclass(frozen=True)
class PartsReport:
    """Sizes and stability of the parts."""

    fewest_count: int
    most_count: int
    """Numbers of parts if the option detail is divided by 1.25, and if detail is multiplied by 1.25. The result is
    stable if both numbers equal the number of segments.
    """
    agreement: float | None
    """The segmentation merges patches, which are small regions, to parts. `agreement` compares the parts with the parts
    from each of five numbers of patches: the number is the mean of the area-weighted Rand indices. The parts are
    compared before small parts are merged and boundaries are cut. 1 means equal parts; below about 0.9 the parts depend
    on the number of patches, and people disagree more, too. Unset with the warning onlySmallComponents.
    """
    thin_shell: bool
    """The shape is a thin wall around a cavity (warning thinShell)."""
    area_shares: tuple[float, ...]
    """Share of each part in the area of all faces; the sum is 1."""
    boundaries: tuple[PartBoundary, ...]
    """Ascending by `first` and `second`."""


@dataclass(frozen=True)
class UnjudgedReason:
    """A cause for which faces cannot be judged, and where."""

    cause: UnjudgedCause
    """The cause."""
    face_count: int
    """Input faces of the components with this cause."""
    edge_count: int
    """Edges with this cause; 0 for causes that are not at edges."""
    face: int
    """The first input face with this cause."""
    place: Point
    """A point of this face, on the edge if the cause is at an edge."""
    bodies: tuple[str, ...]
    """Name of the body of this face, see ThinRegion::bodies."""
    is_repairable: bool
    """Whether the orientation "auto" removes the cause."""
    amount: float
    """Number of negative volumes, or the step of the coordinates in the unit of the mesh. 0 for the other causes."""


@dataclass(frozen=True)
class UnjudgedFaces:
    """Input faces for which the comparison with a limit is impossible or uncertain."""

    open_count: int
    """Faces of open components, because closing such a component may add a thin wall."""
    inverted_count: int
    """Faces of closed components that are oriented inwards or inconsistently."""
    degenerate_count: int
    """Faces without a normal or with a non-finite corner, which are ignored."""
    crossed_count: int
    """Faces that other faces cross. They are judged in pieces."""
    inside_count: int
    """Faces with a part inside of the material, which is no wall and is not judged."""
    reasons: tuple[UnjudgedReason, ...]
    """The causes that prevent a verdict, each with its place."""


@dataclass(frozen=True)
class SectionBall:
    """The largest ball inside of a closed component, or of the space in a sealed void."""

    diameter: float
    """Diameter of the ball."""
    centre: Point
    """Centre of the ball."""


@dataclass(frozen=True)
class ChangedPlace:
    """A point where a wall is new or thinner than in a former version."""

    thickness: float
    """Thickness at the point."""
    former_thickness: float | None
    """Thickness of the former version there; unset if it has no such place."""
    face: int
    """The input face of the point."""
    place: Point
    """The point."""


@dataclass(frozen=True)
class ThinRegion:
    """A region is a connected part of the surface that is thinner than the limit, together with the thin part on the
    other side of the same wall. Lengths are in the unit of the mesh.
    """

    kind: ThinKind
    """The greatest kind of all points of the region: a wall if a point is a wall."""
    min: float
    """The least thickness of all points of this kind. Beside a wall that tapers, its surface is thinner than this."""
    min_face: int
    """Input face with this thickness."""
    place: Point
    opposite: Point
    """Point of this thickness on the face, and its counterpart on the opposing wall."""
    opposite_face: int | None
    """Input face of `opposite`; unset if a whole body is thin."""
    bodies: tuple[str, ...]
    """Names of the one or two bodies at the place, or "component 3"; empty if the mesh has one body without a name."""
    least: float
    """The least thickness of all points of the region; 0 at a sharp edge."""
    angle_degrees: float
    """Angle between the two surfaces at the place of `least`; 0 if they are parallel."""
    width: float
    """Mean width of the thin surface, on both sides of an edge together."""
    face_count: int
    """Number of input faces that have a part in the region."""
    area: float
    """Area of the thin parts of the faces."""
    area_share: float
    """`area` divided by the area of the mesh, or of the computed region."""
    change: WallChange | None
    """Set by a comparison for walls, and for other places that count."""
    changed_place: ChangedPlace | None
    """If only a part of the region is new or thinner: its thinnest point among those that were compared."""


@dataclass(frozen=True)
class ThickBody:
    """A body whose largest ball inside is greater than ThicknessOptions::thickerThan."""

    bodies: tuple[str, ...]
    """Its name, see ThinRegion::bodies."""
    diameter: float
    """Diameter of the largest ball that was found inside. A larger one may exist."""
    centre: Point
    """Centre of the ball."""


@dataclass(frozen=True)
class ThickReport:
    """The largest balls inside of the bodies. The diameter of the largest ball of a body is its greatest thickness."""

    thicker_than: float
    """The limit."""
    verdict: ThicknessVerdict
    """Failed: a ball is greater than 1.001 of the limit. NotJudged: none was found, but a component is not closed, or
    the search ended early.
    """
    sentence: str
    """The verdict in one sentence."""
    ratio: float
    """The diameter of the largest ball that was found, divided by ThicknessReport::min; NaN if one of them is not
    known.
    """
    bodies: tuple[ThickBody, ...]
    """The bodies that are thicker than the limit, the thickest first."""


@dataclass(frozen=True)
class ThicknessReport:
    """The wall thickness (docs/thickness.md), or the width of gaps. Lengths are in the unit of the mesh. In a report on
    gaps, the thickness is that of the space, walls are gaps, and ThinKind::Gap replaces ThinKind::Wall.
    """

    is_of_gaps: bool
    """The report is about gaps, not about walls."""
    verdict: ThicknessVerdict | None
    """Unset without a limit."""
    sentence: str
    """The first line of the text report: the verdict in one sentence. Without a limit, the least wall."""
    thinner_than: float | None
    """The limit: ThicknessOptions::thinnerThan or closerThan."""
    counts_details: bool
    """Details fail the check, too."""
    counts_edges: bool
    """Details and edges fail the check, too."""
    min: float
    """Failed: the least thickness of all thin regions that count. Otherwise: the next wall, which is the least wall at
    the smallest limit at which the check fails, to 5 %. Without a limit: the least wall of all that are wider than
    1/500 of the mesh. NaN if it was not found, or if the search for it ended early (ThicknessOptions::findsNextWall).
    """
    min_face: int | None
    """Input face with this thickness; unset if there is none."""
    min_place: Point | None
    min_opposite: Point | None
    """Point of this thickness on minFace, and the opposite point on the opposing wall."""
    percentile1: float
    percentile5: float
    median: float
    percentile95: float
    max: float
    """Percentiles of the thickness at the barycentres of the triangles, weighted by area."""
    no_value_count: int
    """Input faces without a thickness."""
    unjudged: UnjudgedFaces
    """Input faces for which the comparison with a limit is impossible or uncertain."""
    greatest_section: SectionBall | None
    """The largest ball that was found inside of a closed component; unset without a closed component. A larger ball may
    exist, because the search ends as soon as it cannot change a thickness.
    """
    thin_area: float
    thin_area_share: float
    """Area of all thin regions, and this area divided by the area of the mesh or of the computed region. NaN without a
    limit.
    """
    regions: tuple[ThinRegion, ...]
    """Thin regions: walls, then details, then edges, each by ascending `min`. Empty without a limit."""
    thick: ThickReport | None
    """Set with ThicknessOptions::thickerThan."""


@dataclass(frozen=True)
class ThinnerRegion:
    """A connected part of the surface that is thinner than 0.95 of its former thickness."""

    thickness: float
    """Thickness at the place."""
    former_thickness: float
    """Thickness of the former version there."""
    face: int
    """The input face with the greatest relative decrease."""
    place: Point
    """The barycentre of a triangle of this face."""
    face_count: int
    """Number of input faces."""
    area: float
    """Area of the triangles."""
    area_share: float
    """`area` divided by the area of the mesh, or of the computed region."""


@dataclass(frozen=True)
class ComparisonReport:
    """Comparison of the wall thickness with a former version of the mesh (docs/thickness.md#two-versions)."""

    verdict: ThicknessVerdict | None
    """Unset without a limit. Failed: a wall is new or thinner. NotJudged: none is, but a part of the surface could not
    be judged, or no place is in both versions; or a wall may be, but the former version could not be judged there.
    """
    sentence: str
    """The verdict in one sentence; without a limit, where the mesh became thinner."""
    new_count: int
    thinner_count: int
    kept_count: int
    gone_count: int
    """Numbers of walls, and of other places that count, by WallChange."""
    former_verdict: ThicknessVerdict | None
    """The verdict on the former version."""
    gone: tuple[ThinRegion, ...]
    """Walls that are gone, with faces of the former version."""
    unmatched_face_count: int
    """Input faces with a thickness for which the former version has no thickness at the same place."""
    matched_face_count: int
    """Input faces for which it has one. 0: the mesh may be moved or scaled."""
    thinner_area: float
    thinner_area_share: float
    """The area that is thinner than 0.95 of before, and its share."""
    thinner: tuple[ThinnerRegion, ...]
    """The 100 largest regions that became thinner, by descending area."""


@dataclass(frozen=True)
class SealedVoid:
    """A part of the space without a way out. Lengths are in the unit of the mesh."""

    volume: float
    """Without the bodies inside."""
    face: int
    """An input face of its boundary."""
    place: Point
    """The barycentre of a triangle of this face."""
    size: Point
    """Sides of the bounding box."""
    loose_bodies: tuple[str, ...]
    """Names of the bodies that lie loose inside."""
    is_certain: bool
    """False if bodies overlap in a common plane at its boundary, so that volume and way out are not certain. The void
    is then not judged.
    """


@dataclass(frozen=True)
class BodyContact:
    """Two bodies that touch, cross or overlap. Where they do, they have no gap, not even one of width 0."""

    bodies: tuple[str, ...]
    """Their names, see ThinRegion::bodies."""


@dataclass(frozen=True)
class Finding:
    """A place to which a verdict refers, in the same form for all checks, for programs. Lengths are in the unit of the
    mesh.
    """

    kind: FindingKind
    """What was found."""
    level: FindingLevel
    """What it does to the verdict."""
    value: float
    """Thickness, width of the gap, diameter of the ball, or volume of the void; NaN for other kinds."""
    limit: float | None
    """The limit that `value` is compared with."""
    place: Point | None
    """A point of the surface, or the centre of a ball."""
    opposite: Point | None
    """The point on the other side of a wall or a gap."""
    face: int | None
    """Input face of `place`."""
    opposite_face: int | None
    """Input face of `opposite`."""
    face_count: int
    """Input faces of the region; 0 if it is not a region of faces."""
    is_known: bool
    """A baseline has this failure; its level is a note."""
    bodies: tuple[str, ...]
    """Names of the bodies, see ThinRegion::bodies."""
    message: str
    """What was found, and where, in one sentence."""
    remedy: str
    """What to change, in one sentence."""


@dataclass(frozen=True)
class WorstFace:
    """The error at a held-out face."""

    face: int
    """Input face."""
    error: float
    """Error divided by the range of the values."""


@dataclass(frozen=True)
class ErrorEstimate:
    """Estimate of the error of the result, compared with a result for which all faces are traced. The held-out faces
    are a random sample of the faces. Held-out faces cast rays, but a separate interpolation does not use their values.
    The errors of this interpolation at the held-out faces are extrapolated to all faces. Faces with larger expected
    errors are sampled with a higher probability. The result has smaller errors than this interpolation, because it uses
    the values of the held-out faces. Therefore the estimate is reduced by a factor.
    """

    average: float
    """Mean error over all faces, seeds included, divided by the range of the values (ASDF paper, Table 1)."""
    standard_error: float
    """Standard error of the average."""
    robust_average: float
    """Mean error divided by the robust range, which is the 99th minus the 1st percentile of the values. Prefer this
    member to `average` if the report has the warning rangeDominated. Not finite if the robust range is 0.
    """
    relative_median: float
    relative_percentile90: float
    """Median and 90th percentile of error / value over all faces, seeds included. The median is 0 if at least half of
    the faces are seeds; the percentile is 0 if at least 90 % of the faces are seeds. A quantile is infinite if the face
    at the quantile has an error and the value 0.
    """
    relative_median_standard_error: float
    """Standard error of the relative median."""
    held_out_count: int
    """Number of held-out faces."""
    worst_faces: tuple[WorstFace, ...]
    """Held-out faces with the largest errors, in descending order."""


@dataclass(frozen=True)
class CheckReport:
    """Comparison with the double-precision reference on two random samples. A sample of the traced faces verifies the
    device. A sample of all faces that can cast rays measures the interpolation error. Errors are divided by the range
    of the reference values of the compared faces.
    """

    passed: bool | None
    """True if at least one traced face agrees, and if the number of disagreeing traced faces is at most 1 or at most
    0.1 %. A ray that grazes an edge may hit either face of the edge. Unset if `independent` is false.
    """
    independent: bool
    """False if the reference traced the rays of the result. In this case no traced face is compared, and only the
    errors have a meaning.
    """
    traced_count: int
    """Traced faces that were recomputed."""
    agreeing_count: int
    """Traced faces that differ by at most 1e-4 of the bounding-box diagonal."""
    no_value_agree_count: int
    """Traced faces without a value in both computations."""
    median_difference: float
    """Median difference of traced faces that have a value in at least one of the two computations, in bounding-box
    diagonals.
    """
    worst_difference: float
    """Greatest difference of a traced face, in bounding-box diagonals; infinite if only one of the two values exists.
    """
    worst_face: int
    """Input face of the worst difference."""
    compared_count: int
    """Random faces, seeds included, with a value in both computations."""
    average_error: float
    """Mean error of the compared faces."""
    maximum_error: float
    """Greatest error of the compared faces."""
    interpolated_count: int
    """Compared faces with an interpolated value."""
    interpolated_average_error: float
    """Mean error of the interpolated faces."""
    interpolated_maximum_error: float
    """Greatest error of the interpolated faces."""


@dataclass(frozen=True)
class MeshDefects:
    """Defects of a mesh. Faces are counted as triangles, also in a mesh of polygons. An edge is counted only if its
    triangles have finite corners and three distinct vertices. Rays ignore all other triangles. Edges are counted after
    vertices were welded.
    """

    zero_area_face_count: int
    """Faces of zero area."""
    duplicate_face_count: int
    """Faces with the same corner positions and winding as an earlier face."""
    non_finite_vertex_count: int
    """Vertices with a non-finite coordinate."""
    non_finite_face_count: int
    """Faces with a non-finite corner."""
    boundary_edge_count: int
    """Edges of exactly one face that do not lie on edges of other faces."""
    non_manifold_edge_count: int
    """Edges that belong to more than two faces."""
    inconsistent_edge_count: int
    """Edges whose faces are wound against each other."""
    welded_vertex_count: int
    """Vertices that were replaced by another vertex at the same point, or nearby."""
    unreferenced_vertex_count: int
    """Vertices that belong to no triangle."""
    short_polygon_count: int
    """Input faces with fewer than three corners. Such faces have no value."""


@dataclass(frozen=True)
class Warning:
    """A fact about the mesh or the result that a user should know."""

    code: WarningCode
    """Kind of the warning."""
    message: str
    """The warning in one sentence."""
    details: dict[str, str]
    """Named values that occur in the message."""


@dataclass(frozen=True)
class Report:
    """Facts about a computation: mesh, device, times, errors and warnings."""

    face_count: int
    """Input faces."""
    region_face_count: int
    """Input faces of the computed region; without a region, all input faces."""
    triangle_count: int
    """Triangles of the triangulated mesh."""
    vertex_count: int
    """Vertices of the input."""
    component_count: int
    """Connected components of the mesh."""
    size: Point
    """Sides of the bounding box along x, y, z, in the unit of the mesh."""
    unit: str
    """Unit of length that the file states, for example "mm"; may be empty."""
    chord_error: float
    """Greatest distance between the faces and the curved surfaces of a STEP file, in the unit of the mesh; 0 for other
    formats.
    """
    seed_count: int
    """Triangles that cast rays."""
    ray_count: int
    """Number of rays that the seeds cast."""
    redone_cone_count: int
    """Cones that exceeded a limit of the device or of float32. The reference traced these cones."""
    no_value_count: int
    """Input faces without a value; with a region, only faces of the region."""
    clamped_count: int
    """Interpolated triangles whose value was clamped to the range of the seeds of their component."""
    reversed_face_count: int
    """Input faces whose orientation was reversed."""
    random_seed: int
    """Start value of all random numbers."""
    round_count: int
    """Number of rounds in which seeds were added."""
    backend: str
    """"vulkan", "cpu" or "reference"."""
    device: str
    """Name of the device and its driver, or of the CPU."""
    least_rays_for_gpu: int | None
    """BackendChoice::Automatic takes a GPU for at least this number of rays, and the CPU for fewer. Unset if another
    choice was made.
    """
    runs_on_cpu: bool
    """The CPU traced the rays, also as a CPU device of Vulkan."""
    trace_choice: TraceVariant | None
    """The variant of the Vulkan kernels; unset if no kernel ran."""
    stage_seconds: dict[str, float]
    """Seconds by stage; 0 for a stage that did not run."""
    rays_per_second: float
    """Rays divided by the seconds of the stage "trace"."""
    device_times: DeviceTimes | None
    """Unset if no device with timestamps computed."""
    solver: SolverReport
    """The solution of the Poisson equation."""
    sdf: ValueRange
    """Range and quantiles of the shape diameter."""
    postprocess: PostprocessReport | None
    """Set if the result has the field "normalized"."""
    segment_count: int | None
    """Number of segments: the field "segment" has the labels 0 to segmentCount - 1. Set if the result has this field.
    """
    parts: PartsReport | None
    """Set if the segmentation is "parts"."""
    thickness: ThicknessReport | None
    """Set if the result has the field "thickness"."""
    gap: ThicknessReport | None
    """Set if the result has the field "gap"."""
    comparison: ComparisonReport | None
    """Set by a comparison with a former version."""
    voids: tuple[SealedVoid, ...]
    """Sealed voids, if the result has the field "gap"."""
    contacts: tuple[BodyContact, ...]
    """Bodies in contact, if the result has the field "gap"."""
    findings: tuple[Finding, ...]
    """The places to which the verdicts refer, in one form, for programs."""
    estimated_error: ErrorEstimate | None
    """Unset if every face is a seed or no estimate was requested."""
    check: CheckReport | None
    """Unset if no check was requested."""
    defects: MeshDefects
    """Defects of the mesh."""
    warnings: tuple[Warning, ...]
    """Warnings about the mesh and the result."""
