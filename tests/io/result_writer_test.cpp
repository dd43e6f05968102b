#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "written_file.h"

using namespace asdfvk;

namespace {

const std::vector<double> kFaceValues{1, 2, 3, 4};
const std::vector<uint8_t> kFaceSeeds{1, 0, 0, 1};

}  // namespace

TEST_CASE("the format is told by the extension in any case, or by the options before it") {
  CHECK(resultFormatOf("a.ply") == ResultFormat::Ply);
  CHECK(resultFormatOf("a.b.VTU") == ResultFormat::Vtu);
  CHECK(resultFormatOf("dir.csv/a.NpY") == ResultFormat::Npy);
  CHECK(resultFormatOf("a.ply", {.ascii = false, .format = ResultFormat::Csv}) == ResultFormat::Csv);
  CHECK(resultFormatNamed("csv") == ResultFormat::Csv);
  CHECK(resultFormatNamed(".PLY") == ResultFormat::Ply);
}

TEST_CASE("a format that nothing tells is a usage error") {
  for (const char* path : {"a.obj", "a", "ply", ".ply", "", "-", "a.ply.gz"}) {
    CAPTURE(path);
    try {
      (void)resultFormatOf(path);
      FAIL("no error");
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::Usage);
      CHECK(std::string(error.what()).find("npy") != std::string::npos);
    }
  }
  CHECK_THROWS_AS((void)resultFormatNamed("obj"), Error);
}

TEST_CASE("a minus sign writes the named format to standard output") {
  const Folder folder;
  const int saved = ::dup(STDOUT_FILENO);
  const int file = ::open((folder / "stdout").c_str(), O_WRONLY | O_CREAT, 0600);
  ::dup2(file, STDOUT_FILENO);
  writeResult("-", tetrahedron(), {kFaceValues, kFaceSeeds}, {.ascii = false, .format = ResultFormat::Csv});
  ::dup2(saved, STDOUT_FILENO);
  ::close(file);
  ::close(saved);
  CHECK(contentOf(folder / "stdout") == "face,sdf,seed\n0,1,1\n1,2,0\n2,3,0\n3,4,1\n");
  CHECK(!std::filesystem::exists("-"));
}

TEST_CASE("values that do not match the faces are a programmer's mistake, found before anything is written") {
  const Folder folder;
  const std::vector<double> few{1, 2, 3};
  CHECK_THROWS_AS(writeResult(folder / "a.ply", tetrahedron(), {few, kFaceSeeds}), CheckFailure);
  CHECK(folder.names().empty());
}

TEST_CASE("an empty mesh is written in every format") {
  for (const char* extension : {".ply", ".vtu", ".npy", ".csv"}) CHECK(!written(extension, Mesh{}, {}, {}).empty());
  CHECK(written(".csv", Mesh{}, {}, {}) == "face,sdf,seed\n");
}
