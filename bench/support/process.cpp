#include "support/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "asdf_vk/error.h"
#include "core/stopwatch.h"
#include "support/measurement.h"
#include "support/program.h"

namespace asdfvk::bench {
namespace {

[[noreturn]] void failToStart(int errorNumber) {
  throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(errorNumber)));
}

pid_t spawn(std::string program, std::vector<std::string> arguments, int standardOutput) {
  std::vector<char*> pointers{program.data()};
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, standardOutput, STDOUT_FILENO);
  // This process blocks the signals for which Program::run() waits. The child must not inherit the blocked signals.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t process = 0;
  const int error = posix_spawn(&process, program.c_str(), &actions, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) failToStart(error);
  return process;
}

// The peak memory is read in this interval. wait4() cannot replace the readings, because its peak includes the memory
// of this process.
constexpr int kPollMilliseconds = 5;

std::string readAll(int descriptor, pid_t process, double& peakBytes) {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    pollfd waiting{descriptor, POLLIN, 0};
    if (poll(&waiting, 1, kPollMilliseconds) == 0) {
      peakBytes = std::max(peakBytes, peakMemoryBytes(process));
      continue;
    }
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<size_t>(count));
  }
}

double secondsOf(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::string outputOf(const std::string& program, const std::vector<std::string>& arguments, ProcessUsage* usage) {
  const Stopwatch watch;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) failToStart(errno);
  pid_t process = 0;
  try {
    process = spawn(program, arguments, ends[1]);
  } catch (...) {
    close(ends[0]);
    close(ends[1]);
    throw;
  }
  close(ends[1]);
  double peakBytes = 0;
  std::string text = readAll(ends[0], process, peakBytes);
  close(ends[0]);
  int status = 0;
  rusage used{};
  while (wait4(process, &status, 0, &used) < 0 && errno == EINTR) {
  }
  if (usage != nullptr) *usage = {watch.seconds(), secondsOf(used.ru_utime) + secondsOf(used.ru_stime), peakBytes};
  if (WIFSIGNALED(status))
    throw std::runtime_error(fmt::format("{} was ended by signal {}", program, WTERMSIG(status)));
  if (WEXITSTATUS(status) == kCancelledExitCode) throw Error(ErrorCode::Cancelled, "cancelled");
  if (WEXITSTATUS(status) != 0)
    throw std::runtime_error(
        fmt::format("{} failed with exit code {}; its message is above", program, WEXITSTATUS(status)));
  return text;
}

}  // namespace asdfvk::bench
