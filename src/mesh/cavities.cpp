#include "mesh/cavities.h"

#include <algorithm>
#include <array>
#include <compare>
#include <mutex>
#include <numeric>
#include <span>
#include <tuple>

#include "core/box3.h"
#include "core/parallel.h"
#include "mesh/component_samples.h"
#include "mesh/planar_kd_tree.h"

namespace asdfvk {
namespace {

// Rays run along the third axis of this frame. Faces and edges are often parallel to an axis, a coordinate plane or a
// diagonal; the frame is not.
Vec3d toRayFrame(const Vec3d& p) {
  static constexpr Vec3d kX{0.80134262, -0.56937194, -0.18349152}, kY{0.50881031, 0.48112718, 0.71386211};
  static constexpr Vec3d kZ = cross(kX, kY);  // Nearly orthonormal, which is sufficient for parity.
  return {dot(kX, p), dot(kY, p), dot(kZ, p)};
}

struct Surrounding {
  uint32_t sample = 0, component = 0;
  auto operator<=>(const Surrounding&) const = default;
};

// The side of p relative to an edge, computed from the lower vertex to the upper one. Both faces of an edge therefore
// have the same value: a ray that hits an edge crosses exactly one of the two faces, independent of rounding.
double sideOfEdge(const Face& face, const std::array<Vec3d, 3>& corners, size_t i, const Vec3d& p) {
  const size_t j = (i + 1) % 3;
  const auto plane = [](const Vec3d& v) { return Point2{v.x, v.y}; };
  return face[i] < face[j] ? sideOf(plane(corners[i]), plane(corners[j]), plane(p))
                           : -sideOf(plane(corners[j]), plane(corners[i]), plane(p));
}

bool isOnPositiveSide(const Face& face, size_t i, double side) {
  return side > 0 || (side == 0 && face[i] < face[(i + 1) % 3]);
}

bool rayCrosses(const Face& face, const std::array<Vec3d, 3>& corners, const Vec3d& p) {
  std::array<double, 3> sides;
  std::array<bool, 3> isPositive;
  for (size_t i = 0; i < 3; ++i) {
    sides[i] = sideOfEdge(face, corners, i, p);
    isPositive[i] = isOnPositiveSide(face, i, sides[i]);
  }
  if (isPositive[0] != isPositive[1] || isPositive[1] != isPositive[2]) return false;
  const double sum = sides[0] + sides[1] + sides[2];
  if (sum == 0) return false;
  const double height = (sides[0] * corners[2].z + sides[1] * corners[0].z + sides[2] * corners[1].z) / sum;
  return height > p.z;
}

/// For each sample: the components around the sample, other than its own, ascending.
std::vector<Surrounding> surroundingsOf(const ClosedComponents& closed, std::span<const Sample> samples) {
  std::vector<Vec3d> origins;
  std::vector<Point2> points;
  for (const Sample& sample : samples) {
    origins.push_back(toRayFrame(sample.point));
    points.push_back({origins.back().x, origins.back().y});
  }
  const PlanarKdTree tree(points);
  std::vector<Surrounding> crossings;
  std::mutex mutex;
  forEachRange(closed.mesh.faces.size(), kItemsPerTask / 4, [&](size_t begin, size_t end) {
    std::vector<Surrounding> found;
    for (uint32_t face = static_cast<uint32_t>(begin); face < end; ++face) {
      const uint32_t component = closed.components.componentOf[face];
      const Box3d& box = closed.boxes[component];
      if (box.isEmpty() || !hasDistinctVertices(closed.mesh.faces[face])) continue;
      std::array<Vec3d, 3> corners = closed.triangle(face);
      std::array<Point2, 3> triangle;
      for (size_t i = 0; i < 3; ++i) {
        corners[i] = toRayFrame(corners[i]);
        triangle[i] = {corners[i].x, corners[i].y};
      }
      tree.forEachNear(triangle, [&](uint32_t index) {
        const Sample& sample = samples[index];
        if (sample.component == component || !containsBy(0, box, {sample.point, sample.point})) return;
        if (rayCrosses(closed.mesh.faces[face], corners, origins[index])) found.push_back({index, component});
      });
    }
    const std::lock_guard lock(mutex);
    crossings.insert(crossings.end(), found.begin(), found.end());
  });
  std::sort(crossings.begin(), crossings.end());
  std::vector<Surrounding> surroundings;
  for (auto first = crossings.begin(); first != crossings.end();) {
    const auto last = std::upper_bound(first, crossings.end(), *first);
    if ((last - first) % 2 != 0) surroundings.push_back(*first);
    first = last;
  }
  return surroundings;
}

/// The components around all samples of one component.
struct Containers {
  std::vector<uint32_t> components;
  bool isCrossed = false;  // A component is around some of the samples, but not around all.
};

Containers containersOf(std::span<const Surrounding> surroundings, size_t sampleCount) {
  std::vector<uint32_t> around;
  for (const Surrounding& each : surroundings) around.push_back(each.component);
  std::sort(around.begin(), around.end());
  Containers containers;
  for (auto first = around.begin(); first != around.end();) {
    const auto last = std::upper_bound(first, around.end(), *first);
    if (static_cast<size_t>(last - first) == sampleCount)
      containers.components.push_back(*first);
    else
      containers.isCrossed = true;
    first = last;
  }
  return containers;
}

std::vector<Containers> allContainers(const ClosedComponents& closed) {
  const size_t count = closed.boxes.size();
  std::vector<Sample> samples;
  for (uint32_t component = 0; component < count; ++component) {
    if (closed.boxes[component].isEmpty()) continue;
    const std::array<Vec3d, 3> t = closed.triangle(closed.components.components[component].firstFace);
    samples.push_back({component, (t[0] + t[1] + t[2]) / 3.0});
  }
  std::vector<uint8_t> isWanted(count, 0);  // Whether at least one sample of a component is in another component.
  for (const Surrounding& each : surroundingsOf(closed, samples)) isWanted[samples[each.sample].component] = 1;
  samples = samplesOf(closed, isWanted);
  const std::vector<Surrounding> surroundings = surroundingsOf(closed, samples);
  std::vector<Containers> result(count);
  auto next = surroundings.begin();
  for (size_t first = 0, last = 0; first < samples.size(); first = last) {
    const uint32_t component = samples[first].component;
    while (last < samples.size() && samples[last].component == component) ++last;
    const auto begin = next;
    while (next != surroundings.end() && next->sample < last) ++next;
    result[component] = containersOf({begin, next}, last - first);
  }
  return result;
}

}  // namespace

Nesting findCavities(const TriangleMesh& mesh, const Components& components) {
  const size_t count = components.components.size();
  Nesting nesting{std::vector<uint8_t>(count, 0), std::vector<uint32_t>(count), {}};
  std::iota(nesting.bodyOf.begin(), nesting.bodyOf.end(), 0u);
  nesting.parentOf = nesting.bodyOf;
  const auto isClosed = [](const Component& component) { return component.isClosed; };
  if (std::count_if(components.components.begin(), components.components.end(), isClosed) < 2) return nesting;
  const ClosedComponents closed(mesh, components);
  const std::vector<Containers> containers = allContainers(closed);
  // Outer components come before the components inside of them.
  std::vector<uint32_t> order(count), depths(count, 0);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return closed.boxes[a].diagonal() > closed.boxes[b].diagonal(); });
  // A body that touches or crosses the cavity around it has the same depth as the cavity.
  const auto rankOf = [&](uint32_t c) {
    return std::tuple(depths[c], nesting.isCavity[c] == 0, -closed.boxes[c].diagonal());
  };
  for (const uint32_t inner : order) {
    uint32_t innermost = inner, body = inner;
    for (const uint32_t outer : containers[inner].components) {
      depths[inner] = std::max(depths[inner], depths[outer] + 1);
      if (innermost == inner || rankOf(outer) > rankOf(innermost)) innermost = outer;
      if (nesting.isCavity[outer] == 0 && (body == inner || rankOf(outer) > rankOf(body))) body = outer;
    }
    nesting.parentOf[inner] = innermost;
    if (innermost == inner) continue;
    const Component& component = components.components[inner];
    const bool hasWinding = component.isConsistentlyWound && component.signedVolume != 0;
    const bool isCavity = containers[inner].isCrossed && hasWinding ? component.signedVolume < 0 : body == innermost;
    if (!isCavity) continue;
    nesting.isCavity[inner] = 1;
    nesting.bodyOf[inner] = body;
  }
  return nesting;
}

}  // namespace asdfvk
