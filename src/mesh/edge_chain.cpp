#include "mesh/edge_chain.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "core/box3.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

/// A corner of a face, for the edge from it to the next corner.
struct EdgeCorner {
  uint32_t lower = 0, upper = 0;  // Vertices of the edge.
  uint32_t corner = 0;            // 3 f + i
  bool runsUp = false;            // The face traverses the edge from the lower vertex to the upper one.
  auto operator<=>(const EdgeCorner&) const = default;
};

/// A part of an edge between two vertices, for one face of the edge.
struct EdgePart {
  uint32_t lower = 0, upper = 0;
  uint32_t edge = 0;    // Index of the divided edge.
  uint32_t corner = 0;  // Index of the open corner.
  bool runsUp = false;
  auto operator<=>(const EdgePart&) const = default;
};

/// A tree of the ends of the edges: ranges of points, halved at the middle of their longest side.
class PointTree {
 public:
  explicit PointTree(std::vector<std::pair<Vec3d, uint32_t>> points) : points_(std::move(points)) {
    if (!points_.empty()) build(0, points_.size());
  }

  /// Calls visit(point, vertex) for each point within `distance` of the box of the segment, and for others near it.
  template <typename Visit>
  void forEachNear(const Vec3d& from, const Vec3d& to, double distance, const Visit& visit) const {
    if (!nodes_.empty()) descend(0, from, to, distance, visit);
  }

 private:
  struct Node {
    Box3d box;
    size_t begin = 0, end = 0;
    size_t upperChild = 0;  // 0 for a leaf. The lower child is the next node.
  };
  static constexpr size_t kLeafSize = 8;

  size_t build(size_t begin, size_t end) {
    const size_t index = nodes_.size();
    nodes_.push_back({{}, begin, end, 0});
    Box3d box;
    for (size_t i = begin; i < end; ++i) box.add(points_[i].first);
    nodes_[index].box = box;
    if (end - begin <= kLeafSize) return index;
    const Vec3d size = box.max - box.min;
    const size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const size_t middle = (begin + end) / 2;
    const auto at = [&](size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [axis](const auto& a, const auto& b) {
      return std::pair(a.first[axis], a.second) < std::pair(b.first[axis], b.second);
    });
    build(begin, middle);
    const size_t upper = build(middle, end);
    nodes_[index].upperChild = upper;
    return index;
  }

  /// Whether a point of the segment is within the distance of the box on each axis.
  static bool reaches(const Box3d& box, const Vec3d& from, const Vec3d& to, double distance) {
    double enter = 0, leave = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double low = box.min[axis] - distance - from[axis], high = box.max[axis] + distance - from[axis];
      const double way = to[axis] - from[axis];
      if (way == 0) {
        if (low > 0 || high < 0) return false;
        continue;
      }
      enter = std::max(enter, std::min(low / way, high / way));
      leave = std::min(leave, std::max(low / way, high / way));
    }
    return enter <= leave;
  }

  template <typename Visit>
  void descend(size_t index, const Vec3d& from, const Vec3d& to, double distance, const Visit& visit) const {
    const Node& node = nodes_[index];
    if (!reaches(node.box, from, to, distance)) return;
    if (node.upperChild != 0) {
      descend(index + 1, from, to, distance, visit);
      descend(node.upperChild, from, to, distance, visit);
      return;
    }
    for (size_t i = node.begin; i < node.end; ++i) visit(points_[i].first, points_[i].second);
  }

  std::vector<std::pair<Vec3d, uint32_t>> points_;
  std::vector<Node> nodes_;
};

/// The corners whose edge has a given kind, sorted. isWanted: by EdgeKind.
template <typename IsWanted>
std::vector<EdgeCorner> cornersOf(const TriangleMesh& mesh, const EdgeSurvey& survey, const IsWanted& isWanted) {
  std::vector<EdgeCorner> corners;
  for (uint32_t corner = 0; corner < survey.edgeKinds.size(); ++corner) {
    if (!isWanted(survey.edgeKinds[corner])) continue;
    const Face& face = mesh.faces[corner / 3];
    const uint32_t from = face[corner % 3], to = face[(corner + 1) % 3];
    corners.push_back({std::min(from, to), std::max(from, to), corner, from < to});
  }
  sortInParallel(corners.begin(), corners.end());
  return corners;
}

/// The corners whose edge is not regular, sorted.
std::vector<EdgeCorner> openCornersOf(const TriangleMesh& mesh, const EdgeSurvey& survey) {
  return cornersOf(mesh, survey, [](EdgeKind kind) { return kind != EdgeKind::Regular; });
}

