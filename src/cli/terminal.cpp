#include "cli/terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>

#include "asdf_vk/error.h"
#include "cli/exit_code.h"

namespace asdfvk {
namespace {

/// 0 or the errno of the failure.
int writeAll(int stream, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(stream, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    text.remove_prefix(static_cast<size_t>(count));
  }
  return 0;
}

void printLine(std::string_view kind, std::string_view subject, std::string_view message) {
  const std::string line = subject.empty() ? fmt::format("asdf-vk: {}: {}", kind, message)
                                           : fmt::format("asdf-vk: {}: {}: {}", kind, subject, message);
  writeStandardError(oneLine(line) + "\n");
}

}  // namespace

void writeStandardOutput(std::string_view text) {
  if (const int error = writeAll(STDOUT_FILENO, text); error != 0)
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("standard output cannot be written: {}", std::strerror(error)));
}

void writeStandardError(std::string_view text) { writeAll(STDERR_FILENO, text); }

void printError(std::string_view subject, std::string_view message) { printLine("error", subject, message); }
void printWarning(std::string_view subject, std::string_view message) { printLine("warning", subject, message); }

void secureStandardStreams() {
  std::signal(SIGPIPE, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free number is the one that is missing. Read-only, so that writing to it still fails.
    if (open("/dev/null", O_RDONLY) != stream) return;
  }
}

bool isStandardErrorTerminal() { return isatty(STDERR_FILENO) == 1; }

}  // namespace asdfvk
