#include "render/sample_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr int kTileSide = 16;  ///< In samples.
/// A tile is searched for its farthest sample only after so many changes, so that the search costs little.
constexpr int kWritesPerSearch = 128;

/// First and last whole number i in [begin, end) with low <= i + 0.5 <= high. If there is none, last < first.
std::pair<int, int> centresWithin(double low, double high, int begin, int end) {
  // Uses conversions, because without SSE 4.1, std::ceil and std::floor are function calls.
  const double from = std::clamp(low - 0.5, double(begin), double(end));
  const double to = std::clamp(high - 0.5, double(begin) - 1, double(end) - 1);
  const int first = static_cast<int>(from), last = static_cast<int>(to);
  return {first + (first < from ? 1 : 0), last - (last > to ? 1 : 0)};
}

/// An edge from its end with the smaller y, so that both triangles of the edge cross a row at the same x.
struct RowEdge {
  Point2 low, high;
  double slope = 0;

  RowEdge(const Projected& a, const Projected& b)
      : low{a.x, a.y}, high{b.x, b.y}, slope(b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0) {}

  [[nodiscard]] double crossing(double y) const {
    return std::clamp(low.x + (y - low.y) * slope, std::min(low.x, high.x), std::max(low.x, high.x));
  }
};

/// The triangle between its edges, and its depth as a linear function.
struct RowTriangle {
  std::array<Projected, 3> sorted;  ///< By ascending y.
  RowEdge whole, upper, lower;
  double depthPerX = 0, depthPerY = 0;

  /// corners: by ascending y, then x.
  explicit RowTriangle(const std::array<Projected, 3>& corners)
      : sorted(corners), whole(corners[0], corners[2]), upper(corners[0], corners[1]), lower(corners[1], corners[2]) {
    const auto& [a, b, c] = sorted;
    const double scale = 1 / ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    depthPerX = ((b.depth - a.depth) * (c.y - a.y) - (c.depth - a.depth) * (b.y - a.y)) * scale;
    depthPerY = ((c.depth - a.depth) * (b.x - a.x) - (b.depth - a.depth) * (c.x - a.x)) * scale;
  }

  /// The part of a row inside of the triangle; the second end is below the first if there is none.
  [[nodiscard]] std::pair<double, double> spanAt(double y) const {
    if (y < sorted[0].y || y > sorted[2].y) return {1, 0};
    const double one = whole.crossing(y), other = y < sorted[1].y ? upper.crossing(y) : lower.crossing(y);
    return {std::min(one, other), std::max(one, other)};
  }

  [[nodiscard]] double depthAt(double x, double y) const {
    return sorted[0].depth + depthPerX * (x - sorted[0].x) + depthPerY * (y - sorted[0].y);
  }
};

}  // namespace

SampleRows::SampleRows(int width, int top, int bottom, int perSide, bool keepsIndices)
    : width_(width), top_(top), bottom_(bottom), perSide_(perSide), tileColumns_((width + kTileSide - 1) / kTileSide) {
  const auto count = static_cast<size_t>(width) * static_cast<size_t>(bottom - top);
  depths_.assign(count, -kInfinity);
  if (keepsIndices) indices_.assign(count, kNoSample);
  tiles_.resize(static_cast<size_t>(tileColumns_) * static_cast<size_t>((bottom - top + kTileSide - 1) / kTileSide));
}

bool SampleRows::isHidden(int tileColumn, int tileRow, float nearest) {
  Tile& tile = tiles_[tileAt(tileColumn, tileRow)];
  if (tile.farthest < nearest && tile.writeCount >= kWritesPerSearch) {
    tile = {kInfinity, 0};
    const int left = tileColumn * kTileSide, right = std::min(left + kTileSide, width_);
    const int top = top_ + tileRow * kTileSide, bottom = std::min(top + kTileSide, bottom_);
    for (int row = top; row < bottom; ++row)
      for (int column = left; column < right; ++column)
        tile.farthest = std::min(tile.farthest, depths_[indexOf(column, row)]);
  }
  return tile.farthest >= nearest;
}

bool SampleRows::hides(const SampleBox& box) {
  constexpr int kMaxTileCount = 64;
  const auto [firstRow, lastRow] = centresWithin(box.top - 1, box.bottom + 1, top_, bottom_);
  const auto [firstColumn, lastColumn] = centresWithin(box.left - 1, box.right + 1, 0, width_);
  if (firstRow > lastRow || firstColumn > lastColumn) return true;
  const int left = firstColumn / kTileSide, right = lastColumn / kTileSide;
  const int top = (firstRow - top_) / kTileSide, bottom = (lastRow - top_) / kTileSide;
  if ((right - left + 1) * (bottom - top + 1) > kMaxTileCount) return false;
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column)
      if (!isHidden(column, row, static_cast<float>(box.nearest))) return false;
  return true;
}

