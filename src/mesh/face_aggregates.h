#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/unset_vector.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

/// A partition of the faces into small, almost flat aggregates: groups of neighbours around a centre, which is one of
/// the faces. On fine meshes only the values of the centres are interpolated from the seeds. spreadFromCentres() then
/// computes the values of the other faces.
struct FaceAggregates {
  std::vector<uint32_t> centres;      ///< #A: a face of each aggregate, ascending.
  std::vector<uint32_t> sizes;        ///< #A: number of faces.
  UnsetVector<uint32_t> aggregateOf;  ///< #F
  DualGraph graph;                    ///< #A nodes. There is an arc between two aggregates that share an edge.

  [[nodiscard]] uint32_t centreOf(uint32_t face) const { return centres[aggregateOf[face]]; }
  [[nodiscard]] bool isCentre(uint32_t face) const { return centreOf(face) == face; }
};

/// Limits of an aggregate, measured from its centre.
struct AggregateLimits {
  uint32_t arcCount = 0;  ///< Greatest number of arcs to a face.
  /// #components: greatest distance to the barycentre of a face. With 0 each face is an aggregate of its own.
  std::span<const double> lengths;
  std::span<const uint32_t> componentOf;  ///< #F: see Components.
};

/// Linear time.
[[nodiscard]] FaceAggregates buildFaceAggregates(const DualGraph& graph, const FaceGeometry& geometry,
                                                 const AggregateLimits& limits);

/// Sets the values of all faces that are not centres: relaxation sweeps of the harmonic interpolation on `graph`, which
/// start from the value of the centre. Arcs over bent edges have small weights. The values remain between those of the
/// neighbours. The result does not depend on the number of threads. values: #F, NaN = no value.
void spreadFromCentres(const DualGraph& graph, const FaceGeometry& geometry, const FaceAggregates& aggregates,
                       std::vector<double>& values);

}  // namespace asdfvk
