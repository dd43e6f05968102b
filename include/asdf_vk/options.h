#pragma once

#include <cstdint>
#include <optional>

#include "asdf_vk/api.h"

namespace asdfvk {

/// Rotation of the rays of a cone about its axis.
enum class ConeRotation {
  Fixed,   ///< The axis determines the rotation: neighbouring faces cast nearly parallel rays.
  Hashed,  ///< A hash of the face index determines the rotation: errors of neighbouring faces are independent.
};

/// Definition of the shape diameter of a face (docs/method.md).
enum class Definition {
  Paper,  ///< Shapira, Shamir and Cohen-Or 2008, section 3; ASDF paper, section 3.
  Cgal,   ///< sdf_values() of CGAL 5.5 without its post-processing; see applyDefinition().
};

struct ConeOptions {
  uint32_t rayCount = 30;            ///< 1 to kMaxRayCount.
  double openingAngleDegrees = 120;  ///< Full angle, above 0 and below 180.
  // Definition::Cgal requires the defaults of the next three members.
  /// A hit is false and dropped if the normals of hit face and seed face differ by less than this angle; 0 to 180.
  double falseHitAngleDegrees = 90;
  /// Largest difference of a ray length from the median, in standard deviations, > 0. Other lengths are dropped.
  double outlierDeviations = 1;
  ConeRotation rotation = ConeRotation::Fixed;
  Definition definition = Definition::Paper;

  bool operator==(const ConeOptions&) const = default;
};
inline constexpr uint32_t kMaxRayCount = 1024;

/// Number of seeds. Seeds are the faces that cast rays.
struct SeedCount {
  /// Automatic: kAutomaticSeedShare of the faces. With Guidance::Prediction, the number is at least
  /// kMinAutomaticSeedCount; in a mesh with fewer faces, all faces are seeds. With fewer seeds, a small mesh would lose
  /// accuracy and save little time.
  enum class Kind { Automatic, All, Share, Count } kind = Kind::Automatic;
  double share = 0;    ///< Share of the faces that can cast rays, above 0 and at most 1.
  uint64_t count = 0;  ///< At least 1.
  /// Whether the caller chose the number. If false, and if RoundOptions are set, the first round has kFirstRoundShare
  /// of the faces as seeds.
  bool isChosen = false;

