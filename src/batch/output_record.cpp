#include "batch/output_record.h"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <system_error>

#include "batch/content_hash.h"
#include "core/atomic_file.h"
#include "io/formats.h"

namespace asdfvk {

namespace fs = std::filesystem;

namespace {

bool haveSameOrigin(const MeshRecord& a, const MeshRecord& b) {
  return a.inputHash == b.inputHash && a.optionsHash == b.optionsHash && a.version == b.version && a.commit == b.commit;
}

bool isSamePath(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::absolute(a, ignored).lexically_normal() == fs::absolute(b, ignored).lexically_normal();
}

/// The hash of an output. For an output with a second file (.mtl), returns the hash of both hashes.
std::optional<std::string> outputHashOf(const fs::path& output) {
  std::optional<std::string> hash = contentHashOf(output);
  const std::optional<std::string> beside = hash ? contentHashOf(besidePathOf(output)) : std::nullopt;
  if (beside) hash = contentHash(*hash + *beside);
  return hash;
}

}  // namespace

bool hasOutputRecord(const fs::path& output) {
  std::error_code ignored;
  const fs::file_status status = fs::status(output, ignored);
  return !output.empty() && output != "-" && (fs::is_regular_file(status) || !fs::exists(status));
}

fs::path outputRecordPath(const fs::path& output) { return output.string() + ".json"; }

std::optional<MeshRecord> readOutputRecord(const fs::path& output) {
  const fs::path path = outputRecordPath(output);
  std::error_code ignored;
  if (!hasOutputRecord(output) || !fs::is_regular_file(path, ignored)) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  return parseRecord(std::string(std::istreambuf_iterator<char>(in), {}));
}

std::optional<MeshRecord> findFinishedOutput(const MeshRecord& expected, const fs::path& output) {
  std::optional<MeshRecord> record = readOutputRecord(output);
  const bool isFinished =
      record && (record->code == 0 || record->status == MeshStatus::Done || hasVerdictError(*record));
  if (!isFinished || !haveSameOrigin(*record, expected) || record->outputHash.empty() ||
      outputHashOf(output) != record->outputHash)
    return std::nullopt;
  record->input = expected.input;
  record->key = expected.key;
  record->output = output.string();
  record->time = expected.time;
  record->status = MeshStatus::Skipped;
  return record;
}

void removeOutputRecord(const fs::path& output) {
  if (hasOutputRecord(output)) ::unlink(outputRecordPath(output).c_str());  // unlink() removes no folder.
}

void removeOutput(const MeshRecord& record, const fs::path& output) {
  std::error_code ignored;
  if (record.outputHash.empty() || outputHashOf(output) != record.outputHash) return;
  removeOutputRecord(output);
  fs::remove(besidePathOf(output), ignored);
  fs::remove(fs::canonical(output, ignored), ignored);
}

void removeOutdatedOutput(const MeshRecord& old, const MeshRecord& failed, const fs::path& output) {
  if (failed.inputHash.empty() || haveSameOrigin(old, failed) || !isSamePath(old.input, failed.input)) return;
  removeOutput(old, output);
}

void writeOutputRecord(MeshRecord& record, const fs::path& output) {
  if (!hasOutputRecord(output)) return;
  record.outputHash = outputHashOf(output).value_or("");
  AtomicFile file(outputRecordPath(output));
  file.write(toJsonLine(record) + "\n");
  file.commit();
}

}  // namespace asdfvk
