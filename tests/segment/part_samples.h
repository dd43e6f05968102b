#pragma once

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "generate/creatures.h"
#include "segment/parts.h"

namespace asdfvk::test {

/// A mesh with what the segmentation into parts reads.
struct PartSample {
  Mesh source;
  TriangleMesh mesh;
  FaceGeometry geometry;
  EdgeSurvey edges;
  Components components;
  std::vector<double> values;

  PartSample(Mesh shape, std::vector<double> numbers)
      : source(std::move(shape)),
        mesh(source),
        geometry(computeFaceGeometry(mesh)),
        edges(surveyEdges(mesh)),
        components(findComponents(mesh, edges)),
        values(std::move(numbers)) {}
  PartSample(const PartSample&) = delete;
  PartSample& operator=(const PartSample&) = delete;

  [[nodiscard]] PartsInput input() const { return {mesh, geometry, edges.graph, components, values}; }
};

inline std::vector<double> diametersOf(const GeneratedShape& shape) {
  return {shape.diameter.begin(), shape.diameter.end()};
}

/// Whether some points of a segment are all inside of the shape.
inline LineOfSight sightInside(const CapsuleUnion& field) {
  return [&field](std::span<const LineSegment> segments) {
    std::vector<uint8_t> isClear;
    for (const auto& [from, to] : segments) {
      bool isInside = true;
      for (const double share : {0.5, 0.25, 0.75, 0.35, 0.65})
        isInside = isInside && field.value(from + (to - from) * share) < 0;
      isClear.push_back(isInside ? 1 : 0);
    }
    return isClear;
  };
}

inline std::vector<uint8_t> seeEverything(std::span<const LineSegment> segments) {
  return std::vector<uint8_t>(segments.size(), 1);
}

/// The labels are 0 .. count - 1, each in use.
inline bool areConsecutive(const std::vector<uint32_t>& labels, uint32_t count) {
  std::vector<uint8_t> isUsed(count, 0);
  for (const uint32_t label : labels) {
    if (label >= count) return false;
    isUsed[label] = 1;
  }
  return std::all_of(isUsed.begin(), isUsed.end(), [](uint8_t used) { return used == 1; });
}

}  // namespace asdfvk::test
