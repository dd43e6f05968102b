#include "mesh/winding.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "mesh/edge_chain.h"
#include "mesh/edges.h"

namespace asdfvk {
namespace {

/// Sets of faces in which each face is wound like the first face of the set, or against it.
class WindingSets {
 public:
  explicit WindingSets(uint32_t faceCount) : parents_(faceCount), isAgainst_(faceCount, 0), isTwisted_(faceCount, 0) {
    for (uint32_t face = 0; face < faceCount; ++face) parents_[face] = face;
  }

  /// Returns the first face of the set, and whether the face is wound against it.
  [[nodiscard]] std::pair<uint32_t, bool> firstOf(uint32_t face) {
    bool isAgainst = false;
    for (; parents_[face] != face; face = parents_[face]) {
      const uint32_t parent = parents_[face];
      // Path halving.
      if (parents_[parent] != parent) {
        isAgainst_[face] ^= isAgainst_[parent];
        parents_[face] = parents_[parent];
      }
      isAgainst ^= isAgainst_[face] != 0;
    }
    return {face, isAgainst};
  }

  void join(uint32_t face, uint32_t other, bool areAgainst) {
    const auto [first, isAgainst] = firstOf(face);
    const auto [otherFirst, isOtherAgainst] = firstOf(other);
    const bool isOpposite = (isAgainst != isOtherAgainst) != areAgainst;
    if (first == otherFirst) {
      if (isOpposite) isTwisted_[first] = 1;
      return;
    }
    const uint32_t lower = std::min(first, otherFirst), upper = std::max(first, otherFirst);
    parents_[upper] = lower;
    isAgainst_[upper] = isOpposite ? 1 : 0;
    isTwisted_[lower] |= isTwisted_[upper];
  }

  [[nodiscard]] bool isTwisted(uint32_t first) const { return isTwisted_[first] != 0; }

 private:
  std::vector<uint32_t> parents_;
  std::vector<uint8_t> isAgainst_;  // Relative to the parent.
  std::vector<uint8_t> isTwisted_;  // Per first face: the set cannot be oriented.
};

/// Pairs of faces with a common edge of two faces.
std::vector<TJunction> pairsAtEdges(const TriangleMesh& mesh) {
  std::vector<TJunction> pairs;
  std::mutex mutex;
  const EdgeTable table(mesh,
                        [&](uint32_t f) { return hasDistinctVertices(mesh.faces[f]) && mesh.hasFiniteCorners(f); });
  table.forEachEdge([&](uint32_t lower, std::span<const EdgeEntry> around) {
    if (around.size() != 2) return;
    const auto runsUp = [&](const EdgeEntry& entry) { return mesh.faces[entry.face()][entry.corner % 3] == lower; };
    const std::lock_guard lock(mutex);
    pairs.push_back({around[0].face(), around[1].face(), runsUp(around[0]) == runsUp(around[1])});
  });
  return pairs;
}

}  // namespace

std::vector<uint8_t> findTurnedFaces(const TriangleMesh& mesh, const Normalization& unit, const SurfaceEdges& edges) {
  if (edges.survey.countOf(EdgeKind::Inconsistent) == 0) return {};
  WindingSets sets(mesh.faceCount());
  for (const TJunction& pair : pairsAtEdges(mesh)) sets.join(pair.face, pair.other, pair.isSameDirection);
  EdgeSurvey survey = surveyEdges(mesh);
  const double distance = edges.weldDistance > kWeldDistance ? kCadWeldDistance : kWeldDistance;
  for (const TJunction& pair : sumAsChain(mesh, unit, 2 * distance, survey))
    sets.join(pair.face, pair.other, pair.isSameDirection);
  std::vector<uint32_t> againstCount(mesh.faceCount(), 0), faceCount(mesh.faceCount(), 0);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const auto [first, isAgainst] = sets.firstOf(face);
    ++faceCount[first];
    againstCount[first] += isAgainst ? 1 : 0;
  }
  std::vector<uint8_t> isTurned(mesh.faceCount(), 0);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const auto [first, isAgainst] = sets.firstOf(face);
    const bool isFirstInSmallerPart = 2 * uint64_t{againstCount[first]} > faceCount[first];
    isTurned[face] = !sets.isTwisted(first) && isAgainst != isFirstInSmallerPart ? 1 : 0;
  }
  return isTurned;
}

bool canBeTurned(TriangleMesh mesh, const Normalization& unit) {
  const SurfaceEdges edges = surveySurface(mesh, unit);
  if (!edges.faces.empty()) mesh.faces = edges.faces;
  const std::vector<uint8_t> isTurned = findTurnedFaces(mesh, unit, edges);
  std::vector<Face> faces(mesh.faces.begin(), mesh.faces.end());
  for (size_t face = 0; face < isTurned.size(); ++face)
    if (isTurned[face] != 0) std::swap(faces[face][1], faces[face][2]);
  mesh.faces = faces;
  return surveySurface(mesh, unit).survey.countOf(EdgeKind::Inconsistent) == 0;
}

}  // namespace asdfvk
