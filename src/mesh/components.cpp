#include "mesh/components.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "mesh/buckets.h"
#include "mesh/normalization.h"

namespace asdfvk {
namespace {

constexpr uint32_t kUnvisited = UINT32_MAX;

// A volume below this share of the sum of its terms' factors is rounding noise: a few units in the last place.
constexpr double kVolumeNoise = 1e-15;

void label(const DualGraph& graph, Components& result) {
  result.componentOf.assign(graph.faceCount(), kUnvisited);
  std::vector<uint32_t> queue;
  for (uint32_t first = 0; first < graph.faceCount(); ++first) {
    if (result.componentOf[first] != kUnvisited) continue;
    const uint32_t index = static_cast<uint32_t>(result.components.size());
    queue.assign(1, first);
    result.componentOf[first] = index;
    for (size_t head = 0; head < queue.size(); ++head) {
      for (uint32_t neighbour : graph.neighboursOf(queue[head])) {
        if (result.componentOf[neighbour] != kUnvisited) continue;
        result.componentOf[neighbour] = index;
        queue.push_back(neighbour);
      }
    }
    Component component;
    component.firstFace = first;
    component.faceCount = static_cast<uint32_t>(queue.size());
    result.components.push_back(component);
  }
}

enum class EdgeUse { None, From, To };  // From: the face runs from p to q.

EdgeUse useOfEdge(const Face& face, uint32_t p, uint32_t q) {
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t from = face[i], to = face[(i + 1) % 3];
    if (from == p && to == q) return EdgeUse::From;
    if (from == q && to == p) return EdgeUse::To;
  }
  return EdgeUse::None;
}

struct Surroundings {
  bool areClosed = true;
  bool areConsistent = true;
};

Surroundings surroundingsOf(const Mesh& mesh, const DualGraph& graph, uint32_t f) {
  const Face& face = mesh.faces[f];
  Surroundings result;
  for (size_t i = 0; i < 3; ++i) {
    uint32_t previous = f, count = 0;
    EdgeUse lastUse = EdgeUse::None;
    for (uint32_t neighbour : graph.neighboursOf(f)) {
      if (neighbour == previous || !hasDistinctVertices(mesh.faces[neighbour])) continue;
      previous = neighbour;
      const EdgeUse use = useOfEdge(mesh.faces[neighbour], face[i], face[(i + 1) % 3]);
      if (use == EdgeUse::None) continue;
      ++count;
      lastUse = use;
    }
    if (count != 1) {
      result.areClosed = false;
    } else if (lastUse == EdgeUse::From) {
      result.areConsistent = false;
    }
  }
  return result;
}

void judgeClosedness(const Mesh& mesh, const DualGraph& graph, Components& result) {
  const size_t count = result.components.size();
  std::vector<uint8_t> hasProperFace(count, 0), isOpen(count, 0), isInconsistent(count, 0);
  const auto raise = [](uint8_t& flag) { std::atomic_ref<uint8_t>(flag).store(1, std::memory_order_relaxed); };
  forEachInParallel(mesh.faces.size(), [&](uint32_t f) {
    if (!hasDistinctVertices(mesh.faces[f])) return;
    const uint32_t component = result.componentOf[f];
    const Surroundings around = surroundingsOf(mesh, graph, f);
    raise(hasProperFace[component]);
    if (!around.areClosed) raise(isOpen[component]);
    if (!around.areConsistent) raise(isInconsistent[component]);
  });
  for (size_t i = 0; i < count; ++i) {
    result.components[i].isClosed = hasProperFace[i] && !isOpen[i];
    result.components[i].isConsistentlyWound = !isInconsistent[i];
  }
}

// Volumes are summed in normalised units around a corner of the component, so that neither the unit nor a shift of the
// mesh costs digits.
void measureVolumes(const Mesh& mesh, Components& result) {
  Box3d bounds;
  for (const Vec3d& vertex : mesh.vertices)
    if (isFinite(vertex)) bounds.add(vertex);
  const double scale = normalizationOf(bounds).scale;
  std::vector<double> sum(result.components.size(), 0), noise(result.components.size(), 0);
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
    const uint32_t component = result.componentOf[f];
    if (!result.components[component].isClosed) continue;
    const Vec3d& origin = mesh.vertices[mesh.faces[result.components[component].firstFace][0]];
    const auto [i, j, k] = mesh.faces[f];
    // Scaled first, which rounds nothing, because differences of huge coordinates may overflow.
    const Vec3d corner = mesh.vertices[i] * scale;
    const Vec3d a = corner - origin * scale;
    const Vec3d ab = mesh.vertices[j] * scale - corner, ac = mesh.vertices[k] * scale - corner;
    sum[component] += dot(a, cross(ab, ac)) / 6;
    noise[component] += kVolumeNoise * length(a) * length(ab) * length(ac);
  }
  using Limits = std::numeric_limits<double>;
  for (size_t i = 0; i < sum.size(); ++i) {
    if (std::abs(sum[i]) <= noise[i]) continue;
    const double size = std::abs(sum[i]) / scale / scale / scale;
    result.components[i].signedVolume = std::copysign(std::clamp(size, Limits::min(), Limits::max()), sum[i]);
  }
}

}  // namespace

Components findComponents(const Mesh& mesh, const DualGraph& graph) {
  Components result;
  label(graph, result);
  judgeClosedness(mesh, graph, result);
  measureVolumes(mesh, result);
  return result;
}

}  // namespace asdfvk
