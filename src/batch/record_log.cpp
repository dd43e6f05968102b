#include "batch/record_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int errorNumber) {
  throw Error(ErrorCode::OutputNotWritable,
              fmt::format("the log {} cannot be written: {}", path.string(), std::strerror(errorNumber)));
}

void writeAll(int descriptor, std::string_view text, const std::filesystem::path& path) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, errno);
    text.remove_prefix(static_cast<size_t>(count));
  }
}

/// Whether the file ends within a line. Not for a FIFO or a device, which has no end.
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
  writeAll(descriptor_, line, path_);
}

std::vector<MeshRecord> readLog(const std::filesystem::path& path, size_t& invalidCount) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw Error(ErrorCode::UnreadableInput, fmt::format("the log {} cannot be read", path.string()));
  std::vector<MeshRecord> records;
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    if (std::optional<MeshRecord> record = parseRecord(line)) {
      record->options = nullptr;  // They take more memory than the rest.
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
