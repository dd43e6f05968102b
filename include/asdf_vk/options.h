#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/api.h"

namespace asdfvk {

/// Rotation of the rays of a cone about its axis.
enum class ConeRotation {
  Fixed,   ///< Determined by the axis: neighbouring faces cast nearly parallel rays.
  Hashed,  ///< Determined by a hash of the face index: errors of neighbouring faces are independent.
};

/// Definition of the shape diameter of a face (docs/method.md).
enum class Definition {
  Paper,  ///< Shapira, Shamir and Cohen-Or 2008, section 3; ASDF paper, section 3.
  Cgal,   ///< sdf_values() of CGAL 5.5 without its post-processing; see applyDefinition().
};

/// The cone of rays of a face.
struct ConeOptions {
  uint32_t rayCount = 30;            ///< 1 to kMaxRayCount.
  double openingAngleDegrees = 120;  ///< Full angle, above 0 and below 180.
  // The next three belong to Definition::Paper and must have their defaults with another definition.
  /// A hit is false, and dropped, if the angle between the normals of hit face and seed face is below this; 0 to 180.
  double falseHitAngleDegrees = 90;
  double outlierDeviations = 1;  ///< Lengths farther than this from the median are dropped; standard deviations, > 0.
  ConeRotation rotation = ConeRotation::Fixed;
  Definition definition = Definition::Paper;

  bool operator==(const ConeOptions&) const = default;
};
inline constexpr uint32_t kMaxRayCount = 1024;

/// Number of seed faces, the faces that cast rays.
struct SeedCount {
  /// Automatic: kAutomaticSeedShare of the faces. With Guidance::Prediction at least kMinAutomaticSeedCount, all faces
  /// of a smaller mesh: fewer rays save little time there and cost accuracy.
  enum class Kind { Automatic, All, Share, Count } kind = Kind::Automatic;
  double share = 0;    ///< Share of the faces that can cast rays, above 0 and at most 1.
  uint64_t count = 0;  ///< At least 1.
  /// False: the default, which rounds replace by kFirstRoundShare; Automatic is not chosen.
  bool isChosen = false;

  [[nodiscard]] static SeedCount automatic() { return {}; }
  [[nodiscard]] static SeedCount all() { return {Kind::All, 1, 0, true}; }
  [[nodiscard]] static SeedCount ofShare(double share) { return {Kind::Share, share, 0, true}; }
  [[nodiscard]] static SeedCount ofCount(uint64_t count) { return {Kind::Count, 0, count, true}; }
};
inline constexpr double kAutomaticSeedShare = 0.1;
inline constexpr uint64_t kMinAutomaticSeedCount = 3000;

/// Weights of the edges of the dual graph in the Poisson equation.
enum class ArcWeights {
  Distance,  ///< 1 / distance of the barycentres: ASDF paper, section 4.1.
  Feature,   ///< Decreases with the dihedral angle, faster on concave edges (src/poisson).
};

/// Guidance field of the Poisson equation (ASDF paper, section 4.1).
enum class Guidance {
  None,        ///< No field: harmonic interpolation.
  Curvature,   ///< The divergence is minus the curvature: the paper's choice.
  Prediction,  ///< The gradient of values predicted from the hits of neighbouring seeds (src/predict).
};

struct InterpolationOptions {
  ArcWeights weights = ArcWeights::Feature;
  Guidance guidance = Guidance::Prediction;
  /// Weight of the prediction in the result, 0 to 1: value = (1 - pooling) interpolated + pooling predicted, at seeds
  /// too. 0 keeps the traced values. Above 0 requires Guidance::Prediction.
  double pooling = 0;
};

struct SolverOptions {
  double tolerance = 1e-4;  ///< Relative residual at which a solver stops.
  uint32_t maxIterations = 20000;
};

/// Bilateral filter of the result (Tomasi and Manduchi 1998), for values traced at all faces.
struct SmoothingOptions {
  bool isOn = false;
  struct Window {
    uint32_t rings = 2;   ///< Rings of the dual graph, 1 to 4.
    uint32_t passes = 1;  ///< 0 changes nothing.
    bool operator==(const Window&) const = default;
  };
  std::optional<Window> window;  ///< Unset: chosen by the number of faces.
};

/// Treatment of the finished values, for the field "normalized".
enum class Postprocess {
  None,
  Cgal,  ///< As CGAL's sdf_values_postprocessing(): fills missing values, filters bilaterally, maps to [0, 1].
};

/// Division of the mesh by its values, for the field "segment".
enum class Segmentation {
  None,
  Cgal,   ///< As CGAL's segmentation_from_sdf_values(); implies Postprocess::Cgal.
  Parts,  ///< The parts that people see: from values, creases and lines of sight, without a number of parts.
};

enum class CgalExpansion {
  All,    ///< Every cluster is expanded: the method of Shapira et al. 2008, and that of other versions of CGAL.
  First,  ///< Only the cluster of the least values is expanded, as CGAL 5.5.1 does.
};

struct CgalSegmentationOptions {
  uint32_t clusterCount = 5;  ///< 2 to kMaxClusterCount. A cluster of values may have several segments, or none.
  double smoothness = 0.26;   ///< Weight of the edge costs, 0 to kMaxSmoothness. CGAL's manual has 0 to 1.
  CgalExpansion expansion = CgalExpansion::All;
};
inline constexpr uint32_t kMaxClusterCount = 100;
inline constexpr double kMaxSmoothness = 1000;

struct PartsOptions {
  /// 1 to kMaxPartCount: that many parts, if components and faces allow. Unset: the number is found.
  std::optional<uint32_t> partCount;
  /// The cost at which the merging of regions stops is divided by this, so that more detail means more parts.
  /// kMinDetail to kMaxDetail; must be 1 with partCount.
  double detail = 1;
};
inline constexpr uint32_t kMaxPartCount = 100;
inline constexpr double kMinDetail = 0.1, kMaxDetail = 10;

/// Quantity that is measured at each face.
enum class Measure {
  ShapeDiameter,  ///< Fields "sdf" and "seed".
  Thickness,      ///< Fields "thickness" and "least_thickness" (docs/thickness.md); no rays are traced.
  Both,
};

enum class LengthUnit { OfMesh, Micrometre, Millimetre, Centimetre, Metre, Inch, Foot };

/// Wall thickness: the diameter of the largest ball that touches the surface at a point from inside and contains no
/// point of an opposing wall (docs/thickness.md). Measured at all faces, whatever `seeds` is.
struct ThicknessOptions {
  /// Faces whose normals differ by at least this angle are opposing walls; above 90 and at most 180.
  double wallAngleDegrees = 120;
  /// Report the connected parts of the surface below this thickness, in the unit of the mesh; above 0. Implies
  /// Measure::Thickness.
  std::optional<double> thinnerThan;
  /// Unit of thinnerThan. Others than OfMesh need a mesh that states its own (Mesh::unit).
  LengthUnit limitUnit = LengthUnit::OfMesh;
  /// Leave thin regions that contain a sharp edge or tip out of the verdict and of the minimum. Requires thinnerThan.
  bool allowsSharpEdges = false;
};

/// Conditions under which further rounds of seeds are added. A round keeps the traced values of all earlier rounds.
/// Without a choice of seeds the first round has kFirstRoundShare. Any of them excludes SeedCount::all(); a maximum
/// error requires Options::estimatesError.
struct RoundOptions {
  std::optional<double> maxError;  ///< Last round: the estimated average error is at most this share of the range.
  std::optional<double> maxRelativeError;   ///< Last round: the estimated median of error / value is at most this.
  std::optional<double> timeBudgetSeconds;  ///< Last round: this time since the start of compute() is over.

