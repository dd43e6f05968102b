#pragma once

#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "asdf_vk/mesh.h"
#include "asdf_vk/session.h"

namespace asdfvk {

/// Paths of further meshes of a computation.
struct OtherMeshes {
  std::vector<std::string> with;  ///< Bodies beside the mesh.
  std::string former;             ///< The former version of the mesh; empty: none.

  [[nodiscard]] bool isEmpty() const { return with.empty() && former.empty(); }
};

/// A result with values for the faces of the mesh only.
struct ComputedMesh {
  Mesh joined;  ///< The mesh with the bodies beside it, to which result.scene refers. Empty without such bodies.
  Result result;
};

/// Reads the other meshes, and computes the mesh among them. name: path of the mesh. The mesh must outlive
/// result.scene. Throws the errors of readMesh(), joinMeshes(), Scene::compute() and Scene::compare().
[[nodiscard]] ComputedMesh computeAmong(Session& session, const Mesh& mesh, const std::string& name,
                                        const OtherMeshes& others, const ReadOptions& reading, const Options& options,
                                        const RunControl& control);

/// The fields without the faces and vertices of the other meshes.
[[nodiscard]] std::vector<Field> fieldsOfMesh(const Mesh& mesh, const std::vector<Field>& fields);

}  // namespace asdfvk
