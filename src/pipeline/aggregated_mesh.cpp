#include "pipeline/aggregated_mesh.h"

#include <utility>

#include "core/parallel.h"

namespace asdfvk {
namespace {

// Measured on the horse, the armadillo and generated shapes of 80,000 to 1,500,000 faces (bench/experiments.md). With
// pooling, aggregates raise the errors of the horse and the armadillo. Therefore only finer meshes have aggregates with
// pooling.
constexpr uint64_t kMinFaceCount = 1u << 16, kMinFaceCountIfPooled = 1u << 18, kMinFacesPerSeed = 8;
// All centres of a small component might have no valid ray.
constexpr uint64_t kMinComponentSize = 1000;
constexpr uint32_t kMaxArcCount = 2;
constexpr double kMaxLength = 0.003;  // Unit: diagonal of the bounding box of the component.
// Without so many aggregates per seed, or faces per aggregate, the aggregates are not used.
constexpr uint64_t kMinAggregatesPerSeed = 2;
constexpr double kMinFacesPerAggregate = 1.5;

/// #components: AggregateLimits::lengths.
std::vector<double> lengthLimits(const PreparedMesh& prepared) {
  const std::span<const uint32_t> componentOf = prepared.components.componentOf;
  const std::vector<Component>& components = prepared.components.components;
  const std::vector<uint32_t> large =
      indicesInParallel(components.size(), [&](uint32_t i) { return components[i].faceCount >= kMinComponentSize; });
  std::vector<uint32_t> placeOf(components.size(), static_cast<uint32_t>(large.size()));  // In `large`, or its end.
  for (uint32_t place = 0; place < large.size(); ++place) placeOf[large[place]] = place;
  PerThread<std::vector<Box3d>> ofThreads([&] { return std::vector<Box3d>(large.size()); });
  forEachRange(componentOf.size(), kItemsPerTask, [&](size_t begin, size_t end) {
    std::vector<Box3d>& boxes = ofThreads.local();
    for (size_t face = begin; face < end; ++face) {
      const Vec3d& barycentre = prepared.geometry.barycentres[face];
      const uint32_t place = placeOf[componentOf[face]];
      if (place < boxes.size() && isFinite(barycentre)) boxes[place].add(barycentre);
    }
  });
  std::vector<double> limits(components.size(), 0);
  for (uint32_t place = 0; place < large.size(); ++place) {
    Box3d box;
    ofThreads.forEach([&](const std::vector<Box3d>& boxes) { box.add(boxes[place]); });
    limits[large[place]] = kMaxLength * length(box.size());
  }
  return limits;
}

}  // namespace

AggregatedMesh::AggregatedMesh(const PreparedMesh& prepared)
    : prepared_(prepared),
      aggregates_(buildFaceAggregates(prepared.graph, prepared.geometry,
                                      {kMaxArcCount, lengthLimits(prepared), prepared.components.componentOf})),
      geometry_(geometryOf(prepared.geometry, aggregates_.centres)),
      componentOf_(entriesAt<std::vector<uint32_t>>(aggregates_.centres, prepared.components.componentOf)),
      traceable_(indicesInParallel(geometry_.areas.size(), [&](uint32_t i) { return !geometry_.isDegenerate(i); })) {}

std::unique_ptr<const AggregatedMesh> aggregatesFor(const PreparedMesh& prepared, uint64_t seedCount, bool isPooled) {
  const uint64_t faceCount = prepared.traceableFaces.size();
  if (faceCount < (isPooled ? kMinFaceCountIfPooled : kMinFaceCount) || faceCount < kMinFacesPerSeed * seedCount)
    return nullptr;
  auto aggregated = std::make_unique<const AggregatedMesh>(prepared);
  const uint64_t centreCount = aggregated->domain().traceable.size();
  const bool savesTime = static_cast<double>(faceCount) >= kMinFacesPerAggregate * static_cast<double>(centreCount);
  return savesTime && centreCount >= kMinAggregatesPerSeed * seedCount ? std::move(aggregated) : nullptr;
}

std::vector<double> AggregatedMesh::spreadValues(std::vector<double> values) const {
  std::vector<double> ofFaces = atFaces(domain(), std::move(values), aggregates_.aggregateOf.size(), kNoValue);
  spreadFromCentres(prepared_.graph, prepared_.geometry, aggregates_, ofFaces);
  return ofFaces;
}

UnsetVector<double> AggregatedMesh::spreadEntries(std::span<const double> entries) const {
  return entriesAt<UnsetVector<double>>(aggregates_.aggregateOf, entries);
}

}  // namespace asdfvk
