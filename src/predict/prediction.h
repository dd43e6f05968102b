#pragma once

#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "mesh/face_domain.h"
#include "predict/seed_cells.h"
#include "trace/seed_hits.h"

/// Prediction of the shape diameter of faces that cast no rays, from the hits of the seeds around them. The hit points
/// are on the opposite side of the shape, and most of them are visible from the face too. Each point has a distance
/// from the barycentre of the face and an angle to the axis of the face's cone. In the definition of the value
/// (cone/cone.h), the points in this cone replace the hits of the face. A point is weighted by the solid angle that it
/// represents as seen from the face. No ray is cast, and occlusion between the face and a point is not tested.
///
/// Source: reprojection of cached rays in global illumination (Ward and Heckbert 1992, "Irradiance gradients"; Bekaert,
/// Sbert and Halton 2002, "Accelerating path tracing by re-using paths"). The gradient of the prediction is a guidance
/// field as in the ASDF paper, section 4.1, which uses the curvature.
namespace asdfvk {

struct PredictionOptions {
  uint32_t neighbourCount = 6;  ///< Number of neighbouring cells whose seeds contribute to a face.
  /// Standard deviation of the Gaussian distance weight, in units of half the mean distance to the neighbouring seeds.
  double distanceDeviation = 1.5;
};

struct Prediction {
  /// #N, seeds included, in the unit of the mesh; kNoValue if a face is degenerate, belongs to no cell, or has no hit
  /// point in its cone.
  UnsetVector<double> values;
  UnsetVector<uint32_t> cellOf;  ///< #N, as SeedCells::cellOf.
  NearestCells nearest;          ///< The cells whose seeds contributed, per cell.
};

/// Input of a prediction. Has references and views only.
struct PredictionInput {
  const TraceScene& scene;
  const FaceDomain& domain;
  const Cone& cone;
  SeedHitsView hits;               ///< Its seeds are faces of the mesh.
  const Buckets<uint32_t>& cells;  ///< For each cell, its nodes that are to be predicted.
  const NearestCells& nearest;
  const PredictionOptions& options;
  /// The cells that are not empty, in an order in which neighbours in space are close to each other.
  std::span<const uint32_t> order;
  const Prediction& earlier;  ///< See predictValues().

  /// Whether the same seeds as in the earlier prediction contribute to the faces of a cell. If true, faces that were
  /// already in the cell keep their earlier values.
  [[nodiscard]] bool hasEarlierSeeds(uint32_t cell) const;
};

/// Predicts the faces of one scene on a device instead of on the CPU.
class DevicePredictor {
 public:
  virtual ~DevicePredictor() = default;

  /// Writes the values of all nodes in input.cells. values: #N. Two calls with the same hits give the same bits.
  /// Throws Error{Cancelled} between submissions, and Error of kind Device, for example if there are more neighbours
  /// than the device supports.
  virtual void predict(const PredictionInput& input, std::span<double> values, const RunControl& control) = 0;
};

/// Predicts the values of all nodes of the domain. The result does not depend on the number of threads. hits: the seeds
/// are nodes. earlier: empty, or a prediction of the same scene, domain, cone and options, from which values that did
/// not change are copied. A seed that both predictions use must have the same index in both lists of hits. device: if
/// null, the CPU predicts, which cannot be cancelled. Throws the errors of the device.
[[nodiscard]] Prediction predictValues(const TraceScene& scene, const FaceDomain& domain, const Cone& cone,
                                       const SeedHitsView& hits, const PredictionOptions& options,
                                       Prediction earlier = {}, DevicePredictor* device = nullptr,
                                       const RunControl& control = {});

/// A prediction with further seeds: those in `hits` that have no cell in `prediction`. The cell of a new seed takes the
/// nodes around this seed that are nearer to it than to the seed of their current cell. Only these nodes are predicted
/// again. The other nodes keep their values, although a new seed may be near. Arguments and errors as in
/// predictValues().
[[nodiscard]] Prediction withFurtherSeeds(const Prediction& prediction, const TraceScene& scene,
                                          const FaceDomain& domain, const Cone& cone, const SeedHitsView& hits,
                                          const PredictionOptions& options, DevicePredictor* device = nullptr,
                                          const RunControl& control = {});

}  // namespace asdfvk
