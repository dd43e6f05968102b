#include "support/program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stop_token>
#include <thread>

#include "asdf_vk/error.h"
#include "process/heap.h"

namespace asdfvk::bench {
namespace {

constexpr int kFailureExitCode = 70;

template <typename T>
void restrict(CLI::Option& option, const Range<T>& range) {
  if (range != Range<T>{}) option.check(CLI::Range(range.min, range.max));
}

template <typename T>
void addNumber(CLI::App& app, const std::string& name, T& value, const std::string& text, const Range<T>& range) {
  restrict(*app.add_option(name, value, text)->capture_default_str(), range);
}

// A list is a single argument. With several arguments, CLI11 would add the meshes that follow to the list.
template <typename T>
CLI::Option* addList(CLI::App& app, const std::string& name, std::vector<T>& list, const std::string& text,
                     char separator = ',') {
  return app.add_option(name, list, text)->delimiter(separator)->allow_extra_args(false)->capture_default_str();
}

/// Blocks SIGINT and SIGTERM in this thread and in all threads that it starts later. A separate thread waits for these
/// signals. The first signal requests a stop, the second signal ends the process. A signal that the parent process
/// ignores stays ignored.
class SignalWaiter {
 public:
  SignalWaiter() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM}) {
      struct sigaction action {};
      sigaction(signal, nullptr, &action);
      if (action.sa_handler != SIG_IGN) sigaddset(&signals_, signal);
    }
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    waiter_ = std::jthread([this](const std::stop_token& end) {
      constexpr timespec kPollInterval{0, 50'000'000};
      while (!end.stop_requested())
        if (sigtimedwait(&signals_, nullptr, &kPollInterval) > 0 && !stop_.request_stop()) _exit(kCancelledExitCode);
    });
  }

  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

 private:
  sigset_t signals_;
  std::stop_source stop_;
  std::jthread waiter_;
};

int exitCodeOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Usage:
      return 1;
    case ErrorKind::Input:
      return 2;
    case ErrorKind::Device:
      return 3;
    case ErrorKind::Output:
      return 4;
    case ErrorKind::Cancelled:
      return kCancelledExitCode;
  }
  return kFailureExitCode;
}

}  // namespace

Program::Program(const std::string& name, const std::string& summary)
    : app_(std::make_unique<CLI::App>(summary, name)) {}

Program::~Program() = default;

void Program::addMeshes(std::vector<std::string>& paths) {
  app_->add_option("meshes", paths, "Meshes")->option_text("MESH...")->required();
}

void Program::addOptionalMeshes(std::vector<std::string>& paths, const std::string& substitute) {
  app_->add_option("meshes", paths, "Meshes; default: " + substitute)->option_text("MESH...");
}

void Program::add(const std::string& name, bool& value, const std::string& text) { app_->add_flag(name, value, text); }

void Program::add(const std::string& name, std::string& value, const std::string& text) {
  app_->add_option(name, value, text)->capture_default_str();
}

void Program::addRequired(const std::string& name, std::string& value, const std::string& placeholder,
                          const std::string& text) {
  app_->add_option(name, value, text)->option_text(placeholder)->required();
}

void Program::add(const std::string& name, uint32_t& value, const std::string& text, Range<uint32_t> range) {
  addNumber(*app_, name, value, text, range);
}

void Program::add(const std::string& name, uint64_t& value, const std::string& text, Range<uint64_t> range) {
  addNumber(*app_, name, value, text, range);
}

void Program::add(const std::string& name, double& value, const std::string& text, Range<double> range) {
  addNumber(*app_, name, value, text, range);
}

void Program::add(const std::string& name, std::vector<std::string>& list, const std::string& text, char separator) {
  addList(*app_, name, list, text, separator);
}

void Program::add(const std::string& name, std::vector<uint32_t>& list, const std::string& text,
                  Range<uint32_t> range) {
  restrict(*addList(*app_, name, list, text), range);
}

void Program::add(const std::string& name, std::vector<uint64_t>& list, const std::string& text) {
  addList(*app_, name, list, text);
}

void Program::add(const std::string& name, std::vector<double>& list, const std::string& text) {
  addList(*app_, name, list, text);
}

int Program::run(int argc, char** argv, const std::function<void(const RunControl&)>& body) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) == 0 ? 0 : exitCodeOf(ErrorKind::Usage);
  }
  configureHeap();  // The program does this too. Benchmarks measure what users of the program wait for.
  int exitCode = kFailureExitCode;
  try {
    const SignalWaiter signals;
    body({signals.token(), {}});
    return 0;
  } catch (const Error& error) {
    exitCode = exitCodeOf(error.kind());
    writeProgress(fmt::format("{}: error: {}", app_->get_name(), error.what()));
  } catch (const std::exception& error) {
    writeProgress(fmt::format("{}: error: {}", app_->get_name(), error.what()));
  }
  return exitCode;
}

void writeOutput(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw Error(ErrorCode::OutputNotWritable, fmt::format("cannot write to standard output: {}", std::strerror(errno)));
}

void writeProgress(std::string_view text) {
  const std::string line = std::string(text) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace asdfvk::bench
