#include "trace/vk/device_seeds.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "cone/cone.h"
#include "core/parallel.h"
#include "core/radix_sort.h"
#include "shared/cone_layout.h"
#include "trace/cone_tracer.h"

namespace asdfvk {
namespace {

// If at least 1 / kMinDenseShare of the faces are seeds, the seeds are ordered by an array over all faces, not by a
// sort.
constexpr uint32_t kMinDenseShare = 8;

uint32_t codeOf(const TraceScene& scene, uint32_t face, uint32_t triangle) {
  if (triangle == kNoFace || isTooSmallForFloat(scene, face)) return kNoFace;
  return isConeFrameFlipped(-scene.geometry.normals[face]) ? triangle | kFlippedFrameBit : triangle;
}

}  // namespace

DeviceSeeds::DeviceSeeds(const TraceScene& scene, std::span<const uint32_t> primitiveFaces)
    : codes_(scene.representatives.size(), kNoFace), triangleCount_(static_cast<uint32_t>(primitiveFaces.size())) {
  const std::span<const uint32_t> representatives = scene.representatives;
  forEachInParallel(primitiveFaces.size(), [&](uint32_t i) { codes_[primitiveFaces[i]] = i; });
  // Sets the entries of copies first. These entries are read from the entry of the representative, which must still be
  // the triangle.
  forEachInParallel(codes_.size(), [&](uint32_t face) {
    if (representatives[face] != face) codes_[face] = codeOf(scene, face, codes_[representatives[face]]);
  });
  forEachInParallel(codes_.size(), [&](uint32_t face) {
    if (representatives[face] == face) codes_[face] = codeOf(scene, face, codes_[face]);
  });
}

UnsetVector<DeviceCone> DeviceSeeds::inDeviceOrder(std::span<const uint32_t> faces) const {
  UnsetVector<DeviceCone> cones(faces.size());
  if (cones.size() >= triangleCount_ / kMinDenseShare && collect(faces, cones)) return cones;
  forEachInParallel(cones.size(), [&](uint32_t i) { cones[i] = {codes_[faces[i]], i}; });
  sortByKey(cones, triangleCount_, [&](const DeviceCone& cone) {
    return cone.seed == kNoFace ? triangleCount_ : cone.seed & ~kFlippedFrameBit;
  });
  return cones;
}

/// inDeviceOrder() for many seeds: puts seeds at their triangles and collects them. This needs one random access per
/// seed instead of the four of a sort. Returns false if seeds share a triangle or the device cannot trace a seed.
bool DeviceSeeds::collect(std::span<const uint32_t> faces, UnsetVector<DeviceCone>& cones) const {
  if (faces.size() >= kFlippedFrameBit) return false;
  constexpr uint32_t kEmpty = kNoFace;
  UnsetVector<uint32_t> seedAt(triangleCount_);  // Index of the seed, with kFlippedFrameBit.
  forEachInParallel(triangleCount_, [&](uint32_t triangle) { seedAt[triangle] = kEmpty; });
  forEachInParallel(faces.size(), [&](uint32_t i) {
    const uint32_t code = codes_[faces[i]];
    if (code == kNoFace) return;
    std::atomic_ref(seedAt[code & ~kFlippedFrameBit]).store(i | (code & kFlippedFrameBit), std::memory_order_relaxed);
  });
  const size_t blockCount = (triangleCount_ + kItemsPerTask - 1) / kItemsPerTask;
  const auto forEachSeedOf = [&](size_t block, const auto& visit) {
    const size_t end = std::min<size_t>(triangleCount_, (block + 1) * kItemsPerTask);
    for (size_t triangle = block * kItemsPerTask; triangle < end; ++triangle)
      if (seedAt[triangle] != kEmpty) visit(static_cast<uint32_t>(triangle), seedAt[triangle]);
  };
  std::vector<size_t> begins(blockCount + 1);
  forEachTask(blockCount,
              [&](size_t block) { forEachSeedOf(block, [&](uint32_t, uint32_t) { ++begins[block + 1]; }); });
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  if (begins.back() != faces.size()) return false;
  forEachTask(blockCount, [&](size_t block) {
    DeviceCone* next = cones.data() + begins[block];
    forEachSeedOf(block, [&](uint32_t triangle, uint32_t seed) {
      *next++ = {triangle | (seed & kFlippedFrameBit), seed & ~kFlippedFrameBit};
    });
  });
  return true;
}

}  // namespace asdfvk
