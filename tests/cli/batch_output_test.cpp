#include <sys/stat.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <thread>
#include <utility>

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

TEST_CASE("a glTF mesh is computed again if a file beside it has changed") {
  const ScratchFolder folder;
  fs::create_directory(folder / "in");
  folder.write("in/mesh.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 12, "type": "VEC3"}],
      "bufferViews": [{"buffer": 0, "byteLength": 144}], "buffers": [{"uri": "mesh.bin", "byteLength": 144}]})");
  const auto writeData = [&](float height) {
    const std::array<std::array<float, 3>, 4> p{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, height}}};
    std::string bytes;
    for (const size_t corner : {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3})
      bytes.append(reinterpret_cast<const char*>(p[corner].data()), sizeof p[corner]);
    folder.write("in/mesh.bin", bytes);
  };
  const auto statuses = [&] {
    fs::remove(folder / "log");
    CHECK_EQ(
        runBatch({"-r", folder / "in", "-o", folder / "out", "--log", folder / "log", "--skip-existing", "--quiet"})
            .exitCode,
        0);
    return statusesIn(folder / "log");
  };
  writeData(1);
  CHECK_EQ(statuses(), StatusCounts{{"done", 1}});
  CHECK_EQ(statuses(), StatusCounts{{"skipped", 1}});
  writeData(2);
  CHECK_EQ(statuses(), StatusCounts{{"done", 1}});
}

TEST_CASE("the pages of a batch have the same bytes each time, with any number of threads") {
  const ScratchFolder folder;
  fs::create_directory(folder / "in");
  for (const char* name : {"in/a.off", "in/b.off"}) folder.write(name, sphereOff(6));
  for (const auto& [out, threads] : {std::pair{"one", "1"}, {"two", "2"}})
    CHECK_EQ(runAsdf({"-r", folder / "in", "-o", folder / out, "--backend", "reference", "--format", "html",
                      "--memory-limit", "100G", "--threads", threads, "--quiet"})
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
