#include "trace/sharp_edges.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "cone/touching_ball.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

/// Bits per corner of a face. A corner belongs to one point, so that points can be processed in parallel.
enum CornerBit : uint8_t { kIsThin = 1, kNextEdge = 2, kEdgeBefore = 4 };

struct Edge {
  uint32_t a = 0, b = 0;
  double cosine = 0;
  uint32_t face = 0;
};

class SharpSearch {
 public:
  SharpSearch(const TriangleMesh& mesh, const FaceGeometry& geometry, const PointFans& fans, double maxCosine,
              double minDepth, const Solids* solids)
      : mesh_(mesh),
        geometry_(geometry),
        fans_(fans),
        maxCosine_(maxCosine),
        minDepth_(minDepth),
        solids_(solids),
        cornerBits_(3 * size_t{mesh.faceCount()}) {}

  SharpEdges run() {
    forEachInParallel(fans_.vertexCount(), [&](uint32_t point) {
      forEachPair(point,
                  [&](uint32_t corner, uint32_t other) { cornerBits_[corner] |= kIsThin | edgeBits(corner, other); });
    });
    SharpEdges sharp{{}, std::vector<uint8_t>(mesh_.faceCount())};
    for (size_t corner = 0; corner < cornerBits_.size(); ++corner) {
      if (cornerBits_[corner] == 0) continue;
      const size_t k = corner % 3, before = (k + 2) % 3;
      const auto bits = cornerBits_[corner];
      sharp.faceBits[corner / 3] |=
          static_cast<uint8_t>(((bits & kIsThin) != 0 ? 1 << k : 0) | ((bits & kNextEdge) != 0 ? 8 << k : 0) |
                               ((bits & kEdgeBefore) != 0 ? 8 << before : 0));
    }
    sharp.lines = linesOf(edgesOf(sharp));
    addTips(sharp);
    std::stable_sort(sharp.lines.begin(), sharp.lines.end(),
                     [](const SharpLine& a, const SharpLine& b) { return a.cosine > b.cosine; });
    return sharp;
  }

 private:
  /// Calls visit(corner, other) for each pair of corners at the point such that the face of `other` makes the face of
  /// `corner` thin.
  template <typename Visit>
  void forEachPair(uint32_t point, const Visit& visit) const {
    const std::span<const uint32_t> corners = fans_.cornersAt(point);
    const size_t step = (corners.size() + kMaxComparedFaces - 1) / kMaxComparedFaces;
    for (const uint32_t corner : corners)
      for (size_t j = 0; j < corners.size(); j += step)
        if (isThin(corner, corners[j])) visit(corner, corners[j]);
    if (step > 1) forEachPairOverEdges(corners, visit);
  }

  /// Like forEachPair(), for the pairs of a large fan whose faces share an edge.
  template <typename Visit>
  void forEachPairOverEdges(std::span<const uint32_t> corners, const Visit& visit) const {
    std::vector<std::pair<uint32_t, uint32_t>> byPoint;  // The far end of an edge, and the corner at its near end.
    for (const uint32_t corner : corners)
      for (const uint32_t end : {next(corner), before(corner)}) byPoint.emplace_back(pointAt(end), corner);
    std::sort(byPoint.begin(), byPoint.end());
    for (size_t begin = 0, end = 0; begin < byPoint.size(); begin = end) {
      while (end < byPoint.size() && byPoint[end].first == byPoint[begin].first) ++end;
      for (size_t i = begin; i < end; ++i)
        for (size_t j = begin; j < end; ++j)
          if (isThin(byPoint[i].second, byPoint[j].second)) visit(byPoint[i].second, byPoint[j].second);
    }
  }

  [[nodiscard]] bool isThin(uint32_t corner, uint32_t other) const {
    const uint32_t face = corner / 3, wall = other / 3;
    if (geometry_.isDegenerate(face) || geometry_.isDegenerate(wall)) return false;
    if (solids_ != nullptr && !solids_->mayBoundOneBody(face, wall)) return false;
    if (!(dot(geometry_.normals[face], geometry_.normals[wall]) <= maxCosine_)) return false;
    return leastTouchingBall(triangleAt(face), triangleAt(wall), minDepth_).diameter <= kSharpDepths * minDepth_;
  }

