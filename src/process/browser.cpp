#include "process/browser.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>

#include "asdf_vk/error.h"

namespace asdfvk {

void openInBrowser(const std::string& path) {
  std::string opener = "xdg-open", file = std::filesystem::absolute(path).string();
  char* const arguments[]{opener.data(), file.data(), nullptr};
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&streams, stream, "/dev/null", O_RDWR, 0);
  // The browser must outlive the session of the terminal, and must not inherit ignored signals.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t ignored;
  sigemptyset(&ignored);
  for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&ignored, signal);
  posix_spawnattr_setsigdefault(&attributes, &ignored);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  const int error = posix_spawnp(&process, opener.c_str(), &streams, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&streams);
  if (error != 0)
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("{} is written, but {} (package xdg-utils) cannot be started to open it: {}", path, opener,
                            std::strerror(error)));
}

}  // namespace asdfvk
