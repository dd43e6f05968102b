#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mesh/face_aggregates.h"
#include "mesh/face_domain.h"
#include "pipeline/prepared_mesh.h"

namespace asdfvk {

/// The aggregates of a whole mesh, and the domain of their centres. The mesh must outlive this object.
class AggregatedMesh {
 public:
  explicit AggregatedMesh(const PreparedMesh& prepared);

  [[nodiscard]] FaceDomain domain() const {
    return {aggregates_.graph, geometry_,           componentOf_,     prepared_.components.components.size(),
            traceable_,        aggregates_.centres, aggregates_.sizes};
  }
  /// #F, see spreadFromCentres(). values: of the domain.
  [[nodiscard]] std::vector<double> spreadValues(std::vector<double> values) const;
  /// #F: the entry of the centre of each face. entries: of the domain.
  [[nodiscard]] UnsetVector<double> spreadEntries(std::span<const double> entries) const;

 private:
  const PreparedMesh& prepared_;
  FaceAggregates aggregates_;
  FaceGeometry geometry_;
  std::vector<uint32_t> componentOf_, traceable_;
};

/// The aggregates for an interpolation from this number of seeds. None if they would not save time, or if the mesh is
/// so coarse that values differ much within an aggregate. isPooled: whether values are pooled with predictions.
[[nodiscard]] std::unique_ptr<const AggregatedMesh> aggregatesFor(const PreparedMesh& prepared, uint64_t seedCount,
                                                                  bool isPooled);

}  // namespace asdfvk
