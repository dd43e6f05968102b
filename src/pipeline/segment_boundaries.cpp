#include "pipeline/segment_boundaries.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace asdfvk {

SegmentBoundaries boundariesOfInputFaces(const PreparedMesh& prepared, const Parts& parts,
                                         std::span<const uint32_t> segments) {
  using Pair = std::pair<uint32_t, uint32_t>;
  std::map<Pair, double> stabilityOf, found;
  for (const auto& [first, second, stability] : parts.boundaries) stabilityOf[{first, second}] = stability;
  SegmentBoundaries result;
  result.stability.assign(segments.size(), kNoValue);
  for (uint32_t face = 0; face < prepared.mesh.faceCount(); ++face)
    for (const uint32_t neighbour : prepared.graph.neighboursOf(face)) {
      const uint32_t input = prepared.mesh.inputFaceOf(face);
      const uint32_t segment = segments[input], other = segments[prepared.mesh.inputFaceOf(neighbour)];
      if (segment == other) continue;
      const auto known = stabilityOf.find(std::minmax({parts.partOf[face], parts.partOf[neighbour]}));
      if (known == stabilityOf.end()) continue;  // The edge is inside of a part, and the parts of the polygons differ.
      const auto entry = found.try_emplace(std::minmax({segment, other}), known->second).first;
      entry->second = std::min(entry->second, known->second);
      result.stability[input] = std::fmin(result.stability[input], known->second);
    }
  for (const auto& [pair, stability] : found) result.list.push_back({pair.first, pair.second, stability});
  return result;
}

}  // namespace asdfvk
