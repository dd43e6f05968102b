#include <fmt/core.h>

#include <array>

#include "asdf_vk/files.h"
#include "cli/program_under_test.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

/// The faces with the last two corners exchanged.
std::vector<Face> reversed(std::vector<Face> faces) {
  for (Face& face : faces) std::swap(face[1], face[2]);
  return faces;
}

nlohmann::json runOrient(const std::string& mesh, const char* orientation, const std::string& output) {
  const ChildOutcome outcome =
      runAsdf({mesh, "--orient", orientation, "-o", output, "--json", "--quiet", "--backend", "reference"});
  INFO(outcome.error);
  REQUIRE_EQ(outcome.exitCode, 0);
  return nlohmann::json::parse(outcome.output);
}

TEST_CASE("--fields writes its fields in its order") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  const auto rowsOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{mesh,      "-o",  folder / "out.csv", "--quiet",
                                       "--seeds", "10%", "--backend",        "reference"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ChildOutcome outcome = runAsdf(arguments);
    INFO(outcome.error);
    REQUIRE_EQ(outcome.exitCode, 0);
    return linesOf(folder.read("out.csv"));
  };
  const std::vector<std::string> all = rowsOf({"--fields", "sdf,seed,error"});
  CHECK_EQ(all.at(0), "face,sdf,seed,error");
  CHECK_EQ(rowsOf({}).at(0), "face,sdf,seed");
  CHECK_EQ(rowsOf({"--fields", "sdf"}).at(0), "face,sdf");
  const std::vector<std::string> swapped = rowsOf({"--fields", "error,sdf"});
  CHECK_EQ(swapped.at(0), "face,error,sdf");
  REQUIRE_EQ(swapped.size(), all.size());
  for (size_t i = 1; i < all.size(); ++i) {
    const size_t sdf = all[i].find(',') + 1, seed = all[i].find(',', sdf) + 1, error = all[i].find(',', seed) + 1;
    CHECK_EQ(swapped[i], all[i].substr(0, sdf) + all[i].substr(error) + "," + all[i].substr(sdf, seed - 1 - sdf));
  }
}

TEST_CASE("a field that is unknown or needs a missing estimate ends with 1 and writes nothing") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{mesh, "--quiet", "--backend", "reference", "--fields"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runAsdf(arguments);
  };
  checkFailure(run({"depth"}), 1, "'depth'");
  checkFailure(run({"sdf,error", "--no-estimate"}), 1, "--no-estimate");
  checkFailure(run({"sdf,error", "--seeds", "all"}), 1, "--seeds all");
  // So few seeds that only the computation shows that no estimate is possible.
  checkFailure(run({"error", "--seeds", "1"}), 1, "--seeds");
  const ChildOutcome json = run({"error", "--seeds", "1", "--json"});
  CHECK_EQ(json.exitCode, 1);
  CHECK_EQ(nlohmann::json::parse(json.output).at("code").get<std::string>(), "unknownField");
  CHECK_EQ(folder.names(), std::vector<std::string>{"sphere.off"});
}

TEST_CASE("the faces that --orient reverses are reversed in the file, in the order of the input") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const std::string inverted = folder / "inverted.ply";
  const std::vector<Face> faces = readMesh(mesh).faces;
  CHECK_EQ(runOrient(mesh, "flip", inverted).at("reversedFaceCount").get<int>(), 12);
  CHECK(readMesh(inverted).faces == reversed(faces));

  const nlohmann::json kept = runOrient(inverted, "keep", folder / "kept.ply");
  CHECK_EQ(kept.at("reversedFaceCount").get<int>(), 0);
  CHECK_EQ(kept.at("warnings").at(0).at("code").get<std::string>(), "invertedComponents");
  CHECK(readMesh(folder / "kept.ply").faces == reversed(faces));

  const nlohmann::json corrected = runOrient(inverted, "auto", folder / "corrected.ply");
  CHECK_EQ(corrected.at("reversedFaceCount").get<int>(), 12);
  REQUIRE_EQ(corrected.at("warnings").size(), 1);
  CHECK_EQ(corrected.at("warnings").at(0).at("code"), "componentsReversed");
  CHECK(readMesh(folder / "corrected.ply").faces == faces);

  CHECK_EQ(runOrient(mesh, "auto", folder / "same.ply").at("reversedFaceCount").get<int>(), 0);
  CHECK(readMesh(folder / "same.ply").faces == faces);
}

TEST_CASE("all files of a mesh appear, or none") {
  if (!std::filesystem::exists("/dev/full")) return;
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(10));
  std::filesystem::create_symlink("/dev/full", folder / "full.ply");
  std::filesystem::create_symlink("/dev/full", folder / "full.png");
  for (const std::vector<std::string>& further :
       {std::vector<std::string>{"--points", folder / "full.ply"}, {"--picture", folder / "full.png"}})
    for (const char* const output : {"out.ply", "out.html", "out.obj"}) {
      std::vector<std::string> arguments{mesh, "-o", folder / output, "--quiet", "--backend", "reference", "--segment"};
      arguments.insert(arguments.end(), further.begin(), further.end());
      checkFailure(runAsdf(arguments), 4, "No space left on device");
      CHECK_EQ(folder.names(), std::vector<std::string>{"full.ply", "full.png", "sphere.off"});
    }
}

