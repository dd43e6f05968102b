#include "segment/normal_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr uint32_t kFilterRoundCount = 5;
/// The width of the filter is this factor times the square of the noise: curvature and uneven faces look like little
/// noise, and must remain.
constexpr double kWidthOverSquaredNoise = 10;
/// With fewer faces, most faces are at edges of the shape, which look like noise.
constexpr size_t kMinFilteredFaceCount = 1000;
/// Below this noise the filter would change no normal by more than a fraction of a degree.
constexpr double kMinNoise = 0.02;

double noiseOf(std::span<const Vec3d> normals, std::span<const float> areas, const DualGraph& graph) {
  std::vector<double> distances;
  for (uint32_t face = 0; face < normals.size(); ++face) {
    const std::span<const uint32_t> neighbours = graph.neighboursOf(face);
    if (neighbours.size() < 3 || !(areas[face] > 0)) continue;
    Vec3d sum{};
    for (const uint32_t neighbour : neighbours) sum += normals[neighbour];
    distances.push_back(length(normals[face] - sum / static_cast<double>(neighbours.size())));
  }
  if (distances.empty()) return 0;
  const auto median = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), median, distances.end());
  return *median;
}

}  // namespace

std::vector<Vec3d> filterNormals(std::span<const Vec3d> normals, std::span<const float> areas, const DualGraph& graph) {
  ASDFVK_CHECK_OP(normals.size(), ==, areas.size());
  std::vector<Vec3d> filtered(normals.begin(), normals.end());
  if (normals.size() < kMinFilteredFaceCount) return filtered;
  const double noise = noiseOf(normals, areas, graph);
  if (noise < kMinNoise) return filtered;
  const double width = kWidthOverSquaredNoise * noise * noise;
  std::vector<Vec3d> next(filtered.size());
  for (uint32_t round = 0; round < kFilterRoundCount; ++round) {
    forEachInParallel(filtered.size(), [&](uint32_t face) {
      const Vec3d& normal = filtered[face];
      Vec3d sum = normal * double{areas[face]};
      for (const uint32_t neighbour : graph.neighboursOf(face)) {
        const Vec3d between = normal - filtered[neighbour];
        sum +=
            filtered[neighbour] * (double{areas[neighbour]} * std::exp(-dot(between, between) / (2 * width * width)));
      }
      const double norm = length(sum);
      next[face] = norm > 0 ? sum / norm : normal;
    });
    std::swap(filtered, next);
  }
  return filtered;
}

}  // namespace asdfvk
