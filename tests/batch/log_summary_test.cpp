#include "batch/log_summary.h"
#include "support/kept_json.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace asdfvk {
namespace {

MeshRecord recordOf(const std::string& input, MeshStatus status, double seconds, int code = 0) {
  MeshRecord record;
  record.input = input;
  record.status = status;
  record.totalSeconds = seconds;
  record.code = code;
  if (code != 0) {
    record.error = "unreadableInput";
    record.message = "<broken> & \"quoted\", with a comma";
  }
  record.faceCount = 100;
  record.seconds = {{"read", seconds / 4}, {"trace", seconds / 2}};
  record.estimatedError = {{"average", 0.01}};
  record.device = "a device";
  return record;
}

LogSummary sample() {
  return summarizeRecords({recordOf("b", MeshStatus::Failed, 9, 2), recordOf("a", MeshStatus::Done, 1),
                           recordOf("c", MeshStatus::Failed, 5, 2), recordOf("b", MeshStatus::Done, 3),
                           recordOf("d", MeshStatus::Failed, 0, 8), recordOf("a", MeshStatus::Skipped, 1)},
                          1);
}

TEST_CASE("of several records of a mesh the last one counts") {
  const LogSummary summary = sample();
  CHECK_EQ(summary.recordCount, 6);
  CHECK_EQ(summary.invalidLineCount, 1);
  REQUIRE_EQ(summary.meshes.size(), 4);
  CHECK_EQ(summary.meshes[1].input, "b");
  CHECK(summary.meshes[1].status == MeshStatus::Done);
  CHECK_EQ(summary.statusCounts.at(MeshStatus::Done), 1);
  CHECK_EQ(summary.statusCounts.at(MeshStatus::Skipped), 1);
  CHECK_EQ(summary.statusCounts.at(MeshStatus::Failed), 2);
  CHECK_EQ(summary.faceCount, 200);
  CHECK_EQ(summary.meshSeconds, 4);
  CHECK_EQ(summary.stageSeconds.front().first, "trace");
  CHECK_EQ(summary.stageSeconds.front().second, 2);
  REQUIRE_EQ(summary.failures.size(), 2);
  CHECK_EQ(summary.failures[0].count, 1);
}

TEST_CASE("of several logs in any order the record with the latest time counts") {
  MeshRecord early = recordOf("a", MeshStatus::Failed, 1, 2), late = recordOf("a", MeshStatus::Done, 1);
  early.time = "2026-01-01T00:00:00.999Z";
  late.time = "2026-01-01T00:00:01.000Z";
  const MeshRecord unknown = recordOf("a", MeshStatus::Dropped, 1);
  for (const LogSummary& summary : {summarizeRecords({early, late, unknown}, 0), summarizeRecords({late, early}, 0)}) {
    REQUIRE_EQ(summary.meshes.size(), 1);
    CHECK(summary.meshes.front().status == MeshStatus::Done);
  }
}

TEST_CASE("a spread has ranks of the sorted numbers") {
  const Spread spread = spreadOf({5, 1, 2, 4, 3});
  CHECK_EQ(spread.min, 1);
  CHECK_EQ(spread.median, 3);
  CHECK_EQ(spread.percentile90, 5);
  CHECK_EQ(spread.max, 5);
  CHECK_EQ(spreadOf({}).max, 0);
}

TEST_CASE("dropped meshes are not listed as failed, and the table has a line per row whatever names hold") {
  MeshRecord dropped = recordOf("a\nb", MeshStatus::Dropped, 0, 130);
  dropped.message = "cancelled\nfailed    code 1";
  const LogSummary summary = summarizeRecords({dropped, recordOf("c", MeshStatus::Failed, 0, 130)}, 0);
  REQUIRE_EQ(summary.failures.size(), 2);
  const std::string text = textOf(summary);
  CHECK_NE(text.find("\ndropped   code 130 unreadableInput: 1 mesh; a b: cancelled failed    code 1\n"),
           std::string::npos);
  CHECK_NE(text.find("\nfailed    code 130 unreadableInput: 1 mesh; c: "), std::string::npos);
  CHECK_EQ(test::keptDocument(jsonOf(summary)).at("failures")[1].at("status").get<std::string>(), "dropped");
}

TEST_CASE("meshes whose names differ only in bytes that are not UTF-8 are two meshes") {
  std::vector<MeshRecord> records;
  for (const char* name : {"\xe8.off", "\xe9.off"})
    records.push_back(parseRecord(toJsonLine(recordOf(name, MeshStatus::Done, 1))).value());
  CHECK_EQ(summarizeRecords(records, 0).meshes.size(), 2);
}

TEST_CASE("the summary has counts and failures") {
  const LogSummary summary = sample();
  CHECK_NE(textOf(summary).find("4: 1 done, 1 skipped, 2 failed"), std::string::npos);
  CHECK_EQ(test::keptDocument(jsonOf(summary)).at("failures").size(), 2);
}

/// The cells of a column without commas in its cells.
std::vector<std::string> columnOf(const std::string& table, const std::string& name) {
  std::istringstream lines(table);
  std::vector<std::string> column;
  size_t index = 0;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream fields(line);
    for (std::string cell; std::getline(fields, cell, ',');) cells.push_back(cell);
    if (column.empty()) index = static_cast<size_t>(std::find(cells.begin(), cells.end(), name) - cells.begin());
    column.push_back(index < cells.size() ? cells[index] : "");
  }
  return column;
}

