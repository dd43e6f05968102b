#include "predict/hit_points.h"

#include <algorithm>
#include <array>
#include <limits>

#include "cone/cone_value.h"
#include "core/lane_vec3.h"
#include "core/prefetch.h"

namespace asdfvk {
namespace {

constexpr size_t kLanes = kLaneCount<Double4>;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
static_assert(kMaxRayCount % kPointGroupSize == 0);

ASDFVK_ALWAYS_INLINE inline Float4 toFloats(const Double4& numbers) { return __builtin_convertvector(numbers, Float4); }

/// Rounds the vectors to float, and stores them from entry `place` on.
ASDFVK_ALWAYS_INLINE inline void storeFloats(float (&x)[kPointGroupSize], float (&y)[kPointGroupSize],
                                             float (&z)[kPointGroupSize], size_t place, const Vec3Double4& v) {
  store(&x[place], toFloats(v.x));
  store(&y[place], toFloats(v.y));
  store(&z[place], toFloats(v.z));
}

}  // namespace

HitPoints::HitPoints(const TraceScene& scene, const Cone& cone, const SeedHitsView& hits, InstructionSet instructionSet)
    : scene_(scene),
      cone_(cone),
      hits_(hits),
      instructionSet_(instructionSet),
      groupCount_((cone.directions.size() + kPointGroupSize - 1) / kPointGroupSize) {
  for (size_t axis = 0; axis < 3; ++axis)
    for (const Vec3d& direction : cone.directions) directions_[axis].push_back(direction[axis]);
  for (const double solidAngle : cone.solidAngles) solidAngles_.push_back(static_cast<float>(solidAngle));
  for (std::vector<double>& row : directions_) row.resize(groupCount_ * kPointGroupSize, 0);
  solidAngles_.resize(groupCount_ * kPointGroupSize, 0);
}

void HitPoints::clear() { groups_.clear(); }

void HitPoints::prefetchHits(uint32_t seed) const {
  const auto hits = std::as_bytes(hits_.of(seed));
  for (size_t place = 0; place < hits.size(); place += 64) prefetchMemory(&hits[place]);
  prefetchMemory(&hits.back());  // The hits may begin within a cache line.
  prefetchMemory(&scene_.geometry.barycentres[hits_.seeds[seed]]);
  prefetchMemory(&scene_.geometry.normals[hits_.seeds[seed]]);
}

void HitPoints::prefetchNormals(uint32_t seed) const {
  for (const ConeHit& hit : hits_.of(seed)) prefetchNormal(hit);
}

void HitPoints::prefetchNormal(const ConeHit& hit) const {
  if (hit.face != kNoFace) prefetchMemory(&scene_.geometry.normals[hit.face]);
}

/// Returns the median length. Prefetches one normal per ray, because prefetches that immediately follow each other wait
/// for free line fill buffers.
ASDFVK_ALWAYS_INLINE inline float HitPoints::fill(std::span<PointGroup> groups, uint32_t seed, uint32_t later) const {
  const std::span<const ConeHit> hits = hits_.of(seed), laterHits = hits_.of(later);
  const uint32_t seedFace = hits_.seeds[seed];
  const Vec3d* const faceNormals = scene_.geometry.normals.data();
  const Vec3d& seedNormal = faceNormals[seedFace];
  const ConeFrame frame = seedConeFrame(scene_, cone_, seedFace);
  const Vec3d origin = scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[seedFace]);
  const size_t paddedCount = groups.size() * kPointGroupSize;
  std::array<ConeHit, kMaxRayCount> padded;
  std::fill(std::ranges::copy(hits, padded.begin()).out, padded.begin() + static_cast<std::ptrdiff_t>(paddedCount),
            kMiss);
  std::array<double, kMaxRayCount> lengths;       // NaN for a miss.
  std::array<double, kMaxRayCount> validLengths;  // Without misses and false hits.
  size_t validCount = 0;
  for (size_t first = 0; first < paddedCount; first += kLanes) {
    PointGroup& group = groups[first / kPointGroupSize];
    const size_t place = first % kPointGroupSize;
    for (size_t ray = first; ray < std::min(first + kLanes, hits.size()); ++ray) prefetchNormal(laterHits[ray]);
    const ConeHit* const four = &padded[first];
    LaneIndices faces;
    for (size_t lane = 0; lane < kLanes; ++lane) {
      group.face[place + lane] = four[lane].face;
      faces[lane] = four[lane].face == kNoFace ? 0 : four[lane].face;
    }
    const Vec3Double4 normal = gather(faceNormals, faces);
    const auto lengthOf = [](const ConeHit& hit) { return hit.face == kNoFace ? kNaN : double{hit.distance}; };
    const Double4 length{lengthOf(four[0]), lengthOf(four[1]), lengthOf(four[2]), lengthOf(four[3])};
    const auto isHit = length == length;
    const Vec3Double4 direction = load<Double4>(&directions_[0][first]) * frame.tangent +
                                  load<Double4>(&directions_[1][first]) * frame.bitangent +
                                  load<Double4>(&directions_[2][first]) * frame.axis;
    storeFloats(group.x, group.y, group.z, place, origin + length * direction);
    storeFloats(group.nx, group.ny, group.nz, place, normal);
    const Float4 distance = toFloats(isHit ? length : Double4{});
    store(&group.solidAngleRatio[place], distance * distance * load<Float4>(&solidAngles_[first]));
    const auto isValid = isHit & ~isFalseHit(cone_, seedNormal, direction, normal);
    store(&group.isInlier[place], toFloats(isValid ? broadcast<Double4>(1) : Double4{}));
    store(&lengths[first], length);
    for (size_t lane = 0; lane < kLanes; ++lane) {
      validLengths[validCount] = length[lane];
      validCount += isValid[lane] != 0 ? 1 : 0;
    }
  }
  if (validCount == 0) return 0;
  const LengthWindow window = keptWindow({validLengths.data(), validCount}, cone_.outliers);
  for (size_t first = 0; first < paddedCount; first += kLanes) {
    float* const isInlier = &groups[first / kPointGroupSize].isInlier[first % kPointGroupSize];
    const Double4 difference = load<Double4>(&lengths[first]) - window.median;
    const auto isKept = (difference <= window.bound) & (difference >= -window.bound);
    store(isInlier, load<Float4>(isInlier) * toFloats(isKept ? broadcast<Double4>(1) : Double4{}));
  }
  return static_cast<float>(window.median);
}

HitRange HitPoints::append(uint32_t seed, uint32_t later) {
  HitRange range{static_cast<uint32_t>(groups_.size()), static_cast<uint32_t>(groupCount_)};
  groups_.resize(groups_.size() + groupCount_);
  dispatch<Float8>(instructionSet_, [&]<typename>() ASDFVK_ALWAYS_INLINE {
    range.medianLength = fill({&groups_[range.firstGroup], groupCount_}, seed, later);
  });
  return range;
}

}  // namespace asdfvk
