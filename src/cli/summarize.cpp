#include "cli/summarize.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "asdf_vk/error.h"
#include "batch/log_summary.h"
#include "batch/record_log.h"
#include "cli/options.h"
#include "core/atomic_file.h"
#include "core/text.h"
#include "process/terminal.h"

namespace asdfvk {
namespace {

const std::vector<std::string> kSummaryFormats{"text", "json", "csv"};

/// "csv" for "table.CSV".
std::string formatOfName(const std::string& output) {
  const std::string extension = lowerCase(std::filesystem::path(output).extension().string());
  return extension.empty() ? "" : extension.substr(1);
}

std::string renderSummary(const LogSummary& summary, const std::string& format) {
  if (format == "json") return jsonOf(summary);
  if (format == "csv") return csvOf(summary);
  return textOf(summary);
}

/// --json and the extension of -o; refuses what would give another file than was meant.
void completeFormat(SummaryOptions& options) {
  if (options.isJson && !options.format.empty() && options.format != "json")
    refuseOptions(fmt::format("--json contradicts --format {}; drop one", options.format));
  if (options.isJson) options.format = "json";
  if (options.output == "-") return;
  for (const std::string& log : options.logs) {
    std::error_code ignored;
    if (std::filesystem::equivalent(log, options.output, ignored))
      refuseOptions(fmt::format("-o {} is a log and would be overwritten; choose another -o", options.output));
  }
  if (!options.format.empty()) return;
  options.format = formatOfName(options.output);
  if (options.format.empty() || options.format == "txt") options.format = "text";
  if (std::count(kSummaryFormats.begin(), kSummaryFormats.end(), options.format) == 0)
    refuseOptions(fmt::format("-o {}: the extension names no format; give --format {}", options.output,
                              joined(kSummaryFormats, "|")));
}

const std::array kSummaryRows{
    OptionRow{.name = "format",
              .group = kBasicGroup,
              .access = ASDFVK_MEMBER(SummaryOptions, format),
              .text = "csv: a row per mesh",
              .defaultText = "text, or by -o",
              .valueNames = "text|json|csv"},
    OptionRow{.name = "json",
              .group = kBasicGroup,
              .access = ASDFVK_MEMBER(SummaryOptions, isJson),
              .text = "The same as --format json"},
    OptionRow{.name = "output",
              .group = kBasicGroup,
              .access = ASDFVK_MEMBER(SummaryOptions, output),
              .text = "Write to a file",
              .placeholder = "FILE|-",
              .defaultText = "standard output",
              .flags = "-o,--output"},
};

}  // namespace

void addOptions(ArgumentParser& parser, SummaryOptions& options) {
  parser.setProgram(
      "asdf-vk summarize",
      "Summarises the logs of batches: times, estimated errors, failures by code. Of several records of a mesh\n"
      "the latest one counts.");
  parser.setHelp("Print this help");
  parser.addList("logs", "LOG.jsonl...", "Logs of --log", options.logs).require();
  addRows(parser, {kSummaryRows, &options});
}

ExitCode summarize(std::vector<std::string> arguments) {
  SummaryOptions options;
  ArgumentParser parser;
  addOptions(parser, options);
  const ParseResult result = parser.parse(std::move(arguments));
  if (!result.refusal.empty())
    throw Error(ErrorCode::OptionOutOfRange, result.refusal + "; see asdf-vk summarize --help");
  if (!result.answer.empty()) {
    writeStandardOutput(result.answer);
    return ExitCode::Done;
  }
  completeFormat(options);

  std::vector<MeshRecord> records;
  size_t invalidCount = 0;
  for (const std::string& log : options.logs)
    for (MeshRecord& record : readLog(log, invalidCount)) records.push_back(std::move(record));
  const LogSummary summary = summarizeRecords(std::move(records), invalidCount);
  AtomicFile file(options.output);
  file.write(renderSummary(summary, options.format));
  file.commit();
  return ExitCode::Done;
}

}  // namespace asdfvk
