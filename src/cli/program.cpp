#include "cli/program.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>

#include "asdf_vk/error.h"
#include "asdf_vk/run_control.h"
#include "batch/check_report.h"
#include "batch/log_summary.h"
#include "batch/mesh_record.h"
#include "cli/batch_run.h"
#include "cli/command_line.h"
#include "cli/device_output.h"
#include "cli/one_mesh.h"
#include "cli/report_json.h"
#include "cli/serve_commands.h"
#include "core/text.h"
#include "process/heap.h"
#include "process/interrupt.h"
#include "process/terminal.h"

namespace asdfvk {
namespace {

/// Prints the devices. Returns Device if a GPU is required and none is usable, else Done.
ExitCode printDevices(bool requireGpu, bool asJson) {
  std::string reason;
  const std::vector<DeviceInfo> devices = listDevices(&reason, requireGpu);
  writeStandardOutput(asJson ? jsonDevices(devices, reason) : textDevices(devices, reason));
  const bool hasUsable =
      std::any_of(devices.begin(), devices.end(), [](const DeviceInfo& device) { return device.usable; });
  if (!requireGpu || hasUsable) return ExitCode::Done;
  printError("", "no GPU is usable; install the driver of the GPU, or drop --require-gpu");
  return ExitCode::Device;
}

CheckPolicy policyOf(const Outputs& outputs) {
  CheckPolicy policy;
  if (!outputs.limits.empty()) policy.limits = readLimits(outputs.limits);
  if (!outputs.baseline.empty() && !outputs.updatesBaseline) policy.baseline = readBaseline(outputs.baseline);
  return policy;
}

MeshSettings settingsWithPolicy(const CommandLine& line) {
  MeshSettings settings = meshSettingsOf(line);
  settings.policy = policyOf(line.outputs);
  return settings;
}

constexpr const char* kSummarize = "summarize";

/// Throws Error{UnknownName} if the first argument is no file and looks like a misspelt command.
void requireNoMisspeltCommand(const std::string& first) {
  if (first.find_first_of("./") != std::string::npos) return;  // The name of a file.
  std::error_code ignored;
  const std::string similar = similarNames(first, {kSummarize, kServe, kMcp});
  if (similar.empty() || std::filesystem::exists(first, ignored)) return;
  throw Error(ErrorCode::UnknownName,
              fmt::format("'{}' is neither a file nor a command; did you mean {}?", first, similar));
}

/// The command `asdf-vk summarize LOG.jsonl...`. arguments: those after `summarize`.
ExitCode summarize(const std::vector<std::string>& arguments) {
  std::vector<std::string> logs;
  std::string format;
  bool isJson = false;
  ArgumentParser parser(
      fmt::format("asdf-vk {}", kSummarize),
      "Summarises the logs of batches: times, estimated errors, failures by code. If a mesh has several "
      "records, only the latest one counts.",
      "",
      {{.names = "logs",
        .placeholder = "LOG.jsonl...",
        .text = "Logs that --log wrote",
        .receive = [&logs](const Argument::Values& values) { logs = values; },
        .isRequired = true,
        .isList = true},
       {.names = "--format",
        .placeholder = "text|json|csv|sarif|junit|github",
        .text = "text: a summary. json: the summary as one document. csv: a table with a row per mesh. sarif, junit, "
                "github: the checks, as by --report-format",
        .receive = into(format)},
       {.names = "--json", .text = "As --format json", .receive = [&isJson](const Argument::Values&) {
          isJson = true;
        }}});
  if (const std::string answer = parser.parse(arguments); !answer.empty()) {
    writeStandardOutput(answer);
    return ExitCode::Done;
  }
  if (isJson && !format.empty() && format != "json")
    refuseOptions(fmt::format("--json and --format {} contradict each other; drop one", format));
  if (format.empty()) format = isJson ? "json" : "text";
  std::vector<std::string> formats{"text", "json", "csv"};
  const std::vector<std::string> checkFormats = checkFormatNames();
  formats.insert(formats.end(), checkFormats.begin(), checkFormats.end());
  if (std::find(formats.begin(), formats.end(), format) == formats.end())
    throw Error(ErrorCode::UnknownName, fmt::format("--format: '{}' is not one of {}", format, joined(formats, "|")));
  std::vector<MeshRecord> records;
  size_t invalidCount = 0;
  for (const std::string& log : logs)
    for (MeshRecord& record : readLog(log, invalidCount)) records.push_back(std::move(record));
  const LogSummary summary = summarizeRecords(std::move(records), invalidCount);
  writeStandardOutput(format == "json"   ? jsonOf(summary)
                      : format == "csv"  ? csvOf(summary)
                      : format == "text" ? textOf(summary)
                                         : checkReport(checkFormatOf(format), summary.meshes));
  return ExitCode::Done;
}

/// Prints a failure of the whole call; an invalid command line also as JSON if that was asked for.
ExitCode reportFailure(const Failure& failure, const std::vector<std::string>& arguments) {
  printError("", failure.message);
  const bool isJson = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
  if (failure.code != ExitCode::Usage || !isJson) return failure.code;
  try {
    writeStandardOutput(jsonFailure("", failure.name, failure.message));
  } catch (const std::exception&) {
    return ExitCode::Output;
  }
  return failure.code;
}

ExitCode runCommand(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    writeStandardError(shortUsage());
    return ExitCode::Usage;
  }
  if (arguments.front() == kWorkerArgument) {
    runWorker();
    return ExitCode::Done;
  }
  if (arguments.front() == kSummarize) return summarize({arguments.begin() + 1, arguments.end()});
  if (arguments.front() == kServe || arguments.front() == kMcp)
    return runServer(arguments.front(), {arguments.begin() + 1, arguments.end()});
  requireNoMisspeltCommand(arguments.front());
  const CommandLine line = parseCommandLine(arguments);
  if (line.answer) {
    writeStandardOutput(*line.answer);
    return ExitCode::Done;
  }
  const ThreadLimit threadLimit(line.session.threadCount);
  const Interrupt interrupt;
  if (line.listDevices) return printDevices(line.session.requireGpu, line.outputs.json);
  if (line.deviceReport) return printDeviceReport(line.session, interrupt.token());
  if (line.meshes.size() == 1 && !line.batch.isBatch() && !line.outputs.needsRecords() &&
      !hasPictureFolder(line.outputs))
    return computeOneMesh(line.meshes.front(), settingsWithPolicy(line), interrupt.token());
  return computeBatch(line.meshes, settingsWithPolicy(line), line.batch, interrupt.token());
}

}  // namespace

ExitCode runProgram(const std::vector<std::string>& arguments) {
  secureStandardStreams();
  configureHeap();
  try {
    return runCommand(arguments);
  } catch (...) {
    return reportFailure(currentFailure(), arguments);
  }
}

}  // namespace asdfvk
