#include "pipeline/region.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "asdf_vk/error.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr uint32_t kNoNode = 0xffffffff;

}  // namespace

FaceDomain wholeMesh(const PreparedMesh& prepared) {
  const Components& components = prepared.components;
  return {prepared.graph, prepared.geometry, components.componentOf, components.components.size(),
          prepared.traceableFaces};
}

Region::Region(const PreparedMesh& prepared, const InputFaceSet& inputFaces) : inputFaces_(inputFaces) {
  faces_ = indicesInParallel(prepared.mesh.faceCount(),
                             [&](uint32_t face) { return inputFaces.contains(prepared.mesh.inputFaceOf(face)); });
  geometry_ = geometryOf(prepared.geometry, faces_);
  UnsetVector<uint32_t> nodeOf = filledInParallel(prepared.mesh.faceCount(), kNoNode);
  forEachInParallel(faces_.size(), [&](uint32_t node) { nodeOf[faces_[node]] = node; });
  connect(prepared, nodeOf);
  labelComponents();
  traceable_ = indicesInParallel(faces_.size(), [&](uint32_t node) { return !geometry_.isDegenerate(node); });
}

/// nodeOf: #F, kNoNode outside of the region.
void Region::connect(const PreparedMesh& prepared, std::span<const uint32_t> nodeOf) {
  graph_.offsets.resize(faces_.size() + 1);
  graph_.offsets[0] = 0;
  forEachInParallel(faces_.size(), [&](uint32_t node) {
    const std::span<const uint32_t> neighbours = prepared.graph.neighboursOf(faces_[node]);
    graph_.offsets[node + 1] = static_cast<uint32_t>(
        std::ranges::count_if(neighbours, [&](uint32_t neighbour) { return nodeOf[neighbour] != kNoNode; }));
  });
  std::partial_sum(graph_.offsets.begin(), graph_.offsets.end(), graph_.offsets.begin());
  graph_.neighbours.resize(graph_.offsets.back());
  forEachInParallel(faces_.size(), [&](uint32_t node) {
    uint32_t next = graph_.offsets[node];
    for (const uint32_t neighbour : prepared.graph.neighboursOf(faces_[node]))
      if (nodeOf[neighbour] != kNoNode) graph_.neighbours[next++] = nodeOf[neighbour];
  });
}

/// Numbers the components by their lowest nodes.
void Region::labelComponents() {
  componentOf_.assign(faces_.size(), kNoNode);
  uint32_t count = 0;
  std::vector<uint32_t> queue;
  for (uint32_t first = 0; first < faces_.size(); ++first) {
    if (componentOf_[first] != kNoNode) continue;
    queue.assign(1, first);
    componentOf_[first] = count;
    for (size_t next = 0; next < queue.size(); ++next)
      for (const uint32_t neighbour : graph_.neighboursOf(queue[next])) {
        if (componentOf_[neighbour] != kNoNode) continue;
        componentOf_[neighbour] = count;
        queue.push_back(neighbour);
      }
    ++count;
  }
  componentCount_ = count;
}

std::optional<Region> regionOf(const PreparedMesh& prepared, std::span<const uint8_t> inputFaces) {
  if (inputFaces.empty()) return std::nullopt;
  const uint64_t faceCount = prepared.mesh.inputFaceCount();
  if (inputFaces.size() != faceCount)
    throw Error(ErrorCode::ArraySize,
                fmt::format("the region has {} entries; the mesh has {} faces", inputFaces.size(), faceCount));
  const auto count = static_cast<uint64_t>(inputFaces.size()) -
                     static_cast<uint64_t>(std::count(inputFaces.begin(), inputFaces.end(), uint8_t{0}));
  if (count == 0) throw Error(ErrorCode::EmptyMesh, "the region has no face; give one or more");
  if (count == faceCount) return std::nullopt;
  return std::make_optional<Region>(prepared, InputFaceSet{inputFaces});
}

}  // namespace asdfvk
