#pragma once

#include <functional>
#include <vector>

#include "asdf_vk/run_control.h"
#include "cone/cone.h"
#include "mesh/mesh.h"
#include "pipeline/compute_backend.h"

namespace asdfvk::bench {

/// A traced face: where its cone starts, its normal, and its value in the mesh's unit (NaN for none).
struct TracedFace {
  Vec3d barycentre, normal;
  double value = kNoValue;
};

/// Traces at most `count` random faces of those whose barycentre is `wanted`; nothing is interpolated.
[[nodiscard]] std::vector<TracedFace> traceSample(ComputeBackend& backend, Mesh& mesh, const ConeOptions& cone,
                                                  const std::function<bool(const Vec3d&)>& wanted, uint64_t count,
                                                  uint64_t randomSeed, const RunControl& control);

}  // namespace asdfvk::bench
