#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "cli/lavapipe.h"
#include "cli/program_under_test.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

using Names = std::vector<std::string>;

TEST_CASE("without an argument there is a short usage and exit code 1") {
  const ChildOutcome outcome = runAsdf({});
  CHECK_EQ(outcome.exitCode, 1);
  CHECK(outcome.output.empty());
  CHECK(outcome.error.starts_with("Usage: asdf-vk MESH... [OPTIONS]\nComputes the local thickness (shape diameter "));
}

TEST_CASE("help and version go to standard output with exit code 0") {
  for (const char* option : {"--help", "-h", "--help=all"}) {
    const ChildOutcome help = runAsdf({option});
    CHECK_EQ(help.exitCode, 0);
    CHECK(help.error.empty());
    for (const char* part : {"asdf-vk", "--seeds", "--segment"})
      CHECK_MESSAGE(help.output.find(part) != std::string::npos, part);
  }
  const ChildOutcome version = runAsdf({"--version"});
  CHECK_EQ(version.exitCode, 0);
  CHECK(version.error.empty());
  CHECK_EQ(linesOf(version.output).size(), 1);
}

TEST_CASE("--version prints the version and the commit that the JSON report has") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const ChildOutcome report = runAsdf({mesh, "--json", "--quiet", "--backend", "reference"});
  REQUIRE_EQ(report.exitCode, 0);
  const nlohmann::json json = nlohmann::json::parse(report.output);
  const auto version = json.at("version").get<std::string>(), commit = json.at("commit").get<std::string>();
  CHECK_FALSE(version.empty());
  const bool isHash = commit.size() >= 7 && commit.find_first_not_of("0123456789abcdef") == std::string::npos;
  CHECK_MESSAGE((isHash || commit == "unknown"), commit);
  CHECK_EQ(runAsdf({"--version"}).output, "asdf-vk " + version + " (" + commit + ")\n");
}

TEST_CASE("a good mesh gives 0 and a result beside it") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const ChildOutcome outcome = runAsdf({mesh, "--backend", "reference"});
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 0);
  CHECK(outcome.output.empty());
  CHECK(outcome.error.find("12 faces") != std::string::npos);
  CHECK_EQ(folder.names(), Names{"cube.asdf.ply", "cube.off"});
  CHECK_EQ(folder.read("cube.off"), cubeOff());
}

TEST_CASE("a picture is one more output, and a failed one ends with 4" * doctest::test_suite("slow")) {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const std::vector<std::string> common{mesh, "--backend", "reference", "-o", folder / "out.csv"};
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runAsdf(arguments);
  };
  const ChildOutcome sdf = run({"--picture", folder / "sdf.png"});
  CHECK_EQ(sdf.exitCode, 0);
  CHECK(sdf.error.find("sdf.png") != std::string::npos);
  CHECK_EQ(run({"--quiet", "--picture", folder / "seeds.png", "--picture-of", "seeds", "--picture-up", "-z"}).exitCode,
           0);
  CHECK_EQ(run({"--quiet", "--picture", folder / "turned.png", "--picture-view", "-45,90"}).exitCode, 0);
  CHECK_EQ(folder.names(), Names{"cube.off", "out.csv", "sdf.png", "seeds.png", "turned.png"});
  CHECK(folder.read("sdf.png").starts_with("\x89PNG"));
  CHECK_NE(folder.read("sdf.png"), folder.read("seeds.png"));
  CHECK_NE(folder.read("sdf.png"), folder.read("turned.png"));
  CHECK_EQ(run({"--quiet", "--picture", "-"}).output, folder.read("sdf.png"));
  checkFailure(run({"--quiet", "--picture", folder / "no/such/folder.png"}), 4, "folder.png");
  // Values of polygons go to all of their triangles.
  const std::string quads = folder.write("quads.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  const ChildOutcome ofQuads = runAsdf({quads, "--backend", "reference", "--quiet", "-o", folder / "out.csv",
                                        "--picture-of", "seeds", "--picture", folder / "quads.png"});
  CHECK_EQ(ofQuads.exitCode, 0);
  CHECK_GT(folder.read("quads.png").size(), 1000);
  checkFailure(run({"--quiet", "--json", "--picture", "-"}), 1, "--picture");
}

