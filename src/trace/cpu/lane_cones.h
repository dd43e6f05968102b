#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cone/cone.h"
#include "core/simd.h"
#include "trace/cone_tracer.h"
#include "trace/cpu/ray_walk.h"
#include "trace/trace_scene.h"

// Computes the values of a group of cones from the hits of their rays, in double. Each lane has one cone. Coordinates
// are normalised.
namespace asdfvk {

struct LaneHits {
  static constexpr size_t kWidth = RayGroup::kWidth;

  std::array<uint32_t, kWidth> faces;  ///< kNoFace: the ray hits nothing.
  std::array<float, kWidth> distances;
};

/// Frames of the cones of a group, and barycentres and normals of their seed faces. Rows: x, y and z of all lanes.
struct LaneFrames {
  using Rows = std::array<std::array<double, LaneHits::kWidth>, 3>;

  Rows tangents{}, bitangents{}, axes{}, origins{}, normals{};

  void set(size_t lane, const ConeFrame& frame, const Vec3d& origin, const Vec3d& normal);
};

/// Computes values from hits, with the same bits as isFalseHit() and coneValue(). An object reuses its memory.
class LaneCones {
 public:
  static constexpr size_t kWidth = LaneHits::kWidth;

  /// The cone and the viewed data of the scene must outlive this object. Precondition: this machine has the instruction
  /// set.
  LaneCones(const Cone& cone, const TraceScene& scene, InstructionSet instructionSet = widestInstructionSet());

  /// Computes the lengths of all rays. hits: one entry per ray of the cone. A length is the distance to the plane of
  /// the triangle. On slivers, whose planes are not near the hits, the distance of the hit is used.
  void measure(const LaneFrames& frames, std::span<const LaneHits> hits);

  /// One length per ray and lane; infinite for invalid rays.
  [[nodiscard]] std::span<std::array<double, kWidth>> lengths() { return lengths_; }
  [[nodiscard]] std::array<double, kWidth> values();

 private:
  void computeLengths(const LaneFrames& frames, std::span<const LaneHits> hits);
  void computeValues(std::array<double, kWidth>& values);
  void sort();
  void sortDeviations(std::span<const double> medians);

  const Cone& cone_;
  TraceScene scene_;
  InstructionSet instructionSet_;
  std::vector<std::array<double, kWidth>> lengths_, sorted_;  // One entry per ray.
  std::vector<std::pair<uint16_t, uint16_t>> exchanges_;      // The sorting network.
};

}  // namespace asdfvk
