// Results that cannot be written, are out of date, or have no record.
#include <filesystem>

#include "cli/mesh_tree.h"

namespace asdfvk::test {
namespace {

namespace fs = std::filesystem;

const std::string kNoMesh = "OFF\nnonsense";

/// Below a limit of the shell, such as "-n 4".
/// With the standard streams open only.
ChildOutcome runLimited(const std::string& limit, const Names& arguments) {
  Names all{"-c", "exec 3>&- 4>&- 5>&- 6>&- 7>&- 8>&- 9>&-; ulimit " + limit + " && exec \"$0\" \"$@\"",
            ASDFVK_PROGRAM};
  all.insert(all.end(), arguments.begin(), arguments.end());
  all.insert(all.end(), {"--backend", "reference", "--quiet"});
  return runChild("/bin/sh", all);
}

TEST_CASE("a file beyond the limit on sizes ends with 4 and leaves nothing, and a batch goes on") {
  const ScratchFolder folder;
  fs::create_directory(folder / "in");
  const std::string large = folder.write("in/a.off", sphereOff(30));
  folder.write("in/b.off", cubeOff());
  checkFailure(runLimited("-f 10", {large, "-o", folder / "x.ply"}), 4, "no partial file remains");
  CHECK_EQ(folder.names(), Names{"in"});
  for (const Names& more : {Names{}, Names{"--isolate"}}) {
    Names arguments{"-r", folder / "in", "-o", folder / "out", "--log", folder / "log"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    checkFailure(runLimited("-f 10", arguments), 7, "a.off: ");
    CHECK_EQ(statusesIn(folder / "log"), StatusCounts{{"done", 1}, {"failed", 1}});
    fs::remove(folder / "log");
    CHECK_EQ(resultsIn(folder / "out").size(), 1);
    fs::remove_all(folder / "out");
  }
}

TEST_CASE("a limit on open files ends with 8 and its remedy") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const std::string remedy = "the system allows no further open file; raise its limit (ulimit -n)";
  checkFailure(runLimited("-n 4", {mesh, "-o", folder / "out.ply"}), 8, remedy);
  checkFailure(runLimited("-n 6", {mesh, "-o", folder / "out.ply", "--isolate"}), 8, remedy);
  CHECK_EQ(folder.names(), Names{"cube.off"});
}

TEST_CASE("the old result of a mesh that fails in a batch is removed where it is out of date") {
  const ScratchFolder folder;
  fs::create_directory(folder / "in");
  const Names names{"changed", "missing", "replaced", "unrecorded", "unchanged"};
  std::string list;
  for (const std::string& name : names) list += folder.write("in/" + name + ".off", cubeOff()) + "\n";
  const Names arguments{"--files-from", folder.write("list", list), "-o", folder / "out", "--skip-existing", "--quiet"};
  CHECK_EQ(runBatch(arguments).exitCode, 0);
  const auto before = resultsIn(folder / "out");
  CHECK_EQ(before.size(), names.size());
  for (const char* name : {"changed", "replaced", "unrecorded"})
    folder.write("in/" + std::string(name) + ".off", kNoMesh);
  fs::remove(folder / "in/missing.off");  // The result may still be right, for example of a disk that is not mounted.
  folder.write("out/replaced.asdf.npy", "of another program");
  fs::remove(folder / "out/unrecorded.asdf.npy.json");
  CHECK_EQ(runBatch(arguments).exitCode, 7);
  const auto after = resultsIn(folder / "out");
  CHECK_EQ(after.size(), names.size() - 1);
  CHECK_FALSE(fs::exists(folder / "out/changed.asdf.npy"));
  CHECK_FALSE(fs::exists(folder / "out/changed.asdf.npy.json"));
  CHECK(after.at("missing.asdf.npy") == before.at("missing.asdf.npy"));
  CHECK_EQ(after.at("replaced.asdf.npy"), "of another program");
}

TEST_CASE("the old result of a mesh whose worker crashes, or whose new result cannot be written, is removed") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("crash.off", cubeOff());
  const auto run = [&](const Names& more, const std::string& program) {
    Names arguments{mesh, "-o", folder / "out.npy", "--skip-existing", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runBatch(arguments, program).exitCode;
  };
  CHECK_EQ(run({}, ASDFVK_PROGRAM), 0);
  CHECK_EQ(run({"--isolate", "--seeds", "all"}, ASDFVK_FAULTY_PROGRAM), 70);
  CHECK_EQ(folder.names(), Names{"crash.off"});
  CHECK_EQ(run({}, ASDFVK_PROGRAM), 0);
  folder.write("crash.off", sphereOff(30));
  const ChildOutcome outcome =
      runLimited("-f 10", {mesh, "-o", folder / "out.npy", "--skip-existing", "--format", "npy"});
  checkFailure(outcome, 4, "no partial file remains");
  CHECK_EQ(folder.names(), Names{"crash.off"});
}

TEST_CASE("a mesh whose record cannot be written fails with 4 before the work, the others are computed") {
  const ScratchFolder folder;
  fs::create_directory(folder / "in");
  const std::string longName(244, 'l');  // The name of the record is longer than 255 bytes, that of the result is not.
  for (const std::string& name : {std::string("a"), std::string("b"), longName})
    folder.write("in/" + name + ".off", cubeOff());
  for (const char* inFolder : {"", "/x"}) {
    fs::create_directories(folder / "out/a.asdf.npy.json" + inFolder);
    const ChildOutcome outcome =
        runBatch({"-r", folder / "in", "-o", folder / "out", "--log", folder / "log", "--skip-existing", "--quiet"});
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 7);
    CHECK(outcome.error.find("a.asdf.npy.json cannot be written: it is a directory") != std::string::npos);
    CHECK(outcome.error.find(".json cannot be written: its name is too long") != std::string::npos);
    CHECK_EQ(resultsIn(folder / "out").size(), 1);
    CHECK(fs::is_directory(folder / "out/a.asdf.npy.json"));
  }
  for (const nlohmann::json& record : recordsIn(folder / "log"))
    if (record.at("status") == "failed") CHECK_EQ(record.at("code").get<int>(), 4);
}

TEST_CASE("a picture of a field that the result lacks ends with 1 and writes nothing") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  checkFailure(runAsdf({mesh, "--backend", "reference", "--quiet", "--seeds", "1", "-o", folder / "out.ply", "--points",
                        folder / "points.ply", "--picture", folder / "error.png", "--picture-of", "error"}),
               1, "give a share such as --seeds 10%");
  CHECK_EQ(folder.names(), Names{"sphere.off"});
}

TEST_CASE("the target of a dangling link is created, and the link remains") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  fs::create_directory(folder / "deep");
  fs::create_symlink("deep/second.ply", folder / "link.ply");
  fs::create_symlink("../target.ply", folder / "deep/second.ply");
  const auto run = [&](const std::string& output) {
    return runAsdf({mesh, "-o", folder / output, "--backend", "reference", "--quiet"});
  };
  for (int i = 0; i < 2; ++i) {  // The second time the target exists.
    const ChildOutcome outcome = run("link.ply");
    CHECK_MESSAGE(outcome.exitCode == 0, outcome.error);
    CHECK(fs::is_symlink(folder / "link.ply"));
    CHECK(fs::is_symlink(folder / "deep/second.ply"));
    CHECK(fs::is_regular_file(fs::symlink_status(folder / "target.ply")));
  }
  fs::create_symlink("nowhere/target.ply", folder / "lost.ply");
  checkFailure(run("lost.ply"), 4, "nowhere is not a directory; create it first");
  CHECK_EQ(folder.names(), Names{"cube.off", "deep", "link.ply", "lost.ply", "target.ply"});
}

}  // namespace
}  // namespace asdfvk::test
