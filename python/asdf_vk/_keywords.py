"""Keywords of the options. Written by asdfvk-write-documents from src/describe/computation_options.cpp."""

from __future__ import annotations

from typing import Literal, TypedDict


class ComputeOptions(TypedDict, total=False):
    """Options of the computation. None, as well as leaving an option out, is its default."""

    recipe: Literal["paper", "balanced", "quality"] | None
    """Set of options; single options override it. paper: as the ASDF paper. balanced: half of the error of paper.
    quality: rays pooled over neighbouring seeds, least error against many rays; default balanced."""
    definition: Literal["paper", "cgal"] | None
    """Definition of the values: of the ASDF paper, or of CGAL's sdf_values without post-processing. cgal: rays 25
    seeds all unless given; default paper."""
    seeds: int | float | str | None
    """Faces that cast rays: a share, a count or all; auto: 10%, but at least 3,000; default auto."""
    max_error: float | str | None
    """Add seeds until the estimated average error is below this share of the range, or with rel until the median
    of error / value is; starts with 2% or seeds."""
    max_relative_error: float | None
    """Add seeds until the estimated median of error / value is at most this; above 0 and below 1."""
    orient: Literal["keep", "auto", "flip"] | None
    """Inverted closed components: report them (keep), reverse them, or reverse all faces; default keep."""
    sampler: Literal["random", "blue-noise", "farthest-point", "normal-space", "adaptive"] | None
    """Selection of the seed faces. adaptive: blue noise in two passes, the second denser where the first predicts
    errors; default blue-noise."""
    random_seed: int | None
    """Random seed; the same number gives the same bits; from 0; default 1."""
    time_budget: float | None
    """Add seeds until this time has passed, reading and writing excluded. The result is not reproducible; above 0
    and at most 1000000000."""
    estimate: bool | None
    """False: Do not estimate the error; saves about the time of the interpolation."""
    rays: int | None
    """Rays per cone; from 1 to 1024; default 30."""
    cone_angle: float | None
    """Full opening angle of the cone; above 0 and below 180; default 120."""
    false_hit_angle: float | None
    """A hit is false where the normals of the hit face and of the seed differ by less than this; from 0 to 180;
    needs definition='paper'; default 90."""
    outlier_deviations: float | None
    """Lengths farther from the median than S standard deviations are dropped; above 0; needs definition='paper';
    default 1."""
    cone_rotation: Literal["fixed", "hashed"] | None
    """Rotation of the cones: fixed (parallel rays in neighbouring cones) or hashed (by face index, so that errors
    are independent); needs definition='paper'; default fixed."""
    smooth: str | tuple[int, int] | None
    """Bilateral filter over R rings of faces, P passes; auto: by the number of faces. For seeds all with
    cone_rotation hashed; default off."""
    postprocess: Literal["none", "cgal"] | None
    """Field normalized. cgal: missing values are filled, all are smoothed and mapped to 0 .. 1, as CGAL does;
    default none."""
    segment: Literal["none", "parts", "cgal"] | None
    """Field segment. parts: the parts that people see, also segment without a value. cgal: soft clustering and
    graph cut, as CGAL does; implies postprocess cgal; for seeds all; default none."""
    parts: int | None
    """Number of parts; without it the number is found; from 1 to 100; needs segment='parts'."""
    detail: float | None
    """Divides the cost at which merging stops; a larger number gives more parts; from 0.1 to 10; needs
    segment='parts'; default 1."""
    clusters: int | None
    """Clusters of values, not the number of segments; from 2 to 100; needs segment='cgal'; default 5."""
    smoothness: float | None
    """Weight of the boundaries, usually at most 1; from 0 to 1000; needs segment='cgal'; default 0.26."""
    expansion: Literal["all", "first"] | None
    """The graph cut expands all clusters, or the first one only, as CGAL 5.5.1 does; needs segment='cgal'; default
    all."""
    measure: Literal["sdf", "thickness", "both"] | None
    """thickness: the fields thickness, the diameter of the largest ball inside that touches the face, and
    least_thickness instead of sdf and seed; both: these four; default sdf."""
    thinner_than: float | None
    """Whether any point of the surface is thinner than T, in the unit of the mesh, and where; implies measure
    thickness; above 0."""
    allow_sharp_edges: bool | None
    """Leave sharp edges and tips, where the thickness is 0, out of the verdict; they are listed; needs
    thinner_than."""
    wall_angle: float | None
    """A wall is opposing if its normal differs by this from that of the face; above 90 and at most 180; needs
    measure='thickness'; default 120."""
    check: int | str | None
    """Recompute N random traced faces, and N of all faces, with the reference (2000 without a number); exit code 5
    where traced faces disagree."""
    centres: bool | None
    """The field centre, skeleton points."""
    weights: Literal["distance", "feature"] | None
    """Edge weights of the dual graph: 1/distance of the barycentres, or by the dihedral angle; default feature."""
    guidance: Literal["none", "curvature", "prediction"] | None
    """Guidance field: none (harmonic), minus the curvature, or the gradient of values predicted from the hits of
    neighbouring seeds; default prediction."""
    pooling: float | None
    """Weight of the prediction in the values; 0 keeps traced values. Above 0 needs guidance prediction; from 0 to
    1; default 0."""
    solver: Literal["auto", "cg", "jacobi", "cpu", "eigen"] | None
    """Conjugate gradients (cg) or Jacobi on the device, conjugate gradients on the CPU in float32 (cpu) or with
    Eigen in double; default auto."""
    tolerance: float | None
    """Relative residual at which the solver stops; above 0 and below 1; default 0.0001."""
    max_iterations: int | None
    """Iterations at which the solver stops; from 1; default 20000."""
    per: Literal["face", "vertex"] | None
    """vertex: also fields per vertex, means over its faces by area, with the names of those per face; .csv and
    .npy hold these only; default face."""


class SessionOptions(TypedDict, total=False):
    """Options of a session."""

    backend: Literal["auto", "vulkan", "cpu", "reference"] | None
    """A Vulkan device, Embree on the CPU, the double-precision reference, or the first of them that is available;
    default auto."""
    device: str | int | None
    """Vulkan device: its number in --list-devices or a part of its name; default the best."""
    require_gpu: bool | None
    """Fail where no GPU is usable."""
    threads: int | None
    """CPU threads, also of lavapipe; 0: the number of cores. Results do not depend on it; from 0 to 1024; default
    0."""
