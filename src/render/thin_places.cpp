#include "render/thin_places.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "render/draft_renderer.h"
#include "render/sample_rows.h"

namespace asdfvk {
namespace {

constexpr int kThinSamples = 3;        ///< Per side of a pixel.
constexpr int kThinBandRows = 96;      ///< Of samples.
constexpr float kDepthSlack = 1e-5F;   ///< In normalised units: parts of a face are at its depth, up to rounding.
constexpr double kHiddenShare = 0.45;  ///< Of the alarm colour where the surface is behind faces.
static_assert(kThinBandRows % kThinSamples == 0);

using Surface = std::span<const std::array<Vec3d, 3>>;

/// Mesh and surface on a grid of samples.
class ProjectedPlaces {
 public:
  ProjectedPlaces(const TraceScene& scene, Surface surface, const SampleGrid& grid)
      : scene_(scene), vertices_(scene.mesh.vertices.size()), surface_(surface.size()) {
    const Normalization& normalization = scene.bvh.normalization;
    forEachInParallel(vertices_.size(), [&](uint32_t vertex) {
      vertices_[vertex] = grid.project(normalization.toNormalized(scene.mesh.vertices[vertex]));
    });
    forEachInParallel(surface_.size(), [&](uint32_t i) {
      for (size_t k = 0; k < 3; ++k) surface_[i][k] = grid.project(normalization.toNormalized(surface[i][k]));
    });
  }

  void drawMesh(SampleRows& rows) const {
    for (const uint32_t face : scene_.bvh.primitiveFaces) {
      const auto [a, b, c] = scene_.mesh.faces[face];
      rows.draw(face, vertices_[a], vertices_[b], vertices_[c]);
    }
  }
  void drawSurface(SampleRows& rows) const {
    for (uint32_t i = 0; i < surface_.size(); ++i) rows.draw(i, surface_[i][0], surface_[i][1], surface_[i][2]);
  }

 private:
  const TraceScene& scene_;
  std::vector<Projected> vertices_;
  std::vector<std::array<Projected, 3>> surface_;
};

bool isVisible(const SampleRows& mesh, const SampleRows& surface, int column, int row) {
  return surface.depthAt(column, row) >= mesh.depthAt(column, row) - kDepthSlack;
}

/// Sum over the regions of the square root of their visible samples.
double visibilityOf(const TraceScene& scene, Surface places, std::span<const uint32_t> regions,
                    std::span<const Vec3d> points, const View& view) {
  constexpr int kWidth = 240, kHeight = 180;
  const Camera camera = frameCamera(points, view, {0, 0, kWidth, kHeight});
  const ProjectedPlaces projected(scene, places, {camera, 1});
  SampleRows mesh(kWidth, 0, kHeight), surface(kWidth, 0, kHeight);
  projected.drawMesh(mesh);
  projected.drawSurface(surface);
  std::vector<double> counts(1 + *std::max_element(regions.begin(), regions.end()), 0);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (const uint32_t index = surface.indexAt(x, y); index != kNoSample && isVisible(mesh, surface, x, y))
        counts[regions[index]] += 1;
  double sum = 0;
  for (const double count : counts) sum += std::sqrt(count);
  return sum;
}

}  // namespace

void paintThinPlaces(Image& image, const TraceScene& scene, const Camera& camera, Surface places) {
  if (places.empty()) return;
  const ProjectedPlaces projected(scene, places, {camera, kThinSamples});
  const Vec3d alarm = toLinear(kAlarm), neutral = toLinear(kNeutral);
  const Vec3d tint{alarm.x / neutral.x, alarm.y / neutral.y, alarm.z / neutral.z};
  const int rowCount = kThinSamples * image.height();
  forEachTask(static_cast<size_t>((rowCount + kThinBandRows - 1) / kThinBandRows), [&](size_t index) {
    const int top = static_cast<int>(index) * kThinBandRows, bottom = std::min(rowCount, top + kThinBandRows);
    SampleRows mesh(kThinSamples * image.width(), top, bottom), surface(kThinSamples * image.width(), top, bottom);
    projected.drawMesh(mesh);
    projected.drawSurface(surface);
    for (int y = top / kThinSamples; y < bottom / kThinSamples; ++y)
      for (int x = 0; x < image.width(); ++x) {
        double visible = 0, hidden = 0;
        for (int i = 0; i < kThinSamples * kThinSamples; ++i) {
          const int column = kThinSamples * x + i % kThinSamples, row = kThinSamples * y + i / kThinSamples;
          if (surface.indexAt(column, row) == kNoSample) continue;
          (isVisible(mesh, surface, column, row) ? visible : hidden) += 1.0 / (kThinSamples * kThinSamples);
        }
        if (visible + hidden == 0) continue;
        const Vec3d body = toLinear(image.at(x, y));
        const Vec3d through = body * (1 - kHiddenShare) + alarm * kHiddenShare;
        const Vec3d lit{body.x * tint.x, body.y * tint.y, body.z * tint.z};
        image.at(x, y) = toRgb(body * (1 - visible - hidden) + lit * visible + through * hidden);
      }
  });
}

View bestViewOf(const TraceScene& scene, Surface places, std::span<const uint32_t> regions, const View& view) {
  if (places.empty()) return view;
  const std::vector<Vec3d> points = verticesOfHitFaces(scene);
  View base = view;
  if (!base.up) base.up = guessUp(points);
  // The usual view first: of equal ones it is the best.
  std::vector<View> candidates;
  for (const double elevation : {base.elevationDegrees, 50.0, -30.0})
    for (const double turn : {0.0, -60.0, 120.0, 180.0})
      candidates.push_back({base.up, base.azimuthDegrees + turn, elevation});
  std::vector<double> scores(candidates.size());
  forEachTask(candidates.size(),
              [&](size_t i) { scores[i] = visibilityOf(scene, places, regions, points, candidates[i]); });
  constexpr double kClearlyBetter = 1.1;
  size_t best = 0;
  for (size_t i = 1; i < candidates.size(); ++i)
    if (scores[i] > kClearlyBetter * scores[best]) best = i;
  return candidates[best];
}

}  // namespace asdfvk