TEST_CASE("a picture of the expected error needs an estimate" * doctest::test_suite("slow")) {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(12));
  const auto run = [&](const std::string& input, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{input,       "--backend",         "reference",    "--quiet",
                                       "-o",        folder / "out.csv",  "--picture-of", "error",
                                       "--picture", folder / "error.png"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runAsdf(arguments);
  };
  CHECK_EQ(run(mesh, {"--seeds", "10%"}).exitCode, 0);
  const std::string picture = folder.read("error.png");
  CHECK(picture.starts_with("\x89PNG"));
  checkFailure(run(mesh, {"--no-estimate"}), 1, "--no-estimate");
  for (const char* seeds : {"1", "auto"}) checkFailure(run(mesh, {"--seeds", seeds}), 1, "--seeds 10%");
  // Also where the faces are no triangles.
  const std::string quads = folder.write("quads.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  checkFailure(run(quads, {}), 1, "--seeds 10%");
}

TEST_CASE("each form of --seeds is accepted and wrong ones are usage errors") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  for (const char* seeds : {"all", "auto", "10%", "0.5%", "100%", "1", "12", "1000000"}) {
    const ChildOutcome outcome =
        runAsdf({mesh, "--seeds", seeds, "--backend", "reference", "--quiet", "-o", folder / "out.csv"});
    CHECK_MESSAGE(outcome.exitCode == 0, seeds, ": ", outcome.error);
    CHECK_EQ(linesOf(folder.read("out.csv")).size(), 13);
  }
  for (const char* seeds : {"0", "0%", "101%", "-5", "ten", "10 %", ""})
    checkFailure(runAsdf({mesh, "--seeds", seeds, "--quiet"}), 1, "--seeds");
}

TEST_CASE("usage errors end with 1 before any work") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const std::string other = folder.write("cube.obj", cubeObj());
  checkFailure(runAsdf({"--quiet"}), 1, "no mesh");
  checkFailure(runAsdf({mesh, "--bogus"}), 1, "--bogus");
  checkFailure(runAsdf({mesh, "--rays", "1025"}), 1, "1024");
  checkFailure(runAsdf({mesh, "-o", folder / "out.xyz"}), 1, "out.xyz");
  checkFailure(runAsdf({mesh, "-o", folder / "out.htm"}), 1, "the formats are ply, obj, glb, vtu, npy, npz, csv, html");
  checkFailure(runAsdf({mesh, mesh}), 1, mesh + " is named twice; name it once");
  checkFailure(runAsdf({mesh, "-o", folder / "new/", "--pooling", "0.5", "--recipe", "paper"}), 1, "--pooling");
  checkFailure(runAsdf({mesh, "-o", "-", "--json"}), 1, "--json");
  checkFailure(runAsdf({mesh, other}), 1, "cube.asdf.ply");
  checkFailure(runAsdf({mesh, other, "-o", folder / "out.ply"}), 1, "is not a folder");
  checkFailure(runAsdf({"-"}), 1, "-o");
  checkFailure(runAsdf({mesh, "--check", "5"}), 1, "--check=5");
  checkFailure(runAsdf({mesh, "--backend", "reference", "--solver", "cg"}), 1, "--solver");
  CHECK_EQ(folder.names(), Names{"cube.obj", "cube.off"});
}

TEST_CASE("an input is never overwritten") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.ply", cubeAsciiPly());
  std::filesystem::create_symlink("cube.ply", folder / "link.ply");
  checkFailure(runAsdf({mesh, "-o", mesh}), 1, "overwritten");
  checkFailure(runAsdf({mesh, "-o", folder / "link.ply"}), 1, "overwritten");
  CHECK_EQ(folder.read("cube.ply"), cubeAsciiPly());
}

TEST_CASE("values that do not fit into float32 end with 2 and without a result, except in CSV") {
  const ScratchFolder folder;
  const auto write = [&](const char* name, const char* size) {
    return folder.write(name, fmt::format("OFF\n4 4 0\n0 0 0\n{0} 0 0\n0 {0} 0\n0 0 {0}\n3 0 2 1\n3 0 1 3\n3 0 3 2\n"
                                          "3 1 2 3\n",
                                          size));
  };
  const std::string large = write("large.off", "1e40"), small = write("small.off", "1e-50");
  const std::vector<std::string> common{"--backend", "reference", "--quiet", "-o"};
  const auto run = [&](const std::string& mesh, const std::string& output) {
    std::vector<std::string> arguments{mesh};
    arguments.insert(arguments.end(), common.begin(), common.end());
    arguments.push_back(folder / output);
    return runAsdf(arguments);
  };
  for (const char* output : {"out.ply", "out.vtu", "out.npy", "out.npz", "out.html"})
    for (const std::string& mesh : {large, small})
      checkFailure(run(mesh, output), 2, "a value of 'sdf' in the unit of the mesh does not fit into float32: ");
  CHECK_EQ(folder.names(), Names{"large.off", "small.off"});
  CHECK_EQ(run(large, "out.csv").exitCode, 0);
  CHECK_EQ(folder.read("out.csv").find("inf"), std::string::npos);
}

