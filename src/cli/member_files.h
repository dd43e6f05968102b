#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cli/mesh_settings.h"

// Results of members of tars: a worker process writes them to a folder of its own.
namespace asdfvk {

/// The settings for the members of tars. folder: empty folder for files of worker processes.
[[nodiscard]] MeshSettings memberSettings(MeshSettings settings, const std::string& folder);

/// Makes the current folder of a worker process a new folder below `folder`. Results of members have relative paths.
void enterMemberFolder(const std::string& folder);
/// The path of a mesh, which may be relative to the folder that enterMemberFolder() left.
[[nodiscard]] std::filesystem::path absolutePathOf(const std::string& mesh);
/// Removes the folder of a worker process that was killed.
void removeMemberFolder(const std::string& folder, int process);

/// Reads and removes a result that a computation of a member has written: names and bytes of its files.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> takenResult(const std::string& output);

}  // namespace asdfvk
