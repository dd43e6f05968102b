#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {

/// A partition of the faces into small, almost flat patches, each with one of its faces as its centre. An interpolation
/// on fine meshes computes the values of the centres only; spreadFromCentres() then gives the other faces their values.
struct FacePatches {
  std::vector<uint32_t> centres;  ///< #P: a face per patch, ascending.
  std::vector<uint32_t> sizes;    ///< #P: number of faces.
  std::vector<uint32_t> patchOf;  ///< #F
  DualGraph graph;                ///< #P nodes. There is an arc between two patches that share an edge.

  [[nodiscard]] uint32_t centreOf(uint32_t face) const { return centres[patchOf[face]]; }
  [[nodiscard]] bool isCentre(uint32_t face) const { return centreOf(face) == face; }
};

/// Limits of a patch, measured from its centre.
struct PatchLimits {
  uint32_t arcCount = 0;  ///< Greatest number of arcs to a face.
  double length = 0;      ///< Greatest distance to the barycentre of a face.
};

/// mayGrow: #F; a face with 0 is a patch of its own. Linear time.
[[nodiscard]] FacePatches buildFacePatches(const DualGraph& graph, const FaceGeometry& geometry,
                                           std::span<const uint8_t> mayGrow, const PatchLimits& limits);

/// Sets the values of all faces that are not centres: Jacobi iterations of the harmonic interpolation on `graph`, which
/// start from the value of the centre. Arcs over bent edges have small weights. values: #F, NaN = no value.
void spreadFromCentres(const DualGraph& graph, const FaceGeometry& geometry, const FacePatches& patches,
                       std::vector<double>& values);

}  // namespace asdfvk
