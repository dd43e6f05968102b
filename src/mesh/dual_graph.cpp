#include "mesh/dual_graph.h"

#include <algorithm>
#include <array>
#include <utility>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "mesh/edge_pairs.h"
#include "mesh/edges.h"

namespace asdfvk {
namespace {

constexpr uint32_t kNoNeighbour = UINT32_MAX;
constexpr uint32_t kMany = UINT32_MAX - 1;  ///< The edge has more than two faces; its arcs are in furtherArcs.

/// A face and its neighbour.
using Arc = std::pair<uint32_t, uint32_t>;

/// Results of one thread.
struct Findings {
  std::array<EdgesOfKind, kEdgeKindCount> edges;  ///< Without places.
  uint64_t nonManifoldEdgeCount = 0;
  std::vector<Arc> furtherArcs;
};

class Survey {
 public:
  explicit Survey(const TriangleMesh& mesh)
      : mesh_(mesh),
        hasFiniteVertices_(
            countInParallel(mesh.vertices.size(), [&](uint32_t v) { return !isFinite(mesh.vertices[v]); }) == 0),
        hasDistinctVertices_(
            countInParallel(mesh.faces.size(), [&](uint32_t f) { return !hasDistinctVertices(mesh.faces[f]); }) == 0),
        across_(filledInParallel(3 * mesh.faces.size(), kNoNeighbour)),
        kinds_(filledInParallel(3 * mesh.faces.size(), EdgeKind::Regular)) {}

  EdgeSurvey run() {
    visitEdges();
    EdgeSurvey survey;
    std::vector<Arc> furtherArcs;
    findings_.forEach([&](const Findings& findings) {
      for (size_t kind = 0; kind < kEdgeKindCount; ++kind) {
        survey.edges[kind].count += findings.edges[kind].count;
        survey.edges[kind].firstCorner = std::min(survey.edges[kind].firstCorner, findings.edges[kind].firstCorner);
      }
      survey.nonManifoldEdgeCount += findings.nonManifoldEdgeCount;
      furtherArcs.insert(furtherArcs.end(), findings.furtherArcs.begin(), findings.furtherArcs.end());
    });
    for (EdgesOfKind& kind : survey.edges)
      if (kind.count > 0) kind.place = middleOf(kind.firstCorner);
    survey.isManifold = hasFiniteVertices_ && hasDistinctVertices_ && survey.countOf(EdgeKind::Boundary) == 0 &&
                        survey.nonManifoldEdgeCount == 0;
    survey.graph = survey.isManifold ? closedGraph() : anyGraph(std::move(furtherArcs));
    survey.edgeKinds = std::move(kinds_);
    return survey;
  }

 private:
  void visitEdges() {
    const EdgeTable edges(mesh_, [&](uint32_t f) { return hasFiniteVertices_ || mesh_.hasFiniteCorners(f); });
    edges.forEachEdge([&](uint32_t lower, std::span<const EdgeEntry> around) {
      join(around);
      classify(lower, around);
    });
  }

  /// Precondition: the face has entries in the table of edges.
  [[nodiscard]] bool isProper(uint32_t face) const {
    return hasDistinctVertices_ || hasDistinctVertices(mesh_.faces[face]);
  }
  [[nodiscard]] bool runsFrom(uint32_t vertex, const EdgeEntry& entry) const {
    return mesh_.faces[entry.face()][entry.corner % 3] == vertex;
  }

  void classify(uint32_t lower, std::span<const EdgeEntry> around) {
    size_t properCount = 0, runningUpCount = 0;
    for (const EdgeEntry& entry : around) {
      if (!isProper(entry.face())) continue;
      ++properCount;
      runningUpCount += runsFrom(lower, entry) ? 1 : 0;
    }
    Findings* const findings = properCount > 2 ? &findings_.local() : nullptr;
    if (findings) ++findings->nonManifoldEdgeCount;
    if (2 * runningUpCount == properCount) return;
    const EdgeKind kind = properCount % 2 == 0 ? EdgeKind::Inconsistent
                          : properCount == 1   ? EdgeKind::Boundary
                                               : EdgeKind::Branching;
    EdgesOfKind& edges = findings_.local().edges[static_cast<size_t>(kind)];
    ++edges.count;
    for (const EdgeEntry& entry : around) {
      if (!isProper(entry.face())) continue;
      kinds_[entry.corner] = kind;
      edges.firstCorner = std::min(edges.firstCorner, entry.corner);
    }
  }

