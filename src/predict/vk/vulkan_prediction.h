#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "cone/cone.h"
#include "predict/prediction.h"
#include "predict/vk/prediction_batches.h"
#include "vk/compute_pipeline.h"
#include "vk/device.h"

namespace asdfvk {

/// The compiled shaders/predict/*.comp for one device and one kind of cone, for any number of meshes.
class VulkanPredictionKernels {
 public:
  /// Throws Error of kind Device.
  VulkanPredictionKernels(const Device& device, Definition definition, uint32_t rayCount);

  [[nodiscard]] const Device& device() const { return device_; }
  [[nodiscard]] Definition definition() const { return definition_; }
  [[nodiscard]] uint32_t rayCount() const { return rayCount_; }
  /// Computes hit points. Bindings: faces, table, hits, points. Each workgroup handles one seed.
  [[nodiscard]] const ComputePipeline& points() const { return points_; }
  /// Predicts values. Bindings: faces, points, work, values. Each workgroup handles kFaceLaneCount items.
  [[nodiscard]] const ComputePipeline& faces() const { return faces_; }
  static constexpr uint32_t kFaceLaneCount = 64;

 private:
  const Device& device_;
  Definition definition_;
  uint32_t rayCount_;
  ComputePipeline points_, faces_;
};

/// The largest batch under three conditions: it has at most 32 MiB of hit points; it is within the limits of the
/// device; its number of rays is small enough for a short submission.
[[nodiscard]] PredictionBatchSize predictionBatchSize(const VulkanPredictionKernels& kernels);

/// Uploads the faces of the scene. Scene, cone and kernels must outlive the result. Values differ from the values of
/// the CPU by rounding, which moves a few points across the rim of a cone or the bound of the outlier rule. batchSize:
/// default predictionBatchSize(). Throws Error of kind Device, also where the mesh exceeds a limit of the device.
[[nodiscard]] std::unique_ptr<DevicePredictor> makeVulkanPredictor(
    const VulkanPredictionKernels& kernels, const TraceScene& scene, const Cone& cone,
    const std::optional<PredictionBatchSize>& batchSize = {});

}  // namespace asdfvk