PointTree treeOfEnds(const TriangleMesh& mesh, const Normalization& unit, std::span<const EdgeCorner> corners) {
  std::vector<uint32_t> ends;
  for (const EdgeCorner& corner : corners) ends.insert(ends.end(), {corner.lower, corner.upper});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<std::pair<Vec3d, uint32_t>> points;
  for (const uint32_t vertex : ends) points.emplace_back(unit.toNormalized(mesh.vertices[vertex]), vertex);
  return PointTree(std::move(points));
}

/// The points that lie on the edge between two points, from its lower to its upper vertex, without these.
std::vector<uint32_t> verticesOn(const PointTree& tree, const Vec3d& from, const Vec3d& to, const EdgeCorner& edge,
                                 double tolerance) {
  const Vec3d way = to - from;
  const double squared = dot(way, way);
  std::vector<std::pair<double, uint32_t>> cuts;
  if (!(squared > 0 && std::isfinite(squared))) return {};
  tree.forEachNear(from, to, tolerance, [&](const Vec3d& point, uint32_t vertex) {
    if (vertex == edge.lower || vertex == edge.upper) return;
    const double t = dot(point - from, way) / squared;
    if (t > 0 && t < 1 && length(point - (from + t * way)) <= tolerance) cuts.emplace_back(t, vertex);
  });
  std::sort(cuts.begin(), cuts.end());
  std::vector<uint32_t> vertices;
  for (const auto& [t, vertex] : cuts) vertices.push_back(vertex);
  return vertices;
}

/// An edge, and the vertices that lie on it.
struct CutEdge {
  std::span<const EdgeCorner> corners;  // One of each face of the edge.
  std::vector<uint32_t> vertices;       // From the lower to the upper vertex of the edge, without these.
};

/// The edges of corners, divided at the points of a tree. corners: sorted.
std::vector<CutEdge> cutEdges(const TriangleMesh& mesh, const Normalization& unit, double tolerance,
                              std::span<const EdgeCorner> corners, const PointTree& tree) {
  std::vector<CutEdge> edges;
  for (size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    const EdgeCorner& first = corners[begin];
    while (end < corners.size() && corners[end].lower == first.lower && corners[end].upper == first.upper) ++end;
    edges.push_back({corners.subspan(begin, end - begin), {}});
  }
  forEachInParallel(edges.size(), [&](uint32_t edge) {
    const EdgeCorner& first = edges[edge].corners.front();
    edges[edge].vertices = verticesOn(tree, unit.toNormalized(mesh.vertices[first.lower]),
                                      unit.toNormalized(mesh.vertices[first.upper]), first, tolerance);
  });
  return edges;
}

/// The parts of all edges, sorted by their ends.
std::vector<EdgePart> divide(const TriangleMesh& mesh, const Normalization& unit, double tolerance,
                             std::span<const EdgeCorner> corners) {
  const std::vector<CutEdge> edges = cutEdges(mesh, unit, tolerance, corners, treeOfEnds(mesh, unit, corners));
  std::vector<EdgePart> parts;
  for (uint32_t edge = 0; edge < edges.size(); ++edge) {
    std::vector<uint32_t> vertices{edges[edge].corners.front().lower};
    vertices.insert(vertices.end(), edges[edge].vertices.begin(), edges[edge].vertices.end());
    vertices.push_back(edges[edge].corners.front().upper);
    for (const EdgeCorner& corner : edges[edge].corners)
      for (size_t k = 0; k + 1 < vertices.size(); ++k) {
        const uint32_t from = vertices[k], to = vertices[k + 1];
        parts.push_back({std::min(from, to), std::max(from, to), edge, static_cast<uint32_t>(&corner - corners.data()),
                         corner.runsUp == (from < to)});
      }
  }
  sortInParallel(parts.begin(), parts.end());
  return parts;
}

int sumOf(std::span<const EdgePart> group) {
  int sum = 0;
  for (const EdgePart& part : group) sum += part.runsUp ? 1 : -1;
  return sum;
}

/// Joins the faces of parts with the same ends. Faces with the same edge were joined before.
void joinGroup(std::span<const EdgeCorner> corners, std::span<const EdgePart> group, int sum,
               std::vector<TJunction>& junctions) {
  const auto join = [&](const EdgePart& a, const EdgePart& b) {
    if (a.edge != b.edge)
      junctions.push_back({corners[a.corner].corner / 3, corners[b.corner].corner / 3, a.runsUp == b.runsUp});
  };
  if (sum != 0) {
    for (size_t i = 1; i < group.size(); ++i) join(group[i - 1], group[i]);
    return;
  }
  std::vector<EdgePart> open;
  for (const EdgePart& part : group) {
    if (open.empty() || open.back().runsUp == part.runsUp) {
      open.push_back(part);
      continue;
    }
    join(open.back(), part);
    open.pop_back();
  }
}

