#include "predict/prediction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/index_table.h"
#include "core/parallel.h"
#include "core/prefetch.h"
#include "predict/hit_points.h"
#include "predict/prediction_kernel.h"

namespace asdfvk {
namespace {

// Number of cells that are predicted with one set of hit points. Together, these cells have about 1.5 contributing
// seeds per cell.
constexpr size_t kBlockSize = 128;

/// Predicts the faces of one block of cells after another. Cells of a block are close to each other and share the hit
/// points of their seeds.
class CellPredictor {
 public:
  /// The input must outlive this object.
  explicit CellPredictor(const PredictionInput& input)
      : input_(input), points_(input.scene, input.cone, input.hits), kernel_(input.cone) {
    weighting_.inverseAngleVariance = 1 / (kNormalDeviationRadians * kNormalDeviationRadians);
  }

  /// values: #N; the values of the nodes of these cells are written.
  void run(std::span<const uint32_t> cells, std::span<double> values) {
    points_.clear();
    cached_.resetFor(cells.size() * (1 + input_.options.neighbourCount));
    appendHits(cells);
    for (size_t i = 0; i < cells.size(); ++i) {
      nextNodes_ = {};
      if (i + 1 < cells.size()) nextNodes_ = input_.cells[cells[i + 1]];
      runCell(cells[i], values);
    }
  }

 private:
  using CachedHits = IndexTable<HitRange>::Entry;

  void runCell(uint32_t cell, std::span<double> values);
  void prefetchNextNode();
  void appendHits(std::span<const uint32_t> cells);
  [[nodiscard]] HitRange hitsOf(uint32_t seed);
  void reuseEarlier(uint32_t cell, std::span<double> values);
  void gatherNeighbours(std::span<const uint32_t> neighbourSeeds);
  void weighNeighbours(const VirtualCone& at);
  [[nodiscard]] double valueAt(const VirtualCone& at, float minWeightShare);

  const PredictionInput& input_;
  HitPoints points_;
  PredictionKernel kernel_;
  IndexTable<HitRange> cached_;          // By seed.
  std::vector<CachedHits*> newHits_;     // Entries of cached_ that appendHits() fills.
  std::span<const uint32_t> nextNodes_;  // Nodes of the next cell that are not yet prefetched.

