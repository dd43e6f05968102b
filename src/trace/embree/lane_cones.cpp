#include "trace/embree/lane_cones.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "core/check.h"
#include "mesh/mesh.h"
#include "shared/cone_rules.h"

namespace asdfvk {
namespace {

// Four doubles side by side, rounded as doubles are, whatever the machine's width; two of these are the eight lanes.
using Doubles = double __attribute__((vector_size(32)));
using DoublesMask = int64_t __attribute__((vector_size(32)));
constexpr size_t kDoubleCount = 4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[gnu::always_inline]] inline void load(Doubles& doubles, const double* numbers) {
  std::memcpy(&doubles, numbers, sizeof doubles);
}

[[gnu::always_inline]] inline void store(double* numbers, const Doubles& doubles) {
  std::memcpy(numbers, &doubles, sizeof doubles);
}

/// Of rows into columns.
[[gnu::always_inline]] inline void transpose(Doubles (&rows)[kDoubleCount]) {
  const Doubles even01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6);
  const Doubles odd01 = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
  const Doubles even23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6);
  const Doubles odd23 = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  rows[0] = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
  rows[2] = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
  rows[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
}

struct Quad3 {
  Doubles x, y, z;
};

[[gnu::always_inline]] inline void load(Quad3& quads, const LaneFrames::Rows& rows, size_t first) {
  load(quads.x, &rows[0][first]);
  load(quads.y, &rows[1][first]);
  load(quads.z, &rows[2][first]);
}

/// Batcher's odd-even merge sort (1968) of so many numbers: exchanges with numbers beyond the last are left out, as if
/// those were infinite.
std::vector<std::pair<uint16_t, uint16_t>> sortingNetwork(size_t count) {
  std::vector<std::pair<uint16_t, uint16_t>> exchanges;
  for (size_t sorted = 1; sorted < count; sorted *= 2)
    for (size_t step = sorted; step > 0; step /= 2)
      for (size_t begin = step % sorted; begin + step < count; begin += 2 * step)
        for (size_t i = begin; i < begin + step && i + step < count; ++i)
          if (i / (2 * sorted) == (i + step) / (2 * sorted))
            exchanges.emplace_back(static_cast<uint16_t>(i), static_cast<uint16_t>(i + step));
  return exchanges;
}

}  // namespace

void LaneFrames::set(size_t lane, const ConeFrame& frame, const Vec3d& origin, const Vec3d& normal) {
  for (size_t axis = 0; axis < 3; ++axis) {
    tangents[axis][lane] = frame.tangent[axis];
    bitangents[axis][lane] = frame.bitangent[axis];
    axes[axis][lane] = frame.axis[axis];
    origins[axis][lane] = origin[axis];
    normals[axis][lane] = normal[axis];
  }
}

LaneCones::LaneCones(const Cone& cone, std::span<const SlotPlane> planes, InstructionSet instructionSet)
    : cone_(cone),
      planes_(planes),
      instructionSet_(instructionSet),
      lengths_(cone.directions.size()),
      sorted_(cone.directions.size()),
      exchanges_(sortingNetwork(cone.directions.size())) {}

[[gnu::always_inline]] inline void LaneCones::measureInLanes(const LaneFrames& frames, std::span<const LaneHits> hits) {
  constexpr double kPlaneTolerance = 0x1p-14;
  // Not through this: the compiler would read them anew after every length that is stored.
  const Vec3d* const directions = cone_.directions.data();
  const SlotPlane* const slotPlanes = planes_.data();
  std::array<double, kWidth>* const lengths = lengths_.data();
  const double falseHitCosine = cone_.falseHitCosine;
  for (size_t first = 0; first < kWidth; first += kDoubleCount) {
    Quad3 tangent, bitangent, axis, origin, seedNormal;
    load(tangent, frames.tangents, first);
    load(bitangent, frames.bitangents, first);
    load(axis, frames.axes, first);
    load(origin, frames.origins, first);
    load(seedNormal, frames.normals, first);
    DoublesMask leaves{};
    for (size_t ray = 0; ray < hits.size(); ++ray) {
      const LaneHits& hit = hits[ray];
      Doubles planes[kDoubleCount], distance{};
      DoublesMask isHit{};
      for (size_t k = 0; k < kDoubleCount; ++k) {
        const uint32_t slot = hit.slots[first + k];
        isHit[k] = slot == kNoFace ? 0 : -1;
        distance[k] = hit.distances[first + k];
        load(planes[k], &slotPlanes[slot == kNoFace ? 0 : slot].normal.x);
      }
      transpose(planes);
      const Quad3 normal{planes[0], planes[1], planes[2]};
      const Doubles offset = planes[3];
      const Vec3d& d = directions[ray];
      const Quad3 direction{d.x * tangent.x + d.y * bitangent.x + d.z * axis.x,
                            d.x * tangent.y + d.y * bitangent.y + d.z * axis.y,
                            d.x * tangent.z + d.y * bitangent.z + d.z * axis.z};
      const Doubles cosine = normal.x * direction.x + normal.y * direction.y + normal.z * direction.z;
      const Doubles facing = seedNormal.x * normal.x + seedNormal.y * normal.y + seedNormal.z * normal.z;
      const Doubles onPlane = (offset - (normal.x * origin.x + normal.y * origin.y + normal.z * origin.z)) / cosine;
      const Doubles difference = onPlane - distance;
      const DoublesMask isNear = (difference <= kPlaneTolerance) & (difference >= -kPlaneTolerance);
      const Doubles length = isNear ? onPlane : distance;
      const DoublesMask counts = isHit & (facing <= falseHitCosine);
      store(&lengths[ray][first], counts ? length : Doubles{} + kInfinity);
      leaves |= ~(isHit & (cosine > 0));
    }
    std::memcpy(&leavesSurface_[first], &leaves, sizeof leaves);
  }
}

