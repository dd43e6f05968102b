#include "mesh/curvature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/bucket_sort.h"
#include "core/check.h"
#include "core/parallel.h"
#include "core/raise_flag.h"
#include "mesh/dual_graph.h"

namespace asdfvk {
namespace {

constexpr double kPi = std::numbers::pi;

// Divides by the greatest absolute coordinate, so that products neither underflow nor overflow; zero stays zero.
Vec3d scaledToOne(const Vec3d& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 ? v / largest : v;
}

double angleAt(const Vec3d& apex, const Vec3d& b, const Vec3d& c) {
  const bool touchesB = apex == b, touchesC = apex == c;
  if (touchesB && touchesC) return kPi / 3;
  if (touchesB || touchesC) return kPi / 2;
  const Vec3d toB = scaledToOne(b - apex), toC = scaledToOne(c - apex);
  return std::atan2(length(cross(toB, toC)), dot(toB, toC));
}

}  // namespace

std::vector<double> vertexAngleDefects(const TriangleMesh& mesh) {
  const auto takesPart = [&](uint32_t f) { return hasDistinctVertices(mesh.faces[f]) && mesh.hasFiniteCorners(f); };
  std::vector<uint8_t> isOnBoundary(mesh.vertices.size(), 0);
  const UnsetVector<EdgeKind> kinds = surveyEdges(mesh).edgeKinds;
  forEachInParallel(mesh.faces.size(), [&](uint32_t f) {
    for (size_t i = 0; i < 3; ++i) {
      if (kinds[size_t{3} * f + i] != EdgeKind::Boundary) continue;
      raiseFlag(isOnBoundary[mesh.faces[f][i]]);
      raiseFlag(isOnBoundary[mesh.faces[f][(i + 1) % 3]]);
    }
  });
  const Buckets<uint32_t> facesOf =
      sortIntoBuckets<uint32_t>(mesh.vertices.size(), mesh.faces.size(), [&](uint32_t f, auto&& put) {
        if (!takesPart(f)) return;
        for (uint32_t vertex : mesh.faces[f]) put(vertex, f);
      });
  std::vector<double> defects(mesh.vertices.size(), 0);
  forEachInParallel(mesh.vertices.size(), [&](uint32_t vertex) {
    if (facesOf[vertex].empty()) return;
    double defect = isOnBoundary[vertex] ? kPi : 2 * kPi;
    for (uint32_t f : facesOf[vertex]) {
      const Face& face = mesh.faces[f];
      const size_t corner = static_cast<size_t>(std::find(face.begin(), face.end(), vertex) - face.begin());
      defect -=
          angleAt(mesh.vertices[vertex], mesh.vertices[face[(corner + 1) % 3]], mesh.vertices[face[(corner + 2) % 3]]);
    }
    defects[vertex] = defect;
  });
  return defects;
}

std::vector<double> faceCurvature(const TriangleMesh& mesh) {
  const std::vector<double> defects = vertexAngleDefects(mesh);
  std::vector<double> curvature(mesh.faces.size());
  forEachInParallel(mesh.faces.size(), [&](uint32_t f) {
    const auto [a, b, c] = mesh.faces[f];
    curvature[f] = (defects[a] + defects[b] + defects[c]) / 3;
  });
  return curvature;
}

}  // namespace asdfvk
