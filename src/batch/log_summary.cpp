#include "batch/log_summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "core/text.h"

namespace asdfvk {
namespace {

bool isComputed(const MeshRecord& record) {
  return record.status == MeshStatus::Done || record.status == MeshStatus::Skipped;
}

std::optional<double> averageErrorOf(const MeshRecord& record) {
  const Json& estimate = record.estimatedError;
  if (!estimate.is_object() || !estimate.contains("average") || !estimate["average"].is_number()) return std::nullopt;
  return estimate["average"].get<double>();
}

std::vector<std::pair<std::string, uint64_t>> descending(const std::map<std::string, uint64_t>& counts) {
  std::vector<std::pair<std::string, uint64_t>> rows(counts.begin(), counts.end());
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return rows;
}

std::string spreadText(const Spread& spread, double factor, const char* unit) {
  return fmt::format("min {:.3g}, median {:.3g}, 90 % {:.3g}, max {:.3g}{}", factor * spread.min,
                     factor * spread.median, factor * spread.percentile90, factor * spread.max, unit);
}

}  // namespace

Spread spreadOf(std::vector<double> numbers) {
  if (numbers.empty()) return {};
  std::sort(numbers.begin(), numbers.end());
  const auto at = [&](double share) {
    return numbers[static_cast<size_t>(std::llround(share * static_cast<double>(numbers.size() - 1)))];
  };
  return {numbers.front(), at(0.5), at(0.9), numbers.back()};
}

LogSummary summarizeRecords(std::vector<MeshRecord> records, size_t invalidLineCount) {
  LogSummary summary;
  summary.recordCount = records.size();
  summary.invalidLineCount = invalidLineCount;
  std::unordered_map<std::string, size_t> lastOf;
  for (size_t i = 0; i < records.size(); ++i) {
    const auto [last, isFirst] = lastOf.emplace(records[i].input, i);
    if (!isFirst && records[i].time >= records[last->second].time) last->second = i;
  }
  for (size_t i = 0; i < records.size(); ++i)
    if (lastOf[records[i].input] == i) summary.meshes.push_back(std::move(records[i]));
  std::sort(summary.meshes.begin(), summary.meshes.end(),
            [](const MeshRecord& a, const MeshRecord& b) { return a.input < b.input; });

  std::vector<double> seconds, errors;
  std::map<std::string, double> stages;
  std::map<std::string, uint64_t> warnings, devices;
  std::map<std::tuple<MeshStatus, int, std::string>, FailureGroup> failures;
  for (const MeshRecord& mesh : summary.meshes) {
    ++summary.statusCounts[mesh.status];
    summary.peakMemoryBytes = std::max(summary.peakMemoryBytes, mesh.peakMemoryBytes);
    for (const std::string& warning : mesh.warnings) ++warnings[warning];
    if (!mesh.device.empty()) ++devices[mesh.device];
    if (!isComputed(mesh)) {
      FailureGroup& group = failures[{mesh.status, mesh.code, mesh.error}];
      if (group.count++ == 0) group = {mesh.status, mesh.code, mesh.error, 1, mesh.input, mesh.message};
      continue;
    }
    summary.faceCount += mesh.faceCount.value_or(0);
    summary.meshSeconds += mesh.totalSeconds;
    seconds.push_back(mesh.totalSeconds);
    for (const auto& [stage, time] : mesh.seconds) stages[stage] += time;
    if (const std::optional<double> error = averageErrorOf(mesh)) errors.push_back(*error);
  }
  summary.seconds = spreadOf(seconds);
  summary.averageErrors = spreadOf(errors);
  summary.stageSeconds.assign(stages.begin(), stages.end());
  std::stable_sort(summary.stageSeconds.begin(), summary.stageSeconds.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  for (auto& [key, group] : failures) summary.failures.push_back(std::move(group));
  std::stable_sort(summary.failures.begin(), summary.failures.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  summary.warnings = descending(warnings);
  summary.devices = descending(devices);
  return summary;
}

std::string textOf(const LogSummary& summary) {
  std::string text;
  const auto row = [&text](const std::string& title, const std::string& value) {
    text += oneLine(fmt::format("{:<9} {}", title, value)) + "\n";
  };
  std::string separator = ": ";
  std::string counts = groupDigits(summary.meshes.size());
  for (const auto& [status, count] : summary.statusCounts) {
    counts += fmt::format("{}{} {}", separator, groupDigits(count), nameOf(status));
    separator = ", ";
  }
  row("meshes", counts);
  if (summary.invalidLineCount > 0)
    row("log", fmt::format("{} cut or invalid", counted(summary.invalidLineCount, "line")));
  row("faces", groupDigits(summary.faceCount));
  row("time", fmt::format("{:.4g} s in all; per mesh {}", summary.meshSeconds, spreadText(summary.seconds, 1, " s")));
  std::string stages;
  for (const auto& [stage, seconds] : summary.stageSeconds)
    stages += fmt::format("{}{} {:.3g}", stages.empty() ? "" : ", ", stage, seconds);
  if (!stages.empty()) row("stages", stages + " s");
  row("memory", fmt::format("at most {} MiB", groupDigits(summary.peakMemoryBytes >> 20)));
  if (summary.averageErrors.max > 0)
    row("error", "estimated average of each mesh: " + spreadText(summary.averageErrors, 100, " % of its range"));
  for (const auto& [device, count] : summary.devices)
    row("device", fmt::format("{}: {}", device, counted(count, "mesh", "meshes")));
  for (const auto& [warning, count] : summary.warnings)
    row("warning", fmt::format("{}: {}", warning, counted(count, "mesh", "meshes")));
  for (const FailureGroup& group : summary.failures)
    row(nameOf(group.status),
        fmt::format("code {} {}: {}; {}: {}", group.code, group.error, counted(group.count, "mesh", "meshes"),
                    group.exampleInput, group.exampleMessage));
  return text;
}

std::string jsonOf(const LogSummary& summary) {
  Json json{{"meshCount", summary.meshes.size()},
            {"recordCount", summary.recordCount},
            {"invalidLineCount", summary.invalidLineCount}};
  for (const auto& [status, name] : kMeshStatuses) {
    const auto found = summary.statusCounts.find(status);
    json[std::string(name) + "Count"] = found == summary.statusCounts.end() ? 0 : found->second;
  }
  json["faceCount"] = summary.faceCount;
  json["meshSeconds"] = summary.meshSeconds;
  json["seconds"] = summary.seconds;
  json["averageError"] = summary.averageErrors;
  json["peakMemoryBytes"] = summary.peakMemoryBytes;
  for (const char* key : {"stageSeconds", "devices", "warnings"}) json[key] = Json::object();
  for (const auto& [stage, seconds] : summary.stageSeconds) json["stageSeconds"][stage] = seconds;
  for (const auto& [device, count] : summary.devices) json["devices"][device] = count;
  for (const auto& [warning, count] : summary.warnings) json["warnings"][warning] = count;
  json["failures"] = summary.failures;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string csvOf(const LogSummary& summary) {
  std::string table =
      "input,status,code,error,faces,seconds,peak_memory_bytes,average_error,segments,warnings,backend,device,"
      "message\n";
  const auto quoted = [](const std::string& text) {
    std::string cell = "\"";
    for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
    return cell + "\"";
  };
  const auto numberOf = [](const auto& value) { return value ? fmt::format("{}", *value) : std::string(); };
  for (const MeshRecord& mesh : summary.meshes)
    table += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", quoted(mesh.input), nameOf(mesh.status), mesh.code,
                         mesh.error, numberOf(mesh.faceCount), mesh.totalSeconds, mesh.peakMemoryBytes,
                         numberOf(averageErrorOf(mesh)), numberOf(mesh.segmentCount), joined(mesh.warnings, " "),
                         mesh.backend, quoted(mesh.device), quoted(mesh.message));
  return table;
}

}  // namespace asdfvk
