#include "batch/mesh_record.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "asdf_vk/error.h"
#include "core/shallow_json.h"
#include "core/write_all.h"

namespace asdfvk {
namespace {

std::string bytesOfHex(std::string_view hex) {
  std::string bytes;
  for (size_t i = 0; i < hex.size(); i += 2) {
    uint8_t byte = 0;
    const auto [end, error] = std::from_chars(hex.data() + i, hex.data() + std::min(i + 2, hex.size()), byte, 16);
    if (error != std::errc() || end != hex.data() + i + 2) throw std::invalid_argument("not pairs of digits");
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

/// Whether JSON can represent the text, which requires UTF-8.
bool survivesJson(const std::string& text) {
  const std::string json = jsonText(text);
  return Json::parse(json).get_ref<const std::string&>() == text;
}

[[noreturn]] void failLog(const std::filesystem::path& path, int errorNumber) {
  throw Error(ErrorCode::OutputNotWritable,
              fmt::format("the log {} cannot be written: {}", path.string(), std::strerror(errorNumber)));
}

/// Whether the last line of the file is incomplete. False for a FIFO or a device.
bool endsWithinLine(int descriptor) {
  const off_t size = ::lseek(descriptor, 0, SEEK_END);
  char last = '\n';
  return size > 0 && ::pread(descriptor, &last, 1, size - 1) == 1 && last != '\n';
}

}  // namespace

const char* nameOf(MeshStatus status) { return kMeshStatuses[static_cast<size_t>(status)].first; }

bool hasVerdictError(const MeshRecord& record) {
  return std::any_of(kVerdictErrors.begin(), kVerdictErrors.end(),
                     [&](const auto& verdict) { return record.error == verdict.first; });
}

void to_json(Json& json, MeshStatus status) { json = nameOf(status); }

void from_json(const Json& json, MeshStatus& status) {
  const auto named = std::find_if(kMeshStatuses.begin(), kMeshStatuses.end(),
                                  [&](const auto& row) { return row.first == json.get_ref<const std::string&>(); });
  if (named == kMeshStatuses.end()) throw std::invalid_argument("an unknown status");
  status = named->second;
}

std::string utcTime() {
  const auto now = std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
  const auto milliseconds = now.time_since_epoch().count() % 1000;
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(now)),
                     milliseconds);
}

Json toJson(const MeshRecord& record) {
  Json json = record;
  if (record.error.empty()) json["error"] = nullptr;
  if (record.key.empty()) json["key"] = nullptr;
  if (survivesJson(record.input)) return json;
  std::string hex;
  for (const char c : record.input) hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
  json["inputBytes"] = hex;
  return json;
}

std::string toJsonLine(const MeshRecord& record) { return jsonText(toJson(record)); }

std::optional<MeshRecord> parseRecord(std::string_view text) {
  try {
    const Json json = parsedShallowJson(text);
    for (const char* required : {"input", "status", "code", "message"})
      if (json.at(required).is_null()) return std::nullopt;
    Json complete = MeshRecord();
    for (const auto& [key, value] : json.items())
      if (!value.is_null()) complete[key] = value;
    auto record = complete.get<MeshRecord>();
    if (record.inputBytes) record.input = bytesOfHex(*record.inputBytes);
    record.inputBytes = std::nullopt;
    return record;
  } catch (const std::exception&) {  // Invalid JSON, a missing key, or a value of a wrong type.
    return std::nullopt;
  }
}

RecordLog::RecordLog(const std::filesystem::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) failLog(path_, errno);
}

RecordLog::~RecordLog() { ::close(descriptor_); }

void RecordLog::append(const MeshRecord& record) {
  std::string line = toJsonLine(record) + "\n";
  const std::scoped_lock lock(mutex_);
  if (endsWithinLine(descriptor_)) line.insert(line.begin(), '\n');
  if (const int error = writeAll(descriptor_, line); error != 0) failLog(path_, error);
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
