#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// A mesh and its values, for the segmentation into parts. The unit of length is the square root of the area of the
/// mesh. The data do not depend on the unit of the mesh; scaling the mesh by a power of two changes no bit.
struct PartSurface {
  struct Arc {
    uint32_t face;  ///< Neighbour.
    float length;
  };
  std::span<const uint32_t> offsets;  ///< #F+1: offsets of the dual graph; views the graph of the caller.
  /// #arcs, aligned with DualGraph::neighbours: the length of the path between the barycentres across the edge.
  std::vector<Arc> arcs;
  /// #arcs: the length of `arcs` plus kCreaseLength (3 max(0, angle) + |difference of the log values|).
  std::vector<Arc> creasedArcs;
  std::vector<float> edgeLengths;  ///< #arcs
  /// #arcs: angle between the filtered normals (filterNormals()) in radians, positive on a concave edge.
  std::vector<float> angles;
  std::vector<Vec3d> centres;    ///< #F; the origin for a face with a non-finite corner.
  std::vector<float> areas;      ///< #F, sum 1; 0 for degenerate faces.
  std::vector<float> logValues;  ///< #F, natural logarithm of the value in units of length.
  double meshLength = 1;         ///< Unit of length, in the unit of the mesh.

  [[nodiscard]] uint32_t faceCount() const { return static_cast<uint32_t>(areas.size()); }
};

/// The length that a concave crease of 1/3 radian adds to an arc, in units of length.
inline constexpr double kCreaseLength = 0.00704;

/// graph: the dual graph of the mesh; must outlive the result. values: #F, not negative, NaN for no value. A face
/// without a value gets the value of the nearest face with a value, by the number of edges. In a component without
/// values, all faces get the mean logarithm of all values. Values below 1e-4 of the largest value are raised to this
/// bound. Throws Error{NoValues} if no face has a value.
[[nodiscard]] PartSurface makePartSurface(const TriangleMesh& mesh, const FaceGeometry& geometry,
                                          const DualGraph& graph, std::span<const double> values);

}  // namespace asdfvk