[[gnu::always_inline]] inline void LaneCones::sort() {
  sorted_ = lengths_;
  for (const auto& [low, high] : exchanges_)
    for (size_t first = 0; first < kWidth; first += kDoubleCount) {
      Doubles a, b;
      load(a, &sorted_[low][first]);
      load(b, &sorted_[high][first]);
      store(&sorted_[low][first], b < a ? b : a);
      store(&sorted_[high][first], b < a ? a : b);
    }
}

[[gnu::always_inline]] inline void LaneCones::evaluateInLanes(std::array<double, kWidth>& values) {
  sort();
  for (size_t first = 0; first < kWidth; first += kDoubleCount) {
    // Sums run over the rays in order, and adding a zero changes no bit.
    Doubles count{}, sum{}, squares{}, median, deviation, weightedSum{}, weightSum{}, length;
    for (const auto& lengths : lengths_) {
      load(length, &lengths[first]);
      count += length < kInfinity ? Doubles{} + 1 : Doubles{};
      sum += length < kInfinity ? length : Doubles{};
    }
    const Doubles mean = sum / count;
    for (const auto& lengths : lengths_) {
      load(length, &lengths[first]);
      const Doubles difference = length - mean;
      squares += length < kInfinity ? difference * difference : Doubles{};
    }
    const Doubles variance = squares / count;
    for (size_t k = 0; k < kDoubleCount; ++k) {
      const auto rays = static_cast<size_t>(count[k]);
      const double upper = rays == 0 ? 0 : sorted_[rays / 2][first + k];
      median[k] = rays == 0 || rays % 2 == 1 ? upper : 0.5 * (upper + sorted_[rays / 2 - 1][first + k]);
      deviation[k] = std::sqrt(variance[k]);
    }
    const Doubles bound = cone_.outlierDeviations * deviation + static_cast<double>(kOutlierSlack) * median;
    for (size_t ray = 0; ray < lengths_.size(); ++ray) {
      load(length, &lengths_[ray][first]);
      const Doubles difference = length - median;
      const DoublesMask isKept = (difference <= bound) & (difference >= -bound) & (length < kInfinity);
      weightedSum += isKept ? cone_.weights[ray] * length : Doubles{};
      weightSum += isKept ? Doubles{} + cone_.weights[ray] : Doubles{};
    }
    store(&values[first], weightSum > 0 ? weightedSum / weightSum : Doubles{} + kNoValue);
  }
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void LaneCones::measureWithAvx2(const LaneFrames& frames, std::span<const LaneHits> hits) {
  measureInLanes(frames, hits);
}
[[gnu::target("avx2")]] void LaneCones::evaluateWithAvx2(std::array<double, kWidth>& values) {
  evaluateInLanes(values);
}
#else
void LaneCones::measureWithAvx2(const LaneFrames&, std::span<const LaneHits>) { ASDFVK_CHECK(false); }
void LaneCones::evaluateWithAvx2(std::array<double, kWidth>&) { ASDFVK_CHECK(false); }
#endif

void LaneCones::measure(const LaneFrames& frames, std::span<const LaneHits> hits) {
  ASDFVK_CHECK_OP(hits.size(), ==, lengths_.size());
  if (instructionSet_ >= InstructionSet::Avx2)
    measureWithAvx2(frames, hits);
  else
    measureInLanes(frames, hits);
}

std::array<double, LaneCones::kWidth> LaneCones::values() {
  std::array<double, kWidth> values;
  if (instructionSet_ >= InstructionSet::Avx2)
    evaluateWithAvx2(values);
  else
    evaluateInLanes(values);
  return values;
}

}  // namespace asdfvk
