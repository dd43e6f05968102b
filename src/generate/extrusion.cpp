#include "generate/extrusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

namespace asdfvk::solids {
namespace {

/// Twice the area of a triangle; positive if it turns left.
double turn(const OutlinePoint& a, const OutlinePoint& b, const OutlinePoint& c) {
  return (b.first - a.first) * (c.second - a.second) - (b.second - a.second) * (c.first - a.first);
}

bool isEar(const Outline& outline, const std::vector<uint32_t>& rest, const std::array<uint32_t, 3>& corners) {
  const OutlinePoint &a = outline[corners[0]], &b = outline[corners[1]], &c = outline[corners[2]];
  if (turn(a, b, c) <= 1e-12) return false;
  return std::none_of(rest.begin(), rest.end(), [&](uint32_t i) {
    if (std::find(corners.begin(), corners.end(), i) != corners.end()) return false;
    const OutlinePoint& p = outline[i];
    return turn(a, b, p) >= -1e-12 && turn(b, c, p) >= -1e-12 && turn(c, a, p) >= -1e-12;
  });
}

/// Cuts ears from the outline, which turns left; the ear with the shortest cut first.
std::vector<Face> triangulated(const Outline& outline) {
  std::vector<uint32_t> rest(outline.size());
  std::iota(rest.begin(), rest.end(), 0u);
  std::vector<Face> faces;
  while (rest.size() > 2) {
    std::optional<size_t> best;
    double shortest = 0;
    for (size_t k = 0; k < rest.size(); ++k) {
      const std::array corners{rest[(k + rest.size() - 1) % rest.size()], rest[k], rest[(k + 1) % rest.size()]};
      if (!isEar(outline, rest, corners)) continue;
      const OutlinePoint &a = outline[corners[0]], &c = outline[corners[2]];
      const double cut = std::hypot(a.first - c.first, a.second - c.second);
      if (best && cut >= shortest) continue;
      best = k;
      shortest = cut;
    }
    const size_t k = best.value();
    faces.push_back({rest[(k + rest.size() - 1) % rest.size()], rest[k], rest[(k + 1) % rest.size()]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return faces;
}

}  // namespace

Mesh extruded(Outline outline, double height) {
  double area = 0;
  for (size_t i = 0; i < outline.size(); ++i) area += turn({0, 0}, outline[i], outline[(i + 1) % outline.size()]);
  if (area < 0) std::reverse(outline.begin(), outline.end());
  const auto count = static_cast<uint32_t>(outline.size());
  Mesh mesh;
  for (const double z : {0.0, height})
    for (const auto& [x, y] : outline) mesh.vertices.push_back({x, y, z});
  for (const auto& [a, b, c] : triangulated(outline)) {
    mesh.faces.push_back({c, b, a});
    mesh.faces.push_back({count + a, count + b, count + c});
  }
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t next = (i + 1) % count;
    mesh.faces.push_back({i, next, count + next});
    mesh.faces.push_back({i, count + next, count + i});
  }
  return mesh;
}

Outline arc(double x, double y, double radius, double fromDegrees, double toDegrees, uint32_t sideCount) {
  Outline points;
  for (uint32_t i = 0; i <= sideCount; ++i) {
    const double angle = (fromDegrees + (toDegrees - fromDegrees) * i / sideCount) * std::numbers::pi / 180;
    points.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle));
  }
  return points;
}

Mesh refined(Mesh mesh, double longestEdge) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  std::vector<Face> open = std::move(mesh.faces);
  mesh.faces.clear();
  while (!open.empty()) {
    const Face face = open.back();
    open.pop_back();
    size_t longest = 0;
    std::array<double, 3> lengths{};
    for (size_t k = 0; k < 3; ++k) lengths[k] = length(mesh.vertices[face[(k + 1) % 3]] - mesh.vertices[face[k]]);
    for (size_t k = 1; k < 3; ++k)
      if (lengths[k] > lengths[longest]) longest = k;
    if (lengths[longest] <= longestEdge) {
      mesh.faces.push_back(face);
      continue;
    }
    const uint32_t a = face[longest], b = face[(longest + 1) % 3], c = face[(longest + 2) % 3];
    const auto [found, isNew] =
        middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<uint32_t>(mesh.vertices.size()));
    if (isNew) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) / 2.0);
    open.push_back({a, found->second, c});
    open.push_back({found->second, b, c});
  }
  return mesh;
}

Mesh turned(Mesh mesh, double yaw, double pitch) {
  for (Vec3d& v : mesh.vertices) {
    const double x = v.x * std::cos(yaw) - v.y * std::sin(yaw), y = v.x * std::sin(yaw) + v.y * std::cos(yaw);
    v = {x, y * std::cos(pitch) - v.z * std::sin(pitch), y * std::sin(pitch) + v.z * std::cos(pitch)};
  }
  return mesh;
}

}  // namespace asdfvk::solids
