#include "pipeline/aggregated_mesh.h"

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
// Without so many aggregates per seed, or faces per aggregate, the aggregates are not used.
constexpr uint64_t kMinAggregatesPerSeed = 2;
constexpr double kMinFacesPerAggregate = 1.5;

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

/// The graph of the aggregates with faces as nodes. Only centres have arcs.
DualGraph onCentres(const FaceAggregates& aggregates) {
  DualGraph graph;
  graph.offsets.reserve(aggregates.aggregateOf.size() + 1);
  for (uint32_t aggregate = 0; aggregate < aggregates.centres.size(); ++aggregate)
    graph.offsets.resize(aggregates.centres[aggregate] + size_t{1}, aggregates.graph.offsets[aggregate]);
  graph.offsets.resize(aggregates.aggregateOf.size() + 1, aggregates.graph.offsets.back());
  graph.neighbours.resize(aggregates.graph.neighbours.size());
  forEachInParallel(graph.neighbours.size(),
                    [&](size_t arc) { graph.neighbours[arc] = aggregates.centres[aggregates.graph.neighbours[arc]]; });
  return graph;
}

}  // namespace

AggregatedMesh::AggregatedMesh(const PreparedMesh& prepared)
    : prepared_(prepared),
      aggregates_(buildFaceAggregates(prepared.graph, prepared.geometry, facesOfLargeComponents(prepared.components),
                                      {kMaxArcCount, kMaxLength * length(prepared.geometry.bounds.size())})),
      graph_(onCentres(aggregates_)),
      componentOf_(prepared.mesh.faces.size(), static_cast<uint32_t>(prepared.components.components.size())) {
  for (const uint32_t centre : aggregates_.centres) componentOf_[centre] = prepared.components.componentOf[centre];
  std::copy_if(prepared.traceableFaces.begin(), prepared.traceableFaces.end(), std::back_inserter(traceableFaces_),
               [&](uint32_t face) { return aggregates_.isCentre(face); });
}

std::unique_ptr<const AggregatedMesh> aggregatesFor(const PreparedMesh& prepared, uint64_t seedCount) {
  const uint64_t faceCount = prepared.traceableFaces.size();
  if (faceCount < kMinFaceCount || faceCount < kMinFacesPerSeed * seedCount) return nullptr;
  auto aggregated = std::make_unique<const AggregatedMesh>(prepared);
  const uint64_t centreCount = aggregated->domain().traceableFaces.size();
  const bool savesTime = static_cast<double>(faceCount) >= kMinFacesPerAggregate * static_cast<double>(centreCount);
  return savesTime && centreCount >= kMinAggregatesPerSeed * seedCount ? std::move(aggregated) : nullptr;
}

}  // namespace asdfvk