  [[nodiscard]] Vec3d middleOf(uint32_t corner) const {
    const Face& face = mesh_.faces[corner / 3];
    return 0.5 * mesh_.vertices[face[corner % 3]] + 0.5 * mesh_.vertices[face[(corner + 1) % 3]];
  }

  void join(std::span<const EdgeEntry> around) {
    if (around.size() == 2) {
      across_[around[0].corner] = around[1].face();
      across_[around[1].corner] = around[0].face();
    }
    if (around.size() <= 2 || joinPairs(around)) return;
    std::vector<Arc>& furtherArcs = findings_.local().furtherArcs;
    const size_t reach = around.size() <= kMaxFacesJoinedAllToAll ? around.size() : 1;
    for (size_t i = 0; i < around.size(); ++i) {
      across_[around[i].corner] = kMany;
      for (size_t j = i + 1; j < around.size() && j <= i + reach; ++j) {
        furtherArcs.emplace_back(around[i].face(), around[j].face());
        furtherArcs.emplace_back(around[j].face(), around[i].face());
      }
    }
  }

  /// Returns false, without effect, if the edge is not regular or has a face that is not proper.
  bool joinPairs(std::span<const EdgeEntry> around) {
    if (!std::all_of(around.begin(), around.end(), [&](const EdgeEntry& entry) { return isProper(entry.face()); }))
      return false;
    const std::vector<CornerPair> pairs = pairsAroundEdge(mesh_, around);
    for (const auto& [first, second] : pairs) {
      across_[first] = second / 3;
      across_[second] = first / 3;
    }
    return !pairs.empty();
  }

  /// In a closed mesh each face has three arcs, so that `across_` already has the rows; the function sorts each row.
  DualGraph closedGraph() {
    DualGraph graph;
    graph.offsets.resize(mesh_.faces.size() + 1);
    graph.offsets[0] = 0;
    forEachInParallel(mesh_.faces.size(), [&](uint32_t f) {
      graph.offsets[f + 1] = 3 * (f + 1);
      // No branch, because the processor cannot predict the order.
      uint32_t* row = &across_[size_t{3} * f];
      const uint32_t lower = std::min(row[0], row[1]), upper = std::max(row[0], row[1]), last = row[2];
      row[0] = std::min(lower, last);
      row[1] = std::max(lower, std::min(upper, last));
      row[2] = std::max(upper, last);
    });
    graph.neighbours = std::move(across_);
    return graph;
  }

  DualGraph anyGraph(std::vector<Arc> furtherArcs) {
    sortInParallel(furtherArcs.begin(), furtherArcs.end());
    DualGraph graph;
    UnsetVector<uint32_t>& offsets = graph.offsets;
    offsets.resize(mesh_.faces.size() + 1);
    offsets[0] = 0;
    forEachInParallel(mesh_.faces.size(), [&](uint32_t f) {
      offsets[f + 1] = 0;
      for (size_t i = 0; i < 3; ++i) offsets[f + 1] += across_[size_t{3} * f + i] < kMany ? 1 : 0;
    });
    for (const auto& [face, neighbour] : furtherArcs) ++offsets[face + 1];
    uint64_t total = 0;
    for (uint32_t& offset : offsets) {
      total += offset;
      if (total > UINT32_MAX)
        throw Error(ErrorCode::MeshTooLarge, "the mesh has more connections between faces than 32 bits can index");
      offset = static_cast<uint32_t>(total);
    }
    graph.neighbours.resize(total);
    forEachInParallel(mesh_.faces.size(), [&](uint32_t f) {
      const auto begin = graph.neighbours.begin() + offsets[f];
      auto end = begin;
      bool hasFurther = false;
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t neighbour = across_[size_t{3} * f + i];
        hasFurther = hasFurther || neighbour == kMany;
        if (neighbour < kMany) *end++ = neighbour;
      }
      if (hasFurther)
        for (auto arc = std::lower_bound(furtherArcs.begin(), furtherArcs.end(), Arc(f, 0));
             arc != furtherArcs.end() && arc->first == f; ++arc)
          *end++ = arc->second;
      std::sort(begin, end);
    });
    return graph;
  }

  const TriangleMesh& mesh_;
  bool hasFiniteVertices_, hasDistinctVertices_;
  UnsetVector<uint32_t> across_;  ///< #F x 3: the face on the other side of each edge.
  UnsetVector<EdgeKind> kinds_;   ///< See EdgeSurvey::edgeKinds.
  PerThread<Findings> findings_;
};

}  // namespace

EdgeSurvey surveyEdges(const TriangleMesh& mesh) { return Survey(mesh).run(); }

}  // namespace asdfvk
