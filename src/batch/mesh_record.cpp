#include "batch/mesh_record.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <stdexcept>

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

/// Whether JSON can represent the text: whether it is UTF-8.
bool survivesJson(const std::string& text) {
  const std::string json = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(json).get_ref<const std::string&>() == text;
}

}  // namespace

const char* nameOf(MeshStatus status) { return kMeshStatuses[static_cast<size_t>(status)].second; }

void to_json(Json& json, MeshStatus status) { json = nameOf(status); }

void from_json(const Json& json, MeshStatus& status) {
  const auto named = std::find_if(kMeshStatuses.begin(), kMeshStatuses.end(),
                                  [&](const auto& row) { return row.second == json.get_ref<const std::string&>(); });
  if (named == kMeshStatuses.end()) throw std::invalid_argument("an unknown status");
  status = named->first;
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
  if (survivesJson(record.input)) return json;
  std::string hex;
  for (const char c : record.input) hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
  json["inputBytes"] = hex;
  return json;
}

std::string toJsonLine(const MeshRecord& record) {
  return toJson(record).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<MeshRecord> parseRecord(std::string_view text) {
  try {
    const Json json = Json::parse(text);
    for (const char* required : {"input", "status", "code", "message"})
      if (json.at(required).is_null()) return std::nullopt;
    Json complete = MeshRecord();
    for (const auto& [key, value] : json.items())
      if (!value.is_null()) complete[key] = value;
    auto record = complete.get<MeshRecord>();
    if (complete.contains("inputBytes")) record.input = bytesOfHex(complete["inputBytes"].get<std::string>());
    return record;
  } catch (const std::exception&) {  // No JSON, a required key is missing, or a value has another type.
    return std::nullopt;
  }
}

}  // namespace asdfvk
