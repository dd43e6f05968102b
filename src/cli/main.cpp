#include <oneapi/tbb/global_control.h>

#include <cstdlib>
#include <optional>

#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/run.h"
#include "cli/terminal.h"

namespace asdfvk {
namespace {

/// Limits the threads of TBB and of lavapipe, which reads its variable when the device is opened.
std::optional<oneapi::tbb::global_control> limitThreads(uint32_t threadCount) {
  if (threadCount == 0) return std::nullopt;
  setenv("LP_NUM_THREADS", std::to_string(threadCount).c_str(), 1);
  return std::optional<oneapi::tbb::global_control>(std::in_place, oneapi::tbb::global_control::max_allowed_parallelism,
                                                    threadCount);
}

/// Throws nothing: a failure is one line on standard error.
ExitCode runProgram(const std::vector<std::string>& arguments) {
  try {
    if (arguments.empty()) {
      writeStandardError(shortUsage());
      return ExitCode::Usage;
    }
    const CommandLine line = parseCommandLine(arguments);
    if (line.answer) {
      writeStandardOutput(*line.answer);
      return ExitCode::Done;
    }
    const auto threadLimit = limitThreads(line.threadCount);
    const Interrupt interrupt;
    if (line.listDevices) {
      printDevices(line);
      return ExitCode::Done;
    }
    return runMeshes(line, interrupt.token());
  } catch (...) {
    const Failure failure = currentFailure();
    printError("", failure.message);
    return failure.code;
  }
}

}  // namespace
}  // namespace asdfvk

int main(int argc, char** argv) {
  asdfvk::secureStandardStreams();
  return static_cast<int>(asdfvk::runProgram({argv + (argc > 0 ? 1 : 0), argv + argc}));
}
