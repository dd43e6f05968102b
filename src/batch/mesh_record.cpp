#include "batch/mesh_record.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <nlohmann/json.hpp>

namespace asdfvk {
namespace {

using Json = nlohmann::ordered_json;
using SecondsByStage = std::vector<std::pair<std::string, double>>;

/// Calls visit(key, value) for each key of a record except input and inputBytes, in the order of the line.
template <typename Record, typename Visit>
void visitKeys(Record& record, const Visit& visit) {
  visit("output", record.output);
  visit("time", record.time);
  visit("status", record.status);
  visit("code", record.code);
  visit("error", record.error);
  visit("message", record.message);
  visit("inputHash", record.inputHash);
  visit("optionsHash", record.optionsHash);
  visit("outputHash", record.outputHash);
  visit("faceCount", record.faceCount);
  visit("version", record.version);
  visit("commit", record.commit);
  visit("device", record.device);
  visit("backend", record.backend);
  visit("seconds", record.seconds);
  visit("totalSeconds", record.totalSeconds);
  visit("peakMemoryBytes", record.peakMemoryBytes);
  visit("estimatedError", record.estimatedError);
  visit("segmentCount", record.segmentCount);
  visit("warnings", record.warnings);
  visit("options", record.options);
}

template <typename T>
Json jsonOf(const T& value) {
  return value;
}

template <typename T>
Json jsonOf(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json jsonOf(const SharedJson& value) { return value ? *value : Json(nullptr); }

Json jsonOf(MeshStatus status) { return nameOf(status); }

Json jsonOf(const SecondsByStage& ofStages) {
  Json json = Json::object();
  for (const auto& [stage, seconds] : ofStages) json[stage] = seconds;
  return json;
}

template <typename T>
void read(const Json& json, T& value) {
  json.get_to(value);
}

template <typename T>
void read(const Json& json, std::optional<T>& value) {
  value = json.get<T>();
}

void read(const Json& json, SharedJson& value) {
  value = json.is_null() ? nullptr : std::make_shared<const Json>(json);
}

std::optional<MeshStatus> statusNamed(std::string_view text) {
  for (const auto& [status, name] : kMeshStatuses)
    if (text == name) return status;
  return std::nullopt;
}

/// Throws std::bad_optional_access for an unknown name.
void read(const Json& json, MeshStatus& status) { status = statusNamed(json.get<std::string>()).value(); }

void read(const Json& json, SecondsByStage& ofStages) {
  if (!json.is_object()) return;
  for (const auto& [stage, seconds] : json.items()) ofStages.emplace_back(stage, seconds.get<double>());
}

/// Leaves the value where the key is absent or null.
template <typename T>
void readKey(const Json& json, const char* key, T& value) {
  if (const auto found = json.find(key); found != json.end() && !found->is_null()) read(*found, value);
}

/// Unset where the text is not a sequence of pairs of hexadecimal digits.
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

/// Whether JSON can represent the text: whether it is UTF-8.
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
  visitKeys(record, [&](const char* key, const auto& value) { json[key] = jsonOf(value); });
  if (record.error.empty()) json["error"] = nullptr;
  return json;
}

std::string toJsonLine(const MeshRecord& record) {
  return toJson(record).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<MeshRecord> parseRecord(std::string_view text) { return recordOf(Json::parse(text, nullptr, false)); }

std::optional<MeshRecord> recordOf(const Json& json) {
  if (!json.is_object()) return std::nullopt;
  try {
    MeshRecord record;
    record.input = json.at("input");
    std::string hex;
    readKey(json, "inputBytes", hex);
    if (!hex.empty()) record.input = bytesOfHex(hex).value();
    for (const char* required : {"status", "code", "message"})
      if (json.at(required).is_null()) return std::nullopt;
    visitKeys(record, [&](const char* key, auto& value) { readKey(json, key, value); });
    return record;
  } catch (const Json::exception&) {           // A required key is missing, or a value has another type.
  } catch (const std::bad_optional_access&) {  // An unknown status, or inputBytes that are not hexadecimal.
  }
  return std::nullopt;
}

}  // namespace asdfvk
