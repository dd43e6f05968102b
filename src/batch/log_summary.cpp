#include "batch/log_summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/median.h"
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

template <typename Row, typename Number>
void sortDescending(std::vector<Row>& rows, const Number& numberOf) {
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const Row& a, const Row& b) { return std::invoke(numberOf, a) > std::invoke(numberOf, b); });
}

std::string spreadText(const Spread& spread, double factor, const char* unit) {
  return fmt::format("min {:.3g}, median {:.3g}, 90 % {:.3g}, max {:.3g}{}", factor * spread.min,
                     factor * spread.median, factor * spread.percentile90, factor * spread.max, unit);
}

/// Column names and texts of a row of the table.
using Cells = std::vector<std::pair<std::string, std::string>>;

/// The columns of a record. An object is left out if all its values are null. If another record has such values,
/// addKeys() adds the columns.
Json rowOf(const MeshRecord& mesh) {
  Json row = mesh;
  row["warnings"] = joined(mesh.warnings, " ");
  for (const char* key : {"formatVersion", "inputHash", "optionsHash", "outputHash", "options", "findings"})
    row.erase(key);
  if (mesh.key.empty()) row.erase("key");
  for (const char* key : {"sdf", "thickness", "parts", "estimatedError"})
    if (const Json& values = row.at(key);
        std::all_of(values.begin(), values.end(), [](const Json& value) { return value.is_null(); }))
      row.erase(key);
  return row;
}

std::string cellText(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  const auto& text = value.get_ref<const std::string&>();
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + "\"";
}

void addCells(const Json& object, const std::string& prefix, Cells& cells) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) {
      addCells(value, prefix + key + ".", cells);
    } else if (value.is_array()) {
      std::string coordinates;  // A point.
      for (const Json& each : value) coordinates += (coordinates.empty() ? "" : " ") + jsonText(each);
      cells.emplace_back(prefix + key, cellText(coordinates));
    } else {
      cells.emplace_back(prefix + key, cellText(value));
    }
  }
}

/// Adds the keys of `row` that `all` lacks. Replaces a null of `all` by an object of `row`, because only some meshes
/// may have the object.
void addKeys(const Json& row, Json& all) {
  for (const auto& [key, value] : row.items()) {
    Json& known = all[key];
    if (known.is_null()) known = value.is_object() ? Json::object() : value;
    if (known.is_object() && value.is_object()) addKeys(value, known);
  }
}

constexpr size_t kNamedInputs = 3;  ///< Greatest number of inputs that the text names for a warning.

}  // namespace

Spread spreadOf(std::vector<double> numbers) {
  if (numbers.empty()) return {};
  return {percentileOf(numbers, 0), percentileOf(numbers, 0.5), percentileOf(numbers, 0.9), percentileOf(numbers, 1)};
}

