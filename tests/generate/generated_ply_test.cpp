#include <doctest/doctest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "generate/generated_shape.h"
#include "generate/shapes.h"

using namespace asdfvk;

TEST_CASE("a generated PLY has list, diameter and part per face, and vertices as float or double") {
  const GeneratedShape shape = makeAnimal(500);
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("asdfvk-generated-" + std::to_string(::getpid()) + ".ply");
  for (const bool isDouble : {false, true}) {
    writeGeneratedPly(path, shape, isDouble);
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    CHECK(text.find(isDouble ? "property double x\n" : "property float x\n") != std::string::npos);
    CHECK(
        text.find("property list uchar int vertex_indices\nproperty float diameter\nproperty int part\nend_header\n") !=
        std::string::npos);
    const size_t scalar = isDouble ? 8 : 4, row = 1 + 12 + 4 + 4;
    size_t at = text.find("end_header\n") + 11;
    REQUIRE(text.size() == at + 3 * scalar * shape.mesh.vertices.size() + row * shape.mesh.faces.size());
    if (isDouble)
      CHECK(std::memcmp(text.data() + at, shape.mesh.vertices.data(), 24 * shape.mesh.vertices.size()) == 0);
    at += 3 * scalar * shape.mesh.vertices.size();
    for (size_t f = 0; f < shape.mesh.faces.size(); ++f, at += row) {
      REQUIRE(text[at] == 3);
      REQUIRE(std::memcmp(text.data() + at + 1, shape.mesh.faces[f].data(), 12) == 0);
      REQUIRE(std::memcmp(text.data() + at + 13, &shape.diameter[f], 4) == 0);
      REQUIRE(std::memcmp(text.data() + at + 17, &shape.part[f], 4) == 0);
    }
  }
  std::filesystem::remove(path);
}
