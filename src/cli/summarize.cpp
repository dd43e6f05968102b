#include "cli/summarize.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "asdf_vk/error.h"
#include "batch/log_summary.h"
#include "batch/record_log.h"
#include "cli/option_parsing.h"
#include "cli/terminal.h"
#include "core/atomic_file.h"
#include "core/text.h"

namespace asdfvk {
namespace {

const std::vector<std::string> kSummaryFormats{"text", "json", "csv", "html"};

/// "html" for "page.HTML".
std::string formatOfName(const std::string& output) {
  const std::string extension = lowerCase(std::filesystem::path(output).extension().string());
  return extension.empty() ? "" : extension.substr(1);
}

std::string renderSummary(const LogSummary& summary, const std::string& format, const std::string& title) {
  if (format == "json") return jsonOf(summary);
  if (format == "csv") return csvOf(summary);
  if (format == "html") return pageOf(summary, title);
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
                              fmt::join(kSummaryFormats, "|")));
}

}  // namespace

void addOptions(CLI::App& app, SummaryOptions& options) {
  app.name("asdf-vk summarize");
  app.description(
      "Summarises the logs of batches: times, estimated errors, failures by code. Of several records of a mesh\n"
      "the latest one counts.");
  app.set_help_flag("-h,--help", "Print this help");
  app.add_option("logs", options.logs, "Logs of --log")->option_text("LOG.jsonl...")->required();
  addName(app, "--format", options.format, kSummaryFormats,
          "csv: a row per mesh. html: a page with histograms; default text, or by -o");
  app.add_flag("--json", options.isJson, "The same as --format json");
  addValue(app, "-o,--output", "FILE|-", "Write to a file; default standard output",
           [&](const std::string& text) { options.output = text; });
}

ExitCode summarize(std::vector<std::string> arguments) {
  SummaryOptions options;
  CLI::App app;
  addOptions(app, options);
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back.
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::Success&) {
    writeStandardOutput(app.help());
    return ExitCode::Done;
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::OptionOutOfRange, std::string(error.what()) + "; see asdf-vk summarize --help");
  }
  completeFormat(options);

  std::vector<MeshRecord> records;
  size_t invalidCount = 0;
  for (const std::string& log : options.logs)
    for (MeshRecord& record : readLog(log, invalidCount)) records.push_back(std::move(record));
  const LogSummary summary = summarizeRecords(std::move(records), invalidCount);
  AtomicFile file(options.output);
  file.write(renderSummary(summary, options.format, "Batch of " + counted(summary.meshes.size(), "mesh", "meshes")));
  file.commit();
  return ExitCode::Done;
}

}  // namespace asdfvk