int SampleRows::drawRow(uint32_t index, int row, std::pair<int, int> columns, const DepthLine& line) {
  float* const depths = &depths_[indexOf(0, row)];
  uint32_t* const indices = indices_.empty() ? nullptr : &indices_[indexOf(0, row)];
  int writeCount = 0;
  for (int column = columns.first; column <= columns.second; column += perSide_) {
    const auto depth =
        static_cast<float>(std::clamp(line.atZero + line.perColumn * column, line.farthest, line.nearest));
    if (depth <= depths[column]) continue;
    depths[column] = depth;
    if (indices != nullptr) indices[column] = index;
    ++writeCount;
  }
  return writeCount;
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

  std::array<Projected, 3> sorted = corners;
  std::sort(sorted.begin(), sorted.end(), [](const Projected& one, const Projected& other) {
    return std::tie(one.y, one.x) < std::tie(other.y, other.x);
  });
  const RowTriangle triangle(sorted);
  const double farthest = std::min({a.depth, b.depth, c.depth}), nearest = std::max({a.depth, b.depth, c.depth});
  const double middle = (perSide_ - 1) / 2.0;
  const auto line = [&](double depthAtZero) { return DepthLine{depthAtZero, triangle.depthPerX, farthest, nearest}; };
  const int firstTile = firstColumn / kTileSide, lastTile = lastColumn / kTileSide;
  for (int tileRow = (firstRow - top_) / kTileSide; tileRow <= (lastRow - top_) / kTileSide; ++tileRow) {
    const int tileTop = top_ + tileRow * kTileSide;
    const int rowsBegin = std::max(firstRow, tileTop), rowsEnd = std::min(lastRow, tileTop + kTileSide - 1) + 1;
    const auto isHiddenIn = [&](int tile) {
      const double x = (tile + (triangle.depthPerX > 0 ? 1 : 0)) * kTileSide;
      const double y = tileTop + (triangle.depthPerY > 0 ? kTileSide : 0);
      return isHidden(tile, tileRow, static_cast<float>(std::clamp(triangle.depthAt(x, y), farthest, nearest)));
    };
    for (int tile = firstTile; tile <= lastTile; ++tile) {
      if (isHiddenIn(tile)) continue;
      const int runBegin = tile;
      while (tile < lastTile && !isHiddenIn(tile + 1)) ++tile;
      const int columnsBegin = std::max(firstColumn, runBegin * kTileSide);
      const int columnsEnd = std::min(lastColumn, tile * kTileSide + kTileSide - 1) + 1;
      int writeCount = 0;
      for (int row = rowsBegin; row < rowsEnd; ++row) {
        const double xShift = ((row & (perSide_ - 1)) - middle) / perSide_;
        for (int phase = 0; phase < perSide_; ++phase) {
          const double y = row + 0.5 - (phase - middle) / perSide_;
          const auto [from, to] = triangle.spanAt(y);
          if (to < from) continue;
          const auto [first, last] = centresWithin(from - xShift, to - xShift, columnsBegin, columnsEnd);
          const int begin = first + ((phase - first) & (perSide_ - 1));
          if (begin <= last) writeCount += drawRow(index, row, {begin, last}, line(triangle.depthAt(0.5 + xShift, y)));
        }
      }
      for (int written = runBegin; written <= tile; ++written)
        tiles_[tileAt(written, tileRow)].writeCount += writeCount / (tile - runBegin + 1);
    }
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
    : scene_(scene), grid_(grid), vertices_(scene.mesh.vertices.size()) {
  forEachInParallel(vertices_.size(), [&](uint32_t vertex) {
    vertices_[vertex] = grid.project(scene.bvh.normalization.toNormalized(scene.mesh.vertices[vertex]));
  });
}

SampleBox ProjectedFaces::boxOf(const BvhNode& node) const {
  const Vec3d low(node.min), high(node.max), half = (high - low) * 0.5;
  const Projected middle = grid_.project((low + high) * 0.5);
  const auto reach = [&](const Vec3d& axis) {
    return std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
  };
  const Camera& camera = grid_.camera;
  const double scale = grid_.perSide / camera.pixelSize;
  const double across = scale * reach(camera.right), along = scale * reach(camera.up);
  return {middle.x - across, middle.y - along, middle.x + across, middle.y + along,
          middle.depth + reach(camera.toViewer)};
}

void ProjectedFaces::drawOn(SampleRows& rows) const {
  const Bvh& bvh = scene_.bvh;
  if (bvh.nodes.empty()) return;
  std::vector<std::pair<uint32_t, SampleBox>> open{{0, boxOf(bvh.nodes[0])}};
  while (!open.empty()) {
    const auto [index, box] = open.back();
    open.pop_back();
    if (rows.hides(box)) continue;
    const BvhNode& node = bvh.nodes[index];
    for (uint32_t i = 0; i < node.triangleCount; ++i) {
      const uint32_t face = bvh.primitiveFaces[node.first + i];
      rows.draw(face, cornersOf(face));
    }
    if (node.isLeaf()) continue;
    std::pair<uint32_t, SampleBox> nearer{node.first, boxOf(bvh.nodes[node.first])};
    std::pair<uint32_t, SampleBox> farther{node.first + 1, boxOf(bvh.nodes[node.first + 1])};
    if (nearer.second.nearest < farther.second.nearest) std::swap(nearer, farther);
    open.push_back(farther);
    open.push_back(nearer);
  }
}

}  // namespace asdfvk
