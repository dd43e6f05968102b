#include "render/draft_renderer.h"

#include <algorithm>

#include "core/parallel.h"
#include "render/sample_rows.h"
#include "trace/nearest_hit.h"

namespace asdfvk {
namespace {

constexpr int kSamples = 2;     ///< Per side of a pixel.
constexpr int kBandRows = 128;  ///< Of samples. Every band reads all faces.
constexpr double kDraftAmbient = 0.4, kDraftDiffuse = 0.65;

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
  const SampleGrid grid{camera, kSamples};
  std::vector<Projected> projected(mesh.vertices.size());
  forEachInParallel(projected.size(), [&](uint32_t vertex) {
    projected[vertex] = grid.project(scene.bvh.normalization.toNormalized(mesh.vertices[vertex]));
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
    SampleRows rows(kSamples * image.width(), top, bottom);
    for (const uint32_t face : scene.bvh.primitiveFaces) {
      const auto [a, b, c] = mesh.faces[face];
      rows.draw(face, projected[a], projected[b], projected[c]);
    }
    for (int y = top / kSamples; y < bottom / kSamples; ++y)
      for (int x = 0; x < image.width(); ++x) {
        const Vec3d behind = toLinear(image.at(x, y));
        Vec3d sum;
        bool isEmpty = true;
        for (int i = 0; i < kSamples * kSamples; ++i) {
          const uint32_t face = rows.indexAt(kSamples * x + i % kSamples, kSamples * y + i / kSamples);
          isEmpty = isEmpty && face == kNoSample;
          sum += face == kNoSample ? behind : shade(face);
        }
        if (!isEmpty) image.at(x, y) = toRgb(sum / double{kSamples * kSamples});
      }
  });
}

}  // namespace asdfvk
