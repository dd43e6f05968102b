#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "cli/mesh_tree.h"

namespace asdfvk::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

TEST_CASE("--json has a line per mesh with the key mesh, also of skipped ones") {
  const MeshTree tree;
  const Names arguments{"-r", tree.root, "-o", tree / "out", "--json", "--quiet", "--skip-existing"};
  CHECK_EQ(runBatch(arguments).exitCode, 7);
  int skippedCount = 0;
  const Names lines = linesOf(runBatch(arguments).output);
  CHECK_EQ(lines.size(), tree.meshCount);
  for (const std::string& line : lines) {
    const Json json = Json::parse(line);
    CHECK(json.at("mesh").get<std::string>().starts_with(tree.root));
    if (!json.contains("status")) continue;
    ++skippedCount;
    CHECK_EQ(json.at("status"), "skipped");
    CHECK(json.at("output").get<std::string>().starts_with(tree / "out"));
    CHECK_EQ(json.at("record").at("input"), json.at("mesh"));
    CHECK_EQ(json.at("record").at("optionsHash").get<std::string>().size(), 32);
  }
  CHECK_EQ(skippedCount, 9);
}

TEST_CASE("the pages of a batch have the same bytes each time") {
  const ScratchFolder folder;
  fs::create_directory(folder / "in");
  for (const char* name : {"in/a.off", "in/b.off"}) folder.write(name, sphereOff(6));
  for (const char* out : {"one", "two"})
    CHECK_EQ(runAsdf({"-r", folder / "in", "-o", folder / out, "--backend", "reference", "--format", "html",
                      "--memory-limit", "100G", "--quiet"})
                 .exitCode,
             0);
  CHECK_EQ(resultsIn(folder / "one").size(), 2);
  CHECK(resultsIn(folder / "one") == resultsIn(folder / "two"));
}

TEST_CASE("an output that is no regular file has a line in the log and no record beside it") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("s.off", sphereOff(6)), fifo = folder / "fifo";
  REQUIRE_EQ(mkfifo(fifo.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] {
    std::ifstream in(fifo, std::ios::binary);
    received.assign(std::istreambuf_iterator<char>(in), {});
  });
  const ChildOutcome outcome =
      runAsdf({mesh, "-o", fifo, "--log", folder / "log", "--quiet", "--backend", "reference", "--format", "npy"});
  std::ofstream(fifo, std::ios::in | std::ios::out).flush();  // Lets the reader end where nothing was written.
  reader.join();
  CHECK_MESSAGE(outcome.exitCode == 0, outcome.error);
  CHECK(received.starts_with("\x93NUMPY"));
  CHECK_EQ(statusesIn(folder / "log"), StatusCounts{{"done", 1}});
  CHECK_EQ(folder.names(), Names{"fifo", "log", "s.off"});
}

}  // namespace
}  // namespace asdfvk::test
