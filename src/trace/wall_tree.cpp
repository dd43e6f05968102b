#include "trace/wall_tree.h"

#include <algorithm>
#include <cmath>

#include "core/box3.h"
#include "core/parallel.h"
#include "mesh/coincident_faces.h"
#include "trace/ball_packet.h"

namespace asdfvk {
namespace {

/// Nodes with more walls have no cylinder (WallNode::axis), because so many walls rarely fit into a small cylinder.
constexpr uint32_t kMaxDiscWallCount = 4096;
/// Nodes with up to this number of walls are leaves, because a test of these walls takes less time than a further level
/// of the hierarchy.
constexpr uint32_t kMaxLeafWallCount = 4;

}  // namespace

WallTree::WallTree(const TraceScene& scene, const OpposingWalls& opposing, const Solids* solids,
                   const RunControl& stopOnly)
    : scene_(scene), opposing_(opposing), nodes_(scene.bvh.nodes.size()), wallOf_(scene.mesh.faceCount()) {
  const Buckets<uint32_t> copies = groupCopies(scene.representatives);
  const std::span<const uint32_t> primitives = scene.bvh.primitiveFaces;
  const auto bodyOf = [&](uint32_t face) { return solids == nullptr ? kNoBody : solids->bodyOf(face); };
  std::vector<uint32_t> faces, repeated, wallOfPrimitive(primitives.size() + 1);
  faces.reserve(scene.mesh.faceCount());
  stopOnly.checkpoint(0);
  for (size_t i = 0; i < primitives.size(); ++i) {
    for (const uint32_t face : copies[primitives[i]]) {
      const auto isSame = [&](uint32_t other) { return bodyOf(other) == bodyOf(face); };
      const bool isRepeated = std::any_of(faces.begin() + wallOfPrimitive[i], faces.end(), isSame);
      (isRepeated ? repeated : faces).push_back(face);
    }
    wallOfPrimitive[i + 1] = static_cast<uint32_t>(faces.size());
  }
  faces.insert(faces.end(), repeated.begin(), repeated.end());
  walls_.resize(faces.size());
  forEachInParallel(faces.size(), [&](size_t i) {
    wallOf_[faces[i]] = static_cast<uint32_t>(i);
    walls_[i] = wallOf(faces[i]);
    walls_[i].body = bodyOf(faces[i]);
  });
  stopOnly.checkpoint(0);
  std::vector<uint32_t> firstWalls(nodes_.size()), wallCounts(nodes_.size());
  for (size_t i = nodes_.size(); i-- > 0;) {  // Children follow their parents.
    const BvhNode& node = scene.bvh.nodes[i];
    firstWalls[i] =
        node.isLeaf() ? wallOfPrimitive[node.first] : std::min(firstWalls[node.first], firstWalls[node.first + 1]);
    wallCounts[i] = node.isLeaf() ? wallOfPrimitive[node.first + node.triangleCount] - firstWalls[i]
                                  : wallCounts[node.first] + wallCounts[node.first + 1];
    Box3f normals;
    if (node.isLeaf()) {
      for (uint32_t k = 0; k < wallCounts[i]; ++k) normals.add(walls_[firstWalls[i] + k].normal);
    } else {
      for (const uint32_t child : {node.first, node.first + 1})
        normals.add({nodes_[child].normalMin, nodes_[child].normalMax});
    }
    const Vec3f middle = walls_[firstWalls[i] + wallCounts[i] / 2].middle;
    const bool isLeaf = node.isLeaf() || wallCounts[i] <= kMaxLeafWallCount;
    nodes_[i] = {.min = node.min,
                 .max = node.max,
                 .normalMin = normals.min,
                 .normalMax = normals.max,
                 .middle = middle,
                 .radius = kUnlimitedDiameter,
                 .first = isLeaf ? firstWalls[i] : node.first,
                 .wallCount = isLeaf ? wallCounts[i] : 0};
  }
  stopOnly.checkpoint(0);
  forEachInParallel(nodes_.size(), [&](size_t i) {
    if (wallCounts[i] > kMaxDiscWallCount) return;
    WallNode& node = nodes_[i];
    const std::span<const Wall> walls = std::span(walls_).subspan(firstWalls[i], wallCounts[i]);
    Vec3f sum{};
    for (const Wall& wall : walls) sum += wall.normal;
    const float norm = std::sqrt(dot(sum, sum));
    if (norm > 0) node.axis = sum / norm;
    node.radius = node.lowest = node.highest = 0;
    float square = 0;
    for (const Wall& wall : walls)
      for (const Vec3f& spoke : wall.spokes) {
        const Vec3f v = wall.middle + spoke - node.middle;
        const float along = dot(v, node.axis);
        node.lowest = std::min(node.lowest, along);
        node.highest = std::max(node.highest, along);
        square = std::max(square, dot(v, v) - along * along);
      }
    node.radius = std::sqrt(square) + kWallPlaneMargin;
    node.reach = node.radius + std::max(node.highest, -node.lowest);
    node.lowest -= kWallPlaneMargin;
    node.highest += kWallPlaneMargin;
  });
}

void WallTree::shrink(std::span<BallQuery> queries, InstructionSet instructionSet) const {
  dispatch<Float16>(instructionSet, [&]<typename Floats>() ASDFVK_ALWAYS_INLINE {
    for (size_t begin = 0; begin < queries.size(); begin += kLaneCount<Floats>) {
      const std::span<BallQuery> own = queries.subspan(begin, std::min(kLaneCount<Floats>, queries.size() - begin));
      BallPacket<Floats> packet(*this, own);
      uint32_t last = kNoFace;
      const auto offer = [&](uint32_t wall) ASDFVK_ALWAYS_INLINE {
        if (wall != kNoFace && wall != last) packet.offer(walls_[wallOf_[wall]]);
        last = wall;
      };
      for (const BallQuery& query : own)
        for (const uint32_t wall : query.hints) offer(wall);
      if (begin > 0) {
        for (const BallQuery& before : queries.subspan(begin - kLaneCount<Floats>, kLaneCount<Floats>))
          for (const uint32_t wall : {before.atPoint.wall, before.least.wall}) offer(wall);
      }
      packet.run();
    }
  });
}

Wall WallTree::wallOf(uint32_t face) const {
  const PlaneTriangle triangle = triangleOf(scene_, face);
  const Vec3d middle = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0;
  Box3f box;
  for (const Vec3d& corner : triangle.corners) box.add(Vec3f(corner));
  Wall wall{.normal = Vec3f(triangle.normal),
            .offset = static_cast<float>(dot(triangle.normal, triangle.corners[0])),
            .min = box.min,
            .max = box.max,
            .middle = Vec3f(middle),
            .face = face};
  for (size_t k = 0; k < 3; ++k) {
    wall.spokes[k] = Vec3f(triangle.corners[k] - middle);
    wall.reach = std::max(wall.reach, length(wall.spokes[k]));
  }
  return wall;
}

}  // namespace asdfvk
