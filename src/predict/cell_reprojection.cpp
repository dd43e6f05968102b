#include "predict/cell_reprojection.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace asdfvk {
namespace {

// A seed whose normal is this far from the face's weighs exp(-1/2).
constexpr float kNormalReachRadians = 0.5f;

// A seed with less than this share of the weight of all is not asked: it would add 1 % to the error and save a third of
// the time (docs/experiments.md).
constexpr float kLeastShare = 0.08f;

}  // namespace

CellReprojection::CellReprojection(const ReprojectionTask& task)
    : task_(task), points_(task.scene, task.cone, task.traced), kernel_(task.cone) {
  weighting_.inverseAngleVariance = 1 / (kNormalReachRadians * kNormalReachRadians);
}

void CellReprojection::run(std::span<const uint32_t> cells, std::vector<double>& values) {
  points_.clear();
  gathered_.assign(std::bit_ceil(2 * cells.size() * (1 + task_.options.neighbourCount)), {});
  for (size_t i = 0; i < cells.size(); ++i) {
    if (i + 1 < cells.size()) fetchFaces(cells[i + 1]);
    runCell(cells[i], values);
  }
}

/// The points of that seed's rays, gathered when they are first asked for.
PointCone CellReprojection::coneOf(uint32_t seed) {
  size_t place = seed * 0x9e37'79b1u;  // Knuth's multiplicative hash.
  for (;; ++place) {
    Gathered& gathered = gathered_[place & (gathered_.size() - 1)];
    if (gathered.seed == seed) return gathered.cone;
    if (gathered.seed != kNoCell) continue;
    gathered = {seed, points_.gather(seed)};
    return gathered.cone;
  }
}

/// Into the cache: the faces of a cell are neighbours on the surface and not in memory.
void CellReprojection::fetchFaces(uint32_t cell) const {
  const FaceGeometry& geometry = task_.scene.geometry;
  for (const uint32_t face : task_.cells.faces[cell]) {
    __builtin_prefetch(&geometry.barycentres[face]);
    __builtin_prefetch(&geometry.normals[face]);
    __builtin_prefetch(&task_.scene.representatives[face]);
  }
}

void CellReprojection::runCell(uint32_t cell, std::vector<double>& values) {
  const TraceScene& scene = task_.scene;
  if (takesEarlier(cell, values)) return;
  lookAround(task_.nearest.of(cell));
  for (const uint32_t face : facesLeft_) {
    const Vec3d& normal = scene.geometry.normals[face];
    if (normal.x == 0 && normal.y == 0 && normal.z == 0) continue;  // Degenerate.
    const VirtualCone at{scene.bvh.normalization.toNormalized(scene.geometry.barycentres[face]), normal,
                         scene.representatives[face]};
    weigh(at);
    double value = valueAt(at, kLeastShare);
    if (std::isnan(value)) value = valueAt(at, 0);
    values[face] = scene.bvh.normalization.toMeshLength(value);
  }
}

/// Fills the faces left to predict: not those whose cell still asks the same seeds. True where there are none.
bool CellReprojection::takesEarlier(uint32_t cell, std::vector<double>& values) {
  const Prediction& earlier = task_.earlier;
  const std::span<const uint32_t> faces = task_.cells.faces[cell];
  facesLeft_.assign(faces.begin(), faces.end());
  if (cell >= earlier.nearest.cellCount() || !std::ranges::equal(earlier.nearest.of(cell), task_.nearest.of(cell)))
    return false;
  std::erase_if(facesLeft_, [&](uint32_t face) {
    const bool isSame = earlier.cellOf[face] == cell;
    if (isSame) values[face] = earlier.values[face];
    return isSame;
  });
  return facesLeft_.empty();
}

/// Fills what describes the seeds that a cell asks.
void CellReprojection::lookAround(std::span<const uint32_t> asked) {
  const TraceScene& scene = task_.scene;
  askedCones_.clear();
  seedGroups_.assign((asked.size() + kPointGroupSize - 1) / kPointGroupSize, {});
  Vec3d centre;
  double sum = 0;
  for (size_t i = 0; i < asked.size(); ++i) {
    askedCones_.push_back(coneOf(asked[i]));
    const uint32_t face = task_.traced.seeds[asked[i]];
    const Vec3d origin = scene.bvh.normalization.toNormalized(scene.geometry.barycentres[face]);
    const Vec3d& normal = scene.geometry.normals[face];
    SeedGroup& group = seedGroups_[i / kPointGroupSize];
    const size_t lane = i % kPointGroupSize;
    group.x[lane] = static_cast<float>(origin.x);
    group.y[lane] = static_cast<float>(origin.y);
    group.z[lane] = static_cast<float>(origin.z);
    group.nx[lane] = static_cast<float>(normal.x);
    group.ny[lane] = static_cast<float>(normal.y);
    group.nz[lane] = static_cast<float>(normal.z);
    if (i == 0) centre = origin;
    sum += length(origin - centre);
  }
  const double halfMeanDistance = sum / static_cast<double>(2 * std::max<size_t>(1, asked.size() - 1));
  const double reach = task_.options.reach * halfMeanDistance;
  weighting_.inverseVariance = reach > 0 ? static_cast<float>(1 / (reach * reach)) : 0.0f;
}

/// How much each seed asked counts.
void CellReprojection::weigh(const VirtualCone& at) {
  weights_.resize(seedGroups_.size() * kPointGroupSize);
  for (size_t i = 0; i < seedGroups_.size(); ++i)
    kernel_.weigh(seedGroups_[i], weighting_, at, &weights_[i * kPointGroupSize]);
}

/// leastShare: of all weights, that a seed needs to be asked.
double CellReprojection::valueAt(const VirtualCone& at, float leastShare) {
  float sum = 0;
  for (size_t i = 0; i < askedCones_.size(); ++i) sum += weights_[i];
  weighed_.resize(askedCones_.size());
  size_t count = 0;
  for (size_t i = 0; i < askedCones_.size(); ++i) {  // Without a branch that nobody could foresee.
    weighed_[count] = {askedCones_[i].firstGroup, askedCones_[i].groupCount, weights_[i]};
    count += weights_[i] >= leastShare * sum ? 1 : 0;
  }
  weighed_.resize(count);
  return kernel_.value(points_.groups(), weighed_, at, askedCones_[0].medianLength);
}

}  // namespace asdfvk
