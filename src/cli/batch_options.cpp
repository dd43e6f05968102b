#include "cli/batch_options.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "cli/option_parsing.h"
#include "cli/outputs.h"
#include "core/text.h"

namespace asdfvk {
namespace {

constexpr const char* kBatchGroup = "Many meshes";
constexpr uint32_t kMaxJobCount = 1024;

void addInputs(ArgumentParser& parser, BatchOptions& batch) {
  parser
      .addFlag("-r,--recursive", batch.recurses,
               "Folders are inputs: every mesh below them; results in the same tree below -o")
      .group(kBatchGroup);
  addValue(parser, "--files-from", "FILE|-", "Also compute the meshes of a list, a path per line; - is standard input",
           [&](const std::string& text) { batch.list = text; })
      .group(kBatchGroup);
  parser.addFlag("-0,--null", batch.isNullSeparated, "--files-from: paths end with a zero byte, as find -print0 writes")
      .group(kBatchGroup);
  addValue(parser, "--shard", "I/N", "Compute part I of N only; the parts are of about the same size",
           [&](const std::string& text) { batch.shard = parseShard(text); })
      .group(kBatchGroup);
}

void addRecords(ArgumentParser& parser, BatchOptions& batch) {
  addValue(parser, "--log", "FILE.jsonl", "Append a record per mesh as JSON; asdf-vk summarize FILE.jsonl reads it",
           [&](const std::string& text) { batch.log = text; })
      .group(kBatchGroup);
  parser
      .addFlag("--skip-existing", batch.skipsExisting,
               "Skip meshes whose result is that of the same input, options and version")
      .group(kBatchGroup);
}

void addLimits(ArgumentParser& parser, BatchOptions& batch) {
  addValue(parser, "--timeout", "SECONDS",
           "Fail a mesh that takes longer, exit code 8; without --isolate between steps only",
           [&](const std::string& text) { batch.timeoutSeconds = parseSeconds(text); })
      .group(kBatchGroup);
  addValue(parser, "--memory-limit", "SIZE",
           "Fail a mesh that takes more memory, such as 500M or 2G, exit code 8; implies\n--isolate",
           [&](const std::string& text) { batch.memoryBytes = parseByteCount(text); })
      .group(kBatchGroup);
  parser
      .addFlag("--isolate", batch.isolates,
               "Compute in worker processes, so that a mesh that crashes or hangs fails alone")
      .group(kBatchGroup);
  addValue(
      parser, "--jobs", "N", "Meshes at once; default: the number of cores for many small meshes, else 1",
      [&](const std::string& text) { batch.jobCount = static_cast<uint32_t>(parseWholeNumber(text, 1, kMaxJobCount)); })
      .group(kBatchGroup);
}

}  // namespace

uint64_t parseByteCount(const std::string& text) {
  constexpr std::string_view kUnits = "kmgt";
  const size_t unit = text.empty() ? std::string_view::npos : kUnits.find(lowerCase(text).back());
  const bool hasUnit = unit != std::string_view::npos;
  const auto reject = [&]() -> uint64_t {
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' is not a size such as 500M or 2G", text));
  };
  try {
    const double number = parseNumber(hasUnit ? text.substr(0, text.size() - 1) : text);
    const double bytes = hasUnit ? std::ldexp(number, 10 * (static_cast<int>(unit) + 1)) : number;
    return bytes >= 1 && bytes < 0x1p63 ? static_cast<uint64_t>(bytes) : reject();
  } catch (const Error&) {
    return reject();
  }
}

void addBatch(ArgumentParser& parser, CommandLine& line) {
  addInputs(parser, line.batch);
  addRecords(parser, line.batch);
  addLimits(parser, line.batch);
}

void completeBatch(const ArgumentParser& parser, CommandLine& line) {
  BatchOptions& batch = line.batch;
  if (batch.memoryBytes > 0) batch.isolates = true;
  const bool readsInput = std::count(line.meshes.begin(), line.meshes.end(), "-") > 0;
  if (batch.isNullSeparated && batch.list.empty()) refuseOptions("-0 needs --files-from");
  if (parser.isGiven("--files-from") && batch.list.empty()) refuseOptions("--files-from: the name is empty");
  if (parser.isGiven("--log") && batch.log.empty()) refuseOptions("--log: the name is empty");
  if (batch.list == "-" && readsInput)
    refuseOptions("--files-from - and the mesh - both read standard input; give one of them a file");
  if (batch.isolates && readsInput)
    refuseOptions(
        "--isolate and --memory-limit compute in other processes, which cannot read the mesh -; give it a file");
  if (batch.skipsExisting && readsInput) refuseOptions("--skip-existing does not apply to the mesh -; give it a file");
  if (!batch.isBatch()) {
    if (batch.jobCount > 1 && writesOnePage(line.outputs))
      refuseOptions("one page takes one mesh after another; drop --jobs");
    return;
  }
  if (line.outputs.path == "-") refuseOptions("-o - takes the result of one mesh; give -o a folder");
  if (!line.outputs.picture.empty() || !line.outputs.points.empty())
    refuseOptions(
        "--picture and --points take one mesh; drop them, or -r, --files-from, --log, --skip-existing, --shard and "
        "--isolate");
  if (writesOnePage(line.outputs) || line.outputs.opensPage)
    refuseOptions("a batch writes a page per mesh: give -o a folder, with --format html, and drop --open");
}

}  // namespace asdfvk
