#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "cli/mesh_tree.h"
#include "cli/refusal.h"

namespace asdfvk::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

TEST_CASE("a tree of meshes gives a tree of results, a record of each, and exit code 7 where some failed") {
  const MeshTree tree;
  const ChildOutcome outcome = runBatch({"-r", tree.root, "-o", tree / "out", "--log", tree / "log.jsonl"});
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 7);
  CHECK(outcome.error.find("bad.off: ") != std::string::npos);
  CHECK(outcome.error.find("9 done, 2 unreadable") != std::string::npos);
  const auto results = resultsIn(tree / "out");
  CHECK_EQ(results.size(), 9);
  CHECK(results.count("deep/er/cube.asdf.npy") == 1);
  CHECK_EQ(statusesIn(tree / "log.jsonl"), StatusCounts{{"done", 9}, {"failed", 2}});
  std::set<std::string> inputs;
  for (const Json& record : recordsIn(tree / "log.jsonl")) {
    inputs.insert(record.at("input").get<std::string>());
    CHECK_EQ(record.at("version").get<std::string>().empty(), false);
    CHECK_EQ(record.at("optionsHash").get<std::string>().size(), 32);
    const bool isDone = record.at("status") == "done";
    CHECK_EQ(record.at("code").get<int>(), isDone ? 0 : 2);
    CHECK_EQ(record.at("output").is_null(), !isDone);
    CHECK_EQ(record.at("message").get<std::string>().empty(), isDone);
    if (!isDone) continue;
    CHECK_GT(record.at("faceCount").get<int>(), 0);
    CHECK_GT(record.at("vertexCount").get<int>(), 0);
    CHECK_EQ(record.at("componentCount").get<int>(), 1);
    CHECK_GT(record.at("sdf").at("median").get<double>(), 0);
    CHECK(record.at("thickness").is_null());
    CHECK_EQ(record.at("inputHash").get<std::string>().size(), 32);
    CHECK_GT(record.at("totalSeconds").get<double>(), 0);
    CHECK_GT(record.at("seconds").at("trace").get<double>(), 0);
    CHECK_GT(record.at("peakMemoryBytes").get<uint64_t>(), 1'000'000);
    CHECK_EQ(record.at("backend").get<std::string>(), "reference");
  }
  CHECK_EQ(inputs.size(), tree.meshCount);
}

TEST_CASE("a list of meshes gives the same tree, also from standard input with zero bytes") {
  const MeshTree tree(false);
  std::string lines, zeros;
  for (const auto& entry : fs::recursive_directory_iterator(tree.root))
    if (entry.is_regular_file()) {
      lines += entry.path().string() + "\n";
      zeros += entry.path().string() + '\0';
    }
  const std::string list = tree.folder.write("list", lines);
  CHECK_EQ(runBatch({"-r", tree.root, "-o", tree / "a", "--quiet"}).exitCode, 0);
  CHECK_EQ(runBatch({"--files-from", list, "-o", tree / "b", "--quiet"}).exitCode, 0);
  ChildOptions options;
  options.input = zeros;
  CHECK_EQ(runAsdf({"--files-from", "-", "-0", "-o", tree / "c", "--backend", "reference", "--format", "npy"}, options)
               .exitCode,
           0);
  CHECK_EQ(resultsIn(tree / "a").size(), 9);
  CHECK(resultsIn(tree / "a") == resultsIn(tree / "b"));
  CHECK(resultsIn(tree / "a") == resultsIn(tree / "c"));
}

