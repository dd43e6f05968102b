#include "batch/output_record.h"

#include <fstream>
#include <iterator>
#include <system_error>

#include "batch/content_hash.h"
#include "core/atomic_file.h"

namespace asdfvk {

namespace fs = std::filesystem;

namespace {

/// Whether records lie beside the output: not beside a device, a FIFO or standard output.
bool hasRecord(const fs::path& output) {
  std::error_code ignored;
  const fs::file_status status = fs::status(output, ignored);
  return output != "-" && (fs::is_regular_file(status) || !fs::exists(status));
}

}  // namespace

fs::path outputRecordPath(const fs::path& output) { return output.string() + ".json"; }

std::optional<MeshRecord> findFinishedOutput(const MeshRecord& expected, const fs::path& output) {
  if (!hasRecord(output)) return std::nullopt;
  std::ifstream in(outputRecordPath(output), std::ios::binary);
  if (!in) return std::nullopt;
  std::optional<MeshRecord> record = parseRecord(std::string(std::istreambuf_iterator<char>(in), {}));
  if (!record || record->code != 0 || record->inputHash != expected.inputHash ||
      record->optionsHash != expected.optionsHash || record->version != expected.version ||
      record->commit != expected.commit || record->outputHash.empty() || contentHashOf(output) != record->outputHash)
    return std::nullopt;
  record->input = expected.input;
  record->output = output.string();
  record->time = expected.time;
  record->status = MeshStatus::Skipped;
  return record;
}

void removeOutputRecord(const fs::path& output) {
  if (!hasRecord(output)) return;
  std::error_code ignored;
  fs::remove(outputRecordPath(output), ignored);
}

void writeOutputRecord(MeshRecord& record, const fs::path& output) {
  if (!hasRecord(output)) return;
  record.outputHash = contentHashOf(output).value_or("");
  AtomicFile file(outputRecordPath(output));
  file.write(toJsonLine(record) + "\n");
  file.commit();
}

}  // namespace asdfvk
