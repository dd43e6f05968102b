#pragma once

#include <filesystem>
#include <string>

// Temporary files whose names state the host and the process that writes them.
namespace asdfvk {

/// Returns ".asdf-vk-HOST-PROCESS-COUNT.part" for this process. The name of the host is needed because process numbers
/// are unique only within one machine or container.
[[nodiscard]] std::string temporaryFileName(unsigned count);

/// Removes the temporary files that killed processes of this host left in a folder. Files of running processes remain,
/// if the processes are visible. Processes of other containers with this host name are not visible: their files remain
/// only if the file system supports flock().
void removeAbandonedFiles(const std::filesystem::path& folder);

/// Removes the temporary files that an ended process of this host left in a folder.
void removeFilesOfProcess(const std::filesystem::path& folder, int process);

}  // namespace asdfvk
