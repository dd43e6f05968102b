// Batches with meshes, processes and devices that fail, and runs that are ended.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "cli/mesh_tree.h"

namespace asdfvk::test {
namespace {

namespace fs = std::filesystem;

TEST_CASE("a kill -9 in the middle, then the same call: the bytes of a run without it") {
  MeshTree tree(false);
  tree.add("in/n-slow.off", sphereOff(7));  // The run is killed while it computes this mesh.
  CHECK_EQ(runBatch({"-r", tree.root, "-o", tree / "whole", "--quiet"}).exitCode, 0);
  const auto expected = resultsIn(tree / "whole");
  for (const int isolated : {0, 1})
    for (const size_t awaited : {0, 2, 5}) {
      fs::remove_all(tree / "out");
      fs::create_directory(tree / "out");
      fs::remove(tree / "log");
      Names arguments{"-r",      tree.root,   "-o",        tree / "out", "--log", tree / "log", "--skip-existing",
                      "--quiet", "--backend", "reference", "--format",   "npy",   "--jobs",     "1"};
      if (isolated) arguments.emplace_back("--isolate");
      {
        ChildProcess child(ASDFVK_FAULTY_PROGRAM, arguments);
        const auto begin = std::chrono::steady_clock::now();
        while (resultsIn(tree / "out").size() < awaited &&
               std::chrono::steady_clock::now() - begin < std::chrono::minutes(2))
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        child.send(SIGKILL);
        child.finish(60);
      }
      CHECK_LT(resultsIn(tree / "out").size(), expected.size());
      const ChildOutcome outcome = runChild(ASDFVK_FAULTY_PROGRAM, arguments);
      INFO(outcome.error);
      CHECK_EQ(outcome.exitCode, 0);
      CHECK(resultsIn(tree / "out") == expected);  // Also no temporary file.
    }
}

TEST_CASE("meshes that crash, hang or grow fail alone in worker processes") {
  MeshTree tree(false);
  for (const char* name : {"in/a-crash.off", "in/deep/hang.off", "in/grow.off"}) tree.add(name, sphereOff(5));
  const ChildOutcome outcome = runBatch({"-r", tree.root, "-o", tree / "out", "--log", tree / "log", "--isolate",
                                         "--timeout", "8", "--memory-limit", "300M"},
                                        ASDFVK_FAULTY_PROGRAM);
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 7);
  CHECK_EQ(statusesIn(tree / "log"), StatusCounts{{"done", 9}, {"failed", 3}});
  CHECK_EQ(resultsIn(tree / "out").size(), 9);
  std::map<std::string, int> codes;
  for (const nlohmann::json& record : recordsIn(tree / "log"))
    if (record.at("status") == "failed") codes[record.at("error").get<std::string>()] = record.at("code").get<int>();
  CHECK_EQ(codes, StatusCounts{{"crashed", 70}, {"memoryLimit", 8}, {"timeLimit", 8}});
}

TEST_CASE("a mesh whose worker is killed for memory is computed alone at the end, and its record says so") {
  MeshTree tree(false);
  for (const char* name : {"in/a-once-kill.off", "in/b-swell.off", "in/c-kill.off"}) tree.add(name, sphereOff(5));
  const Names arguments{"-r",        tree.root, "-o", tree / "out",     "--log", tree / "log",
                        "--isolate", "--jobs",  "2",  "--memory-limit", "300M"};
  const ChildOutcome outcome = runBatch(arguments, ASDFVK_FAULTY_PROGRAM);
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 7);
  CHECK_EQ(statusesIn(tree / "log"), StatusCounts{{"done", 11}, {"failed", 1}});
  CHECK_NE(outcome.error.find("b-swell.off: computed in a second attempt, alone, because"), std::string::npos);
  CHECK_NE(outcome.error.find("c-kill.off: the worker process was killed (signal 9) in two attempts"),
           std::string::npos);
  const std::vector<nlohmann::json> records = recordsIn(tree / "log");
  for (size_t i = 0; i < records.size(); ++i)
    CHECK_EQ(records[i].at("attemptCount").get<int>(), i < 9 ? 1 : 2);  // The second attempts are the last ones.
  CHECK_EQ(nlohmann::json::parse(tree.folder.read("out/b-swell.asdf.npy.json")).at("attemptCount").get<int>(), 2);
  CHECK(tree.folder.read("out/a-once-kill.asdf.npy") == tree.folder.read("out/b-swell.asdf.npy"));
  const ChildOutcome again =
      runBatch({"-r", tree.root, "-o", tree / "out", "--skip-existing", "--isolate"}, ASDFVK_FAULTY_PROGRAM);
  CHECK_NE(again.error.find("11 skipped, 1 "), std::string::npos);
  CHECK_EQ(again.error.find("second attempt, alone, because"), std::string::npos);
}

