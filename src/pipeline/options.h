#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cone/cone.h"
#include "poisson/arc_weights.h"
#include "poisson/poisson_solver.h"
#include "predict/reprojection.h"
#include "smooth/bilateral.h"

/// What can be asked of a computation.
namespace asdfvk {

enum class SolverChoice { Auto, Cg, Jacobi, Cpu, Eigen };

/// What is done about closed components whose faces look the wrong way.
enum class Orientation {
  Keep,  ///< Nothing; the report names them.
  Auto,  ///< Outer shells are made to look outwards, shells inside another one inwards (cavities).
  Flip,  ///< Every face is flipped.
};

/// How many faces cast rays.
struct SeedCount {
  enum class Kind { All, Share, Count } kind = Kind::Share;
  double share = 0.1;  ///< Of the faces that can cast rays, above 0 and at most 1.
  uint64_t count = 0;
};

/// Where the guidance field of the interpolation comes from (the ASDF paper, section 4.1).
enum class Guidance {
  None,       ///< No field: harmonic interpolation.
  Curvature,  ///< The divergence is minus the curvature, the paper's reading.
  Hits,       ///< The gradient of what the hits of the neighbouring seeds predict, see reprojection.h.
};

struct InterpolationOptions {
  ArcWeightKind weights = ArcWeightKind::Feature;
  Guidance guidance = Guidance::Hits;
  /// 0 to 1, with Guidance::Hits: how far each value, the traced ones too, is moved from the interpolation towards the
  /// prediction, which pools the rays of several seeds and so has less noise than one cone. 0: traced values are kept.
  double pooling = 0;
  ReprojectionOptions reprojection;
};

/// Bilateral smoothing of the result, see smooth/bilateral.h. Meant for values traced at all faces.
struct SmoothingOptions {
  bool isOn = false;
  std::optional<BilateralOptions> window;  ///< None: bilateralOptionsFor() the mesh.
};

/// When to stop adding seeds. Each round keeps all that was traced before.
struct RoundOptions {
  std::optional<double> maxError;           ///< Until the estimate is at most this share of the range.
  std::optional<double> timeBudgetSeconds;  ///< As many seeds as fit into so much time, counted from compute().

  [[nodiscard]] bool areAsked() const { return maxError || timeBudgetSeconds; }
};

struct Options {
  ConeOptions cone;
  SeedCount seeds;
  std::string sampler =
      "blue-noise";  ///< One of samplerNames(). "adaptive" needs Guidance::Hits, else is "blue-noise".
  uint64_t randomSeed = 1;
  InterpolationOptions interpolation;
  SmoothingOptions smoothing;
  bool estimatesError = true;
  RoundOptions rounds;
  SolverChoice solver = SolverChoice::Auto;
  SolverOptions solverOptions;
  Orientation orientation = Orientation::Keep;
  /// Recompute so many random traced faces, and so many random faces among all, with the reference.
  std::optional<uint64_t> checkCount;
};

/// Sets of options that go together; the defaults of Options are the balanced one.
enum class Recipe {
  Paper,     ///< The ASDF paper's: random permutation, weights 1 / distance, guidance by curvature, equal cones.
  Balanced,  ///< Blue noise, weights by dihedral angle, guidance by the seeds' hits; traced values are kept.
  Quality,   ///< The same with cones turned by a hash, and values pooled over neighbouring cones: nearest to the truth.
};

/// Sets what the recipe decides, and nothing else: number of seeds, rays, solver and so on stay as they are.
void applyRecipe(Recipe recipe, Options& options);

[[nodiscard]] std::vector<std::string> samplerNames();

}  // namespace asdfvk
