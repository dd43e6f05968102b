#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "asdf_vk/error.h"
#include "pipeline/computation.h"
#include "predict/prediction.h"

namespace asdfvk {

/// Predictions of one computation, from the hits of any of its seeds. The device predicts if the solver runs on the
/// device. With SolverChoice::Automatic, the CPU predicts if the device fails or is too small. A warning has the
/// reason.
class SeedPrediction {
 public:
  /// The computation must outlive this object.
  explicit SeedPrediction(const Computation& computation) : computation_(computation) {}

  /// Predicts all nodes from the hits of these seeds. Does nothing if Computation::keepsHits() is false. A seed that
  /// was in `hits` of an earlier call, and is in `hits` again, must have the same index. A new seed must have an index
  /// that no other seed had. An entry kNoFace leaves a seed out. Throws Error{Cancelled}.
  void predict(const SeedHitsView& hits, const RunControl& control);
  /// The last prediction with the seeds that have no cell yet, see asdfvk::withFurtherSeeds(); empty if
  /// Computation::keepsHits() is false. Throws the errors of predict().
  [[nodiscard]] Prediction withFurtherSeeds(const SeedHitsView& hits, const RunControl& control);
  /// The last prediction; empty without Guidance::Prediction.
  [[nodiscard]] const Prediction& last() const { return last_; }

 private:
  DevicePredictor* devicePredictor();
  void continueOnCpu(const Error& failure);
  /// Calls run(device). device: null if the CPU predicts; after a failure of the device, run(null) is called.
  template <typename Run>
  void runWithDevice(const Run& run);

  const Computation& computation_;
  Prediction last_;
  std::unique_ptr<DevicePredictor> predictor_;  ///< Created at first use.
  bool hasFailed_ = false;
};

}  // namespace asdfvk
