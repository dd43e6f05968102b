// Readers and writers process rows in blocks by all threads: the number of threads and the sizes of the blocks must not
// change files, meshes or messages.
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "core/parallel.h"
#include "io/corner_welder.h"
#include "reading.h"
#include "written_file.h"

using namespace asdfvk;
using namespace asdfvk::test;

namespace {

constexpr uint32_t kReadBlock = kItemsPerTask, kStlBlock = 1 << 15, kWriteBlock = 8192;

/// Calls make() with 1, 2 and 16 threads, checks that the results are equal, and returns the result.
template <typename Make>
auto sameOnAnyThreads(const Make& make) {
  const auto makeWith = [&](uint32_t threadCount) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threadCount);
    decltype(make()) made;
    callWithThreads(threadCount, [&] { made = make(); });
    return made;
  };
  const auto made = makeWith(1);
  CHECK(makeWith(2) == made);
  CHECK(makeWith(16) == made);
  return made;
}

/// Arrays of a mesh.
using Arrays = std::tuple<std::vector<Vec3d>, std::vector<Face>, std::vector<uint64_t>, std::vector<uint32_t>,
                          std::vector<std::string>>;
Arrays arraysOf(const Mesh& mesh) {
  return {mesh.vertices, mesh.faces, mesh.polygons.firstCorner, mesh.polygons.corners, mesh.skipped};
}
Arrays readOnAnyThreads(const char* format, const std::string& bytes) {
  return sameOnAnyThreads([&] { return arraysOf(parse(format, bytes)); });
}

/// Triangles over `faceCount` + 2 vertices; the face `polygon` has `cornerCount` corners.
Mesh strip(uint32_t faceCount, uint32_t polygon = UINT32_MAX, uint32_t cornerCount = 3) {
  std::string text = "OFF\n" + std::to_string(faceCount + 2) + " " + std::to_string(faceCount) + " 0\n";
  for (uint32_t v = 0; v < faceCount + 2; ++v)
    text += std::to_string(0.25 * v) + " " + std::to_string(v % 2) + " " + std::to_string(v % 3) + "\n";
  for (uint32_t f = 0; f < faceCount; ++f) {
    const uint32_t count = f == polygon ? cornerCount : 3;
    text += std::to_string(count);
    for (uint32_t i = 0; i < count; ++i) text += " " + std::to_string((f + i) % (faceCount + 2));
    text += "\n";
  }
  return parse("off", text);
}

/// Face and vertex fields of every type.
std::vector<Field> fieldsOn(const Mesh& mesh) {
  std::vector<double> sdf, centre, ofVertices;
  std::vector<uint32_t> segment;
  std::vector<uint8_t> seed;
  for (uint32_t f = 0; f < mesh.inputFaceCount(); ++f) {
    sdf.push_back(f % 7 == 3 ? kNoValue : 1.0 / (f + 1));
    segment.push_back(f / 5000);
    seed.push_back(f % 11 == 0 ? 1 : 0);
    for (int axis = 0; axis < 3; ++axis) centre.push_back(0.1 * f + axis);
  }
  for (uint32_t v = 0; v < mesh.vertices.size(); ++v) ofVertices.push_back(std::sqrt(v));
  return {makeField("sdf", sdf), makeField("seed", seed), makeField("segment", segment),
          makeField("centre", centre, FieldLocation::PerFace, 3),
          makeField("sdf", ofVertices, FieldLocation::PerVertex)};
}

std::string plyOf(const Mesh& mesh) { return written(".ply", mesh, {}); }

template <typename T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string stlOf(const std::vector<std::array<Vec3f, 3>>& triangles) {
  std::string bytes(80, '\0');
  append(bytes, static_cast<uint32_t>(triangles.size()));
  for (const auto& corners : triangles) {
    append(bytes, Vec3f{});
    append(bytes, corners);
    append(bytes, uint16_t{0});
  }
  return bytes;
}

}  // namespace

TEST_CASE("files have the same bytes on any number of threads, for counts around the size of a block") {
  for (const uint32_t faceCount : {1u, kWriteBlock - 2, kWriteBlock, 2 * kWriteBlock + 1}) {
    const Mesh mesh = strip(faceCount);
    const std::vector<Field> fields = fieldsOn(mesh), ofFaces(fields.begin(), fields.end() - 1);
    CAPTURE(faceCount);
    for (const char* extension : {".ply", ".npz", ".npy", ".obj"}) {
      CAPTURE(extension);
      sameOnAnyThreads([&] { return written(extension, mesh, fields); });
    }
    sameOnAnyThreads([&] { return written(".ply", mesh, fields, {.ascii = true}); });
    const std::string csv = sameOnAnyThreads([&] { return written(".csv", mesh, ofFaces); });
    CHECK(std::count(csv.begin(), csv.end(), '\n') == faceCount + 1);
    CHECK(arraysOf(parse("ply", plyOf(mesh))) == arraysOf(mesh));
  }
}

