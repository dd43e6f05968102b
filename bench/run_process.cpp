#include "run_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "asdf_vk/error.h"
#include "cli/exit_code.h"

namespace asdfvk::bench {
namespace {

[[noreturn]] void fail(int errorNumber) {
  throw Error(ErrorCode::UnreadableInput, fmt::format("no further process can be started: {}", std::strerror(errorNumber)));
}

pid_t spawn(std::string name, const std::vector<std::string>& arguments, int standardOutput) {
  std::vector<std::string> owned = arguments;
  std::vector<char*> pointers{name.data()};
  for (std::string& argument : owned) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, standardOutput, STDOUT_FILENO);
  pid_t process = 0;
  const int error = posix_spawn(&process, name.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) fail(error);
  return process;
}

std::string readAll(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<size_t>(count));
  }
}

}  // namespace

std::string outputOf(const std::string& program, const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail(errno);
  pid_t process = 0;
  try {
    process = spawn(program, arguments, ends[1]);
  } catch (...) {
    close(ends[0]);
    close(ends[1]);
    throw;
  }
  close(ends[1]);
  std::string text = readAll(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status))
    throw Error(ErrorCode::UnreadableInput, fmt::format("a run in a process of its own ended by signal {}", WTERMSIG(status)));
  if (WEXITSTATUS(status) == static_cast<int>(ExitCode::Cancelled)) throw Error(ErrorCode::Cancelled, "cancelled");
  if (WEXITSTATUS(status) != 0)
    throw Error(ErrorCode::UnreadableInput,
                fmt::format("a run in a process of its own failed with exit code {}; its reason is above",
                            WEXITSTATUS(status)));
  return text;
}

}  // namespace asdfvk::bench
