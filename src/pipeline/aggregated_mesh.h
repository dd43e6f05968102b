#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mesh/face_aggregates.h"
#include "pipeline/face_domain.h"

namespace asdfvk {

/// The aggregates of a whole mesh, and the domain of their centres. The mesh must outlive this object.
class AggregatedMesh {
 public:
  explicit AggregatedMesh(const PreparedMesh& prepared);

  [[nodiscard]] FaceDomain domain() const {
    const auto& [componentOf, components] = prepared_.components;
    return {graph_, componentOf, components.size(), traceableFaces_, {}, this};
  }
  [[nodiscard]] const FaceAggregates& aggregates() const { return aggregates_; }
  /// #F: for a centre, the number of faces of its aggregate; unset for other faces.
  [[nodiscard]] UnsetVector<uint32_t> representedCounts() const;
  /// Sets the values of the faces that are not centres, see spreadFromCentres(). Their indicator, #F or empty, becomes
  /// that of their centre.
  void spread(std::vector<double>& values, std::span<double> indicator) const;

 private:
  const PreparedMesh& prepared_;
  FaceAggregates aggregates_;
  DualGraph graph_;  // The graph of the aggregates, with their centres as nodes.
  std::vector<uint32_t> traceableFaces_;
};

/// The aggregates for an interpolation from this number of seeds. None if they would not save time, or if the mesh is
/// so coarse that values differ much within an aggregate. isPooled: whether values are pooled with predictions.
[[nodiscard]] std::unique_ptr<const AggregatedMesh> aggregatesFor(const PreparedMesh& prepared, uint64_t seedCount,
                                                                  bool isPooled);

}  // namespace asdfvk
