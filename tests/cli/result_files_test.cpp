// Results that cannot be written, are out of date, or have no record.
#include <filesystem>

#include "cli/mesh_tree.h"

namespace asdfvk::test {
namespace {

namespace fs = std::filesystem;

/// Below a limit of the shell, such as "-n 4".
ChildOutcome runLimited(const std::string& limit, const Names& arguments) {
  Names all{"-c", "ulimit " + limit + " && exec \"$0\" \"$@\"", ASDFVK_PROGRAM};
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

TEST_CASE("a picture of a field that the result lacks ends with 1 and writes nothing") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  checkFailure(runAsdf({mesh, "--backend", "reference", "--quiet", "--seeds", "1", "-o", folder / "out.ply", "--points",
                        folder / "points.ply", "--picture", folder / "error.png", "--picture-of", "error"}),
               1, "give more --seeds");
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