TEST_CASE("an unreadable mesh ends with 2 and its name") {
  const ScratchFolder folder;
  const std::vector<std::string> options{"--quiet", "--backend", "reference"};
  const auto run = [&](const std::string& mesh) {
    std::vector<std::string> arguments = options;
    arguments.push_back(mesh);
    return runAsdf(arguments);
  };
  checkFailure(run(folder / "missing.ply"), 2, "missing.ply: ");
  checkFailure(run(folder / ""), 2, "is a directory, not a file; -r computes all meshes below a folder");
  checkFailure(run(folder.write("empty.ply", "")), 2, "empty.ply: ");
  checkFailure(run(folder.write("half.ply", cubeBinaryPly().substr(0, 300))), 2, "half.ply: ");
  checkFailure(run(folder.write("two\nlines.off", "OFF\nx")), 2, "two lines.off: ");
  checkFailure(run(folder.write("noface.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n")), 2, "noface.off: ");
  checkFailure(run(folder.write("range.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")), 2, "range.off: ");
  std::filesystem::create_directory(folder / "folder.ply");
  checkFailure(run(folder / "folder.ply"), 2, "folder.ply: ");
  for (const std::string& name : folder.names()) CHECK(name.find("asdf") == std::string::npos);
}

TEST_CASE("a result that cannot be written ends with 4 and leaves nothing") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.off", cubeOff());
  const auto run = [&](const std::string& output) {
    return runAsdf({mesh, "--quiet", "--backend", "reference", "-o", output});
  };
  checkFailure(run(folder / "nowhere/out.ply"), 4, "nowhere");
  checkFailure(run("/proc/out.ply"), 4, "/proc/out.ply");
  std::filesystem::create_symlink("/dev/full", folder / "full.ply");
  checkFailure(run(folder / "full.ply"), 4, "full.ply");
  CHECK_EQ(folder.names(), Names{"cube.off", "full.ply"});
  if (geteuid() == 0) return;  // root may write everywhere.
  std::filesystem::create_directory(folder / "locked");
  std::filesystem::permissions(folder / "locked", std::filesystem::perms::owner_read);
  checkFailure(run(folder / "locked/out.ply"), 4, "locked");
}

TEST_CASE("a check that passes ends with 0, one without any traced face with 5") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(16));
  for (const char* check : {"--check", "--check=50", "--check=all"}) {
    const ChildOutcome outcome =
        runAsdf({check, mesh, "--seeds", "50%", "--backend", "vulkan", "--verbose"}, *lavapipe);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 0);
    CHECK(outcome.error.find("\n  check     100 % of ") != std::string::npos);
    CHECK(outcome.error.find(" % of the range on average, against the reference; ") != std::string::npos);
  }
  CHECK_EQ(runAsdf({mesh, "--seeds", "1", "--check=5", "--backend", "vulkan"}, *lavapipe).exitCode, 0);
  CHECK_EQ(folder.names(), Names{"sphere.asdf.ply", "sphere.off"});

  const std::string flat = folder.write("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  checkFailure(runAsdf({flat, "--check", "--backend", "vulkan", "--quiet"}, *lavapipe), 5, "nothing was compared");
}

TEST_CASE("a check of the reference by itself compares nothing, reports that, and ends with 0") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(16));
  for (const bool isVerbose : {false, true}) {
    Names arguments{mesh, "--check", "--backend", "reference", "--seeds", "10%"};
    if (isVerbose) arguments.emplace_back("--verbose");
    const ChildOutcome outcome = runAsdf(arguments);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 0);
    CHECK(outcome.error.find("nothing to compare") != std::string::npos);
    CHECK(outcome.error.find(" average") != std::string::npos);
    CHECK(outcome.error.find("100 %") == std::string::npos);
  }
}

TEST_CASE("--quiet prints nothing without an error") {
  const ScratchFolder folder;
  // Open, and thus with a warning.
  const std::string mesh = folder.write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const ChildOutcome loud = runAsdf({mesh, "--backend", "reference"});
  CHECK(loud.error.find("asdf-vk: warning: " + mesh + ": ") != std::string::npos);
  const ChildOutcome quiet = runAsdf({mesh, "--backend", "reference", "--quiet"});
  CHECK_EQ(quiet.exitCode, 0);
  CHECK(quiet.output.empty());
  CHECK(quiet.error.empty());
}

}  // namespace
}  // namespace asdfvk::test
