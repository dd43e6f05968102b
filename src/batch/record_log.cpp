#include "batch/record_log.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "asdf_vk/error.h"
#include "core/write_all.h"

namespace asdfvk {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int errorNumber) {
  throw Error(ErrorCode::OutputNotWritable,
              fmt::format("the log {} cannot be written: {}", path.string(), std::strerror(errorNumber)));
}

/// Whether the last line of the file is incomplete. False for a FIFO or a device, which has no last line.
bool endsWithinLine(int descriptor) {
  const off_t size = ::lseek(descriptor, 0, SEEK_END);
  char last = '\n';
  return size > 0 && ::pread(descriptor, &last, 1, size - 1) == 1 && last != '\n';
}

}  // namespace

RecordLog::RecordLog(const std::filesystem::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) fail(path_, errno);
}

RecordLog::~RecordLog() { ::close(descriptor_); }

void RecordLog::append(const MeshRecord& record) {
  std::string line = toJsonLine(record) + "\n";
  const std::scoped_lock lock(mutex_);
  if (endsWithinLine(descriptor_)) line.insert(line.begin(), '\n');
  if (const int error = writeAll(descriptor_, line); error != 0) fail(path_, error);
}

std::vector<MeshRecord> readLog(const std::filesystem::path& path, size_t& invalidCount) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw Error(ErrorCode::UnreadableInput, fmt::format("the log {} cannot be read", path.string()));
  std::vector<MeshRecord> records;
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    if (std::optional<MeshRecord> record = parseRecord(line)) {
      record->options = nullptr;  // The options take more memory than the other keys.
      records.push_back(std::move(*record));
    } else {
      ++invalidCount;
    }
  }
  if (in.bad())
    throw Error(ErrorCode::UnreadableInput, fmt::format("the log {} cannot be read to its end", path.string()));
  return records;
}

}  // namespace asdfvk
