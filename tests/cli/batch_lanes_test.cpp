// Batches on a GPU: several meshes at a time in one process.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "cli/lavapipe.h"
#include "cli/mesh_tree.h"
#include "support/fake_device.h"
#include "support/scoped_variable.h"

namespace asdfvk::test {
namespace {

namespace fs = std::filesystem;

const FakeDevice::Variables kGpuOfBatch{{"ASDF_VK_FAKE_TYPE", "discrete"},
                                        {"ASDF_VK_FAKE_SEPARATE_MEMORY", "1"},
                                        {"ASDF_VK_FAKE_QUEUES", "2"},
                                        {"ASDF_VK_GPU_RAYS", "1"},
                                        {"ASDF_VK_FAKE_STORAGE_BUFFERS", "8"}};

ChildOutcome runOnGpu(const ChildOptions& options, const Names& arguments,
                      const std::string& program = ASDFVK_PROGRAM) {
  Names all = arguments;
  all.insert(all.end(), {"--backend", "vulkan", "--format", "npy", "--threads", "4"});
  return runChild(program, all, options);
}

/// Records without what depends on the time of the run, by their input.
std::map<std::string, nlohmann::json> comparableRecords(const std::string& log) {
  std::map<std::string, nlohmann::json> records;
  for (nlohmann::json& record : recordsIn(log)) {
    for (const char* key : {"time", "seconds", "totalSeconds", "peakMemoryBytes", "output"}) record.erase(key);
    records[record.at("input").get<std::string>()] = record;
  }
  return records;
}

TEST_CASE(
    "results and records on a GPU do not depend on the number of lanes, and those of worker processes are equal") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const FakeDevice gpu(kGpuOfBatch);
  const MeshTree tree;
  const auto run = [&](const std::string& name, const Names& more) {
    Names arguments{"-r", tree.root, "-o", tree / name, "--log", tree / (name + ".log"), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ChildOutcome outcome = runOnGpu(*lavapipe, arguments);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 7);
    CHECK(outcome.error.find("9 done, 2 unreadable") != std::string::npos);
    Names meshes;
    for (const std::string& line : linesOf(outcome.output)) meshes.push_back(nlohmann::json::parse(line).at("mesh"));
    CHECK_EQ(meshes.size(), tree.meshCount);
    CHECK(std::is_sorted(meshes.begin(), meshes.end()));
  };
  run("one", {"--jobs", "1"});
  const auto expected = resultsIn(tree / "one");
  const auto records = comparableRecords(tree / "one.log");
  CHECK_EQ(records.size(), tree.meshCount);
  for (const Names& more : {Names{"--jobs", "2"}, Names{"--jobs", "4"}, Names{"--jobs", "2", "--isolate"}}) {
    fs::remove_all(tree / "other");
    fs::remove(tree / "other.log");
    run("other", more);
    CHECK(resultsIn(tree / "other") == expected);
    CHECK(comparableRecords(tree / "other.log") == records);
  }
}

TEST_CASE("lanes are in one process only on a GPU and without --isolate") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  MeshTree tree(false);
  tree.add("in/a-crash.off", sphereOff(5));
  // Whether the process outlives a mesh that crashes.
  const auto survives = [&](const Names& more) {
    Names arguments{"-r", tree.root, "-o", tree / "out", "--jobs", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ChildOutcome outcome = runOnGpu(*lavapipe, arguments, ASDFVK_FAULTY_PROGRAM);
    INFO(outcome.error);
    const bool hasSummary = outcome.error.find("9 done, 1 failed") != std::string::npos;
    CHECK_EQ(outcome.exitCode == 7, hasSummary);
    return hasSummary;
  };
  CHECK(survives({}));
  const FakeDevice gpu(kGpuOfBatch);
  CHECK_FALSE(survives({}));
  CHECK(survives({"--isolate"}));
  CHECK(survives({"--memory-limit", "4G"}));
}

TEST_CASE("a device that is lost fails the meshes of all lanes, and is opened again for the others") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const FakeDevice gpu(kGpuOfBatch);
  MeshTree tree(false);
  for (int i = 0; i < 12; ++i) tree.add("in/u" + std::to_string(i) + ".off", sphereOff(10));
  CHECK_EQ(runOnGpu(*lavapipe, {"-r", tree.root, "-o", tree / "expected"}).exitCode, 0);
  const auto expected = resultsIn(tree / "expected");
  const ScopedVariable lost("ASDF_VK_FAKE_LOST_AT", "60");
  const ChildOutcome outcome =
      runOnGpu(*lavapipe, {"-r", tree.root, "-o", tree / "out", "--log", tree / "log", "--jobs", "2"});
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 7);
  const auto results = resultsIn(tree / "out");
  int failedCount = 0;
  for (const nlohmann::json& record : recordsIn(tree / "log")) {
    if (record.at("status") == "done") continue;
    ++failedCount;
    CHECK_EQ(record.at("error").get<std::string>(), "deviceLost");
    CHECK_EQ(record.at("code").get<int>(), 3);
  }
  CHECK_GT(failedCount, 0);
  CHECK_GT(results.size(), 0);
  CHECK_EQ(results.size() + failedCount, tree.meshCount);
  for (const auto& [name, bytes] : results) CHECK(bytes == expected.at(name));
}

