#pragma once

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "asdf_vk/files.h"
#include "cli/check_policy.h"
#include "cli/other_meshes.h"
#include "cli/outputs.h"
#include "describe/computation_options.h"
#include "describe/session_options.h"

namespace asdfvk {

struct MeshSettings {
  SessionSettings session;
  ComputationSettings computation;
  ReadOptions reading;
  OtherMeshes others;  ///< Empty for one of several meshes and in batches.
  Outputs outputs;
  CheckPolicy policy;
  double timeoutSeconds = std::numeric_limits<double>::infinity();
  bool makesFolders = false;  ///< Whether a missing folder of the result is created.
  /// Whether the mesh is part of a batch. In a batch, a record beside the result replaces the report, and pages have no
  /// times.
  bool isOfBatch = false;
  bool drawsFailedOnly = false;  ///< In a run with a check, only meshes that fail the check have a picture.
  std::string memberFolder;      ///< For members of tars with results: see enterMemberFolder(). Else empty.
};

[[nodiscard]] MeshSettings meshSettingsOf(const struct CommandLine& line);

/// The settings as JSON, for a worker process of the same version. The strings may contain any bytes.
[[nodiscard]] nlohmann::ordered_json toJson(MeshSettings settings);
[[nodiscard]] MeshSettings settingsOf(const nlohmann::ordered_json& json);

/// Hash of all options that affect the output of a mesh, for --skip-existing.
[[nodiscard]] std::string optionsHash(const ComputationSettings& computation, const SessionSettings& session,
                                      const ReadOptions& reading, const Outputs& outputs);

}  // namespace asdfvk
