#pragma once

#include <string>
#include <vector>

#include "asdf_vk/session.h"
#include "cli/other_meshes.h"
#include "cli/outputs.h"
#include "describe/computation_options.h"
#include "describe/session_options.h"

namespace asdfvk {

/// A computed mesh, for its report.
struct MeshOutcome {
  const std::string& mesh;    ///< Path of the mesh, as on the command line.
  const std::string& output;  ///< Path of the result; "-" for standard output; empty: none.
  const ComputationSettings& computation;
  const SessionSettings& session;
  const OtherMeshes& others;
  const Outputs& outputs;
  const Result& result;
  std::vector<uint64_t> withFaceCounts = {};  ///< ComputedMesh::faceCounts
};

}  // namespace asdfvk
