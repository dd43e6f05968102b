#include "trace/greatest_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "core/box3.h"
#include "core/matrix_game.h"
#include "trace/solid_surface.h"

namespace asdfvk {
namespace {

/// Number of faces of a solid from which rays go inwards.
constexpr size_t kRayCount = 16;

/// A set that no ball inside of the solid meets: a face, or the plane of a face that covers it below the box, or a ball
/// outside of the solid. The distance to each is a convex function.
struct Obstacle {
  uint32_t face = kNoFace;  ///< kNoFace for a ball.
  bool isPlane = false;
  uint32_t contradiction = kNoFace;  ///< A face that goes through the plane below a box around this one.
  Vec3d centre;                      ///< The centre of a ball.
  double radius = 0;
  double distances[kGameColumns] = {};  ///< From the corners of the box.
  Vec3d spread;                         ///< About how much the distance changes along each axis of the box.

  /// From the nearest point of the obstacle to p. triangle: that of a face.
  [[nodiscard]] Vec3d wayTo(const Vec3d& p, const PlaneTriangle& triangle) const {
    if (face == kNoFace) return p - centre;
    if (isPlane) return dot(p - triangle.corners[0], triangle.normal) * triangle.normal;
    return p - nearestPoint(triangle, p);
  }
};

/// Part of the box of the solid.
struct Node {
  CentredBox box;
  double bound = std::numeric_limits<double>::infinity();  ///< Bound of the radii of balls with centres in the box.
  size_t splitAxis = 0;
  size_t obstacleCount = 0;
  std::array<Obstacle, kMaxGameRows> all;

  [[nodiscard]] std::span<Obstacle> obstacles() { return std::span(all).first(obstacleCount); }
  [[nodiscard]] std::span<const Obstacle> obstacles() const { return std::span(all).first(obstacleCount); }
};

/// The nodes that may have a larger ball, the one with the greatest bound first.
class NodeQueue {
 public:
  [[nodiscard]] bool isEmpty() const { return order_.empty(); }
  [[nodiscard]] double bound() const { return order_.top().first; }

  void push(const Node& node) {
    if (free_.empty()) {
      free_.push_back(nodes_.size());
      nodes_.emplace_back();
    }
    nodes_[free_.back()] = node;
    order_.emplace(node.bound, free_.back());
    free_.pop_back();
  }
  Node pop() {
    free_.push_back(order_.top().second);
    order_.pop();
    return nodes_[free_.back()];
  }

 private:
  std::vector<Node> nodes_;
  std::vector<size_t> free_;
  std::priority_queue<std::pair<double, size_t>> order_;
};

class Search {
 public:
  explicit Search(const SolidSurface& surface) : surface_(surface) {}

  /// stopOnly: for cancellation.
  GreatestSection run(const Box3d& box, std::span<const uint32_t> faces, const SectionSearch& search, uint32_t maxBoxes,
                      const RunControl& stopOnly) {
    const size_t maxBoxCount = std::min<size_t>(maxBoxes + search.boxesPerFace * faces.size(), kMaxBoxCount);
    for (size_t i = 0; i < std::min(kRayCount, faces.size()); ++i)
      offerMiddle(faces[i * faces.size() / std::min(kRayCount, faces.size())]);
    Node root;
    root.box = {box.centre(), box.halfSize()};
    add(root);
    for (size_t count = 0; !nodes_.isEmpty() && nodes_.bound() > target(); ++count) {
      if (count % 256 == 0) stopOnly.checkpoint(0);
      const bool isDecided = 2 * radius_ >= search.enough || 2 * nodes_.bound() < search.enough;
      if (count == maxBoxCount || (isDecided && std::isfinite(search.enough)))
        return {centre_, 2 * radius_, 2 * nodes_.bound()};
      divide(nodes_.pop());
    }
    return {centre_, 2 * radius_, 2 * target()};
  }

 private:
  static constexpr int kMaxQueries = 3;
  /// Share of obstacles that the game does not use in the choice of the axis. They become useful in smaller boxes.
  static constexpr double kUnusedShare = 0.1;

  [[nodiscard]] double target() const { return (1 + kSectionTolerance) * radius_; }

  /// The ball in the middle of the ray from a face inwards.
  void offerMiddle(uint32_t face) {
    const PlaneTriangle triangle = surface_.triangle(face);
    const auto& [a, b, c] = triangle.corners;
    const Vec3d start = (a + b + c) / 3.0, inwards = -triangle.normal;
    const RayHit hit = surface_.hit(start + kContactDistance * inwards, inwards);
    if (hit.face == kNoFace) return;
    const Vec3d centre = start + 0.5 * (hit.distance + kContactDistance) * inwards;
    const SurfacePoint foot = surface_.nearest(centre);
    if (foot.side < 0) offer(centre, foot.distance);
  }

