#include "reprojection/reprojection.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "reprojection/landed_seeds.h"
#include "reprojection/reprojected_cone.h"

namespace asdfvk {
namespace {

// A seed whose normal is this far from the face's weighs exp(-1/2).
constexpr double kNormalReachRadians = 0.5;
// So that a lone seed, however far, is better than none.
constexpr double kLeastConeWeight = 1e-6;

/// Fills the faces of one cell at a time.
class CellReprojection {
 public:
  CellReprojection(const TraceScene& scene, const Cone& cone, const TracedCones& traced,
                   std::span<const LengthWindow> windows, const SeedCells& cells, const Buckets<uint32_t>& landed,
                   const ReprojectionOptions& options)
      : scene_(scene),
        traced_(traced),
        cells_(cells),
        landed_(landed),
        options_(options),
        hits_(scene, cone, traced, windows),
        cone_(cone) {}

  void run(uint32_t cell, std::vector<double>& values) {
    const std::vector<uint32_t> cones =
        nearestCells(cells_, scene_.geometry, traced_.seeds, cell, options_.neighbourCount);
    hits_.gather(cones);
    const double reach = options_.reach * halfMeanDistance(cones);
    const size_t antipodalCount = options_.antipodal > 0 ? hits_.append(antipodalPoints(cell)) : 0;
    coneWeights_.assign(cones.size() + antipodalCount, static_cast<float>(options_.antipodal));
    for (const uint32_t face : cells_.faces[cell]) {
      if (scene_.geometry.isDegenerate(face)) continue;
      for (size_t i = 0; i < cones.size(); ++i) coneWeights_[i] = coneWeight(face, traced_.seeds[cones[i]], reach);
      const VirtualCone at{scene_.bvh.normalization.toNormalized(scene_.geometry.barycentres[face]),
                           scene_.geometry.normals[face], scene_.representatives[face]};
      values[face] = scene_.bvh.normalization.toMeshLength(cone_.value(hits_, at, coneWeights_));
    }
  }

 private:
  [[nodiscard]] std::vector<GatheredHits::Point> antipodalPoints(uint32_t cell) const {
    const Normalization& normalization = scene_.bvh.normalization;
    std::vector<GatheredHits::Point> points;
    for (const uint32_t seed : landed_[cell]) {
      const uint32_t face = traced_.seeds[seed];
      double area = 0;
      for (const uint32_t other : cells_.faces[seed]) area += scene_.geometry.areas[other];
      points.push_back({normalization.toNormalized(scene_.geometry.barycentres[face]), scene_.geometry.normals[face],
                        area * normalization.scale * normalization.scale, scene_.representatives[face]});
    }
    return points;
  }

  /// Of the first cone's seed to the others', in the mesh's unit.
  [[nodiscard]] double halfMeanDistance(const std::vector<uint32_t>& cones) const {
    const Vec3d& centre = scene_.geometry.barycentres[traced_.seeds[cones[0]]];
    double sum = 0;
    for (const uint32_t cone : cones) sum += length(scene_.geometry.barycentres[traced_.seeds[cone]] - centre);
    return sum / static_cast<double>(2 * std::max<size_t>(1, cones.size() - 1));
  }

  [[nodiscard]] float coneWeight(uint32_t face, uint32_t seed, double reach) const {
    const Vec3d between = scene_.geometry.barycentres[seed] - scene_.geometry.barycentres[face];
    const double cosine = dot(scene_.geometry.normals[seed], scene_.geometry.normals[face]);
    const double turn = std::acos(std::clamp(cosine, -1.0, 1.0)) / kNormalReachRadians;
    const double steps = reach > 0 ? dot(between, between) / (reach * reach) : 0.0;
    return static_cast<float>(std::max(std::exp(-0.5 * (steps + turn * turn)), kLeastConeWeight));
  }

  const TraceScene& scene_;
  const TracedCones& traced_;
  const SeedCells& cells_;
  const Buckets<uint32_t>& landed_;
  const ReprojectionOptions& options_;
  GatheredHits hits_;
  ReprojectedCone cone_;
  std::vector<float> coneWeights_;
};

}  // namespace

std::vector<double> reprojectHits(const TraceScene& scene, const Cone& cone, const TracedCones& traced,
                                  const SeedCells& cells, const ReprojectionOptions& options) {
  ASDFVK_CHECK_OP(traced.hits.size(), ==, traced.seeds.size() * cone.directions.size());
  std::vector<double> values(scene.geometry.areas.size(), kNoValue);
  const std::vector<LengthWindow> windows = keptLengths(scene, cone, traced);
  const Buckets<uint32_t> landed =
      options.antipodal > 0 ? landedSeeds(cone, scene, traced, windows, cells) : Buckets<uint32_t>{};
  tbb::parallel_for(tbb::blocked_range<uint32_t>(0, static_cast<uint32_t>(traced.seeds.size()), 64),
                    [&](const tbb::blocked_range<uint32_t>& range) {
                      CellReprojection reprojection(scene, cone, traced, windows, cells, landed, options);
                      for (uint32_t cell = range.begin(); cell < range.end(); ++cell) reprojection.run(cell, values);
                    });
  return values;
}

}  // namespace asdfvk
