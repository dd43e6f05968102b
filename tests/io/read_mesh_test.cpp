#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <thread>

#include "reading.h"
#include "written_file.h"

using namespace asdfvk;
using asdfvk::test::holds;

namespace {

std::string errorOfReading(const std::filesystem::path& path) {
  try {
    static_cast<void>(readMesh(path));
  } catch (const Error& error) {
    return error.kind() == ErrorKind::Input ? error.what() : "an error of another kind";
  }
  return "no error";
}

/// The name of the detected format; empty for none.
std::string_view detected(std::string_view text, std::string_view extension) {
  const FileFormat* const format = detectFormat(std::span(text.data(), text.size()), extension);
  return format == nullptr ? "" : format->name;
}

constexpr std::string_view kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr std::string_view kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

}  // namespace

TEST_CASE("a file of results without a mesh that is read is an error that names its format") {
  const Folder folder;
  writeResult(folder / "out.vtu", tetrahedron(), {});
  CHECK(holds(errorOfReading(folder / "out.vtu"), "out.vtu: has the format vtu; meshes are read from stl, ply"));
}

TEST_CASE("the content decides the format, then the extension, then a possible keyword") {
  CHECK(detected("ply\n", "obj") == "ply");
  CHECK(detected("# c\nSTCNOFF\n", ".stl") == "off");
  CHECK(detected("solid x\n", "off") == "stl");
  CHECK(detected(std::string(84, '\0'), "ply") == "stl");
  CHECK(detected("\xef\xbb\xbfOFF\n", "") == "off");
  CHECK(detected(kObj, "") == "obj");
  CHECK(detected("# c\nmtllib a\n", "txt") == "obj");
  CHECK(detected("# solid\n# ply\n# OFF\n\ng solid ply OFF\n", "") == "obj");
  CHECK(detected("; c\n# v 0 0 0\n// c\nsolid\n", "obj") == "stl");
  CHECK(detected("3 1 0\n", ".OFF") == "off");
  CHECK(detected("rubbish", ".Obj") == "obj");
  CHECK(detected("rubbish", "stl") == "stl");
  CHECK(detected("rubbish", "txt").empty());
  CHECK(detected("3 1 0\n", "").empty());
  CHECK(detected("", "").empty());
}

TEST_CASE("a file with the extension of another format is read by its content") {
  const Folder folder;
  std::ofstream(folder / "mesh.stl") << kOff;
  CHECK(readMesh(folder / "mesh.stl").faces == std::vector<Face>{{0, 1, 2}});
}

TEST_CASE("a mesh is read from a pipe") {
  const Folder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  // Longer than the buffer of a pipe: several reads.
  std::string text(kObj);
  for (int i = 0; i < 20000; ++i) text += "f 1 2 3\n";
  std::thread writer([&] { std::ofstream(folder / "pipe") << text; });
  const Mesh mesh = readMesh(folder / "pipe");
  writer.join();
  CHECK(mesh.faces.size() == 20001);
}

TEST_CASE("'-' and /dev/stdin are standard input") {
  const Folder folder;
  std::ofstream(folder / "mesh") << kOff;
  for (const char* name : {"-", "/dev/stdin"}) {
    CAPTURE(name);
    const int saved = ::dup(STDIN_FILENO);
    REQUIRE(std::freopen((folder / "mesh").c_str(), "r", stdin) != nullptr);
    CHECK(readMesh(name).faces == std::vector<Face>{{0, 1, 2}});
    ::dup2(saved, STDIN_FILENO);
    ::close(saved);
  }
}

TEST_CASE("errors name the file and the reason") {
  const Folder folder;
  CHECK(holds(errorOfReading(folder / "missing.ply"), "missing.ply: cannot be opened: No such file"));
  CHECK(holds(errorOfReading(folder / ""), "is a directory"));
  CHECK(holds(errorOfReading("/dev/zero"), "/dev/zero: is a device"));
  std::ofstream(folder / "empty.off").flush();
  CHECK(holds(errorOfReading(folder / "empty.off"), "empty.off: is empty"));
  std::ofstream(folder / "letter.txt") << "Dear reader,\n";
  CHECK(holds(errorOfReading(folder / "letter.txt"),
              "has an unknown format; meshes are read from stl, ply, off, obj, glb, 3mf or step"));
  std::ofstream(folder / "bad.obj") << "v 0 0 0\nf 1 2 3\n";
  CHECK(holds(errorOfReading(folder / "bad.obj"), "bad.obj: line 2: vertex index 3"));
}

TEST_CASE("more vertices than 32 bits can index are an error of their own") {
  try {
    static_cast<void>(
        parseMesh(std::string_view("ply\nformat binary_little_endian 1.0\nelement vertex 4294967296\n"
                                   "property float x\nproperty float y\nproperty float z\n"
                                   "element face 1\nproperty list uchar int vertex_indices\n"
                                   "end_header\n")));
    FAIL_CHECK("no error");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::MeshTooLarge);
    CHECK(holds(error.what(), "4294967296 vertices; at most 4294967295"));
  }
}

TEST_CASE("a mesh with more faces than allowed is refused with the limit, the format is given for ambiguous bytes") {
  std::string text = "# no keyword\n";
  for (const char* const vertex : {"v 0 0 0\n", "v 1 0 0\n", "v 0 1 0\n"}) text += vertex;
  for (int i = 0; i < 3; ++i) text += "f 1 2 3\n";
  CHECK(parseMesh(text, {.maxFaces = 3, .format = "obj"}).faces.size() == 3);
  CHECK(parseMesh(text, {.format = ".OBJ"}).faces.size() == 3);
  try {
    static_cast<void>(parseMesh(text, {.maxFaces = 2, .format = "obj"}));
    FAIL("no limit");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::TooManyFaces);
    CHECK(std::string_view(error.what()) == "has 3 faces; the limit is 2");
  }
}
