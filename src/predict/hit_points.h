#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/unset_vector.h"
#include "predict/prediction_kernel.h"
#include "trace/seed_hits.h"

namespace asdfvk {

/// The hit points of seeds in the layout of PredictionKernel.
class HitPoints {
 public:
  /// Scene, cone and arrays must outlive this object. Precondition: this machine has the instruction set.
  HitPoints(const TraceScene& scene, const Cone& cone, const SeedHitsView& hits,
            InstructionSet instructionSet = widestInstructionSet());

  void clear();

  /// Prefetches the hits of a seed, and the barycentre and normal of its face, for append().
  void prefetchHits(uint32_t seed) const;
  /// Prefetches the normals of the hit faces, for append(). Reads the hits.
  void prefetchNormals(uint32_t seed) const;

  /// Appends the hit points of all rays of a seed; misses and padding have NaN coordinates. Also prefetches the
  /// normals of the hit faces of `later`, the seed of a later call.
  HitRange append(uint32_t seed, uint32_t later);
  HitRange append(uint32_t seed) { return append(seed, seed); }  ///< Prefetches nothing for other seeds.

  [[nodiscard]] std::span<const PointGroup> groups() const { return groups_; }

 private:
  void prefetchNormal(const ConeHit& hit) const;
  [[nodiscard]] float fill(std::span<PointGroup> groups, uint32_t seed, uint32_t later) const;

  const TraceScene& scene_;
  const Cone& cone_;
  SeedHitsView hits_;
  InstructionSet instructionSet_;
  size_t groupCount_;                              // Number of groups per seed.
  std::array<std::vector<double>, 3> directions_;  // Rows x, y, z: the rays of the cone, padded with zeros.
  std::vector<float> solidAngles_;                 // One per ray, padded with zeros.
  UnsetVector<PointGroup> groups_;
};

}  // namespace asdfvk
