#include "process/browser.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

constexpr const char* kOpener = "xdg-open";

/// In the folders of PATH; empty where there is none.
std::string findOpener() {
  const char* const variable = std::getenv("PATH");
  std::istringstream folders(variable == nullptr ? "/usr/local/bin:/usr/bin:/bin" : variable);
  std::error_code ignored;
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string path = (std::filesystem::path(folder.empty() ? "." : folder) / kOpener).string();
    if (std::filesystem::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0) return path;
  }
  return "";
}

}  // namespace

void requireBrowser() {
  if (findOpener().empty())
    throw Error(
        ErrorCode::OptionConflict,
        fmt::format("--open needs the program {} (package xdg-utils), which is not in PATH; drop --open", kOpener));
}

void openInBrowser(const std::string& path) {
  requireBrowser();
  const std::string opener = findOpener(), file = std::filesystem::absolute(path).string();
  // A child of a child: init waits for it, and the browser outlives this program.
  const pid_t child = fork();
  if (child < 0)
    throw Error(ErrorCode::OutputNotWritable, fmt::format("{} cannot be started: {}", kOpener, std::strerror(errno)));
  if (child == 0) {
    if (setsid() < 0 || fork() != 0) _exit(0);
    const int null = open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      if (null >= 0) dup2(null, stream);
    for (const int ignored : {SIGPIPE, SIGXFSZ}) signal(ignored, SIG_DFL);  // Programs inherit what this one ignores.
    execl(opener.c_str(), kOpener, file.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
}

}  // namespace asdfvk
