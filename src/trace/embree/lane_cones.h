#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cone/cone.h"
#include "core/simd.h"
#include "trace/embree/slot_planes.h"

namespace asdfvk {

/// What the same ray of eight cones met.
struct LaneHits {
  static constexpr size_t kWidth = 8;

  std::array<uint32_t, kWidth> slots;  ///< kNoFace for a miss.
  std::array<float, kWidth> distances;
};

/// Eight cones side by side: their frames and, of the faces that cast them, the barycentres and normals, each the x of
/// all lanes, then the y, then the z. In normalised coordinates.
struct LaneFrames {
  using Rows = std::array<std::array<double, LaneHits::kWidth>, 3>;

  Rows tangents{}, bitangents{}, axes{}, origins{}, normals{};

  void set(size_t lane, const ConeFrame& frame, const Vec3d& origin, const Vec3d& normal);
};

/// From what the rays of eight cones met to their values, in double and with the bits that isFalseHit() and coneValue()
/// give one cone. Room is kept from call to call.
class LaneCones {
 public:
  static constexpr size_t kWidth = LaneHits::kWidth;

  /// The cone and the planes must outlive it. Precondition: this machine has the instruction set.
  LaneCones(const Cone& cone, std::span<const SlotPlane> planes,
            InstructionSet instructionSet = widestInstructionSet());

  /// Computes the lengths of all rays from hits, one entry per ray of the cone. A hit whose triangle's plane is not
  /// near the distance is on a sliver, whose normal tells little: it keeps the distance.
  void measure(const LaneFrames& frames, std::span<const LaneHits> hits);
  /// Whether a ray met nothing or the side of a face from which the cone's own normal points away: on a closed surface
  /// no ray from within does.
  [[nodiscard]] bool leavesSurface(size_t lane) const { return leavesSurface_[lane] != 0; }

  /// One length per ray and lane; infinite where the ray does not count.
  [[nodiscard]] std::span<std::array<double, kWidth>> lengths() { return lengths_; }
  /// The shape diameters by lengths(), as coneValue() defines them.
  [[nodiscard]] std::array<double, kWidth> values();

 private:
  void computeLengths(const LaneFrames& frames, std::span<const LaneHits> hits);
  void computeValues(std::array<double, kWidth>& values);
  void sort();

  const Cone& cone_;
  std::span<const SlotPlane> planes_;
  InstructionSet instructionSet_;
  std::vector<std::array<double, kWidth>> lengths_, sorted_;  // Per ray.
  std::vector<std::pair<uint16_t, uint16_t>> exchanges_;      // Of the sorting network.
  std::array<int64_t, kWidth> leavesSurface_{};
};

}  // namespace asdfvk
