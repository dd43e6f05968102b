#include "mesh/components.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "core/raise_flag.h"
#include "mesh/face_geometry.h"

namespace asdfvk {
namespace {

// Bound on the rounding error of each term of a volume: a few units in the last place. The bound is relative to the
// product of the three lengths in the term.
constexpr double kVolumeNoise = 1e-15;

void label(const DualGraph& graph, Components& result) {
  const uint32_t faceCount = graph.faceCount();
  DisjointSets sets(faceCount);
  forEachInParallel(faceCount, [&](uint32_t face) {
    for (const uint32_t neighbour : graph.neighboursOf(face))
      if (neighbour < face) sets.join(face, neighbour);
  });
  const std::vector<uint32_t> firstFaces =
      indicesInParallel(faceCount, [&](uint32_t f) { return sets.lowestOf(f) == f; });
  UnsetVector<uint32_t>& componentOf = result.componentOf;
  if (firstFaces.size() == 1) {
    componentOf = filledInParallel(faceCount, uint32_t{0});
    result.components.push_back({.firstFace = firstFaces.front(), .faceCount = faceCount});
    return;
  }
  componentOf.resize(faceCount);
  for (const uint32_t face : firstFaces) {
    componentOf[face] = static_cast<uint32_t>(result.components.size());
    result.components.push_back({.firstFace = face});
  }
  forEachInParallel(faceCount, [&](uint32_t face) {
    if (const uint32_t lowest = sets.lowestOf(face); lowest != face) componentOf[face] = componentOf[lowest];
  });
  for (const uint32_t component : componentOf) ++result.components[component].faceCount;
}

/// Faces that are not proper (EdgeKind) neither open a component nor close it.
void judgeClosedness(const TriangleMesh& mesh, const EdgeSurvey& edges, Components& result) {
  if (edges.isManifold && edges.isChainClosed()) {
    for (Component& component : result.components) component.isClosed = component.isConsistentlyWound = true;
    return;
  }
  const size_t count = result.components.size();
  std::vector<uint8_t> hasProperFace(count, 0), isOpen(count, 0), isBranching(count, 0), isInconsistent(count, 0);
  forEachInParallel(mesh.faces.size(), [&](uint32_t f) {
    if (!hasDistinctVertices(mesh.faces[f]) || !mesh.hasFiniteCorners(f)) return;
    const uint32_t component = result.componentOf[f];
    raiseFlag(hasProperFace[component]);
    for (size_t i = 0; i < 3; ++i) {
      const EdgeKind kind = edges.edgeKinds[size_t{3} * f + i];
      if (kind == EdgeKind::Inconsistent) raiseFlag(isInconsistent[component]);
      if (kind == EdgeKind::Branching) raiseFlag(isBranching[component]);
      if (kind == EdgeKind::Boundary || kind == EdgeKind::Branching) raiseFlag(isOpen[component]);
    }
  });
  for (size_t i = 0; i < count; ++i) {
    result.components[i].isClosed = hasProperFace[i] && !isOpen[i];
    result.components[i].isBranching = isBranching[i] != 0;
    result.components[i].isConsistentlyWound = !isInconsistent[i];
  }
}

/// Volume over some faces of one component, and a bound on its rounding error.
struct VolumeSum {
  uint32_t component = 0;
  double sum = 0, noise = 0;
};

/// Sums over the faces [begin, end). The ranges are fixed, so that the sums do not depend on the number of threads.
std::vector<VolumeSum> sumVolumes(const TriangleMesh& mesh, const Components& components, double scale, uint32_t begin,
                                  uint32_t end) {
  std::vector<VolumeSum> sums;
  VolumeSum last{components.componentOf[begin]};
  for (uint32_t f = begin; f < end; ++f) {
    const uint32_t component = components.componentOf[f];
    if (!components.components[component].isClosed) continue;
    if (last.component != component) {
      sums.push_back(last);
      last = {component};
    }
    const Vec3d& origin = mesh.vertices[mesh.faces[components.components[component].firstFace][0]];
    const auto [i, j, k] = mesh.faces[f];
    // The corner is scaled before the subtraction, because differences of huge coordinates may overflow.
    const Vec3d corner = mesh.vertices[i] * scale;
    const Vec3d a = corner - origin * scale;
    const Vec3d ab = mesh.vertices[j] * scale - corner, ac = mesh.vertices[k] * scale - corner;
    last.sum += dot(a, cross(ab, ac)) / 6;
    last.noise += kVolumeNoise * length(a) * std::sqrt(dot(ab, ab) * dot(ac, ac));
  }
  sums.push_back(last);
  return sums;
}

/// Volumes are summed in normalised units around a corner of the component, so that neither the unit nor a translation
/// of the mesh costs precision.
void measureVolumes(const TriangleMesh& mesh, Components& result) {
  const double scale = normalizationOf(boundsOfFiniteVertices(mesh)).scale;
  const size_t blockCount = (mesh.faces.size() + kItemsPerTask - 1) / kItemsPerTask;
  std::vector<std::vector<VolumeSum>> blocks(blockCount);
  forEachTask(blockCount, [&](size_t block) {
    const size_t begin = block * kItemsPerTask, end = std::min(begin + kItemsPerTask, mesh.faces.size());
    blocks[block] = sumVolumes(mesh, result, scale, static_cast<uint32_t>(begin), static_cast<uint32_t>(end));
  });
  std::vector<double> sum(result.components.size(), 0), noise(result.components.size(), 0);
  for (const std::vector<VolumeSum>& block : blocks)
    for (const VolumeSum& part : block) {
      sum[part.component] += part.sum;
      noise[part.component] += part.noise;
    }
  using Limits = std::numeric_limits<double>;
  for (size_t i = 0; i < sum.size(); ++i) {
    if (std::abs(sum[i]) <= noise[i]) continue;
    const double size = std::abs(sum[i]) / scale / scale / scale;
    result.components[i].signedVolume = std::copysign(std::clamp(size, Limits::min(), Limits::max()), sum[i]);
  }
}

}  // namespace

Components findComponents(const TriangleMesh& mesh, const EdgeSurvey& edges) {
  Components result;
  label(edges.graph, result);
  judgeClosedness(mesh, edges, result);
  measureVolumes(mesh, result);
  return result;
}

}  // namespace asdfvk
