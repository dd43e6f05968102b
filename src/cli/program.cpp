#include "cli/program.h"

#include <malloc.h>

#include "asdf_vk/run_control.h"
#include "cli/batch_worker.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/run.h"
#include "cli/summarize.h"
#include "cli/terminal.h"

namespace asdfvk {
namespace {

/// Freed memory up to this size is used again instead of being returned to the kernel, which clears each new page.
constexpr int kKeptBytes = 32 << 20;  // The most that glibc accepts as M_MMAP_THRESHOLD.

void keepFreedMemory() {
  ::mallopt(M_MMAP_THRESHOLD, kKeptBytes);
  ::mallopt(M_TRIM_THRESHOLD, 4 * kKeptBytes);
}

ExitCode runCommand(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    writeStandardError(shortUsage());
    return ExitCode::Usage;
  }
  if (arguments.front() == kWorkerArgument) return runWorker();
  if (arguments.front() == kSummarizeCommand) return summarize({arguments.begin() + 1, arguments.end()});
  const CommandLine line = parseCommandLine(arguments);
  if (line.answer) {
    writeStandardOutput(*line.answer);
    return ExitCode::Done;
  }
  const ThreadLimit threadLimit(line.threadCount);
  const Interrupt interrupt;
  if (line.listDevices) return printDevices(line);
  if (line.deviceReport) return printDeviceReport(line, interrupt.token());
  return runMeshes(line, arguments, interrupt.token());
}

}  // namespace

ExitCode runProgram(const std::vector<std::string>& arguments) {
  secureStandardStreams();
  keepFreedMemory();
  try {
    return runCommand(arguments);
  } catch (...) {
    const Failure failure = currentFailure();
    printError("", failure.message);
    return failure.code;
  }
}

}  // namespace asdfvk
