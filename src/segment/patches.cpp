#include "segment/patches.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "segment/surface_front.h"

namespace asdfvk {
namespace {

constexpr uint32_t kLloydRoundCount = 2;
constexpr uint32_t kNoFaceFound = 0xffffffff;

/// Finds the face with the largest distance. Precondition: distances only decrease between calls. Because of the
/// precondition, the last known maximum of a block of faces is an upper bound. Only blocks with the largest bound are
/// searched.
class FarthestFace {
 public:
  explicit FarthestFace(std::span<const float> distances)
      : distances_(distances),
        bounds_((distances.size() + kBlock - 1) / kBlock, std::numeric_limits<float>::infinity()) {}

  /// Returns the face; kNoFaceFound if no reached face has a distance above 0.
  uint32_t find() {
    for (;;) {
      const auto bound = std::max_element(bounds_.begin(), bounds_.end());
      if (!(*bound > 0)) return kNoFaceFound;
      const auto begin = static_cast<size_t>(bound - bounds_.begin()) * kBlock;
      const size_t end = std::min(begin + kBlock, distances_.size());
      float largest = 0;
      size_t at = begin;
      for (size_t face = begin; face < end; ++face)
        if (distances_[face] > largest && distances_[face] < SurfaceFront::kUnreached) {
          largest = distances_[face];
          at = face;
        }
      if (largest == *bound) return static_cast<uint32_t>(at);
      *bound = largest;
    }
  }

