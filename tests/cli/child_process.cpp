#include "cli/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

#include "core/check.h"
#include "core/stopwatch.h"
#include "support/kept_json.h"

namespace asdfvk::test {
namespace {

struct Pipe {
  int read = -1, write = -1;
};

Pipe makePipe() {
  std::array<int, 2> ends{};
  ASDFVK_CHECK_OP(pipe2(ends.data(), O_CLOEXEC), ==, 0);
  return {ends[0], ends[1]};
}

/// read is our side, write the side of the child.
Pipe makeTerminal() {
  const int ours = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASDFVK_CHECK_OP(ours, >=, 0);
  ASDFVK_CHECK(grantpt(ours) == 0 && unlockpt(ours) == 0);
  const int theirs = open(ptsname(ours), O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASDFVK_CHECK_OP(theirs, >=, 0);
  return {ours, theirs};
}

void closeStream(int& stream) {
  if (stream >= 0) close(stream);
  stream = -1;
}

void drain(int& stream, std::string& text) {
  std::array<char, 65536> buffer;
  const ssize_t count = read(stream, buffer.data(), buffer.size());
  if (count > 0) text.append(buffer.data(), static_cast<size_t>(count));
  if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) closeStream(stream);
}

[[noreturn]] void becomeProgram(const std::string& program, const std::vector<std::string>& arguments,
                                const ChildOptions& options, int input, int output, int error) {
  if (!options.outputFile.empty()) output = open(options.outputFile.c_str(), O_WRONLY | O_CLOEXEC);
  if (dup2(input, 0) < 0 || dup2(output, 1) < 0 || dup2(error, 2) < 0) _exit(126);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                           const ChildOptions& options)
    : pendingInput_(options.input),
      keptInput_(!arguments.empty() && arguments.front() == "serve" ? options.input : ""),
      keepInputOpen_(options.keepInputOpen) {
  std::signal(SIGPIPE, SIG_IGN);  // A child that does not read its input must not end the test.
  const Pipe in = makePipe();
  const Pipe out = makePipe();
  const Pipe err = options.errorIsTerminal ? makeTerminal() : makePipe();
  process_ = fork();
  ASDFVK_CHECK_OP(process_, >=, 0);
  if (process_ == 0) becomeProgram(program, arguments, options, in.read, out.write, err.write);
  close(in.read);
  close(out.write);
  close(err.write);
  input_ = in.write;
  output_ = out.read;
  error_ = err.read;
  fcntl(input_, F_SETFL, O_NONBLOCK);
}

ChildProcess::~ChildProcess() {
  if (process_ > 0) finish(0);
}

bool ChildProcess::pump(int milliseconds) {
  if (pendingInput_.empty() && !keepInputOpen_) closeStream(input_);
  std::array<pollfd, 3> streams{pollfd{output_, POLLIN, 0}, pollfd{error_, POLLIN, 0},
                                pollfd{pendingInput_.empty() ? -1 : input_, POLLOUT, 0}};
  if (poll(streams.data(), streams.size(), milliseconds) < 0) return true;
  if (streams[0].revents != 0) drain(output_, outcome_.output);
  if (streams[1].revents != 0) drain(error_, outcome_.error);
  if (streams[2].revents != 0) {
    const ssize_t count = write(input_, pendingInput_.data(), pendingInput_.size());
    if (count > 0) pendingInput_.erase(0, static_cast<size_t>(count));
    if (count < 0 && errno != EAGAIN && errno != EINTR) pendingInput_.clear();
  }
  return output_ >= 0 || error_ >= 0;
}

bool ChildProcess::waitForError(const std::string& text, double seconds) {
  return waitFor(text, outcome_.error, seconds);
}

bool ChildProcess::waitForOutput(const std::string& text, double seconds) {
  return waitFor(text, outcome_.output, seconds);
}

bool ChildProcess::waitFor(const std::string& text, const std::string& stream, double seconds) {
  const Stopwatch watch;
  while (stream.find(text) == std::string::npos)
    if (!pump(50) || watch.seconds() > seconds) return stream.find(text) != std::string::npos;
  return true;
}

void ChildProcess::send(int signal) const { kill(process_, signal); }

ChildOutcome ChildProcess::finish(double seconds) {
  const Stopwatch watch;
  while (watch.seconds() < seconds && pump(50)) {
  }
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(process_, &status, WNOHANG)) == 0 && watch.seconds() < seconds) usleep(1000);
  if (ended == 0) {
    kill(process_, SIGKILL);
    waitpid(process_, &status, 0);
  }
  process_ = -1;
  closeStream(input_);
  closeStream(output_);
  closeStream(error_);
  if (WIFEXITED(status)) outcome_.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome_.signal = WTERMSIG(status);
  if (outcome_.signal == 0) keepJson(outcome_.output, keptInput_);
  return outcome_;
}

ChildOutcome runChild(const std::string& program, const std::vector<std::string>& arguments,
                      const ChildOptions& options) {
  ChildProcess child(program, arguments, options);
  return child.finish(300);
}

}  // namespace asdfvk::test