TEST_CASE("a signal to a worker, or a device that is lost, fails one mesh") {
  for (const bool isIsolated : {false, true}) {
    MeshTree tree(false);
    tree.add("in/deep/a-lose.off", sphereOff(5));
    tree.add("in/s1-lose.off", sphereOff(5));
    if (isIsolated) tree.add("in/deep/b-terminate.off", sphereOff(5));
    Names arguments{"-r", tree.root, "-o", tree / "out", "--log", tree / "log"};
    if (isIsolated) arguments.emplace_back("--isolate");
    const ChildOutcome outcome = runBatch(arguments, ASDFVK_FAULTY_PROGRAM);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 7);
    CHECK_EQ(statusesIn(tree / "log"), StatusCounts{{"done", 9}, {"failed", isIsolated ? 3 : 2}});
    StatusCounts errors;
    for (const nlohmann::json& record : recordsIn(tree / "log"))
      if (record.at("status") == "failed") ++errors[record.at("error").get<std::string>()];
    CHECK_EQ(errors["deviceLost"], 2);
    CHECK_EQ(errors["crashed"], isIsolated ? 1 : 0);
  }
}

TEST_CASE("a run that is cancelled after a failure ends with 130") {
  MeshTree tree(false);
  tree.add("in/a.off", "OFF\nnonsense");
  for (const char* name : {"in/b-slow.off", "in/c-slow.off", "in/d-slow.off", "in/e-slow.off"})
    tree.add(name, sphereOff(5));
  ChildProcess child(ASDFVK_FAULTY_PROGRAM, {"-r", tree.root, "-o", tree / "out", "--log", tree / "log", "--jobs", "1",
                                             "--backend", "reference"});
  REQUIRE(child.waitForError("a.off: ", 120));
  child.send(SIGTERM);
  const ChildOutcome outcome = child.finish(120);
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 130);
  CHECK(outcome.error.find("not begun") != std::string::npos);
}

TEST_CASE("--timeout without --isolate ends a mesh between its steps with 8") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(150));
  checkFailure(runAsdf({mesh, "--timeout", "0.5", "--seeds", "all", "--rays", "1024", "--threads", "1", "--backend",
                        "reference", "--quiet"}),
               8, "took longer than --timeout 0.5");
  CHECK_EQ(folder.names(), Names{"sphere.off"});
}

TEST_CASE("SIGTERM drops the meshes at hand, and the log and the message name them") {
  for (const bool isIsolated : {false, true}) {
    const ScratchFolder folder;
    fs::create_directory(folder / "in");
    for (const char* name : {"in/a.off", "in/b.off", "in/c.off"}) folder.write(name, sphereOff(150));
    Names arguments{"-r",      folder / "in", "-o",     folder / "out", "--log",     folder / "log",
                    "--seeds", "all",         "--rays", "1024",         "--backend", "reference"};
    arguments.emplace_back("--verbose");
    if (isIsolated) arguments.emplace_back("--isolate");
    ChildProcess child(ASDFVK_PROGRAM, arguments);
    REQUIRE(child.waitForError("asdf-vk: ", 120));  // The device lines.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    child.send(SIGTERM);
    const ChildOutcome outcome = child.finish(120);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 130);
    CHECK(outcome.error.find("dropped: " + (folder / "in/a.off")) != std::string::npos);
    CHECK(outcome.error.find("2 not begun") != std::string::npos);
    CHECK_EQ(statusesIn(folder / "log"), StatusCounts{{"dropped", 1}});
    CHECK(resultsIn(folder / "out").empty());
  }
}

TEST_CASE("a run that finds no device ends with 3, and --json has the reason for each mesh") {
  const MeshTree tree(false);
  for (const Names& more : {Names{"--isolate"}, Names{"--jobs", "2"}, Names{"--jobs", "1"}}) {
    Names arguments{"-r", tree.root, "-o", tree / "out", "--json", "--device", "no such device"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ChildOutcome outcome = runAsdf(arguments);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 3);
    CHECK(outcome.error.find("asdf-vk: error: ") != std::string::npos);
    const Names lines = linesOf(outcome.output);
    CHECK_EQ(lines.size(), tree.meshCount);
    for (const std::string& line : lines)
      CHECK_EQ(nlohmann::json::parse(line).at("code").get<std::string>(), "noUsableDevice");
  }
}

}  // namespace
}  // namespace asdfvk::test