TEST_CASE("keys of a list name results and are in the records, also of worker processes, failures and skipped meshes") {
  const MeshTree tree;
  const std::string list =
      tree.folder.write("list", tree / "in/s0.off" + "\tfirst\n" + (tree / "in/s0.off") + "\tb/second\n" +
                                    (tree / "in/deep/bad.off") + "\tb/third\n" + (tree / "in/s1.off") + "\n");
  for (const Names& more : {Names{}, Names{"--isolate"}, Names{"--skip-existing"}}) {
    fs::remove(tree / "log");
    Names arguments{"--files-from", list, "-o", tree / "out", "--log", tree / "log", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    CHECK_EQ(runBatch(arguments).exitCode, 7);
    const auto results = resultsIn(tree / "out");
    CHECK_EQ(results.size(), 3);
    CHECK(results.at("first.asdf.npy") == results.at("b/second.asdf.npy"));
    CHECK(results.contains("s1.asdf.npy"));
    std::multiset<std::string> keys;
    for (const Json& record : recordsIn(tree / "log"))
      keys.insert(record.at("key").is_null() ? "" : record.at("key").get<std::string>());
    CHECK(keys == std::multiset<std::string>{"", "first", "b/second", "b/third"});
  }
  CHECK_EQ(Json::parse(runAsdf({"summarize", tree / "log", "--json"}).output).at("meshCount").get<int>(), 4);
  CHECK_NE(runAsdf({"summarize", tree / "log", "--format", "csv"}).output.find("input,key,status"), std::string::npos);
  const std::string unsafe = tree.folder.write("unsafe", tree / "in/s0.off" + "\t../x\n");
  checkFailure(runBatch({"--files-from", unsafe, "-o", tree / "out", "--quiet"}), 2, "line 1: the key '../x'");
}

TEST_CASE("results do not depend on --jobs and --isolate") {
  const MeshTree tree;
  CHECK_EQ(runBatch({"-r", tree.root, "-o", tree / "one", "--jobs", "1", "--quiet"}).exitCode, 7);
  const auto expected = resultsIn(tree / "one");
  for (const Names& more : {Names{"--jobs", "3"}, Names{"--isolate"}, Names{"--isolate", "--jobs", "2"}}) {
    Names arguments{"-r", tree.root, "-o", tree / "other", "--log", tree / "log"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ChildOutcome outcome = runBatch(arguments);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 7);
    CHECK(resultsIn(tree / "other") == expected);
    CHECK_EQ(statusesIn(tree / "log"), StatusCounts{{"done", 9}, {"failed", 2}});
    fs::remove_all(tree / "other");
    fs::remove(tree / "log");
  }
}

TEST_CASE("with --json the reports have the order of the meshes, also with --jobs") {
  const MeshTree tree;
  for (const Names& more : {Names{"--jobs", "3"}, Names{"--isolate", "--jobs", "2"}}) {
    Names arguments{"-r", tree.root, "-o", tree / "out", "--json", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ChildOutcome outcome = runBatch(arguments);
    Names meshes;
    for (const std::string& line : linesOf(outcome.output)) meshes.push_back(Json::parse(line).at("mesh"));
    CHECK_EQ(meshes.size(), tree.meshCount);
    CHECK(std::is_sorted(meshes.begin(), meshes.end()));
  }
}

TEST_CASE("--skip-existing skips what is unchanged and computes what is not") {
  const MeshTree tree(false);
  const auto run = [&](const Names& more) {
    fs::remove(tree / "log");
    Names arguments{"-r", tree.root, "-o", tree / "out", "--log", tree / "log", "--skip-existing", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ChildOutcome outcome = runBatch(arguments);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 0);
    return statusesIn(tree / "log");
  };
  CHECK_EQ(run({}), StatusCounts{{"done", 9}});
  CHECK_EQ(run({}), StatusCounts{{"skipped", 9}});
  CHECK_EQ(run({"--isolate"}), StatusCounts{{"skipped", 9}});
  CHECK_EQ(run({"--seeds", "20%"}), StatusCounts{{"done", 9}});  // Other options.
  CHECK_EQ(run({"--seeds", "20%", "--no-estimate"}), StatusCounts{{"done", 9}});
  CHECK_EQ(run({}), StatusCounts{{"done", 9}});
  const auto expected = resultsIn(tree / "out");
  tree.folder.write("in/s0.off", sphereOff(5));  // Another input.
  fs::remove(tree / "out/s1.asdf.npy");          // No output.
  tree.folder.write("out/deep/t0.asdf.npy", "other bytes");
  fs::remove(tree / "out/deep/t1.asdf.npy.json");  // Killed before the record.
  CHECK_EQ(run({}), StatusCounts{{"done", 4}, {"skipped", 5}});
  const auto again = resultsIn(tree / "out");
  CHECK(again.at("s1.asdf.npy") == expected.at("s1.asdf.npy"));
  CHECK(again.at("deep/t0.asdf.npy") == expected.at("deep/t0.asdf.npy"));
  CHECK(again.at("s0.asdf.npy") != expected.at("s0.asdf.npy"));
}

TEST_CASE("no device is opened where nothing is left to compute") {
  const MeshTree tree(false);
  const Names arguments{"-r",       tree.root, "-o",        tree / "out", "--skip-existing",
                        "--format", "npy",     "--backend", "vulkan"};
  ChildOptions options;
  CHECK_EQ(runAsdf(arguments, options).exitCode, 0);
  options.environment = {{"VK_DRIVER_FILES", "/missing"}};
  for (const Names& more : {Names{}, Names{"--isolate"}}) {
    Names all = arguments;
    all.insert(all.end(), more.begin(), more.end());
    const ChildOutcome outcome = runAsdf(all, options);
    CHECK_MESSAGE(outcome.exitCode == 0, outcome.error);
    CHECK(outcome.error.find("9 skipped") != std::string::npos);
    CHECK(outcome.error.find("device") == std::string::npos);
  }
}

TEST_CASE("a name with a slash at the end is a folder, which is made") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("s.off", sphereOff(6));
  CHECK_EQ(runBatch({mesh, "-o", folder / "new/deep/", "--quiet"}).exitCode, 0);
  CHECK(fs::exists(folder / "new/deep/s.asdf.npy"));
  folder.write("file", "");
  const ChildOutcome outcome = runBatch({mesh, "-o", folder / "file/", "--quiet"});
  CHECK_EQ(outcome.exitCode, 4);
  CHECK(outcome.error.find("cannot be written") != std::string::npos);
}

TEST_CASE("the shards of a batch are the whole") {
  const MeshTree tree(false);
  CHECK_EQ(runBatch({"-r", tree.root, "-o", tree / "whole", "--quiet"}).exitCode, 0);
  for (int i = 1; i <= 3; ++i)
    CHECK_EQ(runBatch({"-r", tree.root, "-o", tree / "parts", "--quiet", "--log", tree / "log", "--shard",
                       std::to_string(i) + "/3"})
                 .exitCode,
             0);
  CHECK_EQ(statusesIn(tree / "log"), StatusCounts{{"done", 9}});
  CHECK(resultsIn(tree / "parts") == resultsIn(tree / "whole"));
}

TEST_CASE("--shard auto computes the part of the scheduler and names it, and is refused without one") {
  const MeshTree tree(false);
  CHECK_EQ(runBatch({"-r", tree.root, "-o", tree / "whole", "--quiet"}).exitCode, 0);
  const Names arguments{"-r",  tree.root, "-o",     tree / "parts", "--format",
                        "npy", "--shard", "auto/2", "--backend",    "reference"};
  for (const char* index : {"0", "1"}) {
    const ChildOutcome outcome = runAsdf(arguments, {.environment = {{"JOB_COMPLETION_INDEX", index}}});
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 0);
    CHECK(outcome.error.starts_with(index[0] == '0' ? "asdf-vk: part 1 of 2, by JOB_COMPLETION_INDEX\n"
                                                    : "asdf-vk: part 2 of 2, by JOB_COMPLETION_INDEX\n"));
  }
  CHECK(resultsIn(tree / "parts") == resultsIn(tree / "whole"));
  checkFailure(runAsdf(arguments), 1, "--shard: auto: none of these variables of schedulers is set: AWS_BATCH_JOB_");
}

