#pragma once

#include <string>
#include <vector>

#include "bvh/bvh.h"
#include "mesh/components.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"
#include "mesh/validation.h"
#include "pipeline/asdf.h"

namespace asdfvk {

/// Everything about a mesh that does not depend on rays, seeds or devices.
struct PreparedMesh {
  FaceGeometry geometry;
  std::vector<uint32_t> representatives;  ///< #F, see coincidentRepresentatives().
  DualGraph graph;
  Components components;
  std::vector<uint32_t> invertedComponents;  ///< That were left so. Ascending indices.
  MeshDefects defects;
  std::vector<std::string> warnings;
  std::vector<uint32_t> castableFaces;  ///< Not degenerate: they can be seeds. Ascending.
};

/// Throws Error{Input} for a mesh without faces or with an index out of range. Turns faces over as `orientation` says.
/// seconds: what it took is added to those of geometry and graph.
[[nodiscard]] PreparedMesh prepareMesh(Mesh& mesh, Orientation orientation, StageSeconds& seconds);

[[nodiscard]] inline PreparedMesh prepareMesh(Mesh& mesh, Orientation orientation) {
  StageSeconds ignored;
  return prepareMesh(mesh, orientation, ignored);
}

}  // namespace asdfvk
