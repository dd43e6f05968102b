#include "io/object_names.h"

#include <doctest/doctest.h>

#include "io/assembled_mesh.h"
#include "reading.h"

using namespace asdfvk;
using asdfvk::test::parse;

namespace {

using Objects = std::vector<NamedFaces>;

}  // namespace

TEST_CASE("a name of an object is one line of valid UTF-8 of limited size") {
  CHECK(objectName("Left arm") == "Left arm");
  CHECK(objectName(" \t a\tb\x01 c\x7f\r ") == "a b  c");
  CHECK(objectName("") == "");
  CHECK(objectName(" \n") == "");
  CHECK(objectName("Geh\xc3\xa4use \xe2\x82\xac \xf0\x9f\x94\xa9") == "Geh\xc3\xa4use \xe2\x82\xac \xf0\x9f\x94\xa9");
  CHECK(objectName("Geh\xe4use") == "Geh\xef\xbf\xbduse");
  CHECK(objectName("a\xc2\x9b\x31m") == "a 1m");  // A control sequence of a terminal.
  CHECK(objectName(std::string(300, 'x')) == std::string(200, 'x'));
  CHECK(objectName(std::string(199, 'x') + "\xc3\xa4") == std::string(199, 'x'));
  CHECK(objectName(std::string(198, 'x') + "\xc3\xa4z") == std::string(198, 'x') + "\xc3\xa4");
}

TEST_CASE("objects have faces and different names") {
  ObjectNames names;
  names.begin(0, "");
  CHECK(names.isEmpty());
  names.begin(2, "a");
  names.begin(4, "b");  // Without faces.
  names.begin(4, " a ");
  names.begin(6, "");
  names.begin(7, "b");
  names.begin(9, "c");
  CHECK(names.byteCount() == 4 * sizeof(NamedFaces) + 3);
  CHECK(names.finish(9) == Objects{{2, "a"}, {6, ""}, {7, "b"}});
  CHECK(names.isEmpty());
  CHECK(names.byteCount() == 0);
}

TEST_CASE("the name of a face is that of the last object that begins at or before it") {
  Mesh mesh;
  CHECK(objectNameOf(mesh.objects, 0).empty());
  mesh.objects = {{2, "a"}, {6, ""}, {7, "b"}};
  std::string found;
  for (uint64_t face = 0; face < 9; ++face)
    found += objectNameOf(mesh.objects, face).empty() ? "-" : objectNameOf(mesh.objects, face);
  CHECK(found == "--aaaa-bb");
}

TEST_CASE("a million objects of OBJ have a million names") {
  std::string text = asdfvk::test::squareCorners("v ");
  constexpr uint32_t kCount = 1'000'000;
  for (uint32_t i = 0; i < kCount; ++i) text += "o " + std::to_string(i) + "\nf 1 2 3\n";
  const Mesh mesh = parse("obj", text);
  REQUIRE(mesh.objects.size() == kCount);
  CHECK(objectNameOf(mesh.objects, 123'456) == "123456");
}

TEST_CASE("the names of instances count for the memory limit") {
  const std::string bytes = "x";
  const MeshSource source{.bytes = std::span(bytes.data(), bytes.size()), .options = {.maxFaces = 100'000'000}};
  AssembledMesh assembled(0, (kMaxInstanceBytes - 1000) / sizeof(Face), source);
  const PartMesh part{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}};
  const std::string name(kMaxObjectNameSize, 'x');
  for (int i = 0; i < 4; ++i) assembled.add(part, {}, name + "1");  // Consecutive equal names count once.
  for (int i = 0; i < 3; ++i) assembled.add(part, {}, std::to_string(i) + name);
  try {
    assembled.add(part, {}, "y" + name);
    FAIL_CHECK("no error");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::InputTooLarge);
  }
}