TEST_CASE("summarize counts the last record of each mesh, as text and JSON") {
  const MeshTree tree;
  CHECK_EQ(runBatch({"-r", tree.root, "-o", tree / "out", "--log", tree / "log", "--quiet"}).exitCode, 7);
  CHECK_EQ(
      runBatch({"-r", tree.root, "-o", tree / "out", "--log", tree / "log", "--quiet", "--skip-existing"}).exitCode, 7);
  const ChildOutcome text = runAsdf({"summarize", tree / "log"});
  INFO(text.output << text.error);
  CHECK_EQ(text.exitCode, 0);
  CHECK(text.output.find("11: 9 skipped, 2 failed") != std::string::npos);
  CHECK(text.output.find("code 2 ") != std::string::npos);
  const auto json = nlohmann::ordered_json::parse(runAsdf({"summarize", tree / "log", "--json"}).output);
  CHECK_EQ(json.at("meshCount").get<int>(), 11);
  CHECK_EQ(json.at("recordCount").get<int>(), 22);
  CHECK_EQ(json.at("failedCount").get<int>(), 2);
  const std::string table = runAsdf({"summarize", tree / "log", "--format", "csv"}).output;
  CHECK_EQ(std::count(table.begin(), table.end(), '\n'), 12);
  CHECK_NE(table.find(",sdf.median,"), std::string::npos);
  CHECK_EQ(table.find(",thickness.min,"), std::string::npos);
  CHECK(runAsdf({"summarize", tree / "log", "--format", "json", "--json"}).output == json.dump(2) + "\n");
  checkFailure(runAsdf({"summarize", tree / "log", "--format", "csv", "--json"}), 1,
               "--json and --format csv contradict each other");
  checkFailure(runAsdf({"summarize", tree / "missing"}), 2, "missing");
  checkFailure(runAsdf({"summarize"}), 1, "summarize --help");
  checkFailure(runAsdf({"sumarize", tree / "log"}), 1,
               "'sumarize' is neither a file nor a command; did you mean summarize?");
}

