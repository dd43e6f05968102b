// One row per option of a computation and of a session. A row is in the help of the program, in the man page, in
// docs/options.md, in the keywords of Python and in the JSON report.
#include "describe/computation_options.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

#include "asdf_vk/error.h"
#include "core/length_unit.h"
#include "core/text.h"

namespace asdfvk {
namespace {

constexpr const char* kSeedGroup = "Seeds and rays";
constexpr const char* kSegmentGroup = "Segments";
constexpr const char* kThicknessGroup = "Thickness";
constexpr const char* kExperimentGroup = "Experiments (the defaults are best)";
constexpr const char* kDeviceGroup = "Device";
constexpr const char* kOutputGroup = "Output";

constexpr double kMaxSeconds = 1e9;  // More would overflow the clocks that count them.
constexpr uint64_t kAllFaces = std::numeric_limits<uint64_t>::max();

/// "10%" as 0.1, "0.1" as 0.1.
std::optional<double> shareIn(std::string_view text) {
  const bool isPercent = text.ends_with('%');
  const auto number = numberIn<double>(text.substr(0, text.size() - (isPercent ? 1 : 0)));
  return number && isPercent ? *number / 100 : number;
}

std::string_view textIn(const OptionValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text == nullptr ? std::string_view() : *text;
}

Options& optionsOf(void* target) { return static_cast<ComputationSettings*>(target)->options; }
const Options& optionsOf(const void* target) { return static_cast<const ComputationSettings*>(target)->options; }

constexpr const char* kLengthWanted = "a number above 0, or one with a unit, such as 0.8mm";

/// 0.8, "0.8" or "0.8mm".
bool readLength(const OptionValue& value, std::optional<double>& length, LengthUnit& unit) {
  std::string_view text = textIn(value);
  const LengthUnitRow* found = nullptr;
  for (const LengthUnitRow& known : kLengthUnits)
    if (text.ends_with(known.name) && (found == nullptr || known.name.size() > found->name.size())) found = &known;
  if (found != nullptr) text.remove_suffix(found->name.size());
  while (text.ends_with(' ')) text.remove_suffix(1);
  std::optional<double> number = numberIn<double>(text);
  if (const auto* real = std::get_if<double>(&value)) number = *real;
  if (const auto* whole = std::get_if<uint64_t>(&value)) number = static_cast<double>(*whole);
  if (!number || !(*number > 0) || !std::isfinite(*number)) return false;
  length = number;
  unit = found != nullptr ? found->unit : LengthUnit::OfMesh;
  return true;
}

OptionValue lengthValue(const std::optional<double>& length, LengthUnit unit) {
  if (!length) return {};
  const LengthUnitRow* const row = findLengthUnit(unit);
  return row == nullptr ? OptionValue(*length) : OptionValue(fmt::format("{}{}", *length, row->name));
}

bool readSeeds(void* target, const OptionValue& value) {
  SeedCount& seeds = optionsOf(target).seeds;
  const std::string_view text = textIn(value);
  const auto* share = std::get_if<double>(&value);
  const auto* whole = std::get_if<uint64_t>(&value);
  const auto percent = text.ends_with('%') ? shareIn(text) : share != nullptr ? std::optional(*share) : std::nullopt;
  if (percent) {
    if (!(*percent > 0 && *percent <= 1)) return false;
    seeds = SeedCount::ofShare(*percent);
    return true;
  }
  const auto count = whole != nullptr ? std::optional(*whole) : numberIn<uint64_t>(text);
  if (text == "auto") seeds = SeedCount::automatic();
  if (text == "all") seeds = SeedCount::all();
  if (count && *count > 0) seeds = SeedCount::ofCount(*count);
  return text == "auto" || text == "all" || (count && *count > 0);
}

bool readMaxError(void* target, const OptionValue& value) {
  constexpr std::string_view kRelative = "rel";
  std::string_view text = textIn(value);
  const bool isRelative = text.ends_with(kRelative);
  if (isRelative) text.remove_suffix(kRelative.size());
  const auto* number = std::get_if<double>(&value);
  const std::optional<double> share = number != nullptr ? std::optional(*number) : shareIn(text);
  if (!share || !(*share > 0 && *share < 1)) return false;
  constexpr double kLeastPercentage = 0.1;  // Without %, 0.5 is more likely to mean 0.5 % than half of the range.
  if (number == nullptr && !text.ends_with('%') && *share >= kLeastPercentage) {
    const char* const suffix = isRelative ? kRelative.data() : "";
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("'{0}{2}' has no %; write {0}%{2} or {1:g}%{2}", text, 100 * *share, suffix));
  }
  RoundOptions& rounds = optionsOf(target).rounds;
  (isRelative ? rounds.maxRelativeError : rounds.maxError) = *share;
  return true;
}

OptionValue writeMaxError(const void* target) {
  const std::optional<double>& maxError = optionsOf(target).rounds.maxError;
  return maxError ? OptionValue(*maxError) : OptionValue();
}

/// "off", "auto" or "2x1": rings x passes.
bool readSmoothing(void* target, const OptionValue& value) {
  const std::string_view text = textIn(value);
  SmoothingOptions& smoothing = optionsOf(target).smoothing;
  smoothing = {.isOn = text != "off", .window = {}};
  if (text == "off" || text == "auto") return true;
  const size_t cross = std::min(text.find('x'), text.size());
  const auto rings = numberIn<uint32_t>(text.substr(0, cross));
  const auto passes = numberIn<uint32_t>(text.substr(std::min(cross + 1, text.size())));
  if (!rings || !passes || *rings < 1 || *rings > 4 || *passes < 1 || *passes > 100) return false;
  smoothing.window = SmoothingOptions::Window{*rings, *passes};
  return true;
}

OptionValue writeSmoothing(const void* target) {
  const SmoothingOptions& smoothing = optionsOf(target).smoothing;
  if (!smoothing.isOn) return "off";
  if (!smoothing.window) return "auto";
  return fmt::format("{}x{}", smoothing.window->rings, smoothing.window->passes);
}

bool readCheck(void* target, const OptionValue& value) {
  const auto* whole = std::get_if<uint64_t>(&value);
  const auto count = textIn(value) == "all" ? kAllFaces
                     : whole != nullptr     ? *whole
                                            : numberIn<uint64_t>(textIn(value)).value_or(0);
  if (count > 0) optionsOf(target).checkCount = count;
  return count > 0;
}

OptionValue writeCheck(const void* target) {
  const std::optional<uint64_t>& count = optionsOf(target).checkCount;
  if (!count) return {};
  return *count == kAllFaces ? OptionValue("all") : OptionValue(*count);
}

#define COMPUTATION_MEMBER(path) ASDFVK_MEMBER(ComputationSettings, path)
#define COMPUTATION_CHOICE(path, names) ASDFVK_CHOICE(ComputationSettings, path, names)

// The layers below have the same names (tests/cli/options_test.cpp).
const std::array kComputationRows{
    OptionRow{.name = "recipe",
              .group = kSeedGroup,
              .access = COMPUTATION_CHOICE(recipe, kRecipes),
              .text = "Set of options; single options override it. paper: as the ASDF paper. balanced: half of the "
                      "error of paper. quality: rays pooled over neighbouring seeds, least error against many rays",
              .more = "[method.md](method.md#recipes) has the sets.",
              .apply = [](void* t) { applyRecipe(static_cast<ComputationSettings*>(t)->recipe, optionsOf(t)); }},
    OptionRow{.name = "definition",
              .group = kSeedGroup,
              .access = COMPUTATION_CHOICE(options.cone.definition, kDefinitions),
              .text = "Definition of the values: of the ASDF paper, or of CGAL's sdf_values without post-processing. "
                      "cgal: --rays 25 --seeds all unless given",
              .more = "`cgal` excludes the options that need `paper`, and `--recipe quality`, which rotates the cones "
                      "([method.md](method.md)).",
              .apply = [](void* t) { applyDefinition(optionsOf(t).cone.definition, optionsOf(t)); }},
    OptionRow{.name = "seeds",
              .group = kSeedGroup,
              .text = "Faces that cast rays: a share, a count or all; auto: 10%, but at least 3,000",
              .more =
                  "The minimum, or all faces of a smaller mesh, belongs to guidance by prediction, not to `--recipe "
                  "paper`. A mesh whose faces all cast rays has no estimate of the error.",
              .placeholder = "N%|N|all|auto",
              .keywordType = "int | float | str",
              .wanted = "a share such as 10% (above 0%, at most 100%), a count of at least 1, all, or auto",
              .read = readSeeds,
              .write = [](const void* t) { return OptionValue(toText(optionsOf(t).seeds)); }},
    OptionRow{.name = "max-error",
              .group = kSeedGroup,
              .text = "Add seeds until the estimated average error is below this share of the range, or with rel until "
                      "the median of error / value is; starts with 2% or --seeds",
              .more = "Compared is the estimate plus 1.5 standard errors. With `rel` half of the faces are within E of "
                      "their value, whatever the range is ([accuracy.md](accuracy.md)); fulfilled where half of the "
                      "faces cast rays. A text of 0.1 or more needs a `%`: `0.5` may mean 0.5% or 50%. Excludes "
                      "`--no-estimate` and `--seeds all`.",
              .placeholder = "E%[rel]",
              .keywordType = "float | str",
              .wanted = "an error above 0% and below 100%, such as 1% (of the range) or 5%rel (of the value)",
              .read = readMaxError,
              .write = writeMaxError},
    OptionRow{.name = "max-relative-error",
              .group = kSeedGroup,
              .access = COMPUTATION_MEMBER(options.rounds.maxRelativeError),
              .range = aboveAndBelow(0, 1),
              .text = "Add seeds until the estimated median of error / value is at most this",
              .placeholder = "E",
              .flags = ""},
    OptionRow{.name = "orient",
              .group = kOutputGroup,
              .access = COMPUTATION_CHOICE(options.orientation, kOrientations),
              .text = "Inverted closed components: report them (keep), reverse them, or reverse all faces",
              .more = "`auto`: outer shells point outwards, shells inside another one (cavities) inwards."},
    OptionRow{.name = "sampler",
              .group = kSeedGroup,
              .access = COMPUTATION_MEMBER(options.sampler),
              .text = "Selection of the seed faces. adaptive: blue noise in two passes, the second denser where the "
                      "first predicts errors",
              .valueNames = "random|blue-noise|farthest-point|normal-space|adaptive"},
    OptionRow{.name = "rng-seed",
              .group = kSeedGroup,
              .access = COMPUTATION_MEMBER(options.randomSeed),
              .range = {.min = 0},
              .text = "Random seed; the same number gives the same bits",
              .placeholder = "N",
              .keyword = "random-seed"},
    OptionRow{.name = "time-budget",
              .group = kSeedGroup,
              .access = COMPUTATION_MEMBER(options.rounds.timeBudgetSeconds),
              .range = aboveUpTo(0, kMaxSeconds),
              .text = "Add seeds until this time has passed, reading and writing excluded. The result is not "
                      "reproducible",
              .more = "Excludes `--seeds all`.",
              .placeholder = "SECONDS"},
    OptionRow{.name = "estimate",
              .group = kSeedGroup,
              .access = COMPUTATION_MEMBER(options.estimatesError),
              .text = "Do not estimate the error; saves about the time of the interpolation",
              .more = "The sampler then places all seeds: none go to faces with large expected errors or to the "
                      "extremes, which costs a little accuracy.",
              .flags = "--no-estimate"},
    OptionRow{.name = "rays",
              .group = kSeedGroup,
              .access = COMPUTATION_MEMBER(options.cone.rayCount),
              .range = fromTo(1, kMaxRayCount),
              .text = "Rays per cone",
              .placeholder = "N"},
    OptionRow{.name = "angle",
              .group = kSeedGroup,
              .access = COMPUTATION_MEMBER(options.cone.openingAngleDegrees),
              .range = aboveAndBelow(0, 180),
              .text = "Full opening angle of the cone",
              .placeholder = "DEGREES",
              .keyword = "cone-angle"},
    OptionRow{.name = "false-hit-angle",
              .group = kSeedGroup,
              .access = COMPUTATION_MEMBER(options.cone.falseHitAngleDegrees),
              .range = fromTo(0, 180),
              .text = "A hit is false where the normals of the hit face and of the seed differ by less than this",
              .placeholder = "DEGREES",
              .needs = "definition=paper"},
    OptionRow{.name = "outlier-deviations",
              .group = kSeedGroup,
              .access = COMPUTATION_MEMBER(options.cone.outlierDeviations),
              .range = above(0),
              .text = "Lengths farther from the median than S standard deviations are dropped",
              .placeholder = "S",
              .needs = "definition=paper"},
    OptionRow{.name = "cone-rotation",
              .group = kSeedGroup,
              .access = COMPUTATION_CHOICE(options.cone.rotation, kConeRotations),
              .text = "Rotation of the cones: fixed (parallel rays in neighbouring cones) or hashed (by face index, so "
                      "that errors are independent)",
              .needs = "definition=paper"},
    OptionRow{.name = "smooth",
              .group = kSeedGroup,
              .text = "Bilateral filter over R rings of faces, P passes; auto: by the number of faces. For --seeds all "
                      "with --cone-rotation hashed",
              .more = "It removes up to a third of the error against many rays. The estimate and `--max-error` refer "
                      "to the values before.",
              .placeholder = "off|auto|RxP",
              .keywordType = "str | tuple[int, int]",
              .wanted = "off, auto or RINGSxPASSES such as 2x1 (1 to 4 rings, 1 to 100 passes)",
              .read = readSmoothing,
              .write = writeSmoothing},
    OptionRow{.name = "postprocess",
              .group = kSegmentGroup,
              .access = COMPUTATION_CHOICE(options.postprocess, kPostprocesses),
              .text = "Field normalized. cgal: missing values are filled, all are smoothed and mapped to 0 .. 1, as "
                      "CGAL does"},
    OptionRow{.name = "segment",
              .group = kSegmentGroup,
              .access = COMPUTATION_CHOICE(options.segmentation, kSegmentations),
              .text = "Field segment. parts: the parts that people see, also --segment without a value. cgal: soft "
                      "clustering and graph cut, as CGAL does; implies --postprocess cgal; for --seeds all",
              .bareValue = "parts",
              .wanted = "one of none|parts|cgal; the number of parts is an option of its own, parts"},
    OptionRow{.name = "parts",
              .group = kSegmentGroup,
              .access = COMPUTATION_MEMBER(options.parts.partCount),
              .range = fromTo(1, kMaxPartCount),
              .text = "Number of parts; without it the number is found",
              .placeholder = "N",
              .needs = "segment=parts"},
    OptionRow{.name = "detail",
              .group = kSegmentGroup,
              .access = COMPUTATION_MEMBER(options.parts.detail),
              .range = fromTo(kMinDetail, kMaxDetail),
              .text = "Divides the cost at which merging stops; a larger number gives more parts",
              .more = "Excludes `--parts`.",
              .placeholder = "X",
              .needs = "segment=parts"},
    OptionRow{.name = "clusters",
              .group = kSegmentGroup,
              .access = COMPUTATION_MEMBER(options.cgalSegmentation.clusterCount),
              .range = fromTo(2, kMaxClusterCount),
              .text = "Clusters of values, not the number of segments",
              .placeholder = "K",
              .needs = "segment=cgal"},
    OptionRow{.name = "smoothness",
              .group = kSegmentGroup,
              .access = COMPUTATION_MEMBER(options.cgalSegmentation.smoothness),
              .range = fromTo(0, kMaxSmoothness),
              .text = "Weight of the boundaries, usually at most 1",
              .placeholder = "L",
              .needs = "segment=cgal"},
    OptionRow{.name = "cgal-expansion",
              .group = kSegmentGroup,
              .access = COMPUTATION_CHOICE(options.cgalSegmentation.expansion, kCgalExpansions),
              .text = "The graph cut expands all clusters, or the first one only, as CGAL 5.5.1 does",
              .needs = "segment=cgal",
              .keyword = "expansion"},
    OptionRow{.name = "measure",
              .group = kThicknessGroup,
              .access = COMPUTATION_CHOICE(options.measure, kMeasures),
              .text = "thickness: the fields thickness, the diameter of the largest ball inside that touches the face, "
                      "and least_thickness instead of sdf and seed; both: these four",
              .more = "All faces are measured, whatever `--seeds` is; without the shape diameter no rays are traced."},
    OptionRow{.name = "thinner-than",
              .group = kThicknessGroup,
              .range = above(0),
              .text = "Whether any point of the surface is thinner than T, in the unit of the mesh, and where; implies "
                      "--measure thickness",
              .more = "With a unit, such as `0.8mm`, where the file states its own (3MF, glTF): `um`, `mm`, `cm`, `m`, "
                      "`in` or `ft`.",
              .placeholder = "T",
              .defaultText = "-",
              .keywordType = "float | str",
              .wanted = kLengthWanted,
              .read =
                  [](void* target, const OptionValue& value) {
                    ThicknessOptions& thickness = optionsOf(target).thickness;
                    return readLength(value, thickness.thinnerThan, thickness.limitUnit);
                  },
              .write =
                  [](const void* target) {
                    const ThicknessOptions& thickness = optionsOf(target).thickness;
                    return lengthValue(thickness.thinnerThan, thickness.limitUnit);
                  }},
    OptionRow{.name = "fail-if-thinner",
              .group = kThicknessGroup,
              .range = above(0),
              .text = "The same, and exit code 6 where a point is thinner than T, 5 where parts of the surface cannot "
                      "be judged",
              .placeholder = "T",
              .defaultText = "-",
              .keyword = "",
              .wanted = kLengthWanted,
              .read =
                  [](void* target, const OptionValue& value) {
                    auto& settings = *static_cast<ComputationSettings*>(target);
                    return readLength(value, settings.failIfThinner, settings.failIfThinnerUnit);
                  },
              .write =
                  [](const void* target) {
                    const auto& settings = *static_cast<const ComputationSettings*>(target);
                    return lengthValue(settings.failIfThinner, settings.failIfThinnerUnit);
                  }},
    OptionRow{.name = "allow-sharp-edges",
              .group = kThicknessGroup,
              .access = COMPUTATION_MEMBER(options.thickness.allowsSharpEdges),
              .text = "Leave sharp edges and tips, where the thickness is 0, out of the verdict; they are listed",
              .needs = "thinner-than"},
    OptionRow{.name = "wall-angle",
              .group = kThicknessGroup,
              .access = COMPUTATION_MEMBER(options.thickness.wallAngleDegrees),
              .range = aboveUpTo(90, 180),
              .text = "A wall is opposing if its normal differs by this from that of the face",
              .placeholder = "DEGREES",
              .needs = "measure=thickness|both"},
    OptionRow{.name = "check",
              .group = kOutputGroup,
              .text = "Recompute N random traced faces, and N of all faces, with the reference (2000 without a "
                      "number); exit code "
                      "5 where traced faces disagree",
              .placeholder = "[=N|all]",
              .keywordType = "int | str",
              .bareValue = "2000",
              .wanted = "a count of at least 1 or all",
              .read = readCheck,
              .write = writeCheck},
    OptionRow{.name = "centres",
              .group = kOutputGroup,
              .access = COMPUTATION_MEMBER(options.computesCentres),
              .text = "The fields centre, skeleton points, and component",
              .flags = ""},
    OptionRow{.name = "weights",
              .group = kExperimentGroup,
              .access = COMPUTATION_CHOICE(options.interpolation.weights, kWeights),
              .text = "Edge weights of the dual graph: 1/distance of the barycentres, or by the dihedral angle",
              .more = "See [method.md](method.md)."},
    OptionRow{.name = "guidance",
              .group = kExperimentGroup,
              .access = COMPUTATION_CHOICE(options.interpolation.guidance, kGuidances),
              .text = "Guidance field: none (harmonic), minus the curvature, or the gradient of values predicted from "
                      "the hits of neighbouring seeds"},
    OptionRow{.name = "pooling",
              .group = kExperimentGroup,
              .access = COMPUTATION_MEMBER(options.interpolation.pooling),
              .range = fromTo(0, 1),
              .text = "Weight of the prediction in the values; 0 keeps traced values. Above 0 needs --guidance "
                      "prediction",
              .placeholder = "P"},
    OptionRow{.name = "solver",
              .group = kExperimentGroup,
              .access = COMPUTATION_MEMBER(options.solver),
              .text = "Conjugate gradients (cg) or Jacobi on the device, conjugate gradients on the CPU in float32 "
                      "(cpu) or with Eigen in double",
              .more =
                  "Eigen also finishes what float32 cannot. `auto` is `cg` on a GPU and `cpu` where the CPU traces. "
                  "With `cg` and `jacobi` the device also predicts values.",
              .valueNames = "auto|cg|jacobi|cpu|eigen"},
    OptionRow{.name = "tolerance",
              .group = kExperimentGroup,
              .access = COMPUTATION_MEMBER(options.solverOptions.tolerance),
              .range = aboveAndBelow(0, 1),
              .text = "Relative residual at which the solver stops",
              .more = "The residual of each face is measured in the unit of the values, so that a finely meshed patch "
                      "does not hide the rest.",
              .placeholder = "R"},
    OptionRow{.name = "max-iterations",
              .group = kExperimentGroup,
              .access = COMPUTATION_MEMBER(options.solverOptions.maxIterations),
              .range = {.min = 1},
              .text = "Iterations at which the solver stops",
              .placeholder = "N"},
    OptionRow{.name = "per",
              .group = kOutputGroup,
              .access = COMPUTATION_CHOICE(options.per, kPerElements),
              .text = "vertex: also fields per vertex, means over its faces by area, with the names of those per face; "
                      ".csv and .npy hold these only"},
};

const std::array kSessionRows{
    OptionRow{.name = "backend",
              .group = kDeviceGroup,
              .access = ASDFVK_MEMBER(SessionSettings, backend),
              .text =
                  "A Vulkan device, the cores of the CPU, the double-precision reference, or the first of them that is "
                  "available",
              .valueNames = "auto|vulkan|cpu|reference"},
    OptionRow{.name = "device",
              .group = kDeviceGroup,
              .access = ASDFVK_MEMBER(SessionSettings, device),
              .text = "Vulkan device: its number in --list-devices or a part of its name",
              .placeholder = "N|NAME",
              .defaultText = "the best",
              .keywordType = "str | int"},
    OptionRow{.name = "require-gpu",
              .group = kDeviceGroup,
              .access = ASDFVK_MEMBER(SessionSettings, requireGpu),
              .text = "Fail where no GPU is usable",
              .more = "Exit code 3 instead of a CPU device, `cpu` or the reference."},
    OptionRow{.name = "threads",
              .group = kDeviceGroup,
              .access = ASDFVK_MEMBER(SessionSettings, threadCount),
              .range = fromTo(0, 1024),
              .text = "CPU threads, also of lavapipe; 0: the number of cores. Results do not depend on it",
              .placeholder = "N"},
    OptionRow{.name = "kernel",
              .group = kExperimentGroup,
              .access = ASDFVK_MEMBER(SessionSettings, variant.kernel),
              .text = "Vulkan: neighbouring lanes trace one ray of neighbouring seeds, the rays of one seed, or these "
                      "as a packet",
              .more = "`auto` of this and the next one: by the class of the device and the size of the mesh "
                      "([devices.md](devices.md)).",
              .keyword = "",
              .valueNames = "auto|seed|ray|packet",
              .emptyIsAuto = true},
    OptionRow{.name = "fetch",
              .group = kExperimentGroup,
              .access = ASDFVK_MEMBER(SessionSettings, variant.fetch),
              .text = "Vulkan: the hierarchy is read from texel or storage buffers",
              .keyword = "",
              .valueNames = "auto|texel|storage",
              .emptyIsAuto = true},
};

}  // namespace

OptionRows computationRows() { return kComputationRows; }
OptionRows sessionRows() { return kSessionRows; }

std::string toText(const SeedCount& seeds) {
  if (seeds.kind == SeedCount::Kind::Automatic) return "auto";
  if (seeds.kind == SeedCount::Kind::All) return "all";
  if (seeds.kind == SeedCount::Kind::Count) return fmt::format("{}", seeds.count);
  const std::string rounded = fmt::format("{:.6g}%", seeds.share * 100);
  return shareIn(rounded) == seeds.share ? rounded : fmt::format("{:.17g}%", seeds.share * 100);
}

std::vector<std::pair<std::string, OptionValue>> reportedOptions(const ComputationSettings& computation,
                                                                 const SessionSettings& session) {
  std::vector<std::pair<std::string, OptionValue>> values;
  const auto add = [&](OptionRows rows, const void* target) {
    for (const OptionRow& row : rows)
      if (target != &session || row.name != std::string_view("threads"))
        values.emplace_back(spelled(row, OptionSpelling::CamelCase),
                            isNeedMet(row, rows, target) ? valueOf(row, target) : OptionValue());
  };
  add(computationRows(), &computation);
  add(sessionRows(), &session);
  return values;
}

}  // namespace asdfvk
