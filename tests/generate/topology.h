#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk {

/// Properties of a closed manifold surface.
struct Topology {
  uint64_t badEdgeCount = 0;    ///< Edges that are not used exactly once in each direction.
  uint64_t badVertexCount = 0;  ///< Vertices whose faces do not form one fan, or that no face uses.
  int64_t eulerCharacteristic = 0;
  uint64_t componentCount = 0;
};

inline Topology topologyOf(const Mesh& mesh) {
  Topology topology;
  std::vector<std::pair<uint32_t, uint32_t>> directed;
  for (const Face& f : mesh.faces)
    for (size_t c = 0; c < 3; ++c) directed.emplace_back(f[c], f[(c + 1) % 3]);
  std::sort(directed.begin(), directed.end());
  for (size_t i = 0; i < directed.size(); ++i) {
    const bool isDouble = i + 1 < directed.size() && directed[i] == directed[i + 1];
    const std::pair opposite{directed[i].second, directed[i].first};
    if (isDouble || !std::binary_search(directed.begin(), directed.end(), opposite)) ++topology.badEdgeCount;
  }
  // The edges opposite a vertex must form one cycle.
  std::vector<std::vector<std::pair<uint32_t, uint32_t>>> links(mesh.vertices.size());
  for (const Face& f : mesh.faces)
    for (size_t c = 0; c < 3; ++c) links[f[c]].emplace_back(f[(c + 1) % 3], f[(c + 2) % 3]);
  for (const auto& link : links) {
    if (link.empty()) {
      ++topology.badVertexCount;
      continue;
    }
    uint32_t at = link[0].first;
    size_t steps = 0;
    do {
      const auto next = std::find_if(link.begin(), link.end(), [&](const auto& edge) { return edge.first == at; });
      if (next == link.end()) break;
      at = next->second;
      ++steps;
    } while (at != link[0].first && steps <= link.size());
    if (steps != link.size()) ++topology.badVertexCount;
  }
  topology.eulerCharacteristic = static_cast<int64_t>(mesh.vertices.size()) -
                                 static_cast<int64_t>(mesh.faces.size() * 3 / 2) +
                                 static_cast<int64_t>(mesh.faces.size());
  std::vector<uint32_t> root(mesh.vertices.size());
  for (uint32_t v = 0; v < root.size(); ++v) root[v] = v;
  const auto find = [&](uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const Face& f : mesh.faces)
    for (size_t c = 1; c < 3; ++c) root[find(f[c])] = find(f[0]);
  for (uint32_t v = 0; v < root.size(); ++v) topology.componentCount += root[v] == v;
  return topology;
}

inline double volumeOf(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.faces)
    volume += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6;
  return volume;
}

inline double areaOf(const Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.faces)
    area += length(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
  return area;
}

/// 4 sqrt 3 area / sum of squared edges: 1 for an equilateral triangle, 0 for a degenerate one.
inline std::vector<double> triangleQualities(const Mesh& mesh) {
  std::vector<double> qualities;
  for (const auto& [i, j, k] : mesh.faces) {
    const Vec3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const double squares = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
    qualities.push_back(2 * std::sqrt(3.0) * length(cross(b - a, c - a)) / squares);
  }
  return qualities;
}

}  // namespace asdfvk
