#include "asdf_vk/run_control.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/run.h"
#include "cli/terminal.h"

namespace asdfvk {
namespace {

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
    const ThreadLimit threadLimit(line.threadCount);
    const Interrupt interrupt;
    if (line.listDevices) {
      printDevices(line);
      return ExitCode::Done;
    }
    if (line.deviceReport) return printDeviceReport(line, interrupt.token());
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
