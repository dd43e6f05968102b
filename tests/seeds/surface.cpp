#include "seeds/surface.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <string>
#include <utility>

#include "generate/shapes.h"

using namespace asdfvk;

namespace {
constexpr float kInfinite = std::numeric_limits<float>::infinity();
}

Surface::Surface(Mesh triangles)
    : mesh(std::move(triangles)), graph(buildDualGraph(mesh)), geometry(computeFaceGeometry(mesh)) {
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    if (!geometry.isDegenerate(face)) candidates.push_back(face);
}

const Surface& generatedSurface(const char* name, uint64_t faceCount) {
  static std::map<std::pair<std::string, uint64_t>, Surface> made;
  const auto key = std::make_pair(std::string(name), faceCount);
  if (const auto found = made.find(key); found != made.end()) return found->second;
  return made.try_emplace(key, generateShape(name, faceCount).mesh).first->second;
}

Mesh strip(uint32_t faceCount) {
  Mesh mesh;
  for (uint32_t i = 0; i < faceCount + 2; ++i)
    mesh.vertices.push_back({0.5 * static_cast<double>(i), static_cast<double>(i % 2), 0});
  for (uint32_t i = 0; i < faceCount; ++i)
    mesh.faces.push_back(i % 2 == 0 ? Face{i, i + 2, i + 1} : Face{i, i + 1, i + 2});
  return mesh;
}

UnsetVector<float> hops(const DualGraph& graph) { return UnsetVector<float>(graph.neighbours.size(), 1.0f); }

std::vector<float> distancesToNearest(const DualGraph& graph, std::span<const float> arcLengths,
                                      std::span<const uint32_t> seeds) {
  std::vector<float> distances(graph.faceCount(), kInfinite);
  for (uint32_t seed : seeds) distances[seed] = 0;
  for (bool hasChanged = true; hasChanged;) {
    hasChanged = false;
    for (uint32_t face = 0; face < graph.faceCount(); ++face) {
      for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
        const float distance = distances[graph.neighbours[arc]] + arcLengths[arc];
        if (!(distance < distances[face])) continue;
        distances[face] = distance;
        hasChanged = true;
      }
    }
  }
  return distances;
}

std::vector<float> distancesToNearestOther(const DualGraph& graph, std::span<const float> arcLengths,
                                           std::span<const uint32_t> seeds) {
  std::vector<uint8_t> isSeed(graph.faceCount(), 0);
  for (uint32_t seed : seeds) isSeed[seed] = 1;
  std::vector<float> nearest;
  for (uint32_t seed : seeds) {
    std::map<uint32_t, float> settled;
    std::priority_queue<std::pair<float, uint32_t>, std::vector<std::pair<float, uint32_t>>, std::greater<>> queue;
    queue.push({0, seed});
    nearest.push_back(kInfinite);
    while (!queue.empty()) {
      const auto [distance, face] = queue.top();
      queue.pop();
      if (!settled.try_emplace(face, distance).second) continue;
      if (face != seed && isSeed[face]) {
        nearest.back() = distance;
        break;
      }
      for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc)
        queue.push({distance + arcLengths[arc], graph.neighbours[arc]});
    }
  }
  return nearest;
}

double meanOf(std::span<const float> numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}