  [[nodiscard]] PlaneTriangle triangleAt(uint32_t face) const {
    const auto& [a, b, c] = mesh_.faces[face];
    return {{mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]}, geometry_.normals[face]};
  }

  [[nodiscard]] uint32_t pointAt(uint32_t corner) const { return fans_.pointOf(mesh_.faces[corner / 3][corner % 3]); }
  static uint32_t next(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
  static uint32_t before(uint32_t corner) { return next(next(corner)); }

  /// The edges at `corner` that the face of `other` also has.
  [[nodiscard]] uint8_t edgeBits(uint32_t corner, uint32_t other) const {
    const uint32_t a = pointAt(next(other)), b = pointAt(before(other));
    const uint32_t n = pointAt(next(corner)), p = pointAt(before(corner));
    return static_cast<uint8_t>((n == a || n == b ? kNextEdge : 0) | (p == a || p == b ? kEdgeBefore : 0));
  }

  [[nodiscard]] double innerCosine(uint32_t face, uint32_t wall) const {
    return -dot(geometry_.normals[face], geometry_.normals[wall]);
  }

  /// Each sharp edge once, with the least angle of its faces.
  [[nodiscard]] std::vector<Edge> edgesOf(const SharpEdges& sharp) const {
    std::vector<Edge> edges;
    for (uint32_t corner = 0; corner < cornerBits_.size(); ++corner) {
      if (!sharp.hasEdge(corner / 3, corner % 3)) continue;
      const uint32_t a = pointAt(corner), b = pointAt(next(corner));
      Edge edge{std::min(a, b), std::max(a, b), -1, corner / 3};
      for (const uint32_t other : fans_.cornersAt(pointAt(corner)))
        if ((edgeBits(corner, other) & kNextEdge) != 0 && isThin(corner, other))
          edge.cosine = std::max(edge.cosine, innerCosine(corner / 3, other / 3));
      edges.push_back(edge);
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return std::tuple(a.a, a.b, -a.cosine, a.face) < std::tuple(b.a, b.b, -b.cosine, b.face);
    });
    edges.erase(
        std::unique(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.a == b.a && a.b == b.b; }),
        edges.end());
    return edges;
  }

  /// Lines of edges that are connected by common points.
  [[nodiscard]] std::vector<SharpLine> linesOf(const std::vector<Edge>& edges) {
    std::map<uint32_t, uint32_t> parents;
    const auto rootOf = [&](uint32_t point) {
      uint32_t root = point;
      while (parents.at(root) != root) root = parents.at(root);
      while (parents.at(point) != root) point = std::exchange(parents.at(point), root);
      return root;
    };
    for (const Edge& edge : edges) {
      parents.try_emplace(edge.a, edge.a);
      parents.try_emplace(edge.b, edge.b);
      parents[rootOf(edge.a)] = rootOf(edge.b);
    }
    std::map<uint32_t, SharpLine> lines;
    for (const Edge& edge : edges) {
      SharpLine& line = lines[rootOf(edge.a)];
      const Vec3d &a = mesh_.vertices[edge.a], &b = mesh_.vertices[edge.b];
      line.length += length(b - a);
      ++line.edgeCount;
      edgePoints_.insert({edge.a, edge.b});
      if (edge.cosine <= line.cosine) continue;
      line.cosine = edge.cosine;
      line.place = 0.5 * (a + b);
      line.face = edge.face;
    }
    std::vector<SharpLine> result;
    for (const auto& [root, line] : lines) result.push_back(line);
    return result;
  }

  void addTips(SharpEdges& sharp) const {
    std::vector<uint32_t> points;
    for (uint32_t corner = 0; corner < cornerBits_.size(); ++corner)
      if ((cornerBits_[corner] & kIsThin) != 0 && !edgePoints_.contains(pointAt(corner)))
        points.push_back(pointAt(corner));
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (const uint32_t point : points) {
      SharpLine tip{.place = mesh_.vertices[point]};
      forEachPair(point, [&](uint32_t corner, uint32_t other) {
        const double cosine = innerCosine(corner / 3, other / 3);
        if (cosine <= tip.cosine) return;
        tip.cosine = cosine;
        tip.face = corner / 3;
      });
      sharp.lines.push_back(tip);
    }
  }

  const TriangleMesh& mesh_;
  const FaceGeometry& geometry_;
  const PointFans& fans_;
  double maxCosine_, minDepth_;
  const Solids* solids_;
  std::vector<uint8_t> cornerBits_;  // 3 #F
  std::set<uint32_t> edgePoints_;
};

}  // namespace

SharpEdges findSharpEdges(const TriangleMesh& mesh, const FaceGeometry& geometry, const PointFans& fans,
                          double maxCosine, double minDepth, const Solids* solids) {
  return SharpSearch(mesh, geometry, fans, maxCosine, minDepth, solids).run();
}

}  // namespace asdfvk
