#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/dual_graph.h"
#include "pipeline/prepared_mesh.h"

namespace asdfvk {

class AggregatedMesh;

/// The faces that get values, and how they are connected: the whole mesh, a region of it, or the centres of aggregates.
/// Views only.
struct FaceDomain {
  const DualGraph& graph;  ///< #F nodes; arcs between faces of the domain only.
  /// #F: the component of each face in `graph`. All faces outside of a region are one further component. With
  /// aggregates, a face that is not a centre has its component of the mesh.
  std::span<const uint32_t> componentOf;
  size_t componentCount = 0;
  std::span<const uint32_t> traceableFaces;    ///< Faces of the domain that can cast rays, ascending.
  std::span<const uint8_t> inputFaces;         ///< #I, nonzero = in the domain; empty: all are.
  const AggregatedMesh* aggregated = nullptr;  ///< Set if the faces of the domain are the centres of aggregates.

  [[nodiscard]] bool contains(uint64_t inputFace) const { return inputFaces.empty() || inputFaces[inputFace] != 0; }
};

[[nodiscard]] FaceDomain wholeMesh(const PreparedMesh& prepared);

/// A region of the mesh. The mesh and `inputFaces` must outlive this object.
class Region {
 public:
  /// inputFaces: #I, nonzero = in the region.
  Region(const PreparedMesh& prepared, std::span<const uint8_t> inputFaces);

  [[nodiscard]] FaceDomain domain() const {
    return {graph_, componentOf_, componentCount_, traceableFaces_, inputFaces_};
  }

 private:
  void connect(const PreparedMesh& prepared);
  void labelComponents();

  std::span<const uint8_t> inputFaces_;
  std::vector<uint8_t> isInside_;  // #F
  DualGraph graph_;
  std::vector<uint32_t> componentOf_;
  size_t componentCount_ = 0;
  std::vector<uint32_t> traceableFaces_;
};

/// Returns no region if `inputFaces` is empty or has all faces. Throws Error{ArraySize} if its size is not #I, and
/// Error{EmptyMesh} for a region without a face.
[[nodiscard]] std::optional<Region> regionOf(const PreparedMesh& prepared, std::span<const uint8_t> inputFaces);

}  // namespace asdfvk