TEST_CASE("--orient reverses the corners of polygons after the first") {
  const ScratchFolder folder;
  const std::string mesh =
      folder.write("polygons.off", "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 2 0\n4 0 1 2 3\n2 0 1\n3 3 2 4\n0\n");
  const std::vector<uint32_t> corners{0, 3, 2, 1, 0, 1, 3, 4, 2};
  CHECK_EQ(runOrient(mesh, "flip", folder / "out.ply").at("reversedFaceCount").get<int>(), 2);
  const Mesh written = readMesh(folder / "out.ply");
  CHECK(written.polygons.corners == corners);
  CHECK(written.polygons.firstCorner == std::vector<uint64_t>{0, 4, 6, 9, 9});
}

TEST_CASE("--per vertex adds fields per vertex, and .csv holds these only") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(10));
  const auto run = [&](const std::string& output) {
    const ChildOutcome outcome = runAsdf({mesh, "-o", folder / output, "--quiet", "--backend", "reference", "--per",
                                          "vertex", "--fields", "sdf,centre"});
    INFO(outcome.error);
    REQUIRE_EQ(outcome.exitCode, 0);
    return folder.read(output);
  };
  const size_t vertexCount = readMesh(mesh).vertices.size();
  const std::string ply = run("out.ply");
  const std::string centre = "property float centre_x\nproperty float centre_y\nproperty float centre_z\n";
  const std::string main =
      "property float quality\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property uchar alpha\n";
  for (const char* end : {"element face", "end_header"}) CHECK(ply.find(main + centre + end) != std::string::npos);
  const std::string vtu = run("out.vtu");
  for (const char* start : {"<PointData", "<CellData"})
    for (const char* name : {"Name=\"sdf\" format", "Name=\"centre\" NumberOfComponents=\"3\" format"})
      CHECK(vtu.find(name, vtu.find(start)) != std::string::npos);
  const std::string npz = run("out.npz");
  for (const char* name : {"sdf.npyface", "vertex_sdf.npyvertex sdf", "centre.npyface", "vertex_centre.npyvertex"})
    CHECK(npz.find(name) != std::string::npos);
  const std::vector<std::string> lines = linesOf(run("out.csv"));
  CHECK_EQ(lines.at(0), "vertex,sdf,centre_x,centre_y,centre_z");
  CHECK_EQ(lines.size(), vertexCount + 1);
  CHECK(run("out.npy").find("'shape': (" + std::to_string(vertexCount) + ",)") != std::string::npos);
}

std::string twoTetrahedraOff() {
  std::string vertices, faces;
  for (const int at : {0, 1}) {
    for (const auto& [x, y, z] : {std::array{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
      vertices += fmt::format("{} {} {}\n", x + 5 * at, y, z);
    for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
      faces += fmt::format("3 {} {} {}\n", a + 4 * at, b + 4 * at, c + 4 * at);
  }
  return "OFF\n8 8 0\n" + vertices + faces;
}

TEST_CASE("--points writes the skeleton points beside the result") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(10));
  const ChildOutcome outcome = runAsdf({mesh, "-o", folder / "out.csv", "--points", folder / "points.ply", "--json",
                                        "--backend", "reference", "--segment", "cgal", "--clusters", "2"});
  INFO(outcome.error);
  REQUIRE_EQ(outcome.exitCode, 0);
  CHECK_EQ(nlohmann::json::parse(outcome.output).at("points"), folder / "points.ply");
  CHECK(outcome.error.find(", points " + (folder / "points.ply")) != std::string::npos);
  const std::string ply = folder.read("points.ply"), end = "end_header\n";
  CHECK(ply.find("element vertex 360\n") != std::string::npos);
  CHECK(ply.find("property uint part\n") != std::string::npos);
  CHECK_EQ(ply.size(), ply.find(end) + end.size() + 360 * 32);
  CHECK_EQ(linesOf(folder.read("out.csv")).at(0), "face,sdf,seed,normalized,segment");
  const ChildOutcome streamed =
      runAsdf({mesh, "-o", folder / "out.csv", "--points", "-", "--quiet", "--backend", "reference"});
  CHECK(streamed.output.starts_with("ply\n"));
  const std::string two = folder.write("two.off", twoTetrahedraOff());
  const ChildOutcome trees = runAsdf({two, "-o", folder / "out.csv", "--points", folder / "trees.swc", "--fields",
                                      "component", "--backend", "reference"});
  REQUIRE_EQ(trees.exitCode, 0);
  std::vector<std::string> lines = linesOf(folder.read("trees.swc"));
  std::erase_if(lines, [](const std::string& line) { return line.starts_with('#'); });
  REQUIRE_EQ(lines.size(), 8);
  for (size_t i = 0; i < 8; ++i) CHECK_EQ(lines[i].ends_with(" -1"), i % 4 == 0);
  CHECK_EQ(folder.read("out.csv"), "face,component\n0,0\n1,0\n2,0\n3,0\n4,1\n5,1\n6,1\n7,1\n");
}

}  // namespace
}  // namespace asdfvk::test
