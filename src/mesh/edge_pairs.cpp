#include "mesh/edge_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/check.h"

namespace asdfvk {
namespace {

// Faces whose angles differ by less touch each other: coordinates in float32 do not resolve the difference.
constexpr double kSameAngleRadians = 1e-6;

struct FaceAtEdge {
  uint32_t corner = 0;
  double angle = 0;          // Around the edge, counter-clockwise as seen against its direction.
  bool hasMaterial = false;  // On the side of greater angles.
};

/// The angles relative to the first face, in [0, 2 pi).
std::vector<FaceAtEdge> facesAround(const TriangleMesh& mesh, std::span<const EdgeEntry> around) {
  const Face& first = mesh.faces[around[0].face()];
  const uint32_t from = first[around[0].corner % 3];
  const Vec3d origin = mesh.vertices[from];
  const Vec3d edge = mesh.vertices[first[(around[0].corner + 1) % 3]] - origin;
  const double scale = 1 / std::max({std::abs(edge.x), std::abs(edge.y), std::abs(edge.z)});
  const Vec3d axis = edge * scale / length(edge * scale);
  Vec3d x, y;
  std::vector<FaceAtEdge> faces;
  for (const EdgeEntry& entry : around) {
    const Face& face = mesh.faces[entry.face()];
    const Vec3d apex = (mesh.vertices[face[(entry.corner + 2) % 3]] - origin) * scale;
    if (faces.empty()) {
      x = apex - dot(apex, axis) * axis;
      y = cross(axis, x);
    }
    double angle = std::atan2(dot(apex, y), dot(apex, x));
    if (angle < 0) angle += 2 * std::numbers::pi;
    if (!(angle >= 0)) angle = 0;  // Differences of huge coordinates overflow.
    // The outward normal of a face that runs along the axis points to greater angles.
    faces.push_back(
        {entry.corner, angle < 2 * std::numbers::pi - kSameAngleRadians ? angle : 0, face[entry.corner % 3] != from});
  }
  return faces;
}

}  // namespace

std::vector<CornerPair> pairsAroundEdge(const TriangleMesh& mesh, std::span<const EdgeEntry> around) {
  std::vector<FaceAtEdge> faces = facesAround(mesh, around);
  const auto openingCount =
      std::count_if(faces.begin(), faces.end(), [](const auto& each) { return each.hasMaterial; });
  if (2 * static_cast<size_t>(openingCount) != faces.size()) return {};
  std::sort(faces.begin(), faces.end(),
            [](const auto& a, const auto& b) { return std::tuple(a.angle, a.corner) < std::tuple(b.angle, b.corner); });
  double angle = faces[0].angle;
  for (size_t i = 1; i < faces.size(); ++i) {
    if (faces[i].angle - angle >= kSameAngleRadians) angle = faces[i].angle;
    faces[i].angle = angle;
  }
  // At the same angle, the material of the faces before ends first.
  const auto order = [](const FaceAtEdge& each) {
    return std::tuple(each.angle, each.hasMaterial, each.hasMaterial ? ~each.corner : each.corner);
  };
  std::sort(faces.begin(), faces.end(), [&](const auto& a, const auto& b) { return order(a) < order(b); });
  // Begins where the fewest pairs are open, so that each pair is closed at the end.
  int depth = 0, least = 0;
  size_t begin = 0;
  for (size_t i = 0; i < faces.size(); ++i) {
    depth += faces[i].hasMaterial ? 1 : -1;
    if (depth < least) {
      least = depth;
      begin = i + 1;
    }
  }
  std::rotate(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(begin), faces.end());
  std::vector<CornerPair> pairs;
  std::vector<uint32_t> open;
  for (const FaceAtEdge& each : faces) {
    if (each.hasMaterial) {
      open.push_back(each.corner);
      continue;
    }
    ASDFVK_CHECK(!open.empty());
    pairs.emplace_back(open.back(), each.corner);
    open.pop_back();
  }
  return pairs;
}

}  // namespace asdfvk
