#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/api.h"

namespace asdfvk {

/// How the rays of a face lie about its axis.
enum class ConeRotation {
  Fixed,   ///< A function of the axis, so that neighbouring faces cast nearly parallel rays.
  Hashed,  ///< Turned by a hash of the face index: errors of neighbouring faces are independent.
};

/// The cone of rays of a face: Shapira, Shamir and Cohen-Or 2008, section 3; ASDF paper, section 3.
struct ConeOptions {
  uint32_t rayCount = 30;            ///< 1 to kMaxRayCount.
  double openingAngleDegrees = 120;  ///< Full angle, above 0 and below 180.
  /// A hit on a face whose normal is within this angle of the normal of the ray's face is false and dropped; 0 to 180.
  double falseHitAngleDegrees = 90;
  double outlierDeviations = 1;  ///< Lengths farther from the median than so many standard deviations are dropped; > 0.
  ConeRotation rotation = ConeRotation::Fixed;
};
inline constexpr uint32_t kMaxRayCount = 1024;

/// Number of seed faces, the faces that cast rays.
struct SeedCount {
  enum class Kind { All, Share, Count } kind = Kind::Share;
  double share = 0.1;  ///< Of the faces that can cast rays, above 0 and at most 1.
  uint64_t count = 0;  ///< At least 1.

  [[nodiscard]] static SeedCount all() { return {Kind::All, 1, 0}; }
  [[nodiscard]] static SeedCount ofShare(double share) { return {Kind::Share, share, 0}; }
  [[nodiscard]] static SeedCount ofCount(uint64_t count) { return {Kind::Count, 0, count}; }
};

/// Weights of the edges of the dual graph in the Poisson equation.
enum class ArcWeights {
  Distance,  ///< 1 / distance of the barycentres: ASDF paper, section 4.1.
  Feature,   ///< Falls with the dihedral angle, faster on concave edges (src/poisson).
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
  /// 0 to 1, with Guidance::Prediction: fraction by which each value, traced ones included, is moved from the
  /// interpolated value to the predicted one. 0 keeps the traced values.
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
    uint32_t rings = 2;   ///< Of the dual graph, 1 to 4.
    uint32_t passes = 1;  ///< 0 changes nothing.
    bool operator==(const Window&) const = default;
  };
  std::optional<Window> window;  ///< Unset: chosen by the number of faces.
};

/// Conditions under which further rounds of seeds are added. A round keeps all that earlier rounds traced.
struct RoundOptions {
  std::optional<double> maxError;           ///< Until the estimated average error is at most this share of the range.
  std::optional<double> timeBudgetSeconds;  ///< While time is left, counted from the start of compute().

  [[nodiscard]] bool areSet() const { return maxError || timeBudgetSeconds; }
};

/// Treatment of closed components whose faces look inwards.
enum class Orientation {
  Keep,  ///< Unchanged; the report names them.
  Auto,  ///< Outer shells look outwards, shells inside another one (cavities) inwards.
  Flip,  ///< Every face is reversed.
};

/// Options of one computation. Sampler and solver are names, listed by samplerNames() and solverNames().
struct Options {
  ConeOptions cone;
  SeedCount seeds;
  std::string sampler = "blue-noise";
  uint64_t randomSeed = 1;  ///< The same seed, mesh, options and device give the same bits.
  InterpolationOptions interpolation;
  SmoothingOptions smoothing;
  bool estimatesError = true;
  RoundOptions rounds;
  std::string solver = "auto";
  SolverOptions solverOptions;
  Orientation orientation = Orientation::Keep;
  /// Recompute so many random traced faces, and so many random faces of all, with the double-precision reference.
  std::optional<uint64_t> checkCount;
  bool keepsScene = false;  ///< Keep geometry and hierarchy in Result::scene, for a picture.
};

/// Sets of options; the defaults of Options are the balanced one.
enum class Recipe {
  Paper,     ///< ASDF paper: random seeds, weights 1 / distance, curvature guidance, fixed cones.
  Balanced,  ///< Blue noise, weights by dihedral angle, guidance by prediction; traced values are kept.
  Quality,   ///< Balanced with hashed cones and values pooled with the prediction: least error against many rays.
};

/// Sets the options that a recipe decides (sampler, weights, guidance, pooling, cone rotation) and no other.
ASDFVK_API void applyRecipe(Recipe recipe, Options& options);

[[nodiscard]] ASDFVK_API std::vector<std::string> samplerNames();
[[nodiscard]] ASDFVK_API std::vector<std::string> solverNames();

}  // namespace asdfvk