void addArcs(std::span<const TJunction> junctions, DualGraph& graph) {
  std::vector<std::pair<uint32_t, uint32_t>> arcs;
  for (const TJunction& junction : junctions) {
    if (junction.face == junction.other) continue;
    arcs.emplace_back(junction.face, junction.other);
    arcs.emplace_back(junction.other, junction.face);
  }
  std::sort(arcs.begin(), arcs.end());
  arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
  if (arcs.empty()) return;
  requireAtMost(UINT32_MAX, graph.neighbours.size() + arcs.size(), "neighbours of faces");
  DualGraph result;
  result.offsets.resize(graph.offsets.size());
  result.neighbours.resize(graph.neighbours.size() + arcs.size());
  result.offsets[0] = 0;
  size_t next = 0;
  uint32_t end = 0;
  for (uint32_t face = 0; face < graph.faceCount(); ++face) {
    const uint32_t begin = end;
    for (const uint32_t neighbour : graph.neighboursOf(face)) result.neighbours[end++] = neighbour;
    for (; next < arcs.size() && arcs[next].first == face; ++next) result.neighbours[end++] = arcs[next].second;
    std::sort(result.neighbours.data() + begin, result.neighbours.data() + end);
    result.offsets[face + 1] = end;
  }
  graph = std::move(result);
}

}  // namespace

std::vector<TJunction> sumAsChain(const TriangleMesh& mesh, const Normalization& unit, double tolerance,
                                  EdgeSurvey& survey) {
  std::vector<TJunction> junctions;
  const std::vector<EdgeCorner> corners = openCornersOf(mesh, survey);
  if (corners.empty()) return junctions;
  const std::vector<EdgePart> parts = divide(mesh, unit, tolerance, corners);
  // The least closed kind of the parts of each edge, and the middle of the first such part.
  struct Remains {
    EdgeKind kind = EdgeKind::Regular;
    Vec3d place;
  };
  std::vector<Remains> remains(corners.size());
  for (size_t begin = 0, end = 0; begin < parts.size(); begin = end) {
    while (end < parts.size() && parts[end].lower == parts[begin].lower && parts[end].upper == parts[begin].upper)
      ++end;
    const std::span<const EdgePart> group = std::span(parts).subspan(begin, end - begin);
    const int sum = sumOf(group);
    if (group.front().edge != group.back().edge) joinGroup(corners, group, sum, junctions);
    if (sum == 0) continue;
    const EdgeKind kind = sum % 2 == 0        ? EdgeKind::Inconsistent
                          : group.size() == 1 ? EdgeKind::Boundary
                                              : EdgeKind::Branching;
    const Vec3d middle = 0.5 * mesh.vertices[group[0].lower] + 0.5 * mesh.vertices[group[0].upper];
    for (const EdgePart& part : group)
      if (kind > remains[part.corner].kind) remains[part.corner] = {kind, middle};
  }
  survey.edges = {};
  for (size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    EdgeKind kind = EdgeKind::Regular;
    for (; end < corners.size() && corners[end].lower == corners[begin].lower &&
           corners[end].upper == corners[begin].upper;
         ++end) {
      const uint32_t corner = corners[end].corner;
      const Remains& remaining = remains[end];
      survey.edgeKinds[corner] = remaining.kind;
      if (remaining.kind == EdgeKind::Regular) continue;
      kind = std::max(kind, remaining.kind);
      EdgesOfKind& edges = survey.edges[static_cast<size_t>(remaining.kind)];
      if (corner < edges.firstCorner) {
        edges.firstCorner = corner;
        edges.place = remaining.place;
      }
    }
    if (kind != EdgeKind::Regular) ++survey.edges[static_cast<size_t>(kind)].count;
  }
  addArcs(junctions, survey.graph);
  return junctions;
}

std::vector<DividedEdge> findDividedEdges(const TriangleMesh& mesh, const Normalization& unit, double tolerance,
                                          const EdgeSurvey& survey) {
  std::vector<DividedEdge> divided;
  const std::vector<EdgeCorner> open = openCornersOf(mesh, survey);
  if (open.empty()) return divided;
  const std::vector<EdgeCorner> corners = cornersOf(mesh, survey, [](EdgeKind) { return true; });
  for (const CutEdge& edge : cutEdges(mesh, unit, tolerance, corners, treeOfEnds(mesh, unit, open))) {
    if (edge.vertices.empty()) continue;
    for (const EdgeCorner& corner : edge.corners) {
      divided.push_back({corner.corner, edge.vertices});
      if (!corner.runsUp) std::reverse(divided.back().vertices.begin(), divided.back().vertices.end());
    }
  }
  return divided;
}

}  // namespace asdfvk
