#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bvh/bvh.h"
#include "bvh/subtree.h"
#include "core/check.h"
#include "core/unset_vector.h"

namespace asdfvk {
namespace {

// Faces that are looked at by one task.
constexpr size_t kBlockFaceCount = 4096;

// At or below the number itself, and at or below it rounded to nearest: lowered by at least the error of rounding,
// without a branch on what that is.
float roundedDown(double d) { return static_cast<float>(d - std::abs(d) * 0x1p-23 - 0x1p-149); }

// Holds the corners as doubles and as floats.
SplitBox outerBox(const TriangleMesh& mesh, const Face& face, const Normalization& normalization) {
  const Vec3d &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]], &c = mesh.vertices[face[2]];
  const auto least = [](double x, double y, double z) { return std::min(std::min(x, y), z); };
  const auto greatest = [](double x, double y, double z) { return std::max(std::max(x, y), z); };
  const Vec3d min = normalization.toNormalized({least(a.x, b.x, c.x), least(a.y, b.y, c.y), least(a.z, b.z, c.z)});
  const Vec3d max =
      normalization.toNormalized({greatest(a.x, b.x, c.x), greatest(a.y, b.y, c.y), greatest(a.z, b.z, c.z)});
  const Float4 lower = {roundedDown(min.x), roundedDown(min.y), roundedDown(min.z), 0};
  const Float4 negatedUpper = {roundedDown(-max.x), roundedDown(-max.y), roundedDown(-max.z), 0};
  return {lower, negatedUpper};
}

bool isFinite(const SplitBox& box) {
  bool finite = true;
  for (size_t axis = 0; axis < 3; ++axis)
    finite = finite && std::isfinite(box.lower[axis]) && std::isfinite(box.negatedUpper[axis]);
  return finite;
}

// In the order of the faces.
UnsetVector<SplitTriangle> collectTriangles(const TriangleMesh& mesh, const FaceGeometry& geometry,
                                            std::span<const uint32_t> representatives,
                                            const Normalization& normalization) {
  UnsetVector<SplitTriangle> triangles(mesh.faces.size());
  std::vector<size_t> counts((mesh.faces.size() + kBlockFaceCount - 1) / kBlockFaceCount);
  tbb::parallel_for(size_t{0}, counts.size(), [&](size_t block) {
    const size_t begin = block * kBlockFaceCount, end = std::min(begin + kBlockFaceCount, mesh.faces.size());
    SplitTriangle* next = &triangles[begin];
    for (auto f = static_cast<uint32_t>(begin); f < end; ++f) {
      if (representatives[f] != f || geometry.isDegenerate(f)) continue;
      const SplitBox box = outerBox(mesh, mesh.faces[f], normalization);
      if (isFinite(box)) *next++ = {box, f};
    }
    counts[block] = static_cast<size_t>(next - &triangles[begin]);
  });
  size_t count = 0;
  for (size_t block = 0; block < counts.size(); ++block) {
    const size_t begin = block * kBlockFaceCount;
    if (count < begin) std::copy_n(&triangles[begin], counts[block], &triangles[count]);
    count += counts[block];
  }
  triangles.resize(count);
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
uint32_t place(const Subtree& subtree, uint32_t index, uint32_t next, std::span<BvhNode> nodes,
               std::vector<Placement>& placements) {
  if (!subtree.left) {
    placements.push_back({subtree.nodes, index, next});
    return next + static_cast<uint32_t>(subtree.nodes.size()) - 1;
  }
  nodes[index] = subtree.box.toNode(next, 0);
  const uint32_t afterLeft = place(*subtree.left, next, next + 2, nodes, placements);
  return place(*subtree.right, next + 1, afterLeft, nodes, placements);
}

UnsetVector<BvhNode> assemble(const Subtree& root) {
  UnsetVector<BvhNode> nodes(root.nodeCount);
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

Bvh buildBvh(const TriangleMesh& mesh, const FaceGeometry& geometry, std::span<const uint32_t> representatives,
             const BvhOptions& options) {
  ASDFVK_CHECK_OP(representatives.size(), ==, mesh.faces.size());
  ASDFVK_CHECK_OP(options.maxLeafTriangleCount, >, 0u);
  Bvh bvh;
  bvh.normalization = normalizationOf(geometry.bounds);
  UnsetVector<SplitTriangle> triangles = collectTriangles(mesh, geometry, representatives, bvh.normalization);
  if (triangles.empty()) return bvh;
  bvh.slotFaces.resize(triangles.size());
  const std::unique_ptr<Subtree> root = buildSubtree(triangles, bvh.slotFaces, 0, 0, options);
  triangles = {};
  bvh.depth = root->depth;
  bvh.nodes = assemble(*root);
  return bvh;
}

}  // namespace asdfvk
