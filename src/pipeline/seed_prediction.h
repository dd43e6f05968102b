#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "asdf_vk/error.h"
#include "pipeline/computation.h"
#include "pipeline/prepared_scene.h"
#include "predict/prediction.h"
#include "trace/seeds.h"

namespace asdfvk {

/// Predictions of one computation, from the hits of any of its seeds. The device predicts if the solver runs on the
/// device. With SolverChoice::Automatic, the CPU predicts if the device fails or is too small. A warning has the
/// reason.
class SeedPrediction {
 public:
  /// The computation and the scene must outlive this object.
  SeedPrediction(const Computation& computation, PreparedScene& scene) : computation_(computation), scene_(scene) {}

  /// Predicts all nodes from the hits of seeds. used: #S, the nodes of the seeds; kNoFace leaves a seed out. Does
  /// nothing if Computation::keepsHits() is false. If the CPU predicts, the hits move to the host. Throws
  /// Error{Cancelled}.
  void predict(std::span<const uint32_t> used, Seeds& seeds, const RunControl& control);
  /// The last prediction with the seeds that have no cell yet, see asdfvk::withFurtherSeeds(); empty if
  /// Computation::keepsHits() is false. Throws the errors of predict().
  [[nodiscard]] Prediction withFurtherSeeds(Seeds& seeds, const RunControl& control);
  /// The last prediction; empty without Guidance::Prediction.
  [[nodiscard]] const Prediction& last() const { return last_; }

 private:
  DevicePredictor* devicePredictor();
  void continueOnCpu(const Error& failure);
  /// Calls run(device). device: null if the CPU predicts; after a failure of the device, run(null) is called.
  template <typename Run>
  void runWithDevice(Seeds& seeds, const RunControl& control, const Run& run);

  const Computation& computation_;
  PreparedScene& scene_;
  Prediction last_;
  std::unique_ptr<DevicePredictor> predictor_;  ///< Created at first use.
  bool hasFailed_ = false;
};

}  // namespace asdfvk
