#include <doctest/doctest.h>

#include <sys/stat.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

#include "asdf_vk/error.h"
#include "batch/content_hash.h"
#include "batch/mesh_record.h"
#include "batch/output_record.h"
#include "cli/scratch_folder.h"

namespace asdfvk {
namespace {

using test::ScratchFolder;

MeshRecord sampleRecord() {
  MeshRecord record;
  record.input = "a.off";
  record.key = "x/a";
  record.output = "a.asdf.ply";
  record.time = "2026-05-31T12:34:56.789Z";
  record.inputHash = "01";
  record.optionsHash = "02";
  record.faceCount = 12;
  record.version = "1";
  record.commit = "abc";
  record.seconds = {{"read", 0.5}, {"trace", 1.5}};
  record.totalSeconds = 2.25;
  record.peakMemoryBytes = 1000;
  record.estimatedError = {{"average", 0.01}};
  record.segmentCount = 3;
  record.warnings = {"missingValues"};
  record.status = MeshStatus::Failed;
  record.code = 5;
  record.error = "checkFailed";
  record.message = "the check failed";
  return record;
}

TEST_CASE("a record is one line and reads back as it was") {
  const std::string line = toJsonLine(sampleRecord());
  CHECK_EQ(line.find('\n'), std::string::npos);
  const auto read = parseRecord(line);
  REQUIRE(read.has_value());
  CHECK_EQ(toJsonLine(*read), line);
  CHECK_EQ(read->faceCount, 12);
  CHECK_EQ(read->key, "x/a");
  CHECK(toJson({}).at("key").is_null());
  CHECK_EQ(read->time, "2026-05-31T12:34:56.789Z");
  CHECK(read->status == MeshStatus::Failed);
}

TEST_CASE("other programs can write records with few keys") {
  const auto read = parseRecord(R"({"input": "a.off", "status": "failed", "code": 137, "message": "killed"})");
  REQUIRE(read.has_value());
  CHECK(read->status == MeshStatus::Failed);
  CHECK_EQ(read->code, 137);
  CHECK_FALSE(read->output.has_value());
  CHECK_FALSE(parseRecord(R"({"input": "a.off", "status": "failed", "code": 137})").has_value());
  CHECK_FALSE(parseRecord(R"({"input": "a.off", "status": "odd", "code": 1, "message": ""})").has_value());
  CHECK_FALSE(parseRecord(R"({"input": "a", "status": "done", "code": 0, "message": "", "seconds": {"read": "x"}})"));
}

TEST_CASE("the order of times is that of their texts") {
  const std::string time = utcTime();
  CHECK_EQ(time.size(), std::string("2026-05-31T12:34:56.789Z").size());
  CHECK_EQ(time[10], 'T');
  CHECK_GE(time, "2026");
  CHECK_GE(utcTime(), time);
}

TEST_CASE("every cut line is no record") {
  const std::string line = toJsonLine(sampleRecord());
  for (size_t size = 0; size < line.size(); ++size) CHECK_FALSE(parseRecord(line.substr(0, size)).has_value());
  for (const char* text : {"1", "[]", "{}", "{\"input\": 3}"}) CHECK_FALSE(parseRecord(text).has_value());
}

TEST_CASE("bytes that are not UTF-8 do not stop the log") {
  MeshRecord record = sampleRecord();
  record.input = "caf\xe9.off";
  CHECK(parseRecord(toJsonLine(record)).has_value());
}

TEST_CASE("names that are not UTF-8 read back as they are, others have no further key") {
  MeshRecord record = sampleRecord();
  for (const char* name : {"caf\xe9.off", "caf\xe8.off", "\xff\xfe", "caf\xc3\xa9.off", "a.off"}) {
    record.input = name;
    const auto read = parseRecord(toJsonLine(record));
    REQUIRE(read.has_value());
    CHECK_EQ(read->input, name);
  }
  CHECK_FALSE(toJson(record).contains("inputBytes"));
  for (const char* hex : {"6", "6g", "616", "-1", " 1"})
    CHECK_FALSE(parseRecord(R"({"input": "a", "status": "done", "code": 0, "message": "", "inputBytes": ")" +
                            std::string(hex) + "\"}"));
}

TEST_CASE("a record with values nested too deep is invalid") {
  const auto nested = [](size_t depth) {
    return R"({"input": "a", "status": "done", "code": 0, "message": "", "sdf": )" + std::string(depth, '[') +
           std::string(depth, ']') + "}";
  };
  CHECK(parseRecord(nested(10)));
  CHECK_FALSE(parseRecord(nested(300000)));
}

TEST_CASE("a line that another process leaves cut is ended by the next record") {
  const ScratchFolder folder;
  const std::string path = folder / "log.jsonl";
  RecordLog log(path);
  log.append(sampleRecord());
  std::ofstream(path, std::ios::app) << "{\"input\": \"cut";
  log.append(sampleRecord());
  size_t invalidCount = 0;
  CHECK_EQ(readLog(path, invalidCount).size(), 2);
  CHECK_EQ(invalidCount, 1);
}

TEST_CASE("the next run ends a cut line, and a reader counts it") {
  const ScratchFolder folder;
  const std::string path = folder.write("log.jsonl", toJsonLine(sampleRecord()) + "\n{\"input\": \"cut");
  {
    RecordLog log(path);
    log.append(sampleRecord());
  }
  size_t invalidCount = 0;
  CHECK_EQ(readLog(path, invalidCount).size(), 2);
  CHECK_EQ(invalidCount, 1);
  CHECK(folder.read("log.jsonl").ends_with("\n"));
  CHECK_THROWS_AS(RecordLog(folder / "no/log"), Error);
  CHECK_THROWS_AS((void)readLog(folder / "missing", invalidCount), Error);
}

TEST_CASE("the hash of a file is that of its bytes") {
  const ScratchFolder folder;
  const std::string bytes(1'000'000, 'x');
  CHECK_EQ(contentHashOf(folder.write("x", bytes)), contentHash(bytes));
  CHECK_EQ(contentHash(std::string()), "99aa06d3014798d86001c324468d497f");  // From the specification of XXH3.
  CHECK_NE(contentHash(std::string("a")), contentHash(std::string("b")));
  CHECK_FALSE(contentHashOf(folder / "missing").has_value());
}

TEST_CASE("an output is finished only with its own record and its own bytes") {
  const ScratchFolder folder;
  const std::string output = folder.write("a.asdf.ply", "values");
  MeshRecord record = sampleRecord();
  record.status = MeshStatus::Done;
  record.code = 0;
  CHECK_FALSE(findFinishedOutput(record, output).has_value());
  writeOutputRecord(record, output);
  const MeshRecord expected = record;
  REQUIRE(findFinishedOutput(expected, output).has_value());
  CHECK(findFinishedOutput(expected, output)->status == MeshStatus::Skipped);
  for (std::string MeshRecord::*part :
       {&MeshRecord::inputHash, &MeshRecord::optionsHash, &MeshRecord::version, &MeshRecord::commit}) {
    MeshRecord other = expected;
    other.*part = "other";
    CHECK_FALSE(findFinishedOutput(other, output).has_value());
  }
  folder.write("a.asdf.ply", "values of another run");
  CHECK_FALSE(findFinishedOutput(expected, output).has_value());
  folder.write("a.asdf.ply", "values");
  CHECK(findFinishedOutput(expected, output).has_value());
  removeOutputRecord(output);
  CHECK_FALSE(findFinishedOutput(expected, output).has_value());
}

TEST_CASE("an output with a file of materials is finished only with that file") {
  const ScratchFolder folder;
  const std::string output = folder.write("a.obj", "mtllib a.obj.mtl");
  folder.write("a.obj.mtl", "colours");
  MeshRecord record = sampleRecord();
  record.code = 0;
  writeOutputRecord(record, output);
  CHECK(findFinishedOutput(record, output).has_value());
  folder.write("a.obj.mtl", "colours of another run");
  CHECK_FALSE(findFinishedOutput(record, output).has_value());
  std::filesystem::remove(folder / "a.obj.mtl");
  CHECK_FALSE(findFinishedOutput(record, output).has_value());
  folder.write("a.obj.mtl", "colours");
  removeOutput(record, output);
  CHECK(folder.names().empty());
}

TEST_CASE("an old output is removed only where it is known to be out of date") {
  const ScratchFolder folder;
  const std::string output = folder.write("a.asdf.ply", "values");
  MeshRecord old = sampleRecord();
  old.input = folder / "a.off";
  writeOutputRecord(old, output);
  const std::vector<std::string> all = folder.names();
  MeshRecord failed = old;
  removeOutdatedOutput(old, failed, output);
  CHECK_EQ(folder.names(), all);  // Nothing has changed.
  failed.inputHash.clear();
  removeOutdatedOutput(old, failed, output);
  CHECK_EQ(folder.names(), all);  // The input was not read.
  failed.inputHash = "other";
  failed.input = folder / "a.ply";
  removeOutdatedOutput(old, failed, output);
  CHECK_EQ(folder.names(), all);  // Another mesh.
  failed.input = folder / "x/../a.off";
  folder.write("a.asdf.ply", "values of another run");
  removeOutdatedOutput(old, failed, output);
  CHECK_EQ(folder.names(), all);  // Not the output of the record.
  folder.write("a.asdf.ply", "values");
  removeOutdatedOutput(old, failed, output);
  CHECK(folder.names().empty());
}

TEST_CASE("an output that is no regular file has no record") {
  const ScratchFolder folder;
  const std::string fifo = folder / "fifo";
  REQUIRE_EQ(mkfifo(fifo.c_str(), 0600), 0);
  const std::string other = folder.write("fifo.json", "of another program");
  CHECK_FALSE(contentHashOf(fifo).has_value());
  MeshRecord record = sampleRecord();
  writeOutputRecord(record, fifo);
  removeOutputRecord(fifo);
  CHECK_FALSE(findFinishedOutput(record, fifo).has_value());
  CHECK_EQ(folder.read("fifo.json"), "of another program");
  CHECK(record.outputHash.empty());
}

TEST_CASE("a failed mesh is not finished") {
  const ScratchFolder folder;
  const std::string output = folder.write("a.asdf.ply", "values");
  MeshRecord record = sampleRecord();
  writeOutputRecord(record, output);
  CHECK_FALSE(findFinishedOutput(record, output).has_value());
}

}  // namespace
}  // namespace asdfvk
