#pragma once

#include "cli/command_line.h"
#include "serve/mesh_request.h"
#include "serve/path_root.h"

namespace asdfvk {

/// Which files requests may use.
struct RequestFiles {
  PathRoot root;
  bool protectsFiles = false;  ///< Outputs replace only files with names such as NAME.asdf.ply.
};

/// The resolved path of a mesh file. Throws Error{UnreadableInput} for a file that requests may not use, and for one
/// that is not a regular file: a device may have no end.
[[nodiscard]] std::string inputPath(const std::string& path, const RequestFiles& files);

/// The name of the mesh of a request in reports: its path, or such as "mesh.stl".
[[nodiscard]] std::string meshNameOf(const MeshRequest& request);

/// The command line that is the same as the request. Its mesh is meshNameOf(). Files without a path have the paths
/// inlineFile() in the folder `temporary`. session: the options of the server; the request may repeat them. Throws
/// Error of kind Usage, Input and Output.
[[nodiscard]] CommandLine commandLineOf(const MeshRequest& request, const SessionSettings& session,
                                        const RequestFiles& files, const std::string& temporary);

/// The JSON Schemas of a request and of its objects, by their names in docs/schema.json.
[[nodiscard]] Json requestDefinitions();

}  // namespace asdfvk
