#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asdf_vk/files.h"
#include "asdf_vk/mesh.h"
#include "asdf_vk/session.h"

namespace asdfvk {

/// Paths of further meshes of a computation.
struct OtherMeshes {
  std::vector<std::string> with;  ///< Bodies beside the mesh. Empty if there is a former version.
  std::string former;             ///< The former version of the mesh; empty: none.

  [[nodiscard]] bool isEmpty() const { return with.empty() && former.empty(); }
};

/// A result with values for the faces of the mesh only.
struct ComputedMesh {
  Mesh joined;  ///< The mesh with the bodies beside it, to which result.scene refers. Empty without such bodies.
  Result result;
  std::vector<uint64_t> faceCounts = {};  ///< Numbers of input faces of the bodies beside the mesh.
};

/// Reads the other meshes, and computes the mesh among them. The mesh takes their unit if it states none. name: path of
/// the mesh. The mesh must outlive result.scene. Throws the errors of readMesh(), joinMeshes(), Scene::compute() and
/// Scene::compare(). A stop request also ends the wait for a FIFO.
[[nodiscard]] ComputedMesh computeAmong(Session& session, Mesh& mesh, const std::string& name,
                                        const OtherMeshes& others, const ReadOptions& reading,
                                        const CheckedOptions& options, const RunControl& control);

/// Replaces the indices of faces that were not judged by those in their files, for texts. faceCount: input faces of the
/// mesh. others: ComputedMesh::faceCounts.
void numberFacesByFile(Report& report, uint64_t faceCount, const std::vector<uint64_t>& others);

/// The fields without the faces and vertices of the other meshes.
[[nodiscard]] std::vector<Field> fieldsOfMesh(const Mesh& mesh, const std::vector<Field>& fields);

}  // namespace asdfvk
