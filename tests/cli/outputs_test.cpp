#include "cli/outputs.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "asdf_vk/error.h"
#include "cli/command_line.h"
#include "cli/scratch_folder.h"

namespace asdfvk {
namespace {

/// The outputs of the meshes of a command line.
std::vector<std::string> plannedOutputs(const CommandLine& line) {
  std::vector<InputFile> inputs;
  for (const std::string& mesh : line.meshes) inputs.push_back({.path = mesh});
  return planOutputs(line.outputs, line.batch, inputs);
}

CommandLine lineOf(std::vector<std::string> meshes, const std::string& output = "", const std::string& format = "") {
  CommandLine line;
  line.meshes = std::move(meshes);
  line.outputs.path = output;
  line.outputs.format = format;
  return line;
}

using Names = std::vector<std::string>;

TEST_CASE("a result lies beside its mesh by default") {
  CHECK_EQ(plannedOutputs(lineOf({"dir/horse.off"})), Names{"dir/horse.asdf.ply"});
  CHECK_EQ(plannedOutputs(lineOf({"horse"})), Names{"horse.asdf.ply"});
  CHECK_EQ(plannedOutputs(lineOf({"a.b.obj"}, "", "vtu")), Names{"a.b.asdf.vtu"});
  CHECK_EQ(plannedOutputs(lineOf({"x/a.ply", "y/a.ply"})), Names{"x/a.asdf.ply", "y/a.asdf.ply"});
  CHECK_EQ(plannedOutputs(lineOf({"a.ply"}, "out.CSV")), Names{"out.CSV"});
  CHECK_EQ(plannedOutputs(lineOf({"-"}, "-")), Names{"-"});
  CHECK_EQ(plannedOutputs(lineOf({"a.ply"}, "/dev/null", "npy")), Names{"/dev/null"});
}

TEST_CASE("a directory receives the results of all meshes") {
  const test::ScratchFolder folder;
  CHECK_EQ(plannedOutputs(lineOf({"x/a.ply", "-"}, folder / "", "npy")),
           Names{folder / "a.asdf.npy", folder / "stdin.asdf.npy"});
}

TEST_CASE("outputs that contradict each other are usage errors") {
  const auto isRefused = [](const CommandLine& line) {
    try {
      (void)plannedOutputs(line);
    } catch (const Error& error) {
      return error.kind() == ErrorKind::Usage;
    }
    return false;
  };
  CHECK(isRefused(lineOf({"-"})));
  CHECK(isRefused(lineOf({"a.ply", "b.ply"}, "-")));
  CHECK(isRefused(lineOf({"a.ply", "b.ply"}, "out.ply")));
  CHECK(isRefused(lineOf({"a.ply", "a.obj"})));
  CHECK(isRefused(lineOf({"a.ply", "./a.ply"})));
  CHECK(isRefused(lineOf({"a.ply"}, "out.xyz")));
  CHECK(isRefused(lineOf({"a.ply"}, "out")));
  CHECK(isRefused(lineOf({"a.ply"}, "out.vtu", "ply")));
  CHECK(isRefused(lineOf({"a.ply"}, "x/../a.ply")));
  CHECK(isRefused(lineOf({"a.ply", "a.asdf.ply"})));
  const auto withPicture = [](CommandLine line, const std::string& picture) {
    line.outputs.picture = picture;
    return line;
  };
  CHECK(isRefused(withPicture(lineOf({"a.png"}, "out.ply"), "x/../a.png")));
  CHECK(isRefused(withPicture(lineOf({"a.ply"}, "out.png", "ply"), "out.png")));
  CHECK_FALSE(isRefused(withPicture(lineOf({"a.ply"}, "out.ply"), "out.png")));
  CHECK_FALSE(isRefused(withPicture(lineOf({"a.ply"}, "out.ply"), "-")));
  const auto withPoints = [](CommandLine line, const std::string& points) {
    line.outputs.points = points;
    return line;
  };
  CHECK(isRefused(withPoints(lineOf({"a.ply"}, "out.ply"), "x/../out.ply")));
  CHECK(isRefused(withPoints(lineOf({"a.ply"}, "out.ply"), "a.ply")));
  CHECK(isRefused(withPoints(lineOf({"a.ply"}), "a.asdf.ply")));
  CHECK_FALSE(isRefused(withPoints(lineOf({"a.ply"}, "out.ply"), "points.ply")));
  CHECK_FALSE(isRefused(withPoints(lineOf({"a.ply"}, "out.ply"), "-")));
  CHECK(isRefused(withPoints(withPicture(lineOf({"a.ply"}), "b"), "b")));
  CommandLine ascii = lineOf({"a.ply"}, "out.csv");
  ascii.outputs.ascii = true;
  CHECK(isRefused(ascii));
}

TEST_CASE("a format of rows per face or per vertex holds the vertex fields where there are any") {
  const std::vector<Field> fields{{.name = "a"}, {.name = "b"}, {.name = "a", .location = FieldLocation::PerVertex}};
  const auto writable = [&](const char* output, PerElement per) { return writableFields({}, per, output, fields); };
  CHECK_EQ(writable("out.csv", PerElement::Faces).size(), 3);
  for (const char* whole : {"out.ply", "out.vtu", "out.npz"}) CHECK_EQ(writable(whole, PerElement::Vertices).size(), 3);
  for (const char* one : {"out.csv", "out.npy"}) {
    REQUIRE_EQ(writable(one, PerElement::Vertices).size(), 1);
    CHECK_EQ(&writable(one, PerElement::Vertices)[0], &fields[2]);
  }
}

TEST_CASE("thousands of meshes are planned with a few file operations for each") {
  const test::ScratchFolder folder;
  Names meshes;
  for (int i = 0; i < 5000; ++i) meshes.push_back(folder / fmt::format("mesh{}.off", i));
  meshes.push_back(folder.write("other.off", ""));
  CHECK_EQ(plannedOutputs(lineOf(meshes)).size(), 5001);
  // Only the files themselves show that this result is an input.
  std::filesystem::create_hard_link(folder / "other.off", folder / "mesh4999.asdf.ply");
  CHECK_THROWS_AS((void)plannedOutputs(lineOf(meshes)), Error);
}

TEST_CASE("a device can be written to without permission for its folder") {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    if (geteuid() == 0 && setuid(65534) != 0) _exit(2);
    try {
      requireWritablePlace("/dev/null");
    } catch (...) {
      _exit(1);
    }
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK_EQ(WEXITSTATUS(status), 0);
}

TEST_CASE("the results of a tree lie in the same tree, whose folders need not exist") {
  const test::ScratchFolder folder;
  CommandLine line = lineOf({}, folder / "new", "npy");
  line.batch.recurses = true;
  const std::vector<InputFile> inputs{{.path = "in/a.off"}, {.path = "in/b/c.ply", .folder = "b"}};
  CHECK_EQ(planOutputs(line.outputs, line.batch, inputs),
           Names{folder / "new/a.asdf.npy", folder / "new/b/c.asdf.npy"});
  line.outputs.path.clear();
  CHECK_EQ(planOutputs(line.outputs, line.batch, inputs), Names{"in/a.asdf.npy", "in/b/c.asdf.npy"});
  const std::vector<InputFile> colliding{{.path = "x/a.off"}, {.path = "x/a.ply"}};
  CHECK_THROWS_WITH_AS(
      (void)planOutputs(line.outputs, line.batch, colliding),
      "x/a.off and x/a.ply would both be written to x/a.asdf.npy; rename one of the two, or compute it in "
      "a separate call with another -o",
      Error);
  const std::vector<InputFile> twice{{.path = "x/a.off"}, {.path = "x/../x/a.off"}};
  CHECK_THROWS_WITH_AS((void)planOutputs(line.outputs, line.batch, twice), "x/../x/a.off is named twice; name it once",
                       Error);
  line.outputs.path = folder.write("file", "x");
  CHECK_THROWS_AS((void)planOutputs(line.outputs, line.batch, inputs), Error);
  line.outputs.path = folder / "new.npy";  // The name of a result, not of a folder.
  CHECK_THROWS_AS((void)planOutputs(line.outputs, line.batch, inputs), Error);
  line.outputs.path = folder / "new";
  line.batch.log = "in/a.off";
  CHECK_THROWS_AS((void)planOutputs(line.outputs, line.batch, inputs), Error);
  for (const char* log : {"new/b/c.asdf.npy", "new/x/../a.asdf.npy", "new/a.asdf.npy.json"}) {
    line.batch.log = folder / log;
    CHECK_THROWS_AS((void)planOutputs(line.outputs, line.batch, inputs), Error);
  }
  line.batch.log = "list";
  CHECK_NOTHROW((void)planOutputs(line.outputs, line.batch, inputs));
  line.batch.list = "./list";
  CHECK_THROWS_AS((void)planOutputs(line.outputs, line.batch, inputs), Error);
}

TEST_CASE("a key replaces the file name in the name of a result, and its folders are made below -o only") {
  const test::ScratchFolder folder;
  CommandLine line = lineOf({}, folder / "new", "npy");
  line.batch.list = "list";
  const InputFile named{.path = "in/a.off", .key = "v1.2"}, nested{.path = "in/b.ply", .folder = "x/y", .key = "x/y/z"};
  CHECK_EQ(planOutputs(line.outputs, line.batch, std::vector{named, nested}),
           Names{folder / "new/v1.2.asdf.npy", folder / "new/x/y/z.asdf.npy"});
  const std::vector<InputFile> colliding{{.path = "in/a.off"}, {.path = "in/b.off", .key = "a"}};
  CHECK_THROWS_AS((void)planOutputs(line.outputs, line.batch, colliding), Error);
  const std::vector<InputFile> twice{{.path = "in/a.off", .key = "a1"}, {.path = "in/a.off", .key = "a2"}};
  CHECK_EQ(planOutputs(line.outputs, line.batch, twice), Names{folder / "new/a1.asdf.npy", folder / "new/a2.asdf.npy"});
  line.outputs.path.clear();
  CHECK_EQ(planOutputs(line.outputs, line.batch, std::vector{named}), Names{"in/v1.2.asdf.npy"});
  CHECK_THROWS_WITH_AS((void)planOutputs(line.outputs, line.batch, std::vector{nested}),
                       "the key x/y/z of in/b.ply has a folder, which is made below -o; give -o FOLDER", Error);
  line.outputs.writesResult = false;
  CHECK_NOTHROW((void)planOutputs(line.outputs, line.batch, std::vector{nested}));
}

TEST_CASE("a folder of pictures has the tree and the names of the results") {
  Outputs outputs;
  CHECK_EQ(pictureFileOf({.path = "in/a.off"}, outputs), "");
  outputs.picture = "a.png";
  CHECK_EQ(pictureFileOf({.path = "in/a.off"}, outputs), "a.png");
  outputs.picture = "shown/";
  CHECK_EQ(pictureFileOf({.path = "in/b/a.off", .folder = "b"}, outputs), "shown/b/a.asdf.png");
  CHECK_EQ(pictureFileOf({.path = "in/a.off", .folder = "x", .key = "x/v1.2"}, outputs), "shown/x/v1.2.asdf.png");
  const std::vector<InputFile> colliding{{.path = "x/a.off"}, {.path = "x/a.ply"}};
  outputs.writesResult = false;
  CHECK_THROWS_WITH_AS((void)planOutputs(outputs, {.recurses = true}, colliding),
                       "shown/a.asdf.png is the picture of x/a.off and would be overwritten by the picture of x/a.ply; "
                       "choose another --picture",
                       Error);
}

TEST_CASE("an impossible place for a file is an error before the work") {
  const test::ScratchFolder folder;
  CHECK_NOTHROW(requireWritablePlace(folder / "new.ply"));
  CHECK_NOTHROW(requireWritablePlace(folder.write("old.ply", "x")));
  CHECK_NOTHROW(requireWritablePlace("-"));
  CHECK_THROWS_AS(requireWritablePlace(folder / "missing/new.ply"), Error);
  CHECK_THROWS_AS(requireWritablePlace(folder / "old.ply/new.ply"), Error);
  CHECK_THROWS_AS(requireWritablePlace(folder / ""), Error);
}

}  // namespace
}  // namespace asdfvk
