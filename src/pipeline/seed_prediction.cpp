#include "pipeline/seed_prediction.h"

#include <utility>

#include "describe/warnings.h"
#include "pipeline/kept_tracers.h"
#include "pipeline/seed_tracing.h"

namespace asdfvk {

/// Returns null if the CPU predicts.
DevicePredictor* SeedPrediction::devicePredictor() {
  Backend& backend = *computation_.backend;
  if (!computation_.keepsHits() || hasFailed_ || !backend.predictsOnDevice(computation_.options.solver)) return nullptr;
  try {
    if (!predictor_) {
      const auto scope = computation_.clock.time(setUpStage(backend));
      predictor_ = backend.makePredictor(computation_.scene, computation_.cone);
    }
    return predictor_.get();
  } catch (const Error& error) {
    continueOnCpu(error);
    return nullptr;
  }
}

/// Called in the handler of the failure.
void SeedPrediction::continueOnCpu(const Error& failure) {
  // With a named solver a failure of the device is an error. A limit is not a failure: naming a solver does not request
  // that the device predicts.
  if (failure.kind() != ErrorKind::Device ||
      (computation_.options.solver != SolverChoice::Automatic && failure.code() != ErrorCode::DeviceLimit))
    throw;
  hasFailed_ = true;
  computation_.warnings.push_back(predictedOnCpu(failure));
}

template <typename Run>
void SeedPrediction::runWithDevice(Seeds& seeds, const RunControl& control, const Run& run) {
  if (DevicePredictor* const device = devicePredictor()) {
    try {
      return run(device);
    } catch (const Error& error) {
      continueOnCpu(error);
    }
    predictor_.reset();
  }
  if (seeds.hitsOnDevice) moveHitsToHost(computation_, scene_, seeds, control);
  run(nullptr);
}

void SeedPrediction::predict(std::span<const uint32_t> used, Seeds& seeds, const RunControl& control) {
  if (seeds.hitsOf(used).isEmpty()) return;
  runWithDevice(seeds, control, [&](DevicePredictor* device) {
    last_ = predictValues(computation_.scene, computation_.domain, computation_.cone, seeds.hitsOf(used), {},
                          std::exchange(last_, {}), device, control);
  });
}

Prediction SeedPrediction::withFurtherSeeds(Seeds& seeds, const RunControl& control) {
  Prediction result;
  if (seeds.hitsOf(seeds.nodes).isEmpty()) return result;
  runWithDevice(seeds, control, [&](DevicePredictor* device) {
    result = asdfvk::withFurtherSeeds(last_, computation_.scene, computation_.domain, computation_.cone,
                                      seeds.hitsOf(seeds.nodes), {}, device, control);
  });
  return result;
}

}  // namespace asdfvk