LogSummary summarizeRecords(std::vector<MeshRecord> records, size_t invalidLineCount) {
  LogSummary summary;
  summary.recordCount = records.size();
  summary.invalidLineCount = invalidLineCount;
  std::map<std::pair<std::string, std::string>, size_t> lastOf;  // By input and key.
  const auto identityOf = [](const MeshRecord& record) { return std::pair(record.input, record.key); };
  for (size_t i = 0; i < records.size(); ++i) {
    const auto [last, isFirst] = lastOf.emplace(identityOf(records[i]), i);
    if (!isFirst && records[i].time >= records[last->second].time) last->second = i;
  }
  for (size_t i = 0; i < records.size(); ++i)
    if (lastOf[identityOf(records[i])] == i) summary.meshes.push_back(std::move(records[i]));
  std::sort(summary.meshes.begin(), summary.meshes.end(), [](const MeshRecord& a, const MeshRecord& b) {
    return std::tie(a.input, a.key) < std::tie(b.input, b.key);
  });

  std::vector<double> seconds, errors;
  std::map<std::string, double> stages;
  std::map<std::string, uint64_t> devices;
  std::map<std::string, std::vector<std::string>> warnings;
  std::map<std::tuple<MeshStatus, int, std::string>, FailureGroup> failures;
  for (MeshRecord& mesh : summary.meshes) {
    if (mesh.status == MeshStatus::Skipped && mesh.code != 0) mesh.status = MeshStatus::Failed;  // In an earlier run.
    ++summary.statusCounts[mesh.status];
    summary.peakMemoryBytes = std::max(summary.peakMemoryBytes, mesh.peakMemoryBytes);
    for (const std::string& warning : mesh.warnings) warnings[warning].push_back(mesh.input);
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
  sortDescending(summary.stageSeconds, &std::pair<std::string, double>::second);
  for (auto& [key, group] : failures) summary.failures.push_back(std::move(group));
  sortDescending(summary.failures, &FailureGroup::count);
  for (auto& [code, inputs] : warnings) summary.warnings.push_back({code, inputs.size(), std::move(inputs)});
  sortDescending(summary.warnings, &WarningGroup::count);
  summary.devices.assign(devices.begin(), devices.end());
  sortDescending(summary.devices, &std::pair<std::string, uint64_t>::second);
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
    row("log", fmt::format("{} incomplete or invalid", counted(summary.invalidLineCount, "line")));
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
  for (const WarningGroup& warning : summary.warnings) {
    std::string names = warning.inputs.front();
    for (size_t i = 1; i < std::min(warning.inputs.size(), kNamedInputs); ++i) names += ", " + warning.inputs[i];
    if (warning.inputs.size() > kNamedInputs)
      names += fmt::format(" and {} more", groupDigits(warning.inputs.size() - kNamedInputs));
    row("warning", fmt::format("{}: {}; {}", warning.code, counted(warning.count, "mesh", "meshes"), names));
  }
  for (const FailureGroup& group : summary.failures)
    row(nameOf(group.status),
        fmt::format("code {} {}: {}; {}: {}", group.code, group.error, counted(group.count, "mesh", "meshes"),
                    group.exampleInput, group.exampleMessage));
  return text;
}

std::string jsonOf(const LogSummary& summary) {
  const auto countOf = [&](MeshStatus status) {
    const auto found = summary.statusCounts.find(status);
    return found == summary.statusCounts.end() ? 0 : found->second;
  };
  const SummaryDocument document{.meshCount = summary.meshes.size(),
                                 .recordCount = summary.recordCount,
                                 .invalidLineCount = summary.invalidLineCount,
                                 .doneCount = countOf(MeshStatus::Done),
                                 .skippedCount = countOf(MeshStatus::Skipped),
                                 .failedCount = countOf(MeshStatus::Failed),
                                 .droppedCount = countOf(MeshStatus::Dropped),
                                 .faceCount = summary.faceCount,
                                 .meshSeconds = summary.meshSeconds,
                                 .seconds = summary.seconds,
                                 .averageError = summary.averageErrors,
                                 .peakMemoryBytes = summary.peakMemoryBytes,
                                 .stageSeconds = summary.stageSeconds,
                                 .devices = summary.devices,
                                 .warnings = summary.warnings,
                                 .failures = summary.failures};
  return jsonText(document, 2) + "\n";
}

std::string csvOf(const LogSummary& summary) {
  std::vector<Cells> rows;
  Json all = Json::object();  // All keys of the rows.
  for (const MeshRecord& mesh : summary.meshes) {
    const Json row = rowOf(mesh);
    addKeys(row, all);
    addCells(row, "", rows.emplace_back());
  }
  if (rows.empty()) all = rowOf({});
  Cells columns;
  addCells(all, "", columns);
  std::string table;
  for (const auto& [name, ignored] : columns) table += (table.empty() ? "" : ",") + cellText(name);
  for (const Cells& row : rows) {
    const std::map<std::string, std::string> cellOf(row.begin(), row.end());
    char separator = '\n';
    for (const auto& [name, ignored] : columns) {
      const auto cell = cellOf.find(name);
      table += separator + (cell == cellOf.end() ? "" : cell->second);
      separator = ',';
    }
  }
  return table + "\n";
}

}  // namespace asdfvk