TEST_CASE("options of a batch that contradict each other are refused") {
  CHECK_EQ(refusal({"a.ply", "-0"}), "--null needs --files-from");
  CHECK_NE(refusal({"-", "--files-from", "-"}), "accepted");
  CHECK_NE(refusal({"-", "--isolate"}), "accepted");
  CHECK_NE(refusal({"-", "--memory-limit", "1G"}), "accepted");
  CHECK_NE(refusal({"-", "--skip-existing"}), "accepted");
  CHECK_NE(refusal({"-r", "in", "-o", "-"}), "accepted");
  CHECK_EQ(refusal({"-r", "in", "--picture", "a.png"}),
           "--picture a.png is for one mesh; give a folder that ends in /, such as --picture pictures/");
  CHECK_NE(refusal({"-r", "in", "--picture", "-"}), "accepted");
  CHECK_NE(refusal({"a.ply", "b.ply", "--picture", "a.png"}), "accepted");
  CHECK_NE(refusal({"-r", "in", "--picture", "pictures"}), "accepted");
  CHECK_EQ(refusal({"-r", "in", "--picture", "pictures/"}), "accepted");
  CHECK_EQ(refusal({"a.ply", "b.ply", "--picture", "pictures/"}), "accepted");
  CHECK_NE(refusal({"a.ply", "--points", "points/"}), "accepted");
  CHECK_NE(refusal({"-r", "in", "--points", "a.ply"}), "accepted");
  CHECK_NE(refusal({"-r", "in", "-o", "page.html"}), "accepted");
  CHECK_EQ(refusal({"--files-from", "list", "-o", "out"}), "accepted");
  for (const char* text : {"", "0", "-1", "x", "2X", "1e99"})
    CHECK_EQ(refusal({"a.ply", "--memory-limit", text}),
             "--memory-limit: '" + std::string(text) + "' is not a size such as 500M or 2G");
  CHECK_EQ(parseCommandLine({"a.ply", "--timeout", "1e9"}).batch.timeoutSeconds, 1e9);
  for (const char* text : {"0", "-1", "soon", "1e10", "inf"})
    CHECK_NE(refusal({"a.ply", "--timeout", text}), "accepted");
  CHECK_NE(refusal({"a.ply", "--shard", "3/2"}), "accepted");
  CHECK_NE(refusal({"a.ply", "--jobs", "0"}), "accepted");
  CHECK_EQ(parseCommandLine({"a.ply", "--memory-limit", "1.5g"}).batch.memoryBytes, uint64_t{3} << 29);
  CHECK(parseCommandLine({"a.ply", "--memory-limit", "1000"}).batch.isolates);
}

}  // namespace
}  // namespace asdfvk::test
