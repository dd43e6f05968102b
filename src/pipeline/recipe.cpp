#include "pipeline/options.h"

namespace asdfvk {

void applyRecipe(Recipe recipe, Options& options) {
  const Options balanced;
  options.cone.rotation = balanced.cone.rotation;
  options.sampler = balanced.sampler;
  options.interpolation = balanced.interpolation;
  switch (recipe) {
    case Recipe::Paper:
      options.sampler = "random";
      options.interpolation.weights = ArcWeightKind::Distance;
      options.interpolation.guidance = Guidance::Curvature;
      break;
    case Recipe::Balanced:
      break;
    case Recipe::Quality:
      options.cone.rotation = ConeRotation::Hashed;
      options.interpolation.pooling = 0.75;
      break;
  }
}

}  // namespace asdfvk
