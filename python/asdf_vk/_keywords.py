"""Keywords of the options. Written by asdfvk-write-documents."""

from __future__ import annotations

from typing import Literal, TypedDict


class ComputeOptions(TypedDict, total=False):
    """Options of the computation. The value None means the default of an option."""

    recipe: Literal["paper", "balanced", "quality"] | None
    """Set of options; single options override the set. paper: the method of the ASDF paper. balanced: about half
    the error of paper. quality: also pools the rays of neighbouring seeds, for the least error; default
    balanced."""
    definition: Literal["paper", "cgal"] | None
    """Definition of the shape diameter. paper: as in the ASDF paper. cgal: as CGAL's sdf_values without
    post-processing, with rays=25 seeds='all' unless these are given; default paper."""
    seeds: int | float | str | None
    """Faces that cast rays: a share, a count or all faces. auto: 10%, but at least 3,000; default auto."""
    max_error: float | str | None
    """Add seeds until the estimated average error is at most E of the range of the values; with rel, until the
    estimated median of error / value is at most E. Starts with 2% of the faces, or with seeds."""
    max_relative_error: float | None
    """Add seeds until the estimated median of error / value is at most E; above 0 and below 1."""
    orient: Literal["keep", "auto", "flip"] | None
    """Closed components with faces oriented inwards. keep: report them. auto: reverse them. flip: reverse all
    faces of the mesh; default keep."""
    sampler: Literal["random", "blue-noise", "farthest-point", "normal-space", "adaptive"] | None
    """Selection of the seeds. adaptive: blue noise in two passes; the second pass is denser where the first one
    predicts errors; default blue-noise."""
    random_seed: int | None
    """Start value of all random numbers; the same value gives the same bits; from 0; default 1."""
    estimate: bool | None
    """False: Do not estimate the error. This saves 3 to 15 % of the time, with 1 % seeds up to 25 %."""
    rays: int | None
    """Rays per cone; from 1 to 1024; default 30."""
    cone_angle: float | None
    """Full opening angle of the cone; above 0 and below 180; default 120."""
    false_hit_angle: float | None
    """A hit is dropped as false if the normals of hit face and seed differ by less than this angle; from 0 to 180;
    needs definition='paper'; default 90."""
    outlier_deviations: float | None
    """Ray lengths farther from the median than S standard deviations are dropped; above 0; needs
    definition='paper'; default 1."""
    cone_rotation: Literal["fixed", "hashed"] | None
    """Rotation of each cone about its axis. fixed: neighbouring cones have nearly parallel rays. hashed: by a hash
    of the face index, so that errors of neighbouring faces are independent; needs definition='paper'; default
    fixed."""
    smooth: str | tuple[int, int] | None
    """Bilateral filter of the values over R rings of faces, in P passes. auto: the number of faces determines R
    and P. Use the filter with seeds='all' and cone_rotation='hashed'; default off."""
    postprocess: Literal["none", "cgal"] | None
    """Post-processing of the values for the field normalized. cgal: fill missing values, smooth all values and map
    them to 0 .. 1, as CGAL does; default none."""
    segment: Literal["none", "parts", "cgal"] | None
    """Segmentation for the field segment. parts: parts as people see them; segment without a value means parts.
    cgal: soft clustering and graph cut as in CGAL; implies postprocess='cgal'; use cgal with seeds='all';
    default none."""
    parts: int | None
    """Number of parts. Without parts, the segmentation chooses the number; from 1 to 100; needs segment='parts'."""
    detail: float | None
    """Level of detail: a larger number gives more parts. The cost at which the merging of regions stops is divided
    by X; from 0.1 to 10; needs segment='parts'; default 1."""
    clusters: int | None
    """Number of clusters of values. A cluster may become several segments; from 2 to 100; needs segment='cgal';
    default 5."""
    smoothness: float | None
    """Weight of the boundaries in the graph cut, usually at most 1; from 0 to 1000; needs segment='cgal'; default
    0.26."""
    expansion: Literal["all", "first"] | None
    """Clusters that the graph cut expands: all, or only the first one, as CGAL 5.5.1 does; needs segment='cgal';
    default all."""
    measure: Literal["sdf", "thickness", "both", "gap", "sdf,gap", "thickness,gap", "sdf,thickness,gap"] | None
    """Quantity to measure. sdf: the shape diameter, with the fields sdf and seed. thickness: the wall thickness,
    with the fields thickness and least_thickness. both: all four fields. gap: the width of the space in front
    of the faces, with the fields gap and least_gap, and sealed voids; default sdf."""
    thinner_than: float | str | None
    """Report whether and where the surface is thinner than T, in the unit of the mesh; implies
    measure='thickness'; above 0."""
    thicker_than: float | str | None
    """Report which bodies are thicker than T: the largest ball inside; implies measure='thickness'; above 0."""
    closer_than: float | str | None
    """Report gaps that are narrower than D: slots of a body, and clearances between bodies; implies measure='gap';
    above 0."""
    count_details: bool | None
    """Details fail the check, too: thin places that are too small for a wall, such as low ribs. The report lists
    them; needs thinner_than or closer_than."""
    count_edges: bool | None
    """Details and edges fail the check, too: each point that is thinner than T; needs thinner_than or closer_than."""
    next_wall: bool | None
    """Search the next wall, or without a limit the least wall, to the end, however long it takes. Without this
    option, a long search ends early; needs measure='thickness'."""
    wall_angle: float | None
    """Two faces are opposing walls if their normals differ by at least this angle; above 90 and at most 180; needs
    measure='thickness'; default 120."""
    check: int | str | None
    """Recompute N random traced faces, and N random faces of the mesh, with the double-precision reference; N is
    2000 if not given. Exit code 5 if traced faces disagree."""
    centres: bool | None
    """Add the fields centre (skeleton points) and component."""
    weights: Literal["distance", "feature"] | None
    """Edge weights of the dual graph. distance: 1 / distance of the barycentres. feature: depending on the
    dihedral angle; default feature."""
    guidance: Literal["none", "curvature", "prediction"] | None
    """Guidance field of the Poisson equation. none: harmonic interpolation. curvature: a field whose divergence is
    minus the curvature. prediction: the gradient of values that the hits of neighbouring seeds predict; default
    prediction."""
    pooling: float | None
    """Weight of the prediction in the values; 0 keeps traced values. A weight above 0 needs guidance='prediction';
    from 0 to 1; default 0."""
    solver: Literal["auto", "cg", "jacobi", "cpu", "eigen"] | None
    """Solver of the Poisson equation. On the device: conjugate gradients (cg) or jacobi. On the CPU: conjugate
    gradients in float32 (cpu), or in double (eigen); default auto."""
    tolerance: float | None
    """Relative residual at which the solver stops; above 0 and below 1; default 0.0001."""
    max_iterations: int | None
    """Greatest number of iterations of the solver; from 1; default 20000."""
    per: Literal["face", "vertex"] | None
    """Elements of the fields. vertex: for each face field, add a vertex field with the same name. Its values are
    area-weighted means over the faces of a vertex. .csv and .npy then have vertex fields only; default face."""


class SessionOptions(TypedDict, total=False):
    """Options of a session."""

    backend: Literal["auto", "vulkan", "cpu", "reference"] | None
    """Backend that traces the rays. vulkan: a Vulkan device. cpu: the cores of the CPU. reference: the CPU in
    double precision. auto: the first of these that is available; default auto."""
    device: str | int | None
    """Vulkan device: its number in the list of devices or a part of its name; default the best."""
    require_gpu: bool | None
    """Fail if no GPU is usable."""
    threads: int | None
    """Number of CPU threads, also of lavapipe; 0: the number of cores. Results do not depend on the number; from 0
    to 1024; default 0."""
