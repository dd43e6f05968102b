#include "render/draft_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

constexpr int kSamples = 2;     ///< Per side of a pixel.
constexpr int kBandRows = 128;  ///< Of samples. Every band reads all faces.
constexpr double kDraftAmbient = 0.4, kDraftDiffuse = 0.65;

/// A vertex in units of samples, x to the right, y down, depth towards the viewer.
struct Projected {
  float x, y, depth;
};

/// The rows of samples from `top`, below `bottom`.
class Band {
 public:
  Band(int width, int top, int bottom) : width_(width), top_(top), bottom_(bottom) {
    const auto count = static_cast<size_t>(width) * static_cast<size_t>(bottom - top);
    depths_.assign(count, -std::numeric_limits<float>::infinity());
    faces_.assign(count, kNoFace);
  }

  void draw(uint32_t face, const Projected& a, const Projected& b, const Projected& c) {
    const auto [low, high] = std::minmax({a.y, b.y, c.y});
    const int firstRow = std::max(top_, static_cast<int>(std::ceil(low - 0.5f)));
    const int lastRow = std::min(bottom_ - 1, static_cast<int>(std::floor(high - 0.5f)));
    if (firstRow > lastRow) return;
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const int firstColumn = std::max(0, static_cast<int>(std::ceil(left - 0.5f)));
    const int lastColumn = std::min(width_ - 1, static_cast<int>(std::floor(right - 0.5f)));
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) return;
    for (int row = firstRow; row <= lastRow; ++row)
      for (int column = firstColumn; column <= lastColumn; ++column) {
        const float x = static_cast<float>(column) + 0.5f, y = static_cast<float>(row) + 0.5f;
        const float ofA = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / area;
        const float ofB = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / area;
        const float ofC = 1 - ofA - ofB;
        if (ofA < 0 || ofB < 0 || ofC < 0) continue;
        const float depth = ofA * a.depth + ofB * b.depth + ofC * c.depth;
        const size_t sample = indexOf(column, row);
        if (depth <= depths_[sample]) continue;
        depths_[sample] = depth;
        faces_[sample] = face;
      }
  }

  [[nodiscard]] uint32_t faceAt(int column, int row) const { return faces_[indexOf(column, row)]; }

 private:
  [[nodiscard]] size_t indexOf(int column, int row) const {
    return static_cast<size_t>(row - top_) * static_cast<size_t>(width_) + static_cast<size_t>(column);
  }

  int width_, top_, bottom_;
  std::vector<float> depths_;
  std::vector<uint32_t> faces_;
};

}  // namespace

std::vector<Vec3d> verticesOfHitFaces(const TraceScene& scene) {
  std::vector<uint8_t> isUsed(scene.mesh.vertices.size(), 0);
  for (const uint32_t face : scene.bvh.primitiveFaces)
    for (const uint32_t vertex : scene.mesh.faces[face]) isUsed[vertex] = 1;
  std::vector<Vec3d> points;
  for (size_t vertex = 0; vertex < isUsed.size(); ++vertex)
    if (isUsed[vertex] != 0) points.push_back(scene.bvh.normalization.toNormalized(scene.mesh.vertices[vertex]));
  return points;
}

void renderDraft(Image& image, const TraceScene& scene, const Camera& camera, std::span<const Rgb> faceColours) {
  const TriangleMesh& mesh = scene.mesh;
  std::vector<Projected> projected(mesh.vertices.size());
  forEachInParallel(projected.size(), [&](uint32_t vertex) {
    const Vec3d p = scene.bvh.normalization.toNormalized(mesh.vertices[vertex]) - camera.centre;
    projected[vertex] = {static_cast<float>(kSamples * (camera.centreX + dot(p, camera.right) / camera.pixelSize)),
                         static_cast<float>(kSamples * (camera.centreY - dot(p, camera.up) / camera.pixelSize)),
                         static_cast<float>(dot(p, camera.toViewer))};
  });
  const Vec3d light = unitVector(camera.toViewer + camera.up * 0.5 - camera.right * 0.4, camera.toViewer);
  const auto shade = [&](uint32_t face) {
    const double facing = std::abs(dot(scene.geometry.normals[face], light));
    return toLinear(faceColours[face]) * (kDraftAmbient + kDraftDiffuse * facing);
  };
  static_assert(kBandRows % kSamples == 0);
  const int rowCount = kSamples * image.height();
  forEachTask(static_cast<size_t>((rowCount + kBandRows - 1) / kBandRows), [&](size_t index) {
    const int top = static_cast<int>(index) * kBandRows, bottom = std::min(rowCount, top + kBandRows);
    Band band(kSamples * image.width(), top, bottom);
    for (const uint32_t face : scene.bvh.primitiveFaces) {
      const auto [a, b, c] = mesh.faces[face];
      band.draw(face, projected[a], projected[b], projected[c]);
    }
    for (int y = top / kSamples; y < bottom / kSamples; ++y)
      for (int x = 0; x < image.width(); ++x) {
        const Vec3d behind = toLinear(image.at(x, y));
        Vec3d sum;
        bool isEmpty = true;
        for (int i = 0; i < kSamples * kSamples; ++i) {
          const uint32_t face = band.faceAt(kSamples * x + i % kSamples, kSamples * y + i / kSamples);
          isEmpty = isEmpty && face == kNoFace;
          sum += face == kNoFace ? behind : shade(face);
        }
        if (!isEmpty) image.at(x, y) = toRgb(sum / double{kSamples * kSamples});
      }
  });
}

}  // namespace asdfvk
