#include "render/sample_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/parallel.h"

namespace asdfvk {
namespace {

/// First and last whole number i in [begin, end) with low <= i + 0.5 <= high. If there is none, last < first.
std::pair<int, int> centresWithin(double low, double high, int begin, int end) {
  // Uses conversions, because without SSE 4.1, std::ceil and std::floor are function calls.
  const double from = std::clamp(low - 0.5, double(begin), double(end));
  const double to = std::clamp(high - 0.5, double(begin) - 1, double(end) - 1);
  const int first = static_cast<int>(from), last = static_cast<int>(to);
  return {first + (first < from ? 1 : 0), last - (last > to ? 1 : 0)};
}

}  // namespace

SampleRows::SampleRows(int width, int top, int bottom, int perSide)
    : width_(width), top_(top), bottom_(bottom), perSide_(perSide) {
  const auto count = static_cast<size_t>(width) * static_cast<size_t>(bottom - top);
  depths_.assign(count, -std::numeric_limits<float>::infinity());
  indices_.assign(count, kNoSample);
}

void SampleRows::draw(uint32_t index, const std::array<Projected, 3>& corners) {
  const auto& [a, b, c] = corners;
  // The greatest distance of a sample from the centre of its square, along one axis.
  const double shift = 0.5 - 0.5 / perSide_;
  const auto [low, high] = std::minmax({a.y, b.y, c.y});
  const auto [firstRow, lastRow] = centresWithin(low - shift, high + shift, top_, bottom_);
  if (firstRow > lastRow) return;
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [firstColumn, lastColumn] = centresWithin(left - shift, right + shift, 0, width_);
  if (firstColumn > lastColumn || (b.x - a.x) * (c.y - a.y) == (b.y - a.y) * (c.x - a.x)) return;
  for (int row = firstRow; row <= lastRow; ++row)
    for (int column = firstColumn; column <= lastColumn; ++column) {
      const auto [ofA, ofB, ofC] = cornerShares(corners, placeOf(column, row));
      if (ofA < 0 || ofB < 0 || ofC < 0) continue;
      const auto depth = static_cast<float>(ofA * a.depth + ofB * b.depth + ofC * c.depth);
      const size_t sample = indexOf(column, row);
      if (depth <= depths_[sample]) continue;
      depths_[sample] = depth;
      indices_[sample] = index;
    }
}

ProjectedSurface projectSurface(const TraceScene& scene, const SampleGrid& grid, Surface surface) {
  ProjectedSurface projected(surface.size());
  for (size_t i = 0; i < surface.size(); ++i)
    for (size_t k = 0; k < 3; ++k) projected[i][k] = grid.project(scene.bvh.normalization.toNormalized(surface[i][k]));
  return projected;
}

void drawSurface(SampleRows& rows, const ProjectedSurface& surface) {
  for (uint32_t i = 0; i < surface.size(); ++i) rows.draw(i, surface[i]);
}

std::vector<Vec3d> verticesOfHitFaces(const TraceScene& scene) {
  std::vector<uint8_t> isUsed(scene.mesh.vertices.size(), 0);
  for (const uint32_t face : scene.bvh.primitiveFaces)
    for (const uint32_t vertex : scene.mesh.faces[face]) isUsed[vertex] = 1;
  std::vector<Vec3d> points;
  for (size_t vertex = 0; vertex < isUsed.size(); ++vertex)
    if (isUsed[vertex] != 0) points.push_back(scene.bvh.normalization.toNormalized(scene.mesh.vertices[vertex]));
  return points;
}

ProjectedFaces::ProjectedFaces(const TraceScene& scene, const SampleGrid& grid)
    : scene_(scene), vertices_(scene.mesh.vertices.size()) {
  forEachInParallel(vertices_.size(), [&](uint32_t vertex) {
    vertices_[vertex] = grid.project(scene.bvh.normalization.toNormalized(scene.mesh.vertices[vertex]));
  });
}

}  // namespace asdfvk