  void offer(const Vec3d& centre, double radius) {
    if (radius <= radius_) return;
    radius_ = radius;
    centre_ = centre;
  }

  void divide(Node node) {
    const size_t axis = node.splitAxis;
    const double half = node.box.half[axis] /= 2;
    Node upper = node;
    node.box.centre[axis] -= half;
    upper.box.centre[axis] += half;
    for (size_t i = 0; i < node.obstacleCount; ++i) {
      Obstacle &below = node.all[i], &above = upper.all[i];
      const PlaneTriangle triangle = triangleOf(below);
      for (size_t c = 0; c < kGameColumns; ++c)
        if ((c >> axis & 1) == 0)
          above.distances[c] = below.distances[c | size_t{1} << axis] =
              length(below.wayTo(upper.box.corner(c), triangle)) - below.radius;
      below.spread[axis] = above.spread[axis] = below.spread[axis] / 2;
    }
    add(node);
    add(upper);
  }

  void add(Node& node) {
    bound(node);
    if (node.bound > target()) nodes_.push(node);
  }

  /// Bounds the radii of balls with centres in the box of the node. No ball is larger than a convex combination of the
  /// distances from its centre to obstacles, and a convex function is greatest at a corner of the box. The best
  /// combination is that of a matrix game between obstacles and corners. The mean of the corners that the game takes
  /// has a ball that is nearly as large, or a further obstacle.
  void bound(Node& node) {
    for (int queries = 0;; ++queries) {
      GameSolution game;
      Vec3d point = node.box.centre;
      if (node.obstacleCount > 0) {
        game = solve(node);
        if (node.bound <= target()) return;
        if (flattenAny(node)) {
          game = solve(node);
          if (node.bound <= target()) return;
        }
        point = {};
        for (size_t c = 0; c < kGameColumns; ++c) point += game.columns[c] * node.box.corner(c);
      }
      if (queries == kMaxQueries || !addObstacle(node, point, game)) break;
    }
  }

  static GameSolution solve(Node& node) {
    double payoffs[kMaxGameRows][kGameColumns];
    for (size_t i = 0; i < node.obstacleCount; ++i) std::copy_n(node.all[i].distances, kGameColumns, payoffs[i]);
    const GameSolution game = solveGame(std::span(payoffs).first(node.obstacleCount));
    node.bound = std::min(node.bound, game.value);
    std::array<double, 3> spread{};
    for (size_t i = 0; i < node.obstacleCount; ++i)
      for (size_t axis = 0; axis < 3; ++axis) spread[axis] += (game.rows[i] + kUnusedShare) * node.all[i].spread[axis];
    node.splitAxis = static_cast<size_t>(std::max_element(spread.begin(), spread.end()) - spread.begin());
    if (spread[node.splitAxis] <= 0) node.splitAxis = node.box.longestAxis();
    return game;
  }

  [[nodiscard]] PlaneTriangle triangleOf(const Obstacle& obstacle) const {
    return obstacle.face != kNoFace ? surface_.triangle(obstacle.face) : PlaneTriangle{};
  }

  static void measure(const CentredBox& box, const PlaneTriangle& triangle, Obstacle& obstacle) {
    obstacle.spread = {};
    for (size_t c = 0; c < kGameColumns; ++c) {
      const Vec3d way = obstacle.wayTo(box.corner(c), triangle);
      const double distance = length(way);
      obstacle.distances[c] = distance - obstacle.radius;
      for (size_t axis = 0; axis < 3 && distance > 0; ++axis)
        obstacle.spread[axis] = std::max(obstacle.spread[axis], std::abs(way[axis]) / distance * box.half[axis]);
    }
  }

  bool flattenAny(Node& node) const {
    bool isFlat = false;
    for (Obstacle& obstacle : node.obstacles()) isFlat = flatten(node.box, obstacle) || isFlat;
    return isFlat;
  }

  /// Replaces a face by its plane where the plane is a nearer obstacle.
  bool flatten(const CentredBox& box, Obstacle& obstacle) const {
    if (obstacle.face == kNoFace || obstacle.isPlane) return false;
    const PlaneTriangle triangle = surface_.triangle(obstacle.face);
    bool isNearer = false;
    for (size_t c = 0; c < kGameColumns; ++c)
      isNearer = isNearer || std::abs(dot(box.corner(c) - triangle.corners[0], triangle.normal)) <
                                 obstacle.distances[c] - kSectionTolerance / 4 * radius_;
    if (!isNearer || !surface_.coversPlaneBelow(box, obstacle.face, obstacle.contradiction)) return false;
    obstacle.isPlane = true;
    measure(box, triangle, obstacle);
    return true;
  }

