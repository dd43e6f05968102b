#include "pipeline/patched_mesh.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/parallel.h"

namespace asdfvk {
namespace {

// Measured on generated shapes of 200,000 to 1,500,000 faces (docs/experiments.md).
constexpr uint64_t kMinFaceCount = 1u << 17, kMinFacesPerSeed = 8;
// All centres of a small component might have no valid ray.
constexpr uint64_t kMinComponentSize = 1000;
constexpr uint32_t kMaxArcCount = 2;
constexpr double kMaxLength = 0.002;  // Unit: diagonal of the bounding box.
// Without so many patches per seed, or faces per patch, the patches are not used.
constexpr uint64_t kMinPatchesPerSeed = 2;
constexpr double kMinFacesPerPatch = 1.5;

/// #F: whether the face is in a component with many faces.
std::vector<uint8_t> facesOfLargeComponents(const Components& components) {
  std::vector<uint64_t> sizes(components.components.size(), 0);
  for (const uint32_t component : components.componentOf) ++sizes[component];
  std::vector<uint8_t> isLarge(components.componentOf.size());
  forEachInParallel(isLarge.size(), [&](uint32_t face) {
    isLarge[face] = sizes[components.componentOf[face]] >= kMinComponentSize ? 1 : 0;
  });
  return isLarge;
}

/// The graph of the patches with faces as nodes. Only centres have arcs.
DualGraph onCentres(const FacePatches& patches) {
  DualGraph graph;
  graph.offsets.reserve(patches.patchOf.size() + 1);
  for (uint32_t patch = 0; patch < patches.centres.size(); ++patch)
    graph.offsets.resize(patches.centres[patch] + size_t{1}, patches.graph.offsets[patch]);
  graph.offsets.resize(patches.patchOf.size() + 1, patches.graph.offsets.back());
  graph.neighbours.resize(patches.graph.neighbours.size());
  forEachInParallel(graph.neighbours.size(),
                    [&](size_t arc) { graph.neighbours[arc] = patches.centres[patches.graph.neighbours[arc]]; });
  return graph;
}

}  // namespace

PatchedMesh::PatchedMesh(const PreparedMesh& prepared)
    : prepared_(prepared),
      patches_(buildFacePatches(prepared.graph, prepared.geometry, facesOfLargeComponents(prepared.components),
                                {kMaxArcCount, kMaxLength * length(prepared.geometry.bounds.size())})),
      graph_(onCentres(patches_)),
      componentOf_(prepared.mesh.faces.size(), static_cast<uint32_t>(prepared.components.components.size())) {
  for (const uint32_t centre : patches_.centres) componentOf_[centre] = prepared.components.componentOf[centre];
  std::copy_if(prepared.traceableFaces.begin(), prepared.traceableFaces.end(), std::back_inserter(traceableFaces_),
               [&](uint32_t face) { return patches_.isCentre(face); });
}

std::unique_ptr<const PatchedMesh> patchesFor(const PreparedMesh& prepared, uint64_t seedCount) {
  const uint64_t faceCount = prepared.traceableFaces.size();
  if (faceCount < kMinFaceCount || faceCount < kMinFacesPerSeed * seedCount) return nullptr;
  auto patched = std::make_unique<const PatchedMesh>(prepared);
  const uint64_t centreCount = patched->domain().traceableFaces.size();
  const bool savesTime = static_cast<double>(faceCount) >= kMinFacesPerPatch * static_cast<double>(centreCount);
  return savesTime && centreCount >= kMinPatchesPerSeed * seedCount ? std::move(patched) : nullptr;
}

}  // namespace asdfvk
