#pragma once

#include <cstdint>
#include <vector>

#include "asdf_vk/mesh.h"
#include "bvh/bvh.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

/// A mesh with its geometry and hierarchy, owned. Result::scene of the public interface.
struct SceneData {
  Mesh storage;       ///< Arrays of `mesh` that are not the caller's.
  TriangleMesh mesh;  ///< Of `storage` and of the arrays of the caller, which must outlive this.
  FaceGeometry geometry;
  std::vector<uint32_t> representatives;  ///< #F, see coincidentRepresentatives().
  Bvh bvh;

  [[nodiscard]] TraceScene view() const { return {mesh, geometry, representatives, bvh}; }
};

}  // namespace asdfvk
