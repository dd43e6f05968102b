#pragma once

#include <cstdint>
#include <string>

#include "cli/loaded_mesh.h"
#include "serve/mesh_request.h"

namespace asdfvk {

/// Reads the mesh of a request. path: inputPath() of its file; empty if the request has the mesh. maxBytes: greatest
/// size of the file; 0: no limit. A failure is returned in LoadedMesh::failure.
[[nodiscard]] LoadedMesh requestedMesh(const MeshRequest& request, const std::string& path, const ReadOptions& reading,
                                       uint64_t maxBytes);

}  // namespace asdfvk