  /// A distance of the surface from p that is known from the obstacles.
  [[nodiscard]] double knownDistance(const Node& node, const Vec3d& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Obstacle& obstacle : node.obstacles())
      if (obstacle.face != kNoFace) least = std::min(least, length(obstacle.wayTo(p, triangleOf(obstacle))));
    return least + kFlat;
  }

  /// Adds what limits the ball around a point of the box. Returns false if this is no further obstacle.
  bool addObstacle(Node& node, const Vec3d& point, const GameSolution& game) {
    const double reach = node.box.reachFrom(point);
    const double enough = target() - reach;
    const SurfacePoint foot = surface_.nearest(point, enough, knownDistance(node, point));
    if (foot.face == kNoFace) return false;
    if (foot.distance < enough) {  // It need not be the nearest point.
      node.bound = std::min(node.bound, foot.distance + reach);
      return false;
    }
    Obstacle added;
    added.face = foot.face;
    if (foot.side < 0) {
      offer(point, foot.distance);
    } else if (surface_.leavesEmpty(node.box) && surface_.nearest(node.box.centre).side >= 0) {
      node.bound = 0;
      return false;
    } else if (2 * foot.distance > reach) {
      added.face = kNoFace;
      added.centre = point;
      added.radius = foot.distance;
    }
    const std::span<const Obstacle> known = node.obstacles();
    if (added.face != kNoFace &&
        std::any_of(known.begin(), known.end(), [&](const Obstacle& other) { return other.face == added.face; }))
      return false;
    measure(node.box, triangleOf(added), added);
    const size_t index = node.obstacleCount < kMaxGameRows
                             ? node.obstacleCount++
                             : static_cast<size_t>(std::min_element(game.rows, game.rows + kMaxGameRows) - game.rows);
    node.all[index] = added;
    return true;
  }

  const SolidSurface& surface_;
  NodeQueue nodes_;
  double radius_ = 0;
  Vec3d centre_;
};

}  // namespace

std::vector<GreatestSection> findGreatestSections(const TraceScene& scene, std::span<const uint32_t> solidOf,
                                                  std::span<const uint8_t> isWanted, const SectionSearch& search,
                                                  const RunControl& control) {
  const Buckets<uint32_t> copies = groupCopies(scene.representatives);
  std::vector<Box3d> boxes(isWanted.size());
  std::vector<std::vector<uint32_t>> faces(isWanted.size());
  for (uint32_t face = 0; face < scene.mesh.faceCount(); ++face) {
    const uint32_t solid = solidOf[face];
    if (isWanted[solid] == 0 || scene.geometry.isDegenerate(face)) continue;
    faces[solid].push_back(face);
    for (const uint32_t vertex : scene.mesh.faces[face])
      boxes[solid].add(scene.bvh.normalization.toNormalized(scene.mesh.vertices[vertex]));
  }
  const auto wanted = static_cast<uint32_t>(std::count(isWanted.begin(), isWanted.end(), 1));
  const uint32_t maxBoxes = std::max(search.boxCount / std::max(wanted, 1u), kLeastBoxCount);
  std::vector<GreatestSection> sections(isWanted.size());
  for (uint32_t solid = 0; solid < sections.size(); ++solid) {
    control.checkpoint(static_cast<double>(solid) / static_cast<double>(sections.size()));
    if (isWanted[solid] == 0) continue;
    const SolidSurface surface(scene, copies, solidOf, solid);
    sections[solid] = Search(surface).run(boxes[solid], faces[solid], search, maxBoxes, control.withoutProgress());
  }
  return sections;
}

void searchInexactSections(const TraceScene& scene, std::span<const uint32_t> solidOf,
                           std::span<const uint8_t> isWanted, const SectionSearch& search, const RunControl& control,
                           std::vector<GreatestSection>& sections) {
  std::vector<uint8_t> isInexact(sections.size());
  for (size_t solid = 0; solid < sections.size(); ++solid)
    isInexact[solid] = isWanted[solid] != 0 && !sections[solid].isExact() ? 1 : 0;
  if (std::find(isInexact.begin(), isInexact.end(), 1) == isInexact.end()) return;
  const std::vector<GreatestSection> found = findGreatestSections(scene, solidOf, isInexact, search, control);
  for (size_t solid = 0; solid < sections.size(); ++solid)
    if (isInexact[solid] != 0) sections[solid] = found[solid];
}

}  // namespace asdfvk