  [[nodiscard]] static SeedCount automatic() { return {}; }
  [[nodiscard]] static SeedCount all() { return {Kind::All, 1, 0, true}; }
  [[nodiscard]] static SeedCount ofShare(double share) { return {Kind::Share, share, 0, true}; }
  [[nodiscard]] static SeedCount ofCount(uint64_t count) { return {Kind::Count, 0, count, true}; }
};
inline constexpr double kAutomaticSeedShare = 0.1;
inline constexpr uint64_t kMinAutomaticSeedCount = 3000;

/// Selection of the seeds (docs/method.md).
enum class SamplerChoice {
  Random,         ///< ASDF paper, section 4.2.
  BlueNoise,      ///< Poisson-disk sampling of the dual graph.
  FarthestPoint,  ///< Each seed is the face that is farthest from all earlier seeds.
  NormalSpace,    ///< The same number of seeds in each bin of normals.
  Adaptive,       ///< Blue noise in two passes; the second is denser where the first one predicts errors.
};

/// Weights of the edges of the dual graph in the Poisson equation.
enum class ArcWeights {
  Distance,  ///< 1 / distance of the two barycentres (ASDF paper, section 4.1).
  Feature,   ///< The weight decreases with the dihedral angle, faster at concave edges (src/poisson).
};

/// Guidance field of the Poisson equation (ASDF paper, section 4.1).
enum class Guidance {
  None,        ///< No guidance field: harmonic interpolation.
  Curvature,   ///< The divergence of the field is minus the curvature, as in the ASDF paper.
  Prediction,  ///< The field is the gradient of values that the hits of neighbouring seeds predict (src/predict).
};

struct InterpolationOptions {
  ArcWeights weights = ArcWeights::Feature;
  Guidance guidance = Guidance::Prediction;
  /// Weight of the prediction in the result, 0 to 1: value = (1 - pooling) * interpolated + pooling * predicted. The
  /// formula also applies to seeds, which keep their traced values only if pooling is 0. A pooling above 0 requires
  /// Guidance::Prediction.
  double pooling = 0;
};

/// Solver of the Poisson equation.
enum class SolverChoice {
  Automatic,  ///< Cg on a GPU that can run it, else Cpu.
  Cg,         ///< Conjugate gradients on the Vulkan device, which then also predicts values.
  Jacobi,     ///< Jacobi iterations on the Vulkan device: slow, for comparison.
  Cpu,        ///< Conjugate gradients in float32 on the CPU; in double if float32 does not reach the tolerance.
  Eigen,      ///< Conjugate gradients in double on the CPU.
};

struct SolverOptions {
  double tolerance = 1e-4;  ///< Relative residual at which a solver stops.
  uint32_t maxIterations = 20000;
};

/// Bilateral filter of the result (Tomasi and Manduchi 1998). Useful if all faces are seeds.
struct SmoothingOptions {
  bool isOn = false;
  struct Window {
    uint32_t rings = 2;   ///< Rings of neighbouring faces in the window, 1 to 4.
    uint32_t passes = 1;  ///< How many times the filter is applied, 1 to 100.
    bool operator==(const Window&) const = default;
  };
  std::optional<Window> window;  ///< Unset: the number of faces determines the window.
};

/// Post-processing of the values. Its result is the field "normalized".
enum class Postprocess {
  None,
  Cgal,  ///< Fills, filters and maps the values to [0, 1], as CGAL's sdf_values_postprocessing() does.
};

/// Division of the mesh into segments. Its result is the field "segment".
enum class Segmentation {
  None,
  Cgal,   ///< The segments of CGAL's segmentation_from_sdf_values(). Implies Postprocess::Cgal.
  Parts,  ///< Parts as people see them, computed from values, creases and lines of sight.
};

enum class CgalExpansion {
  All,    ///< The graph cut expands every cluster, as in Shapira et al. 2008 and in other versions of CGAL.
  First,  ///< The graph cut expands only the cluster with the least values, as in CGAL 5.5.1.
};

struct CgalSegmentationOptions {
  uint32_t clusterCount = 5;  ///< 2 to kMaxClusterCount. A cluster of values may become several segments, or none.
  double smoothness = 0.26;   ///< Weight of the edge costs, 0 to kMaxSmoothness. CGAL's manual allows 0 to 1.
  CgalExpansion expansion = CgalExpansion::All;
};
inline constexpr uint32_t kMaxClusterCount = 100;
inline constexpr double kMaxSmoothness = 1000;

struct PartsOptions {
  /// Requested number of parts, 1 to kMaxPartCount. The result has more parts if the mesh has more components, and
  /// fewer if the mesh has fewer faces. Unset: the segmentation chooses the number.
  std::optional<uint32_t> partCount;
  /// The cost at which the merging of regions stops is divided by this number. A larger number gives more parts. Range:
  /// kMinDetail to kMaxDetail; must be 1 if partCount is set.
  double detail = 1;
};
inline constexpr uint32_t kMaxPartCount = 100;
inline constexpr double kMinDetail = 0.1, kMaxDetail = 10;

/// Quantities that are measured at each face, as a set of bits.
enum class Measure : uint8_t {
  ShapeDiameter = 1,  ///< Fields "sdf" and "seed".
  Thickness = 2,      ///< Fields "thickness" and "least_thickness" (docs/thickness.md). Traces no rays.
  Both = 3,
  Gap = 4,  ///< Fields "gap" and "least_gap": the width of the space in front of the face. Traces no rays.
  DiameterAndGap = 5,
  ThicknessAndGap = 6,
  All = 7,
};
[[nodiscard]] constexpr bool includes(Measure set, Measure measure) {
  return (static_cast<uint8_t>(set) & static_cast<uint8_t>(measure)) != 0;
}
[[nodiscard]] constexpr Measure united(Measure a, Measure b) {
  return static_cast<Measure>(static_cast<uint8_t>(a) | static_cast<uint8_t>(b));
}

enum class LengthUnit { OfMesh, Micrometre, Millimetre, Centimetre, Metre, Inch, Foot };

/// A length above 0. Units other than OfMesh require a mesh with a unit (Mesh::unit).
struct LengthLimit {
  double value = 0;
  LengthUnit unit = LengthUnit::OfMesh;

  LengthLimit(double value_, LengthUnit unit_ = LengthUnit::OfMesh)  // NOLINT: implicit by design
      : value(value_), unit(unit_) {}
  bool operator==(const LengthLimit&) const = default;
};

/// Wall thickness at a point of the surface: the diameter of the largest ball that touches the point from inside and
/// contains no point of an opposing wall (docs/thickness.md). All faces are measured; Options::seeds has no effect.
struct ThicknessOptions {
  /// Two faces are opposing walls if their normals differ by at least this angle; above 90 and at most 180.
  double wallAngleDegrees = 120;
  /// Limit of the thickness. The report lists the connected parts of the surface that are thinner than the limit.
  /// Implies Measure::Thickness.
  std::optional<LengthLimit> thinnerThan;
  /// Limit of the greatest section of each body. Implies Measure::Thickness.
  std::optional<LengthLimit> thickerThan;
  /// Limit of the gaps within a body and between bodies: as thinnerThan, with inside and outside exchanged. Implies
  /// Measure::Gap.
  std::optional<LengthLimit> closerThan;
  /// Whether details fail the checks, too (ThinKind). Requires thinnerThan or closerThan.
  bool countsDetails = false;
  /// Whether details and edges fail the checks, too. Requires thinnerThan or closerThan.
  bool countsEdges = false;
  /// Whether the next wall, or without a limit the least wall (ThicknessReport::min), is searched to the end. If not,
  /// the search ends where it would take longer than a check usually does.
  bool findsNextWall = false;
};

/// Targets that end the rounds. Each round adds seeds and keeps the traced values of earlier rounds. A target excludes
/// SeedCount::all() and requires Options::estimatesError.
struct RoundOptions {
  std::optional<double> maxError;  ///< Rounds end when the estimated average error is at most this share of the range.
  std::optional<double> maxRelativeError;  ///< Rounds end when the estimated median of error / value is at most this.

