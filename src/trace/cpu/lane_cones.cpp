#include "trace/cpu/lane_cones.h"

#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/lane_vec3.h"
#include "mesh/mesh.h"

namespace asdfvk {
namespace {

using Mask = IntsOf<Double4>;
constexpr size_t kDoubleCount = kLaneCount<Double4>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

ASDFVK_ALWAYS_INLINE inline Vec3Double4 loadRows(const LaneFrames::Rows& rows, size_t first) {
  return {load<Double4>(&rows[0][first]), load<Double4>(&rows[1][first]), load<Double4>(&rows[2][first])};
}

/// Batcher's odd-even merge sort (1968) of `count` numbers, without exchanges beyond the last number.
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

LaneCones::LaneCones(const Cone& cone, const TraceScene& scene, InstructionSet instructionSet)
    : cone_(cone),
      scene_(scene),
      instructionSet_(instructionSet),
      lengths_(cone.directions.size()),
      sorted_(cone.directions.size()),
      exchanges_(sortingNetwork(cone.directions.size())) {}

ASDFVK_ALWAYS_INLINE inline void LaneCones::computeLengths(const LaneFrames& frames, std::span<const LaneHits> hits) {
  // Local copies, because the compiler would reload members after every store of a length.
  const Vec3d* const directions = cone_.directions.data();
  const Vec3d* const faceNormals = scene_.geometry.normals.data();
  const Vec3d* const barycentres = scene_.geometry.barycentres.data();
  const Normalization unit = scene_.bvh.normalization;
  std::array<double, kWidth>* const lengths = lengths_.data();
  for (size_t first = 0; first < kWidth; first += kDoubleCount) {
    const Vec3Double4 tangent = loadRows(frames.tangents, first), bitangent = loadRows(frames.bitangents, first),
                      axis = loadRows(frames.axes, first), origin = loadRows(frames.origins, first),
                      seedNormal = loadRows(frames.normals, first);
    for (size_t ray = 0; ray < hits.size(); ++ray) {
      const LaneHits& hit = hits[ray];
      Double4 distance{};
      Mask isHit{};
      LaneIndices faces;
      for (size_t k = 0; k < kDoubleCount; ++k) {
        const bool isMiss = hit.faces[first + k] == kNoFace;
        faces[k] = isMiss ? 0 : hit.faces[first + k];
        isHit[k] = isMiss ? 0 : -1;
        distance[k] = hit.distances[first + k];
      }
      const Vec3Double4 normal = gather(faceNormals, faces), point = gather(barycentres, faces);
      const Double4 offset = normal.x * ((point.x - unit.centre.x) * unit.scale) +
                             normal.y * ((point.y - unit.centre.y) * unit.scale) +
                             normal.z * ((point.z - unit.centre.z) * unit.scale);
      const Vec3d& d = directions[ray];
      const Vec3Double4 direction{d.x * tangent.x + d.y * bitangent.x + d.z * axis.x,
                                  d.x * tangent.y + d.y * bitangent.y + d.z * axis.y,
                                  d.x * tangent.z + d.y * bitangent.z + d.z * axis.z};
      const Double4 onPlane = (offset - dot(normal, origin)) / dot(normal, direction);
      const Double4 difference = onPlane - distance;
      const Mask isNear = (difference <= kPlaneTolerance) & (difference >= -kPlaneTolerance);
      const Double4 length = isNear ? onPlane : distance;
      const Mask counts = isHit & ~isFalseHit(cone_, seedNormal, direction, normal);
      store(&lengths[ray][first], counts ? length : broadcast<Double4>(kInfinity));
    }
  }
}

ASDFVK_ALWAYS_INLINE inline void LaneCones::sort() {
  for (const auto& [low, high] : exchanges_)
    for (size_t first = 0; first < kWidth; first += kDoubleCount) {
      const Double4 a = load<Double4>(&sorted_[low][first]), b = load<Double4>(&sorted_[high][first]);
      store(&sorted_[low][first], b < a ? b : a);
      store(&sorted_[high][first], b < a ? a : b);
    }
}

/// Replaces sorted_ by the sorted absolute differences of the lengths from the medians, one median per lane.
ASDFVK_ALWAYS_INLINE inline void LaneCones::sortDeviations(std::span<const double> medians) {
  for (size_t ray = 0; ray < lengths_.size(); ++ray)
    for (size_t first = 0; first < kWidth; first += kDoubleCount) {
      const Double4 difference = load<Double4>(&lengths_[ray][first]) - load<Double4>(&medians[first]);
      store(&sorted_[ray][first], difference < 0 ? -difference : difference);
    }
  sort();
}

ASDFVK_ALWAYS_INLINE inline void LaneCones::computeValues(std::array<double, kWidth>& values) {
  const OutlierRule& rule = cone_.outliers;
  std::array<double, kWidth> counts, medians, spreads;
  const auto middles = [&](std::array<double, kWidth>& result) {
    for (size_t lane = 0; lane < kWidth; ++lane) {
      const auto rays = static_cast<size_t>(counts[lane]);
      const double upper = rays == 0 ? 0 : sorted_[rays / 2][lane];
      result[lane] = rays == 0 || rays % 2 == 1 ? upper : 0.5 * (upper + sorted_[rays / 2 - 1][lane]);
    }
  };
  sorted_ = lengths_;
  sort();
  // Sums in the order of the rays, like coneValue(). Adding zero changes no bit.
  for (size_t first = 0; first < kWidth; first += kDoubleCount) {
    Double4 count{}, sum{}, squares{};
    for (const auto& lengths : lengths_) {
      const Double4 length = load<Double4>(&lengths[first]);
      count += length < kInfinity ? broadcast<Double4>(1) : Double4{};
      sum += length < kInfinity ? length : Double4{};
    }
    store(&counts[first], count);
    if (rule.spread != OutlierRule::Spread::StandardDeviation) continue;
    const Double4 mean = sum / count;
    for (const auto& lengths : lengths_) {
      const Double4 length = load<Double4>(&lengths[first]);
      const Double4 difference = length - mean;
      squares += length < kInfinity ? difference * difference : Double4{};
    }
    store(&spreads[first], squareRoots(squares / count));
  }
  middles(medians);
  if (rule.spread == OutlierRule::Spread::MedianDeviation) {
    sortDeviations(medians);
    middles(spreads);
  }
  for (size_t first = 0; first < kWidth; first += kDoubleCount) {
    const Double4 median = load<Double4>(&medians[first]);
    const Double4 bound = rule.deviations * load<Double4>(&spreads[first]) + rule.slack * median;
    Double4 weightedSum{}, weightSum{};
    for (size_t ray = 0; ray < lengths_.size(); ++ray) {
      const Double4 length = load<Double4>(&lengths_[ray][first]);
      const Double4 difference = length - median;
      const Mask isKept = (difference <= bound) & (difference >= -bound) & (length < kInfinity);
      weightedSum += isKept ? cone_.weights[ray] * length : Double4{};
      weightSum += isKept ? broadcast<Double4>(cone_.weights[ray]) : Double4{};
    }
    store(&values[first], weightSum > 0 ? weightedSum / weightSum : broadcast<Double4>(kNoValue));
  }
}

void LaneCones::measure(const LaneFrames& frames, std::span<const LaneHits> hits) {
  ASDFVK_CHECK_OP(hits.size(), ==, lengths_.size());
  dispatch<Float8>(instructionSet_, [&]<typename>() ASDFVK_ALWAYS_INLINE { computeLengths(frames, hits); });
}

std::array<double, LaneCones::kWidth> LaneCones::values() {
  std::array<double, kWidth> values;
  dispatch<Float8>(instructionSet_, [&]<typename>() ASDFVK_ALWAYS_INLINE { computeValues(values); });
  return values;
}

}  // namespace asdfvk
