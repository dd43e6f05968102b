// One row per option of a computation.
#include "describe/computation_options.h"

#include <fmt/core.h>

#include <array>

#include "describe/option_values.h"

namespace asdfvk {
namespace {

constexpr const char* kSeedGroup = "Seeds and rays";
constexpr const char* kSegmentGroup = "Segments";
constexpr const char* kThicknessGroup = "Thickness";

constexpr const char* kNeedsThickness = "measure=thickness|both|gap|sdf,gap|thickness,gap|sdf,thickness,gap";

}  // namespace

OptionRows computationRows(ComputationSettings& settings) {
  Options& options = settings.options;
  return withGroups({
      OptionRow{
          .name = "recipe",
          .group = kSeedGroup,
          .member = choice<kRecipes>(&settings.recipe),
          .text =
              "Set of options; single options override the set. paper: the method of the ASDF paper. balanced: "
              "about half the error of paper. quality: also pools the rays of neighbouring seeds, for the least error",
          .more = "[method.md](method.md#recipes) lists the options of each set.",
          .atPoints = AtPoints::Diameter,
          .applied = [&settings] { applyRecipe(settings.recipe, settings.options); }},
      OptionRow{.name = "definition",
                .member = choice<kDefinitions>(&options.cone.definition),
                .text = "Definition of the shape diameter. paper: as in the ASDF paper. cgal: as CGAL's sdf_values "
                        "without post-processing, with {rays=25} {seeds=all} unless these are given",
                .more = "`cgal` excludes the options that need `{definition=paper}`. It also excludes `{recipe=quality}"
                        "`, because this recipe rotates the cones ([method.md](method.md)).",
                .atPoints = AtPoints::Diameter,
                .applied = [&options] { applyDefinition(options.cone.definition, options); }},
      OptionRow{
          .name = "seeds",
          .member = memberAs<SeedCountCodec>(&options.seeds),
          .text = "Faces that cast rays: a share, a count or all faces. auto: 10%, but at least 3,000",
          .more = "With `auto`, all faces of a mesh of at most 3,000 faces cast rays. Without `{guidance=prediction}`, "
                  "as in `{recipe=paper}`, `auto` has no minimum. If all faces cast rays, there is no error estimate.",
          .placeholder = "N%|N|all|auto"},
      OptionRow{
          .name = "max-error",
          .member = memberAs<MaxErrorCodec>(&options.rounds),
          .text =
              "Add seeds until the estimated average error is at most E of the range of the values; with rel, until "
              "the estimated median of error / value is at most E. Starts with 2% of the faces, or with {seeds}",
          .more =
              "E is compared with the estimate plus 1.5 standard errors. With `rel`, half of the faces are within E of "
              "their value, whatever the range is ([accuracy.md](accuracy.md)). If half of the faces cast rays, this "
              "goal is reached. A number of 0.1 or more needs a `%`, because `0.5` may mean 0.5% or 50%. Excludes "
              "`{estimate=off}` and `{seeds=all}`.",
          .placeholder = "E%[rel]"},
      OptionRow{.name = "max-relative-error",
                .member = &options.rounds.maxRelativeError,
                .range = aboveAndBelow(0, 1),
                .text = "Add seeds until the estimated median of error / value is at most E",
                .placeholder = "E",
                .where = OptionPlace::Library},
      OptionRow{.name = "orient",
                .group = kOutputGroup,
                .member = choice<kOrientations>(&options.orientation),
                .text = "Closed components with faces oriented inwards. keep: report them. auto: reverse them. flip: "
                        "reverse all faces of the mesh",
                .more = "`auto` orients outer shells outwards, and shells inside another shell (cavities) inwards.",
                .atPoints = AtPoints::Both},
      OptionRow{.name = "sampler",
                .group = kSeedGroup,
                .member = choice<kSamplerNames>(&options.sampler),
                .text =
                    "Selection of the seeds. adaptive: blue noise in two passes; the second pass is denser where the "
                    "first one predicts errors"},
      OptionRow{.name = "rng-seed",
                .member = &options.randomSeed,
                .range = {.min = 0},
                .text = "Start value of all random numbers; the same value gives the same bits",
                .placeholder = "N",
                .keyword = "random-seed"},
      OptionRow{.name = "estimate",
                .member = &options.estimatesError,
                .text = "Do not estimate the error. This saves 3 to 15 % of the time, with 1 % seeds up to 25 %",
                .more = "The sampler then selects all seeds. No seed is placed at large expected errors or extreme "
                        "values, so that the result is a little less accurate.",
                .flags = "--no-estimate"},
      OptionRow{.name = "rays",
                .member = &options.cone.rayCount,
                .range = fromTo(1, kMaxRayCount),
                .text = "Rays per cone",
                .placeholder = "N",
                .atPoints = AtPoints::Diameter},
      OptionRow{.name = "angle",
                .member = &options.cone.openingAngleDegrees,
                .range = aboveAndBelow(0, 180),
                .unit = OptionUnit::Degrees,
                .text = "Full opening angle of the cone",
                .atPoints = AtPoints::Diameter,
                .keyword = "cone-angle"},
      OptionRow{.name = "false-hit-angle",
                .member = &options.cone.falseHitAngleDegrees,
                .range = fromTo(0, 180),
                .unit = OptionUnit::Degrees,
                .text = "A hit is dropped as false if the normals of hit face and seed differ by less than this angle",
                .needs = "definition=paper",
                .atPoints = AtPoints::Diameter},
      OptionRow{.name = "outlier-deviations",
                .member = &options.cone.outlierDeviations,
                .range = above(0),
                .text = "Ray lengths farther from the median than S standard deviations are dropped",
                .placeholder = "S",
                .needs = "definition=paper",
                .atPoints = AtPoints::Diameter},
      OptionRow{.name = "cone-rotation",
                .member = choice<kConeRotations>(&options.cone.rotation),
                .text = "Rotation of each cone about its axis. fixed: neighbouring cones have nearly parallel rays. "
                        "hashed: by a hash of the face index, so that errors of neighbouring faces are independent",
                .needs = "definition=paper",
                .atPoints = AtPoints::Diameter},
      OptionRow{.name = "smooth",
                .member = memberAs<SmoothingCodec>(&options.smoothing),
                .text = "Bilateral filter of the values over R rings of faces, in P passes. auto: the number of faces "
                        "determines R and P. Use the filter with {seeds=all} and {cone-rotation=hashed}",
                .more = "The filter removes up to a third of the error against many rays. The error estimate and "
                        "`{max-error}` refer to the unfiltered values.",
                .placeholder = "off|auto|RxP"},
      OptionRow{.name = "postprocess",
                .group = kSegmentGroup,
                .member = choice<kPostprocesses>(&options.postprocess),
                .text = "Post-processing of the values for the field normalized. cgal: fill missing values, smooth all "
                        "values and map them to 0 .. 1, as CGAL does"},
      OptionRow{.name = "segment",
                .member = choice<kSegmentations>(&options.segmentation),
                .text =
                    "Segmentation for the field segment. parts: parts as people see them; {segment} without a value "
                    "means parts. cgal: soft clustering and graph cut as in CGAL; implies {postprocess=cgal}; use "
                    "cgal with {seeds=all}",
                .bareValue = "parts",
                .wanted = "one of none|parts|cgal; {parts} sets the number of parts"},
      OptionRow{.name = "parts",
                .member = &options.parts.partCount,
                .range = fromTo(1, kMaxPartCount),
                .text = "Number of parts. Without {parts}, the segmentation chooses the number",
                .placeholder = "N",
                .needs = "segment=parts"},
      OptionRow{.name = "detail",
                .member = &options.parts.detail,
                .range = fromTo(kMinDetail, kMaxDetail),
                .text = "Level of detail: a larger number gives more parts. The cost at which the merging of regions "
                        "stops is divided by X",
                .more = "Excludes `{parts}`.",
                .placeholder = "X",
                .needs = "segment=parts"},
      OptionRow{.name = "clusters",
                .member = &options.cgalSegmentation.clusterCount,
                .range = fromTo(2, kMaxClusterCount),
                .text = "Number of clusters of values. A cluster may become several segments",
                .placeholder = "K",
                .needs = "segment=cgal"},
      OptionRow{.name = "smoothness",
                .member = &options.cgalSegmentation.smoothness,
                .range = fromTo(0, kMaxSmoothness),
                .text = "Weight of the boundaries in the graph cut, usually at most 1",
                .placeholder = "L",
                .needs = "segment=cgal"},
      OptionRow{.name = "cgal-expansion",
                .member = choice<kCgalExpansions>(&options.cgalSegmentation.expansion),
                .text = "Clusters that the graph cut expands: all, or only the first one, as CGAL 5.5.1 does",
                .needs = "segment=cgal",
                .keyword = "expansion"},
      OptionRow{
          .name = "measure",
          .group = kThicknessGroup,
          .member = choice<kMeasures>(&options.measure),
          .text = "Quantity to measure. sdf: the shape diameter, with the fields sdf and seed. thickness: the wall "
                  "thickness, with the fields thickness and least_thickness. both: all four fields. gap: the width "
                  "of the space in front of the faces, with the fields gap and least_gap, and sealed voids",
          .more = "The wall thickness is the diameter of the largest ball that touches the face from inside; the "
                  "gap is that of the largest ball outside. Both are measured at all faces, whatever `{seeds}` is, "
                  "and trace no rays.",
          .atPoints = AtPoints::Both},
      OptionRow{
          .name = "thinner-than",
          .member = memberAs<LengthCodec>(&options.thickness.thinnerThan),
          .range = above(0),
          .text = "Report whether and where the surface is thinner than T, in the unit of the mesh; implies "
                  "{measure=thickness}",
          .more = "If the file states its unit (3MF, glTF, STEP), T may have a unit, as in `0.8mm`: `um`, `mm`, `cm`, "
                  "`m`, `in` or `ft`. The other limits may have one, too.",
          .placeholder = "T"},
      OptionRow{.name = "fail-if-thinner",
                .member = memberAs<LengthCodec>(&settings.failIfThinner),
                .range = above(0),
                .text = "Like {thinner-than}, but with exit codes: 6 if a wall is thinner than T, 5 if parts of the "
                        "surface cannot be judged. Without -o, no result is written",
                .placeholder = "T",
                .where = OptionPlace::Program},
      OptionRow{.name = "thicker-than",
                .member = memberAs<LengthCodec>(&options.thickness.thickerThan),
                .range = above(0),
                .text = "Report which bodies are thicker than T: the largest ball inside; implies {measure=thickness}",
                .placeholder = "T"},
      OptionRow{.name = "fail-if-thicker",
                .member = memberAs<LengthCodec>(&settings.failIfThicker),
                .range = above(0),
                .text = "Like {thicker-than}, with the exit codes of {fail-if-thinner}",
                .placeholder = "T",
                .where = OptionPlace::Program},
      OptionRow{.name = "closer-than",
                .member = memberAs<LengthCodec>(&options.thickness.closerThan),
                .range = above(0),
                .text = "Report gaps that are narrower than D: slots of a body, and clearances between bodies; implies "
                        "{measure=gap}",
                .placeholder = "D"},
      OptionRow{.name = "fail-if-closer",
                .member = memberAs<LengthCodec>(&settings.failIfCloser),
                .range = above(0),
                .text = "Like {closer-than}, with the exit codes of {fail-if-thinner}",
                .placeholder = "D",
                .where = OptionPlace::Program},
      OptionRow{.name = "fail-if-voids",
                .member = &settings.failsIfVoids,
                .text = "Exit code 6 if the mesh has a sealed void, 5 if that cannot be judged; implies {measure=gap}",
                .where = OptionPlace::Program},
      OptionRow{.name = "fail-if-contact",
                .member = &settings.failsIfContact,
                .text = "Exit code 6 if two bodies touch, cross or overlap, 5 if that cannot be judged; implies "
                        "{measure=gap}. {fail-if-closer} does not count contact, which is no gap",
                .where = OptionPlace::Program},
      OptionRow{.name = "count-details",
                .member = &options.thickness.countsDetails,
                .text = "Details fail the check, too: thin places that are too small for a wall, such as low ribs. The "
                        "report lists them",
                .needs = "thinner-than|closer-than"},
      OptionRow{.name = "count-edges",
                .member = &options.thickness.countsEdges,
                .text = "Details and edges fail the check, too: each point that is thinner than T",
                .needs = "thinner-than|closer-than"},
      OptionRow{.name = "next-wall",
                .member = &options.thickness.findsNextWall,
                .text = "Search the next wall, or without a limit the least wall, to the end, however long it takes. "
                        "Without this option, a long search ends early",
                .needs = kNeedsThickness},
      OptionRow{.name = "wall-angle",
                .member = &options.thickness.wallAngleDegrees,
                .range = aboveUpTo(90, 180),
                .unit = OptionUnit::Degrees,
                .text = "Two faces are opposing walls if their normals differ by at least this angle",
                .needs = kNeedsThickness,
                .atPoints = AtPoints::Thickness},
      OptionRow{.name = "check",
                .group = kOutputGroup,
                .member = memberAs<FaceCountCodec>(&options.checkCount),
                .text = "Recompute N random traced faces, and N random faces of the mesh, with the double-precision "
                        "reference; N is 2000 if not given. Exit code 5 if traced faces disagree",
                .placeholder = "[=N|all]",
                .bareValue = "2000"},
      OptionRow{.name = "centres",
                .member = &options.computesCentres,
                .text = "Add the fields centre (skeleton points) and component",
                .where = OptionPlace::Library},
      OptionRow{.name = "weights",
                .group = kExperimentGroup,
                .member = choice<kWeights>(&options.interpolation.weights),
                .text = "Edge weights of the dual graph. distance: 1 / distance of the barycentres. feature: depending "
                        "on the dihedral angle",
                .more = "See [method.md](method.md)."},
      OptionRow{
          .name = "guidance",
          .member = choice<kGuidances>(&options.interpolation.guidance),
          .text =
              "Guidance field of the Poisson equation. none: harmonic interpolation. curvature: a field whose "
              "divergence "
              "is minus the curvature. prediction: the gradient of values that the hits of neighbouring seeds predict"},
      OptionRow{.name = "pooling",
                .member = &options.interpolation.pooling,
                .range = fromTo(0, 1),
                .text = "Weight of the prediction in the values; 0 keeps traced values. A weight above 0 needs "
                        "{guidance=prediction}",
                .placeholder = "P"},
      OptionRow{.name = "solver",
                .member = choice<kSolverNames>(&options.solver),
                .text =
                    "Solver of the Poisson equation. On the device: conjugate gradients (cg) or jacobi. On the CPU: "
                    "conjugate gradients in float32 (cpu), or in double (eigen)",
                .more = "If float32 does not reach the tolerance, `eigen` continues. `auto` is `cg` on a GPU, and "
                        "`cpu` if the CPU traces. With `cg` and `jacobi` the device also predicts values."},
      OptionRow{.name = "tolerance",
                .member = &options.solverOptions.tolerance,
                .range = aboveAndBelow(0, 1),
                .text = "Relative residual at which the solver stops",
                .more = "The residual of each face is scaled to the unit of the values, so that a finely meshed patch "
                        "does not hide the residuals of other faces.",
                .placeholder = "R"},
      OptionRow{.name = "max-iterations",
                .member = &options.solverOptions.maxIterations,
                .range = {.min = 1},
                .text = "Greatest number of iterations of the solver",
                .placeholder = "N"},
      OptionRow{
          .name = "per",
          .group = kOutputGroup,
          .member = choice<kPerElements>(&options.per),
          .text =
              "Elements of the fields. vertex: for each face field, add a vertex field with the same name. Its values "
              "are area-weighted means over the faces of a vertex. .csv and .npy then have vertex fields only"},
  });
}

std::string withSpelledOptions(std::string_view message, OptionSpelling spelling) {
  ComputationSettings defaults;
  return withSpelledOptions(computationRows(defaults), message, spelling);
}

std::string removedOptionText(std::string_view name, OptionSpelling spelling) {
  constexpr std::array kRemoved{
      RemovedOption{"allow-sharp-edges", "thin edges do not count any more; {count-edges} counts them"},
      RemovedOption{"time-budget",
                    "the result depended on the speed of the machine; {max-error} or {seeds} bound the work"}};
  for (const RemovedOption& removed : kRemoved)
    if (name == withSpelledOptions(fmt::format("{{{}}}", removed.name), spelling))
      return fmt::format("{} was removed: {}", name, withSpelledOptions(removed.message, spelling));
  return {};
}

}  // namespace asdfvk