  [[nodiscard]] bool areSet() const { return maxError || maxRelativeError; }
};
/// Share of the faces that are seeds in the first round if SeedCount::isChosen is false.
inline constexpr double kFirstRoundShare = 0.02;

/// Treatment of inverted components, which are closed components with faces oriented inwards.
enum class Orientation {
  Keep,  ///< Inverted components stay unchanged; the report warns about them.
  Auto,  ///< Orients outer shells outwards, and cavities (shells inside another shell) inwards.
  Flip,  ///< Reverses every face of the mesh.
};

/// Elements of the mesh that the fields of a result describe.
enum class PerElement {
  Faces,  ///< Input faces.
  /// Input faces and vertices. Each vertex field has the name of a face field. The real value of a vertex is the
  /// area-weighted mean over the faces of the vertex.
  Vertices,
};

/// Options of one computation. A computation throws Error{OptionOutOfRange} for a member out of its range. A
/// computation throws Error{OptionConflict} if a member that differs from its default has no effect or contradicts
/// another member.
struct Options {
  ConeOptions cone;
  SeedCount seeds;
  SamplerChoice sampler = SamplerChoice::BlueNoise;
  /// Start value of all random numbers. The same value, mesh, options and device give the same bits.
  uint64_t randomSeed = 1;
  InterpolationOptions interpolation;
  SmoothingOptions smoothing;
  Postprocess postprocess = Postprocess::None;
  Segmentation segmentation = Segmentation::None;
  CgalSegmentationOptions cgalSegmentation;  ///< Requires Segmentation::Cgal.
  PartsOptions parts;                        ///< Requires Segmentation::Parts.
  Measure measure = Measure::ShapeDiameter;
  ThicknessOptions thickness;
  bool estimatesError = true;
  RoundOptions rounds;
  SolverChoice solver = SolverChoice::Automatic;
  SolverOptions solverOptions;
  Orientation orientation = Orientation::Keep;
  bool computesCentres = false;  ///< Adds the fields "centre" and "component", for skeletons.
  PerElement per = PerElement::Faces;
  /// Size of each of two random samples: one of the traced faces, one of all faces. The double-precision reference
  /// recomputes both samples.
  std::optional<uint64_t> checkCount;
  /// Keeps geometry and hierarchy in Result::scene, for a picture. The arrays of the mesh must outlive Result::scene.
  bool keepsScene = false;

  [[nodiscard]] bool postprocesses() const {
    return postprocess == Postprocess::Cgal || segmentation == Segmentation::Cgal;
  }
  [[nodiscard]] bool measuresThickness() const { return includes(measure, Measure::Thickness); }
  [[nodiscard]] bool measuresGap() const { return includes(measure, Measure::Gap); }
  /// Also true if segments, skeleton points, a check or RoundOptions need the shape diameter.
  [[nodiscard]] bool measuresDiameter() const {
    return includes(measure, Measure::ShapeDiameter) || postprocesses() || segmentation != Segmentation::None ||
           computesCentres || checkCount || rounds.areSet();
  }
};

/// Valid options together with the settings that they imply. Steps of a computation take them and check nothing again.
class ASDFVK_API CheckedOptions {
 public:
  /// Throws Error{OptionOutOfRange}, Error{UnknownName} for an enumerator without a name, and Error{OptionConflict};
  /// see Options.
  explicit CheckedOptions(const Options& options);

  [[nodiscard]] const Options& operator*() const { return options_; }
  [[nodiscard]] const Options* operator->() const { return &options_; }

 private:
  friend struct ComputationSettings;
  enum class Trust { Checked };
  CheckedOptions(const Options& options, Trust) : options_(options) {}
  Options options_;
};

/// Sets of options. The defaults of Options are the recipe Balanced.
enum class Recipe {
  Paper,     ///< The method of the ASDF paper: random seeds, weights 1 / distance, curvature guidance, fixed cones.
  Balanced,  ///< Blue noise, weights by dihedral angle, guidance by prediction. Seeds keep their traced values.
  /// Balanced with hashed cones, and with pooling of solutions and predictions. Of the recipes, this one has the least
  /// error relative to values from many rays per face.
  Quality,
};

/// Sets the options of a recipe: sampler, weights, guidance, pooling and cone rotation. Leaves other options unchanged.
ASDFVK_API void applyRecipe(Recipe recipe, Options& options);

/// Sets the definition and its numbers of rays and seeds. Paper: 30 rays, SeedCount::automatic(). Cgal: 25 rays,
/// SeedCount::all(). Leaves other options unchanged.
ASDFVK_API void applyDefinition(Definition definition, Options& options);

}  // namespace asdfvk