TEST_CASE("a polygon of more corners than a buffer has bytes is written in order") {
  const Mesh mesh = strip(kWriteBlock + 10, kWriteBlock - 1, kWriteBlock);
  const std::string bytes = sameOnAnyThreads([&] { return plyOf(mesh); });
  CHECK(readOnAnyThreads("ply", bytes) == arraysOf(mesh));
}

TEST_CASE("a PLY of triangles, also with another face, gives its mesh on any number of threads") {
  for (const uint32_t faceCount : {kReadBlock - 1, kReadBlock, kReadBlock + 1, 3 * kReadBlock + 7})
    for (const uint32_t polygon : {UINT32_MAX, 0u, 1u, kReadBlock - 1, kReadBlock, faceCount - 1})
      for (const uint32_t cornerCount : {2u, 4u}) {
        CAPTURE(faceCount);
        CAPTURE(polygon);
        const Mesh mesh = strip(faceCount, polygon, cornerCount);
        CHECK(readOnAnyThreads("ply", plyOf(mesh)) == arraysOf(mesh));
      }
}

TEST_CASE("the first error of a PLY in several blocks is reported, on any number of threads") {
  const uint32_t faceCount = 3 * kReadBlock;
  const std::string ply = plyOf(strip(faceCount));
  constexpr size_t kRowSize = 1 + 3 * sizeof(int32_t);
  const size_t firstRow = ply.size() - faceCount * kRowSize;
  const auto errorOnAnyThreads = [](const std::string& bytes) {
    return sameOnAnyThreads([&] { return errorOf("ply", bytes); });
  };
  std::string wrong = ply;
  for (const size_t row : {size_t{faceCount} - 1, size_t{kReadBlock} + 5, size_t{kReadBlock} - 1}) {
    const size_t at = firstRow + row * kRowSize + 1 + sizeof(int32_t);
    wrong.replace(at, sizeof(int32_t), 4, '\x7f');
    CHECK(errorOnAnyThreads(wrong) ==
          "byte " + std::to_string(at) + ": vertex index 2139062143 is out of range; the mesh has 12,290 vertices");
  }
  const auto errorWithout = [&](size_t missing) { return errorOnAnyThreads(ply.substr(0, ply.size() - missing)); };
  CHECK(errorWithout(1) == "byte " + std::to_string(ply.size() - kRowSize) +
                               ": a list of length 3 does not fit into the remaining 11 bytes; the file is truncated "
                               "or the length is wrong");
  for (const size_t missing : {size_t{kRowSize}, size_t{kReadBlock} * kRowSize})
    CHECK(errorWithout(missing) == "byte " + std::to_string(ply.size() - missing) +
                                       ": the file ends where the length of a list is expected; it is truncated; copy "
                                       "or export it again");
  std::string longList = ply;  // The file ends within the last row.
  longList[firstRow + 2 * kReadBlock * kRowSize] = 5;
  CHECK(errorOnAnyThreads(longList) != "no error");
}

TEST_CASE("an STL has the vertices that a CornerWelder makes, on any number of threads") {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const auto point = [&](uint32_t i) -> Vec3f {
    if (i % 1009 == 0) return {nan, 1, 0};
    if (i % 1013 == 0) return {infinity, i % 2 == 0 ? 0.0f : -0.0f, 1};
    return {static_cast<float>(i % 101), i % 2 == 0 ? 0.0f : -0.0f, -static_cast<float>(i / 7)};
  };
  for (const uint32_t faceCount : {1u, kStlBlock - 1, kStlBlock, 2 * kStlBlock + 1}) {
    std::vector<std::array<Vec3f, 3>> triangles;
    CornerWelder welder(0);
    std::vector<Face> faces;
    for (uint32_t f = 0; f < faceCount; ++f) {
      triangles.push_back({point(f), point(f * 3), point(f / 2 + 1)});
      Face& face = faces.emplace_back();
      for (size_t i = 0; i < 3; ++i) face[i] = welder.indexOf(static_cast<Vec3d>(triangles.back()[i]));
    }
    const std::string stl = stlOf(triangles);
    const auto read = [&] {
      const Mesh mesh = parse("stl", stl);
      std::vector<std::string> bits;  // A NaN does not equal itself.
      for (const Vec3d& p : mesh.vertices) append(bits.emplace_back(), p);
      return std::tuple(bits, mesh.faces);
    };
    const auto [bits, readFaces] = sameOnAnyThreads(read);
    CHECK(readFaces == faces);
    REQUIRE(bits.size() == welder.points().size());
    size_t differentCount = 0;
    for (size_t v = 0; v < bits.size(); ++v)
      differentCount += std::memcmp(bits[v].data(), &welder.points()[v], sizeof(Vec3d)) == 0 ? 0 : 1;
    CHECK(differentCount == 0);
  }
}

TEST_CASE("a file of several blocks is read whole, on any number of threads") {
  const Folder folder;
  const Mesh mesh = strip(200'000);
  const std::filesystem::path path = folder / "strip.ply";
  putContent(path, plyOf(mesh));
  REQUIRE(std::filesystem::file_size(path) > 4 << 20);
  const Arrays read = sameOnAnyThreads([&] { return arraysOf(readMesh(path)); });
  CHECK(read == arraysOf(mesh));
}