  // For the current cell:
  std::vector<uint32_t> remainingNodes_;
  std::vector<HitRange> neighbourHits_;
  std::vector<SeedGroup> neighbourSeeds_;
  SeedWeighting weighting_;
  std::vector<float> weights_;
  std::vector<WeightedRange> weighted_;
};

void CellPredictor::runCell(uint32_t cell, std::span<double> values) {
  const Normalization& unit = input_.scene.bvh.normalization;
  const FaceGeometry& geometry = input_.domain.geometry;
  reuseEarlier(cell, values);
  if (remainingNodes_.empty()) return;
  gatherNeighbours(input_.nearest.of(cell));
  for (const uint32_t node : remainingNodes_) {
    prefetchNextNode();
    const Vec3d& normal = geometry.normals[node];
    if (normal.x == 0 && normal.y == 0 && normal.z == 0) continue;  // The face is degenerate.
    const VirtualCone at{unit.toNormalized(geometry.barycentres[node]), normal,
                         input_.scene.representatives[input_.domain.faceOf(node)]};
    weighNeighbours(at);
    double value = valueAt(at, kMinWeightShare);
    if (std::isnan(value)) value = valueAt(at, 0);
    values[node] = unit.toMeshLength(value);
  }
  while (!nextNodes_.empty()) prefetchNextNode();
}

/// The nodes of a cell are neighbours on the surface but not in memory. One node at a time, as in HitPoints::append().
void CellPredictor::prefetchNextNode() {
  if (nextNodes_.empty()) return;
  const FaceGeometry& geometry = input_.domain.geometry;
  const uint32_t node = nextNodes_.front();
  nextNodes_ = nextNodes_.subspan(1);
  prefetchMemory(&geometry.barycentres[node]);
  prefetchMemory(&geometry.normals[node]);
  prefetchMemory(&input_.scene.representatives[input_.domain.faceOf(node)]);
}

/// Appends the hit points of all seeds of those cells that cannot reuse an earlier prediction. Cache misses take most
/// of the time without prefetching.
void CellPredictor::appendHits(std::span<const uint32_t> cells) {
  constexpr size_t kDistance = 4;  // Normals are prefetched 4 seeds ahead. Hits are prefetched 8 seeds ahead.
  newHits_.clear();
  for (const uint32_t cell : cells) {
    if (input_.hasEarlierSeeds(cell)) continue;
    for (const uint32_t seed : input_.nearest.of(cell)) {
      const auto [cached, isNew] = cached_.add(seed);
      if (isNew) newHits_.push_back(&cached);
    }
  }
  const size_t count = newHits_.size();
  if (count == 0) return;
  for (size_t i = 0; i < count + 2 * kDistance; ++i) {
    if (i < count) points_.prefetchHits(newHits_[i]->index);
    if (i < kDistance) continue;
    const uint32_t later = newHits_[std::min(i - kDistance, count - 1)]->index;
    if (i < 2 * kDistance) {
      points_.prefetchNormals(later);
    } else {
      CachedHits& cached = *newHits_[i - 2 * kDistance];
      cached.value = points_.append(cached.index, later);
    }
  }
}

/// The hit points of the seed. Appends them if appendHits() has not, because the cell keeps some of its earlier values.
HitRange CellPredictor::hitsOf(uint32_t seed) {
  const auto [cached, isNew] = cached_.add(seed);
  if (isNew) cached.value = points_.append(seed);
  return cached.value;
}

/// Copies the values of nodes that were in this cell in the earlier prediction, if the contributing seeds are
/// unchanged. Puts the other nodes into remainingNodes_.
void CellPredictor::reuseEarlier(uint32_t cell, std::span<double> values) {
  const std::span<const uint32_t> nodes = input_.cells[cell];
  remainingNodes_.assign(nodes.begin(), nodes.end());
  if (!input_.hasEarlierSeeds(cell)) return;
  std::erase_if(remainingNodes_, [&](uint32_t node) {
    const bool isSame = input_.earlier.cellOf[node] == cell;
    if (isSame) values[node] = input_.earlier.values[node];
    return isSame;
  });
}

void CellPredictor::gatherNeighbours(std::span<const uint32_t> neighbourSeeds) {
  const TraceScene& scene = input_.scene;
  neighbourHits_.clear();
  // Lanes without a seed keep earlier numbers, whose weights are ignored.
  neighbourSeeds_.resize((neighbourSeeds.size() + kPointGroupSize - 1) / kPointGroupSize);
  Vec3d centre;
  double sum = 0;
  for (size_t i = 0; i < neighbourSeeds.size(); ++i) {
    neighbourHits_.push_back(hitsOf(neighbourSeeds[i]));
    const uint32_t face = input_.hits.seeds[neighbourSeeds[i]];
    const Vec3d origin = scene.bvh.normalization.toNormalized(scene.geometry.barycentres[face]);
    const Vec3d& normal = scene.geometry.normals[face];
    SeedGroup& group = neighbourSeeds_[i / kPointGroupSize];
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
  const double halfMeanDistance = sum / static_cast<double>(2 * std::max<size_t>(1, neighbourSeeds.size() - 1));
  const double deviation = input_.options.distanceDeviation * halfMeanDistance;
  weighting_.inverseVariance = deviation > 0 ? static_cast<float>(1 / (deviation * deviation)) : 0.0f;
}

void CellPredictor::weighNeighbours(const VirtualCone& at) {
  weights_.resize(neighbourSeeds_.size() * kPointGroupSize);
  for (size_t i = 0; i < neighbourSeeds_.size(); ++i)
    kernel_.weigh(neighbourSeeds_[i], weighting_, at, &weights_[i * kPointGroupSize]);
}

/// The value that is predicted from those seeds that each have at least minWeightShare of the total weight.
double CellPredictor::valueAt(const VirtualCone& at, float minWeightShare) {
  float sum = 0;
  for (size_t i = 0; i < neighbourHits_.size(); ++i) sum += weights_[i];
  weighted_.resize(neighbourHits_.size());
  size_t count = 0;
  for (size_t i = 0; i < neighbourHits_.size(); ++i) {  // Branch-free: the condition is unpredictable.
    weighted_[count] = {neighbourHits_[i].firstGroup, neighbourHits_[i].groupCount, weights_[i]};
    count += weights_[i] >= minWeightShare * sum ? 1 : 0;
  }
  weighted_.resize(count);
  return kernel_.value(points_.groups(), weighted_, at, neighbourHits_[0].medianLength);
}

/// #S from nodes. kNoFace remains.
std::vector<uint32_t> facesOfSeeds(const FaceDomain& domain, std::span<const uint32_t> seeds) {
  std::vector<uint32_t> faces(seeds.begin(), seeds.end());
  for (uint32_t& face : faces)
    if (face != kNoFace) face = domain.faceOf(face);
  return faces;
}

/// The cells in the order of their seeds in the hierarchy. In this order, neighbours in space are close to each other.
/// seeds: faces.
std::vector<uint32_t> cellsInOrder(const TraceScene& scene, std::span<const uint32_t> seeds) {
  const auto isCell = [&](uint32_t cell) { return seeds[cell] != kNoFace; };
  UnsetVector<uint32_t> cellOfFace = filledInParallel(scene.mesh.faceCount(), kNoCell);
  for (uint32_t cell = 0; cell < seeds.size(); ++cell)
    if (isCell(cell)) cellOfFace[seeds[cell]] = cell;
  const std::span<const uint32_t> faces = scene.bvh.primitiveFaces;
  std::vector<uint32_t> order = selectInParallel(
      faces.size(), [&](size_t primitive) { return cellOfFace[faces[primitive]]; },
      [](uint32_t cell) { return cell != kNoCell; });
  if (order.size() == countInParallel(seeds.size(), isCell)) return order;
  std::vector<uint8_t> isListed(seeds.size(), 0);
  for (const uint32_t cell : order) isListed[cell] = 1;
  // Seeds that are copies of other faces are not in the hierarchy; their cells are the last ones.
  for (uint32_t cell = 0; cell < seeds.size(); ++cell)
    if (isCell(cell) && !isListed[cell]) order.push_back(cell);
  return order;
}

void predictOnCpu(const PredictionInput& input, std::span<double> values) {
  const std::span<const uint32_t> order = input.order;
  const size_t blockCount = (order.size() + kBlockSize - 1) / kBlockSize;
  PerThread<CellPredictor> predictors([&] { return CellPredictor(input); });
  forEachTask(blockCount, [&](size_t block) {
    const size_t first = block * kBlockSize;
    predictors.local().run(order.subspan(first, std::min(kBlockSize, order.size() - first)), values);
  });
}

/// Gives each new cell those nodes around its seed that are nearer to this seed than to the seed of their current cell.
/// Returns these nodes, ascending.
std::vector<uint32_t> claimNodes(const FaceDomain& domain, std::span<const uint32_t> seeds,
                                 std::span<const uint32_t> newCells, std::span<uint32_t> cellOf) {
  const UnsetVector<Vec3d>& barycentres = domain.geometry.barycentres;
  const auto squaredDistance = [&](uint32_t node, uint32_t cell) {
    return comparableSquare(barycentres[node] - barycentres[seeds[cell]]);
  };
  for (const uint32_t cell : newCells) cellOf[seeds[cell]] = cell;
  std::vector<uint32_t> claimed, queue;
  for (const uint32_t cell : newCells) {
    queue.assign(1, seeds[cell]);
    for (size_t next = 0; next < queue.size(); ++next)
      for (const uint32_t neighbour : domain.graph.neighboursOf(queue[next])) {
        const uint32_t other = cellOf[neighbour];
        if (other == cell || (other != kNoCell && seeds[other] == neighbour)) continue;
        if (other != kNoCell && !(squaredDistance(neighbour, cell) < squaredDistance(neighbour, other))) continue;
        cellOf[neighbour] = cell;
        queue.push_back(neighbour);
      }
    claimed.insert(claimed.end(), queue.begin(), queue.end());
  }
  std::sort(claimed.begin(), claimed.end());
  claimed.erase(std::unique(claimed.begin(), claimed.end()), claimed.end());
  return claimed;
}

/// device: null predicts on the CPU.
void predict(const PredictionInput& input, std::span<double> values, DevicePredictor* device,
             const RunControl& control) {
  if (device != nullptr) return device->predict(input, values, control);
  ASDFVK_CHECK(input.hits.onDevice == nullptr);
  predictOnCpu(input, values);
}

}  // namespace

bool PredictionInput::hasEarlierSeeds(uint32_t cell) const {
  return cell < earlier.nearest.cellCount() && std::ranges::equal(earlier.nearest.of(cell), nearest.of(cell));
}

Prediction predictValues(const TraceScene& scene, const FaceDomain& domain, const Cone& cone, const SeedHitsView& hits,
                         const PredictionOptions& options, Prediction earlier, DevicePredictor* device,
                         const RunControl& control) {
  if (hits.onDevice == nullptr) ASDFVK_CHECK_OP(hits.hits.size(), ==, hits.seeds.size() * cone.directions.size());
  SeedCells cells = buildSeedCells(domain.graph, hits.seeds);
  Prediction prediction{filledInParallel(domain.size(), kNoValue),
                        {},
                        NearestCells(cells, domain.graph, domain.geometry, hits.seeds, options.neighbourCount)};
  const std::vector<uint32_t> faces = facesOfSeeds(domain, hits.seeds), order = cellsInOrder(scene, faces);
  predict({scene,
           domain,
           cone,
           {faces, hits.hits, hits.onDevice},
           cells.faces,
           prediction.nearest,
           options,
           order,
           earlier},
          prediction.values, device, control);
  prediction.cellOf = std::move(cells.cellOf);
  return prediction;
}

Prediction withFurtherSeeds(const Prediction& prediction, const TraceScene& scene, const FaceDomain& domain,
                            const Cone& cone, const SeedHitsView& hits, const PredictionOptions& options,
                            DevicePredictor* device, const RunControl& control) {
  const std::vector<uint32_t> newCells = indicesInParallel(hits.seeds.size(), [&](uint32_t cell) {
    return hits.seeds[cell] != kNoFace && prediction.cellOf[hits.seeds[cell]] != cell;
  });
  Prediction result = prediction;
  const std::vector<uint32_t> claimed = claimNodes(domain, hits.seeds, newCells, result.cellOf);
  const Buckets<uint32_t> cells =
      sortIntoBuckets<uint32_t>(hits.seeds.size(), claimed.size(),
                                [&](uint32_t i, const auto& put) { put(result.cellOf[claimed[i]], claimed[i]); });
  for (const uint32_t node : claimed) result.values[node] = kNoValue;
  result.nearest.update(newCells, cells, result.cellOf, domain.graph, domain.geometry, hits.seeds);
  const std::vector<uint32_t> faces = facesOfSeeds(domain, hits.seeds);
  const Prediction none;
  predict({scene, domain, cone, {faces, hits.hits, hits.onDevice}, cells, result.nearest, options, newCells, none},
          result.values, device, control);
  return result;
}

}  // namespace asdfvk
