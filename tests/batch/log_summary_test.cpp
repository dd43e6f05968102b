#include "batch/log_summary.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <algorithm>

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
  CHECK_EQ(nlohmann::json::parse(jsonOf(summary)).at("failures")[1].at("status").get<std::string>(), "dropped");
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
  CHECK_EQ(nlohmann::json::parse(jsonOf(summary)).at("failures").size(), 2);
}

TEST_CASE("the table has a row for each mesh, with commas and quotes in quotes") {
  MeshRecord record = recordOf("a,\"b\".ply", MeshStatus::Done, 0.5);
  record.warnings = {"openComponents", "coarseParts"};
  record.segmentCount = 3;
  const std::string table = csvOf(summarizeRecords({record, recordOf("z", MeshStatus::Failed, 1, 2)}, 0));
  const size_t end = table.find('\n');
  CHECK(table.starts_with("input,status,code,error,faces,seconds,"));
  CHECK_EQ(table.substr(end + 1),
           "\"a,\"\"b\"\".ply\",done,0,,100,0.5,0,0.01,3,openComponents coarseParts,,\"a device\",\"\"\n"
           "\"z\",failed,2,unreadableInput,100,1,0,0.01,,,,\"a device\",\"<broken> & \"\"quoted\"\", with a comma\"\n");
}

TEST_CASE("an empty log has a summary") {
  const LogSummary summary = summarizeRecords({}, 0);
  CHECK_FALSE(textOf(summary).empty());
}

}  // namespace
}  // namespace asdfvk