 private:
  static constexpr size_t kBlock = 1024;
  std::span<const float> distances_;
  std::vector<float> bounds_;
};

struct SeededPatches {
  Patches patches;
  std::vector<uint32_t> seeds;
};

std::vector<SeededPatches> sampleFarthest(const PartSurface& surface, std::span<const uint32_t> firstSeeds,
                                          std::span<const uint32_t> counts, const RunControl& stopOnly) {
  SurfaceFront front(surface.offsets, surface.creasedArcs, stopOnly.stop);
  std::vector<uint32_t> seeds;
  const auto addSeed = [&](uint32_t face) {
    front.add(face, 0, static_cast<uint32_t>(seeds.size()));
    front.advance();
    stopOnly.checkpoint(0);
    seeds.push_back(face);
  };
  for (const uint32_t face : firstSeeds) addSeed(face);
  FarthestFace farthest(front.distances());
  std::vector<SeededPatches> results;
  for (const uint32_t count : counts) {
    while (seeds.size() < count) {
      const uint32_t face = farthest.find();
      if (face == kNoFaceFound) break;
      addSeed(face);
    }
    Patches patches{{front.labels().begin(), front.labels().end()}, static_cast<uint32_t>(seeds.size())};
    if (front.reached().size() < surface.faceCount())
      for (uint32_t face = 0; face < surface.faceCount(); ++face)
        if (front.distances()[face] == SurfaceFront::kUnreached) patches.patchOf[face] = kNoPatch;
    results.push_back({std::move(patches), seeds});
  }
  return results;
}

/// Moves each seed to the face of its patch that is farthest from other patches, and divides the surface again. After a
/// stop request the result is meaningless.
void improve(const PartSurface& surface, SurfaceFront& front, SeededPatches& seeded, const std::stop_token& stop) {
  std::vector<uint32_t>& patchOf = seeded.patches.patchOf;
  front.clear();
  for (uint32_t face = 0; face < surface.faceCount(); ++face)
    for (uint32_t arc = surface.offsets[face]; arc < surface.offsets[face + 1]; ++arc)
      if (const auto& [neighbour, length] = surface.creasedArcs[arc]; patchOf[neighbour] != patchOf[face])
        front.add(face, length / 2, 0);
  front.advance();
  if (stop.stop_requested()) return;
  std::vector<float> farthest(seeded.patches.count, -1);
  for (uint32_t face = 0; face < surface.faceCount(); ++face) {
    const float distance = front.distances()[face];
    if (patchOf[face] == kNoPatch || distance == SurfaceFront::kUnreached || distance <= farthest[patchOf[face]])
      continue;
    farthest[patchOf[face]] = distance;
    seeded.seeds[patchOf[face]] = face;
  }
  front.clear();
  for (uint32_t patch = 0; patch < seeded.patches.count; ++patch) front.add(seeded.seeds[patch], 0, patch);
  front.advance();
  for (uint32_t face = 0; face < surface.faceCount(); ++face)
    if (patchOf[face] != kNoPatch)
      patchOf[face] = front.distances()[face] == SurfaceFront::kUnreached ? kNoPatch : front.labels()[face];
}

}  // namespace

std::vector<Patches> makePatches(const PartSurface& surface, std::span<const uint32_t> firstSeeds,
                                 std::span<const uint32_t> counts, const RunControl& stopOnly) {
  ASDFVK_CHECK(!firstSeeds.empty());
  std::vector<SeededPatches> seeded = sampleFarthest(surface, firstSeeds, counts, stopOnly);
  forEachTask(seeded.size(), [&](size_t i) {
    SurfaceFront front(surface.offsets, surface.creasedArcs, stopOnly.stop);
    for (uint32_t round = 0; round < kLloydRoundCount && !stopOnly.stop.stop_requested(); ++round)
      improve(surface, front, seeded[i], stopOnly.stop);
  });
  stopOnly.checkpoint(0);
  std::vector<Patches> results;
  for (SeededPatches& entry : seeded) results.push_back(std::move(entry.patches));
  return results;
}

PatchData describePatches(const PartSurface& surface, std::span<const Vec3d> normals, const Patches& patches) {
  PatchData data;
  data.patches.resize(patches.count);
  std::vector<double> faceCounts(patches.count, 0);
  std::vector<Vec3d> plainCentres(patches.count);
  std::vector<double> plainLogs(patches.count, 0);
  for (uint32_t face = 0; face < surface.faceCount(); ++face) {
    const uint32_t index = patches.patchOf[face];
    if (index == kNoPatch) continue;
    PatchData::Patch& patch = data.patches[index];
    const double area = double{surface.areas[face]};
    patch.area += area;
    patch.logValue += area * double{surface.logValues[face]};
    patch.centre += surface.centres[face] * area;
    patch.normal += normals[face] * area;
    plainCentres[index] += surface.centres[face];
    plainLogs[index] += double{surface.logValues[face]};
    ++faceCounts[index];
  }
  for (uint32_t i = 0; i < patches.count; ++i) {
    PatchData::Patch& patch = data.patches[i];
    const bool hasArea = patch.area > 0;  // Without area, means are unweighted.
    patch.logValue = hasArea ? patch.logValue / patch.area : plainLogs[i] / std::max(1.0, faceCounts[i]);
    patch.centre = hasArea ? patch.centre / patch.area : plainCentres[i] / std::max(1.0, faceCounts[i]);
    if (const double norm = length(patch.normal); norm > 0) patch.normal = patch.normal / norm;
  }
  std::vector<double> nearest(patches.count, std::numeric_limits<double>::infinity());
  std::map<std::pair<uint32_t, uint32_t>, PatchData::Border> borders;
  for (uint32_t face = 0; face < surface.faceCount(); ++face) {
    const uint32_t index = patches.patchOf[face];
    if (index == kNoPatch) continue;
    const Vec3d toCentre = surface.centres[face] - data.patches[index].centre;
    if (const double squared = dot(toCentre, toCentre); squared < nearest[index]) {
      nearest[index] = squared;
      data.patches[index].centreFace = face;
    }
    for (uint32_t arc = surface.offsets[face]; arc < surface.offsets[face + 1]; ++arc) {
      const uint32_t other = patches.patchOf[surface.arcs[arc].face];
      if (other <= index || other == kNoPatch) continue;  // Each edge is counted once.
      const double length = double{surface.edgeLengths[arc]}, angle = double{surface.angles[arc]};
      PatchData::Border& border = borders[{index, other}];
      border.a = index;
      border.b = other;
      border.length += length;
      border.concave += length * std::max(0.0, angle);
      border.convex += length * std::max(0.0, -angle);
    }
  }
  for (const auto& [pair, border] : borders) data.borders.push_back(border);
  return data;
}

}  // namespace asdfvk
