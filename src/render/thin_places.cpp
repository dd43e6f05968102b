#include "render/thin_places.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "render/sample_rows.h"

namespace asdfvk {
namespace {

/// Sum over the regions of the square root of the number of their visible samples.
double visibilityOf(const TraceScene& scene, Surface places, std::span<const uint32_t> regions,
                    std::span<const Vec3d> points, const View& view) {
  constexpr int kWidth = 240, kHeight = 180;
  const Camera camera = frameCamera(points, view, {0, 0, kWidth, kHeight});
  const SampleGrid grid{camera, 1};
  SampleRows mesh(kWidth, 0, kHeight), surface(kWidth, 0, kHeight);
  ProjectedFaces(scene, grid).drawOn(mesh);
  drawSurface(surface, projectSurface(scene, grid, places));
  std::vector<double> counts(1 + *std::max_element(regions.begin(), regions.end()), 0);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (isAtSurface(mesh, surface, x, y)) counts[regions[surface.indexAt(x, y)]] += 1;
  double sum = 0;
  for (const double count : counts) sum += std::sqrt(count);
  return sum;
}

}  // namespace

View bestViewOf(const TraceScene& scene, Surface places, std::span<const uint32_t> regions, const View& view) {
  if (places.empty()) return view;
  const std::vector<Vec3d> points = verticesOfHitFaces(scene);
  View base = view;
  if (!base.up) base.up = guessUp(points);
  // The usual view comes first, so that the usual view is chosen among equally good views.
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
