#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <thread>

#include "io/mesh_format.h"
#include "reading.h"

using namespace asdfvk;
using asdfvk::test::holds;

namespace {

/// A new folder that goes with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "asdfvk-readers-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

std::string errorOfReading(const std::filesystem::path& path) {
  try {
    static_cast<void>(readMesh(path));
  } catch (const Error& error) {
    return error.kind() == ErrorKind::Input ? error.what() : "an error of another kind";
  }
  return "no error";
}

std::optional<MeshFormat> detected(std::string_view text, std::string_view extension) {
  return detectFormat(std::span(text.data(), text.size()), extension);
}

constexpr std::string_view kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr std::string_view kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

}  // namespace

TEST_CASE("the content tells the format before the extension does") {
  CHECK(detected("ply\n", "obj") == MeshFormat::Ply);
  CHECK(detected("# c\nSTCNOFF\n", ".stl") == MeshFormat::Off);
  CHECK(detected("solid x\n", "off") == MeshFormat::Stl);
  CHECK(detected(std::string(84, '\0'), "ply") == MeshFormat::Stl);
  CHECK(detected("\xef\xbb\xbfOFF\n", "") == MeshFormat::Off);
  CHECK(detected(kObj, "") == MeshFormat::Obj);
  CHECK(detected("# c\nmtllib a\n", "txt") == MeshFormat::Obj);
  CHECK(detected("3 1 0\n", ".OFF") == MeshFormat::Off);
  CHECK(detected("rubbish", ".Obj") == MeshFormat::Obj);
  CHECK(detected("rubbish", "stl") == MeshFormat::Stl);
  CHECK(!detected("rubbish", "txt"));
  CHECK(!detected("3 1 0\n", ""));
  CHECK(!detected("", ""));
}

TEST_CASE("a mesh is read from a file, whatever its name") {
  const TemporaryFolder folder;
  std::ofstream(folder / "mesh.stl") << kOff;
  CHECK(readMesh(folder / "mesh.stl").faces == std::vector<Face>{{0, 1, 2}});
}

TEST_CASE("a mesh is read from a pipe") {
  const TemporaryFolder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  // Longer than a pipe holds, so that it comes in pieces.
  std::string text(kObj);
  for (int i = 0; i < 20000; ++i) text += "f 1 2 3\n";
  std::thread writer([&] { std::ofstream(folder / "pipe") << text; });
  const Mesh mesh = readMesh(folder / "pipe");
  writer.join();
  CHECK(mesh.faces.size() == 20001);
}

TEST_CASE("'-' and /dev/stdin are standard input") {
  const TemporaryFolder folder;
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

TEST_CASE("what cannot be read is named with the reason") {
  const TemporaryFolder folder;
  CHECK(holds(errorOfReading(folder / "missing.ply"), "missing.ply: cannot be opened: No such file"));
  CHECK(holds(errorOfReading(folder / ""), "is a directory"));
  CHECK(holds(errorOfReading("/dev/zero"), "/dev/zero: is a device"));
  std::ofstream(folder / "empty.off").flush();
  CHECK(holds(errorOfReading(folder / "empty.off"), "empty.off: is empty"));
  std::ofstream(folder / "letter.txt") << "Dear reader,\n";
  CHECK(holds(errorOfReading(folder / "letter.txt"), "in no format that can be read here"));
  std::ofstream(folder / "bad.obj") << "v 0 0 0\nf 1 2 3\n";
  CHECK(holds(errorOfReading(folder / "bad.obj"), "bad.obj: line 2: vertex index 3"));
}
