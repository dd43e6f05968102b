#include "core/abandoned_files.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <system_error>

namespace asdfvk {
namespace {

/// Returns ".asdf-vk-HOST-".
const std::string& temporaryPrefix() {
  static const std::string prefix = [] {
    std::array<char, HOST_NAME_MAX + 1> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
    return fmt::format(".asdf-vk-{}-", host.data());
  }();
  return prefix;
}

/// Removes the temporary files of this host in a folder, for which select(process, path) returns true.
template <typename Select>
void removeTemporaries(const std::filesystem::path& folder, const Select& select) {
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(temporaryPrefix())) continue;
    int process = 0, end = 0;
    unsigned count = 0;
    const char* rest = name.c_str() + temporaryPrefix().size();
    if (std::sscanf(rest, "%d-%u.part%n", &process, &count, &end) != 2 || end == 0 || rest[end] != '\0') continue;
    if (process > 0 && select(process, entry->path())) ::unlink(entry->path().c_str());
  }
}

/// False for a zombie: a process that has ended, but whose parent has not waited for it.
bool isRunning(int process) {
  if (::kill(process, 0) != 0 && errno == ESRCH) return false;
  std::ifstream stream(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(stream, text);
  const size_t end = text.rfind(") ");  // The end of the process name, which may contain any character.
  return end == std::string::npos || (text[end + 2] != 'Z' && text[end + 2] != 'X');
}

/// Whether a running process has locked the file. False if the file system does not support locks.
bool isLocked(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool isHeld = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return isHeld;
}

}  // namespace

std::string temporaryFileName(unsigned count) {
  return fmt::format("{}{}-{}.part", temporaryPrefix(), ::getpid(), count);
}

void removeAbandonedFiles(const std::filesystem::path& folder) {
  removeTemporaries(
      folder, [](int process, const std::filesystem::path& path) { return !isRunning(process) && !isLocked(path); });
}

void removeFilesOfProcess(const std::filesystem::path& folder, int process) {
  removeTemporaries(
      folder, [process](int owner, const std::filesystem::path& path) { return owner == process && !isLocked(path); });
}

}  // namespace asdfvk
