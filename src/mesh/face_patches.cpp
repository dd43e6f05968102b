#include "mesh/face_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr double kMaxAngleDegrees = 10;  // Between the normals of a face and of the centre of its patch.
constexpr double kBentAngleDegrees = 5;  // At this angle between two faces the weight of an arc is 1/2.
constexpr int kIterationCount = 4;       // Eight iterations lower the error by 1 % (docs/experiments.md).
constexpr uint32_t kNoPatch = 0xffffffff;

double inRadians(double degrees) { return degrees * (std::numbers::pi / 180); }

/// Builds the patches one after another, in the order of the faces.
class PatchGrower {
 public:
  PatchGrower(const DualGraph& graph, const FaceGeometry& geometry, const PatchLimits& limits, FacePatches& patches)
      : graph_(graph), geometry_(geometry), limits_(limits), patches_(patches) {
    patches.patchOf.assign(graph.faceCount(), kNoPatch);
    members_.reserve(graph.faceCount());
  }

  void grow(uint32_t centre, bool mayGrow) {
    const size_t begin = members_.size();
    begins_.push_back(begin);
    const auto patch = static_cast<uint32_t>(patches_.centres.size());
    patches_.centres.push_back(centre);
    add(centre, patch);
    size_t next = begin;
    for (uint32_t arc = 0; mayGrow && arc < limits_.arcCount; ++arc)
      for (const size_t end = members_.size(); next < end; ++next)
        for (const uint32_t neighbour : graph_.neighboursOf(members_[next]))
          if (patches_.patchOf[neighbour] == kNoPatch && isWithinLimits(centre, neighbour)) add(neighbour, patch);
    patches_.sizes.push_back(static_cast<uint32_t>(members_.size() - begin));
  }

  /// The faces of a patch.
  [[nodiscard]] std::span<const uint32_t> membersOf(size_t patch) const {
    const size_t end = patch + 1 < begins_.size() ? begins_[patch + 1] : members_.size();
    return {members_.data() + begins_[patch], members_.data() + end};
  }

 private:
  void add(uint32_t face, uint32_t patch) {
    patches_.patchOf[face] = patch;
    members_.push_back(face);
  }
  [[nodiscard]] bool isWithinLimits(uint32_t centre, uint32_t face) const {
    const Vec3d between = geometry_.barycentres[face] - geometry_.barycentres[centre];
    return dot(geometry_.normals[face], geometry_.normals[centre]) >= minCosine_ &&
           dot(between, between) <= limits_.length * limits_.length;
  }

  const DualGraph& graph_;
  const FaceGeometry& geometry_;
  const PatchLimits limits_;
  const double minCosine_ = std::cos(inRadians(kMaxAngleDegrees));
  FacePatches& patches_;
  std::vector<uint32_t> members_;  // Of all patches, one after another.
  std::vector<size_t> begins_;     // Per patch.
};

/// Sets patches.graph.
void connect(const DualGraph& graph, const PatchGrower& grower, FacePatches& patches) {
  constexpr uint32_t kBlockSize = 4096;
  const auto patchCount = static_cast<uint32_t>(patches.centres.size());
  std::vector<std::vector<uint32_t>> blocks((patchCount + kBlockSize - 1) / kBlockSize);
  std::vector<uint32_t>& offsets = patches.graph.offsets;
  offsets.assign(patchCount + size_t{1}, 0);
  forEachTask(blocks.size(), [&](size_t block) {
    std::vector<uint32_t>& rows = blocks[block];
    for (auto patch = static_cast<uint32_t>(block) * kBlockSize;
         patch < std::min((static_cast<uint32_t>(block) + 1) * kBlockSize, patchCount); ++patch) {
      const auto begin = static_cast<std::ptrdiff_t>(rows.size());
      for (const uint32_t face : grower.membersOf(patch))
        for (const uint32_t neighbour : graph.neighboursOf(face))
          if (patches.patchOf[neighbour] != patch) rows.push_back(patches.patchOf[neighbour]);
      std::sort(rows.begin() + begin, rows.end());
      rows.erase(std::unique(rows.begin() + begin, rows.end()), rows.end());
      offsets[patch + 1] = static_cast<uint32_t>(rows.size() - static_cast<size_t>(begin));
    }
  });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  patches.graph.neighbours.resize(offsets.back());
  forEachTask(blocks.size(), [&](size_t block) {
    std::copy(blocks[block].begin(), blocks[block].end(),
              patches.graph.neighbours.begin() + offsets[block * kBlockSize]);
  });
}

}  // namespace

FacePatches buildFacePatches(const DualGraph& graph, const FaceGeometry& geometry, std::span<const uint8_t> mayGrow,
                             const PatchLimits& limits) {
  ASDFVK_CHECK_OP(mayGrow.size(), ==, size_t{graph.faceCount()});
  FacePatches patches;
  PatchGrower grower(graph, geometry, limits, patches);
  for (uint32_t face = 0; face < graph.faceCount(); ++face)
    if (patches.patchOf[face] == kNoPatch) grower.grow(face, mayGrow[face] != 0);
  connect(graph, grower, patches);
  return patches;
}

void spreadFromCentres(const DualGraph& graph, const FaceGeometry& geometry, const FacePatches& patches,
                       std::vector<double>& values) {
  // The square of a small angle is 2 (1 - cosine).
  const double perVersine = 2 / (inRadians(kBentAngleDegrees) * inRadians(kBentAngleDegrees));
  forEachInParallel(values.size(), [&](uint32_t face) {
    if (!patches.isCentre(face)) values[face] = values[patches.centreOf(face)];
  });
  std::vector<double> next = values;
  for (int iteration = 0; iteration < kIterationCount; ++iteration, std::swap(values, next))
    forEachInParallel(values.size(), [&](uint32_t face) {
      if (patches.isCentre(face)) return;
      double sum = 0, weightSum = 0;
      for (const uint32_t neighbour : graph.neighboursOf(face)) {
        if (!std::isfinite(values[neighbour])) continue;
        const double versine = 1 - dot(geometry.normals[face], geometry.normals[neighbour]);
        const double weight = 1 / (1 + perVersine * versine);
        sum += weight * values[neighbour];
        weightSum += weight;
      }
      if (weightSum > 0) next[face] = sum / weightSum;
    });
}

}  // namespace asdfvk
