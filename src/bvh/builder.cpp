#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <memory>

#include "bvh/bvh.h"
#include "bvh/subtree.h"
#include "core/check.h"

namespace asdfvk {
namespace {

float roundedDown(double d) {
  const auto f = static_cast<float>(d);
  return static_cast<double>(f) > d ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

// Rounding down is at or below rounding to nearest, so the box holds the corners as doubles and as floats.
SplitBox outerBox(const Mesh& mesh, const Face& face, const Normalization& normalization) {
  SplitBox box = SplitBox::empty();
  for (const uint32_t vertex : face) {
    const Vec3d p = normalization.toNormalized(mesh.vertices[vertex]);
    const Quad lower = {roundedDown(p.x), roundedDown(p.y), roundedDown(p.z), 0};
    const Quad negatedUpper = {roundedDown(-p.x), roundedDown(-p.y), roundedDown(-p.z), 0};
    box.grow({lower, negatedUpper});
  }
  return box;
}

std::vector<SplitTriangle> collectTriangles(const Mesh& mesh, const FaceGeometry& geometry,
                                            std::span<const uint32_t> representatives,
                                            const Normalization& normalization, SplitBounds& bounds) {
  const auto isFiniteFace = [&](uint32_t f) {
    for (const uint32_t vertex : mesh.faces[f])
      if (!isFinite(normalization.toNormalized(mesh.vertices[vertex]))) return false;
    return true;
  };
  std::vector<uint32_t> faces;
  faces.reserve(mesh.faces.size());
  for (uint32_t f = 0; f < mesh.faceCount(); ++f)
    if (representatives[f] == f && !geometry.isDegenerate(f) && isFiniteFace(f)) faces.push_back(f);
  std::vector<SplitTriangle> triangles(faces.size());
  tbb::parallel_for(size_t{0}, faces.size(), [&](size_t i) {
    triangles[i] = {outerBox(mesh, mesh.faces[faces[i]], normalization), faces[i]};
  });
  for (const SplitTriangle& t : triangles) bounds.grow(t.box);
  return triangles;
}

// A finished run of nodes and where it goes: its root to `index`, the rest from `next` on.
struct Placement {
  const std::vector<BvhNode>& run;
  uint32_t index = 0, next = 0;
};

// Lays the runs of a finished subtree end to end and writes the nodes above them. A node's place is given by its
// parent; what is below it follows from `next` on: first the pair of children, then all below the left one, then all
// below the right one. Returns where the subtree ends.
uint32_t place(const Subtree& subtree, uint32_t index, uint32_t next, std::vector<BvhNode>& nodes,
               std::vector<Placement>& placements) {
  if (!subtree.left) {
    placements.push_back({subtree.nodes, index, next});
    return next + static_cast<uint32_t>(subtree.nodes.size()) - 1;
  }
  nodes[index] = subtree.box.toNode(next, 0);
  const uint32_t afterLeft = place(*subtree.left, next, next + 2, nodes, placements);
  return place(*subtree.right, next + 1, afterLeft, nodes, placements);
}

std::vector<BvhNode> assemble(const Subtree& root) {
  std::vector<BvhNode> nodes(root.nodeCount);
  std::vector<Placement> placements;
  place(root, 0, 1, nodes, placements);
  tbb::parallel_for(size_t{0}, placements.size(), [&](size_t p) {
    const auto& [run, index, next] = placements[p];
    for (size_t i = 0; i < run.size(); ++i) {
      BvhNode node = run[i];
      if (!node.isLeaf()) node.first += next - 1;
      nodes[i == 0 ? index : next + i - 1] = node;
    }
  });
  return nodes;
}

}  // namespace

Bvh buildBvh(const Mesh& mesh, const FaceGeometry& geometry, std::span<const uint32_t> representatives,
             const BvhOptions& options) {
  ASDFVK_CHECK_OP(representatives.size(), ==, mesh.faces.size());
  ASDFVK_CHECK_OP(options.maxLeafTriangleCount, >, 0u);
  Bvh bvh;
  bvh.normalization = normalizationOf(geometry.bounds);
  SplitBounds bounds;
  std::vector<SplitTriangle> triangles = collectTriangles(mesh, geometry, representatives, bvh.normalization, bounds);
  if (triangles.empty()) return bvh;
  bvh.slotFaces.resize(triangles.size());
  const std::unique_ptr<Subtree> root = buildSubtree(triangles, bounds, bvh.slotFaces, 0, 0, options);
  bvh.depth = root->depth;
  bvh.nodes = assemble(*root);
  return bvh;
}

}  // namespace asdfvk
