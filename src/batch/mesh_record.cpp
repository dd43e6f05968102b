#include "batch/mesh_record.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <charconv>
#include <chrono>

namespace asdfvk {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// Leaves the value where the key is absent or null.
template <typename T>
void read(const Json& json, const char* key, T& value) {
  if (const auto found = json.find(key); found != json.end() && !found->is_null()) found->get_to(value);
}

template <typename T>
void read(const Json& json, const char* key, std::optional<T>& value) {
  if (const auto found = json.find(key); found != json.end() && !found->is_null()) value = found->get<T>();
}

/// Unset where the text holds anything but pairs of hexadecimal digits.
std::optional<std::string> bytesOfHex(std::string_view hex) {
  std::string bytes;
  for (size_t i = 0; i < hex.size(); i += 2) {
    uint8_t byte = 0;
    const auto [end, error] = std::from_chars(hex.data() + i, hex.data() + std::min(i + 2, hex.size()), byte, 16);
    if (error != std::errc() || end != hex.data() + i + 2) return std::nullopt;
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

/// Whether the text is UTF-8, which JSON can hold.
bool survivesJson(const std::string& text) {
  const std::string json = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(json).get_ref<const std::string&>() == text;
}

}  // namespace

const char* nameOf(MeshStatus status) { return kMeshStatuses[static_cast<size_t>(status)].second; }

std::string utcTime() {
  const auto now = std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
  const auto milliseconds = now.time_since_epoch().count() % 1000;
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(now)),
                     milliseconds);
}

nlohmann::ordered_json toJson(const MeshRecord& record) {
  Json json;
  json["input"] = record.input;
  if (!survivesJson(record.input)) {
    std::string hex;
    for (const char c : record.input) hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
    json["inputBytes"] = hex;
  }
  json["output"] = orNull(record.output);
  json["time"] = record.time;
  json["status"] = nameOf(record.status);
  json["code"] = record.code;
  json["error"] = record.error.empty() ? Json(nullptr) : Json(record.error);
  json["message"] = record.message;
  json["inputHash"] = record.inputHash;
  json["optionsHash"] = record.optionsHash;
  json["outputHash"] = record.outputHash;
  json["faceCount"] = orNull(record.faceCount);
  json["version"] = record.version;
  json["commit"] = record.commit;
  json["device"] = record.device;
  json["backend"] = record.backend;
  json["seconds"] = Json::object();
  for (const auto& [stage, seconds] : record.seconds) json["seconds"][stage] = seconds;
  json["totalSeconds"] = record.totalSeconds;
  json["peakMemoryBytes"] = record.peakMemoryBytes;
  json["estimatedError"] = record.estimatedError;
  json["segmentCount"] = orNull(record.segmentCount);
  json["warnings"] = record.warnings;
  json["options"] = record.options;
  return json;
}

std::string toJsonLine(const MeshRecord& record) {
  return toJson(record).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<MeshRecord> parseRecord(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    MeshRecord record;
    record.input = json.at("input");
    std::string inputBytes;
    read(json, "inputBytes", inputBytes);
    if (!inputBytes.empty()) {
      const std::optional<std::string> bytes = bytesOfHex(inputBytes);
      if (!bytes) return std::nullopt;
      record.input = *bytes;
    }
    const std::string status = json.at("status");
    bool isKnown = false;
    for (const auto& [value, name] : kMeshStatuses)
      if (status == name) {
        record.status = value;
        isKnown = true;
      }
    if (!isKnown) return std::nullopt;
    record.code = json.at("code");
    record.message = json.at("message");
    read(json, "output", record.output);
    read(json, "time", record.time);
    read(json, "faceCount", record.faceCount);
    read(json, "segmentCount", record.segmentCount);
    read(json, "error", record.error);
    read(json, "inputHash", record.inputHash);
    read(json, "optionsHash", record.optionsHash);
    read(json, "outputHash", record.outputHash);
    read(json, "version", record.version);
    read(json, "commit", record.commit);
    read(json, "device", record.device);
    read(json, "backend", record.backend);
    if (const auto seconds = json.find("seconds"); seconds != json.end() && seconds->is_object())
      for (const auto& [stage, value] : seconds->items()) record.seconds.emplace_back(stage, value.get<double>());
    read(json, "totalSeconds", record.totalSeconds);
    read(json, "peakMemoryBytes", record.peakMemoryBytes);
    read(json, "estimatedError", record.estimatedError);
    read(json, "warnings", record.warnings);
    read(json, "options", record.options);
    return record;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace asdfvk
