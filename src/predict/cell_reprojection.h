#pragma once

#include <vector>

#include "predict/prediction_kernel.h"
#include "predict/reprojection.h"
#include "predict/seed_points.h"

namespace asdfvk {

/// What is the same for all cells.
struct ReprojectionTask {
  const TraceScene& scene;
  const Cone& cone;
  TracedCones traced;
  const SeedCells& cells;
  const NearestCells& nearest;
  const ReprojectionOptions& options;
  const Prediction& earlier;
};

/// Predicts the faces of a few cells that lie together, so that each of them finds the points of the seeds around
/// already gathered for the cells before.
class CellReprojection {
 public:
  /// What `task` refers to must outlive it.
  explicit CellReprojection(const ReprojectionTask& task);

  /// values: #F; those of the cells' faces are written.
  void run(std::span<const uint32_t> cells, std::vector<double>& values);

 private:
  [[nodiscard]] PointCone coneOf(uint32_t seed);
  void fetchFaces(uint32_t cell) const;
  void runCell(uint32_t cell, std::vector<double>& values);
  [[nodiscard]] bool takesEarlier(uint32_t cell, std::vector<double>& values);
  void lookAround(std::span<const uint32_t> asked);
  void weigh(const VirtualCone& at);
  [[nodiscard]] double valueAt(const VirtualCone& at, float leastShare);

  const ReprojectionTask& task_;
  SeedPoints points_;
  PredictionKernel kernel_;
  struct Gathered {
    uint32_t seed = kNoCell;
    PointCone cone;
  };
  std::vector<Gathered> gathered_;     // By seed: open addressing, a power of two of places.
  std::vector<PointCone> askedCones_;  // Of the cell at hand.
  std::vector<uint32_t> facesLeft_;    // Of the cell at hand.
  std::vector<SeedGroup> seedGroups_;  // Their seeds.
  SeedWeighting weighting_;
  std::vector<float> weights_;
  std::vector<WeighedCone> weighed_;
};

}  // namespace asdfvk