TEST_CASE("with auto another backend computes the meshes of lanes whose device is lost") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const FakeDevice gpu(kGpuOfBatch);
  const ScopedVariable lost("ASDF_VK_FAKE_LOST_AT", "40");
  const MeshTree tree(false);
  const ChildOutcome outcome =
      runAsdf({"-r", tree.root, "-o", tree / "out", "--log", tree / "log", "--jobs", "3"}, *lavapipe);
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 0);
  CHECK_EQ(statusesIn(tree / "log"), StatusCounts{{"done", 9}});
  CHECK(outcome.error.find("cpu") != std::string::npos);
}

TEST_CASE("--timeout ends the meshes of lanes between their steps, and the lanes continue") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const FakeDevice gpu(kGpuOfBatch);
  const ScratchFolder folder;
  fs::create_directory(folder / "in");
  for (const char* name : {"in/a.off", "in/b.off", "in/c.off"}) folder.write(name, sphereOff(300));
  const ChildOutcome outcome =
      runOnGpu(*lavapipe, {"-r", folder / "in", "-o", folder / "out", "--log", folder / "log", "--jobs", "2", "--rays",
                           "1024", "--seeds", "all", "--timeout", "1"});
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 8);
  CHECK_EQ(statusesIn(folder / "log"), StatusCounts{{"failed", 3}});
  CHECK(outcome.error.find("c.off: took longer than --timeout 1") != std::string::npos);
}

TEST_CASE("SIGTERM drops the meshes of all lanes, and no further mesh begins") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const FakeDevice gpu(kGpuOfBatch);
  const ScratchFolder folder;
  fs::create_directory(folder / "in");
  for (const char* name : {"in/a.off", "in/b.off", "in/c.off"}) folder.write(name, sphereOff(300));
  ChildProcess child(ASDFVK_PROGRAM,
                     {"-r", folder / "in", "-o", folder / "out", "--log", folder / "log", "--seeds", "all", "--rays",
                      "1024", "--backend", "vulkan", "--jobs", "2", "--verbose"},
                     *lavapipe);
  REQUIRE(child.waitForError("asdf-vk: ", 120));  // The device lines.
  std::this_thread::sleep_for(std::chrono::seconds(2));
  child.send(SIGTERM);
  const ChildOutcome outcome = child.finish(120);
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 130);
  // On a machine with much other work, the second lane may not have begun.
  const int dropped = statusesIn(folder / "log")["dropped"];
  CHECK(dropped >= 1);
  CHECK(dropped <= 2);
  const size_t line = outcome.error.find("dropped: ");
  REQUIRE(line != std::string::npos);
  CHECK(outcome.error.find(folder / "in/a.off", line) != std::string::npos);
  CHECK(outcome.error.find(std::to_string(3 - dropped) + " not begun") != std::string::npos);
  CHECK(resultsIn(folder / "out").empty());
}

}  // namespace
}  // namespace asdfvk::test