TEST_CASE("the table has a row for each mesh, with the keys of the records") {
  MeshRecord walls = recordOf("a", MeshStatus::Done, 0.5), parts = recordOf("b", MeshStatus::Done, 0.5);
  walls.vertexCount = 50;
  walls.sdf = {{"min", nullptr}, {"median", nullptr}};  // Not measured.
  walls.thickness = {{"verdict", "failed"}, {"min", 0.5}, {"unjudged", {{"openCount", 3}}}, {"minPlace", {1, 2, 3}}};
  walls.warnings = {"openComponents", "coarseParts"};
  parts.segmentCount = 3;
  parts.sdf = {{"min", 0.25}, {"median", 2.5}};
  MeshRecord failed = recordOf("z", MeshStatus::Failed, 1, 2);
  failed.message = "cannot be read";
  const std::string table = csvOf(summarizeRecords({walls, parts, failed}, 0));
  using Column = std::vector<std::string>;
  CHECK(table.starts_with("input,status,code,error,message,warnings,faceCount,vertexCount,"));
  for (const Column& column :
       {Column{"vertexCount", "50", "", ""}, Column{"sdf.min", "", "0.25", ""}, Column{"sdf.median", "", "2.5", ""},
        Column{"thickness.min", "0.5", "", ""}, Column{"thickness.verdict", "failed", "", ""},
        Column{"thickness.unjudged.openCount", "3", "", ""}, Column{"warnings", "openComponents coarseParts", "", ""},
        Column{"segmentCount", "", "3", ""}, Column{"thickness.minPlace", "1 2 3", "", ""},
        Column{"seconds.trace", "0.25", "0.25", "0.5"}})
    CHECK_EQ(columnOf(table, column.front()), column);
  for (const char* absent : {"findings", "optionsHash", "options"}) CHECK_EQ(table.find(absent), std::string::npos);
}

TEST_CASE("a mesh without an object has empty cells in the columns of its members") {
  MeshRecord closed = recordOf("a", MeshStatus::Done, 1), open = recordOf("b", MeshStatus::Done, 1);
  closed.thickness = {{"min", 0.5}, {"greatestSection", {{"diameter", 2}}}};
  open.thickness = {{"min", 0.5}, {"greatestSection", nullptr}};
  using Column = std::vector<std::string>;
  const auto diametersOf = [](const std::vector<MeshRecord>& meshes) {
    return columnOf(csvOf(summarizeRecords(meshes, 0)), "thickness.greatestSection.diameter");
  };
  CHECK_EQ(diametersOf({closed, open}), Column{"thickness.greatestSection.diameter", "2", ""});
  std::swap(closed.input, open.input);
  CHECK_EQ(diametersOf({closed, open}), Column{"thickness.greatestSection.diameter", "", "2"});
  // Records of other versions may have another type of value under this key. No column has values of both types.
  open.thickness["greatestSection"]["diameter"]["further"] = 3;
  CHECK_EQ(diametersOf({closed, open}).size(), 3);
}

TEST_CASE("the table has texts with commas, quotes and line ends in quotes") {
  const std::string table = csvOf(
      summarizeRecords({recordOf("a,\"b\"\n.ply", MeshStatus::Done, 0.5), recordOf("z", MeshStatus::Failed, 1, 2)}, 0));
  CHECK_NE(table.find("\n\"a,\"\"b\"\"\n.ply\",done,0,,,,100,"), std::string::npos);
  CHECK_NE(table.find("\nz,failed,2,unreadableInput,\"<broken> & \"\"quoted\"\", with a comma\","), std::string::npos);
}

TEST_CASE("the summary names the meshes of each warning") {
  std::vector<MeshRecord> records;
  for (const char* name : {"a", "b", "c", "d"}) {
    records.push_back(recordOf(name, MeshStatus::Done, 1));
    records.back().warnings = {"coarseParts"};
  }
  records.front().warnings.emplace_back("thinShell");
  const LogSummary summary = summarizeRecords(records, 0);
  const std::string text = textOf(summary);
  CHECK_NE(text.find("\nwarning   coarseParts: 4 meshes; a, b, c and 1 more\n"), std::string::npos);
  CHECK_NE(text.find("\nwarning   thinShell: 1 mesh; a\n"), std::string::npos);
  const auto warnings = test::keptDocument(jsonOf(summary)).at("warnings");
  CHECK_EQ(warnings[0].at("inputs").size(), 4);
  CHECK_EQ(warnings[1].at("code").get<std::string>(), "thinShell");
}

TEST_CASE("an empty log has a summary") {
  const LogSummary summary = summarizeRecords({}, 0);
  CHECK_FALSE(textOf(summary).empty());
  CHECK(csvOf(summary).starts_with("input,status,"));
}

}  // namespace
}  // namespace asdfvk