  [[nodiscard]] bool limitError() const { return maxError || maxRelativeError; }
  [[nodiscard]] bool areSet() const { return limitError() || timeBudgetSeconds; }
};
/// Share of seeds of the first round where no seeds are chosen.
inline constexpr double kFirstRoundShare = 0.02;

/// Treatment of inverted components: closed components whose faces are oriented inwards.
enum class Orientation {
  Keep,  ///< Unchanged; the report lists them.
  Auto,  ///< Outer shells are oriented outwards, cavities (shells inside another shell) inwards.
  Flip,  ///< Every face is reversed.
};

/// Elements of the mesh that the fields of a result describe.
enum class PerElement {
  Faces,     ///< Input faces.
  Vertices,  ///< Input faces; and vertices, in fields with the same names: means over the faces of a vertex by area.
};

/// Options of one computation. A member out of its range, and one without effect or against another that differs from
/// its default, is Error{OptionOutOfRange} or Error{OptionConflict}, as on the command line. Sampler and solver are
/// names, listed by samplerNames() and solverNames().
struct Options {
  ConeOptions cone;
  SeedCount seeds;
  std::string sampler = "blue-noise";
  uint64_t randomSeed = 1;  ///< The same seed, mesh, options and device give the same bits.
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
  std::string solver = "auto";
  SolverOptions solverOptions;
  Orientation orientation = Orientation::Keep;
  bool computesCentres = false;  ///< Adds the fields "centre" and "component", for skeletons.
  PerElement per = PerElement::Faces;
  /// Number of random traced faces, and of random faces of the whole mesh, that the double-precision reference
  /// recomputes.
  std::optional<uint64_t> checkCount;
  /// Keep geometry and hierarchy in Result::scene, for a picture. The scene views the arrays of the mesh, which must
  /// outlive it.
  bool keepsScene = false;

  [[nodiscard]] bool postprocesses() const {
    return postprocess == Postprocess::Cgal || segmentation == Segmentation::Cgal;
  }
  [[nodiscard]] bool measuresThickness() const { return measure != Measure::ShapeDiameter; }
  /// True also where segments, skeleton points, a check or a maximum error need the shape diameter.
  [[nodiscard]] bool measuresDiameter() const {
    return measure != Measure::Thickness || postprocesses() || segmentation != Segmentation::None || computesCentres ||
           checkCount || rounds.areSet();
  }
};

/// Sets of options. The defaults of Options are those of Balanced.
enum class Recipe {
  Paper,     ///< ASDF paper: random seeds, weights 1 / distance, curvature guidance, fixed cones.
  Balanced,  ///< Blue noise, weights by dihedral angle, guidance by prediction; traced values are kept.
  Quality,   ///< Balanced with hashed cones and values pooled with the prediction: least error against many rays.
};

/// Sets the options of a recipe: sampler, weights, guidance, pooling, cone rotation. The others are unchanged.
ASDFVK_API void applyRecipe(Recipe recipe, Options& options);

/// Sets the definition with its number of rays and of seeds. Paper: 30 rays, SeedCount::automatic(). Cgal: 25 rays, all
/// faces. The others are unchanged.
ASDFVK_API void applyDefinition(Definition definition, Options& options);

[[nodiscard]] ASDFVK_API std::vector<std::string> samplerNames();
[[nodiscard]] ASDFVK_API std::vector<std::string> solverNames();

}  // namespace asdfvk
