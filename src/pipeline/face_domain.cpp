#include "pipeline/face_domain.h"

#include <fmt/core.h>

#include <numeric>

#include "asdf_vk/error.h"
#include "core/parallel.h"

namespace asdfvk {

FaceDomain wholeMesh(const PreparedMesh& prepared) {
  const Components& components = prepared.components;
  return {prepared.graph, components.componentOf, components.components.size(), prepared.traceableFaces, {}};
}

Region::Region(const PreparedMesh& prepared, std::span<const uint8_t> inputFaces)
    : inputFaces_(inputFaces), isInside_(prepared.mesh.faces.size()) {
  forEachInParallel(isInside_.size(),
                    [&](uint32_t face) { isInside_[face] = inputFaces[prepared.mesh.inputFaceOf(face)] != 0 ? 1 : 0; });
  connect(prepared);
  labelComponents();
  traceableFaces_ = selectInParallel(prepared.traceableFaces, [&](uint32_t face) { return isInside_[face] != 0; });
}

void Region::connect(const PreparedMesh& prepared) {
  const auto isArc = [&](uint32_t face, uint32_t neighbour) {
    return isInside_[face] != 0 && isInside_[neighbour] != 0;
  };
  graph_.offsets.assign(isInside_.size() + 1, 0);
  forEachInParallel(isInside_.size(), [&](uint32_t face) {
    for (const uint32_t neighbour : prepared.graph.neighboursOf(face))
      graph_.offsets[face + 1] += isArc(face, neighbour) ? 1 : 0;
  });
  std::partial_sum(graph_.offsets.begin(), graph_.offsets.end(), graph_.offsets.begin());
  graph_.neighbours.resize(graph_.offsets.back());
  forEachInParallel(isInside_.size(), [&](uint32_t face) {
    uint32_t next = graph_.offsets[face];
    for (const uint32_t neighbour : prepared.graph.neighboursOf(face))
      if (isArc(face, neighbour)) graph_.neighbours[next++] = neighbour;
  });
}

/// Numbers the components by their lowest faces. Faces outside of the region get the number after the last component.
void Region::labelComponents() {
  constexpr uint32_t kUnlabelled = 0xffffffff;
  componentOf_.assign(isInside_.size(), kUnlabelled);
  uint32_t count = 0;
  std::vector<uint32_t> queue;
  for (uint32_t first = 0; first < isInside_.size(); ++first) {
    if (isInside_[first] == 0 || componentOf_[first] != kUnlabelled) continue;
    queue.assign(1, first);
    componentOf_[first] = count;
    for (size_t next = 0; next < queue.size(); ++next)
      for (const uint32_t neighbour : graph_.neighboursOf(queue[next])) {
        if (componentOf_[neighbour] != kUnlabelled) continue;
        componentOf_[neighbour] = count;
        queue.push_back(neighbour);
      }
    ++count;
  }
  std::replace(componentOf_.begin(), componentOf_.end(), kUnlabelled, count);
  componentCount_ = size_t{count} + 1;
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
  return std::make_optional<Region>(prepared, inputFaces);
}

}  // namespace asdfvk
