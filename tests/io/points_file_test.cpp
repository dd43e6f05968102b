#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>

#include "asdf_vk/error.h"
#include "core/random.h"
#include "core/vec3.h"
#include "support/require_failure.h"
#include "support/stopped_control.h"
#include "written_file.h"

using namespace asdfvk;

namespace {

/// Three faces: two with values and the parts 7 and 9, and one without.
std::vector<Field> pointFields() {
  return {makeField("sdf", std::vector<double>{1, kNoValue, 3}),
          makeField("centre", std::vector<double>{0.5, 1, 2, kNoValue, kNoValue, kNoValue, 3, -4, 5},
                    FieldLocation::PerFace, 3)};
}

std::string pointsOf(const std::vector<Field>& fields) {
  const Folder folder;
  writePoints(folder / "points.ply", fields);
  CHECK(folder.names() == std::vector<std::string>{"points.ply"});
  return contentOf(folder / "points.ply");
}

template <typename T>
T numberAt(const std::string& bytes, size_t at) {
  REQUIRE(at + sizeof(T) <= bytes.size());
  T number;
  std::memcpy(&number, bytes.data() + at, sizeof(T));
  return number;
}

std::string bodyOf(const std::string& ply) {
  const std::string end = "end_header\n";
  return ply.substr(ply.find(end) + end.size());
}

ErrorCode codeOf(const std::vector<Field>& fields, const std::string& path = "/dev/null") {
  try {
    writePoints(path, fields);
  } catch (const Error& error) {
    return error.code();
  }
  FAIL("no error");
  return ErrorCode::Cancelled;
}

}  // namespace

TEST_CASE("points have a place and a radius, and only faces with a value have a point") {
  const std::string ply = pointsOf(pointFields());
  CHECK(ply.starts_with("ply\nformat binary_little_endian 1.0\ncomment "));
  CHECK(ply.find("element vertex 2\nproperty double x\nproperty double y\nproperty double z\nproperty float radius\n"
                 "end_header\n") != std::string::npos);
  const std::string body = bodyOf(ply);
  REQUIRE(body.size() == 2 * 28);
  const std::vector<double> expected{0.5, 1, 2, 3, -4, 5};
  for (size_t i = 0; i < expected.size(); ++i) CHECK(numberAt<double>(body, 28 * (i / 3) + 8 * (i % 3)) == expected[i]);
  CHECK(numberAt<float>(body, 24) == 0.5f);
  CHECK(numberAt<float>(body, 52) == 1.5f);
}

TEST_CASE("points of a segmented mesh have their part") {
  std::vector<Field> fields = pointFields();
  fields.push_back(makeField("segment", std::vector<uint32_t>{7, 8, 9}));
  const std::string ply = pointsOf(fields);
  CHECK(ply.find("property float radius\nproperty uint part\nend_header\n") != std::string::npos);
  const std::string body = bodyOf(ply);
  REQUIRE(body.size() == 2 * 32);
  CHECK(numberAt<uint32_t>(body, 28) == 7);
  CHECK(numberAt<uint32_t>(body, 60) == 9);
}

TEST_CASE("fields per vertex are ignored") {
  std::vector<Field> fields = pointFields();
  fields.push_back(makeField("segment", std::vector<uint32_t>{1}, FieldLocation::PerVertex));
  CHECK(pointsOf(fields) == pointsOf(pointFields()));
}

TEST_CASE("no point at all is a file of none") {
  const std::string ply = pointsOf({makeField("sdf", std::vector<double>{kNoValue}),
                                    makeField("centre", std::vector<double>(3, kNoValue), FieldLocation::PerFace, 3)});
  CHECK(ply.find("element vertex 0\n") != std::string::npos);
  CHECK(bodyOf(ply).empty());
}

TEST_CASE("points need the fields centre and sdf of the same faces") {
  const std::vector<Field> fields = pointFields();
  CHECK(codeOf({fields[0]}) == ErrorCode::UnknownField);
  CHECK(codeOf({fields[1]}) == ErrorCode::UnknownField);
  CHECK(codeOf({fields[0], makeField("centre", std::vector<double>(9), FieldLocation::PerVertex, 3)}) ==
        ErrorCode::UnknownField);
  CHECK(codeOf({fields[0], makeField("centre", std::vector<double>(6), FieldLocation::PerFace, 3)}) ==
        ErrorCode::OptionConflict);
  CHECK(codeOf({fields[0], fields[1], makeField("segment", std::vector<uint32_t>(2))}) == ErrorCode::OptionConflict);
  CHECK(codeOf(fields, "/nonexistent/points.ply") == ErrorCode::OutputNotWritable);
}

namespace {

struct SwcLine {
  int64_t id = 0;
  int type = 0;
  Vec3d place;
  double radius = 0;
  int64_t parent = 0;
};

std::vector<SwcLine> swcOf(const std::vector<Field>& fields) {
  const Folder folder;
  writePoints(folder / "points.SWC", fields);
  CHECK(folder.names() == std::vector<std::string>{"points.SWC"});
  std::istringstream text(contentOf(folder / "points.SWC"));
  std::vector<SwcLine> lines;
  bool hasHeader = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with('#')) {
      hasHeader = true;
      CHECK(lines.empty());
      continue;
    }
    std::istringstream words(line);
    SwcLine read;
    words >> read.id >> read.type >> read.place.x >> read.place.y >> read.place.z >> read.radius >> read.parent;
    CHECK(!words.fail());
    CHECK(words.eof());
    lines.push_back(read);
  }
  CHECK(hasHeader);
  return lines;
}

}  // namespace

TEST_CASE("a .swc is a minimum spanning tree for each component, with its thickest point as the root") {
  constexpr size_t kCount = 240;
  Random random(3);
  std::vector<double> centre, sdf;
  std::vector<uint32_t> component;
  for (size_t i = 0; i < kCount; ++i) {
    component.push_back(i % 3 == 1 ? 4 : i % 3 == 2 ? 0xffffffff : 0);
    for (int axis = 0; axis < 3; ++axis) centre.push_back(i % 5 == 0 && axis == 1 ? kNoValue : random.real());
    sdf.push_back(i % 7 == 0 ? 0 : 0.5 + random.real());
  }
  std::vector<Field> fields{makeField("centre", centre, FieldLocation::PerFace, 3), makeField("sdf", sdf),
                            makeField("component", component)};
  const std::vector<SwcLine> lines = swcOf(fields);
  size_t expectedCount = 0;
  std::array<double, 3> greatest{};
  for (size_t i = 0; i < kCount; ++i) {
    if (i % 5 == 0 || i % 7 == 0) continue;
    ++expectedCount;
    greatest[i % 3] = std::max(greatest[i % 3], sdf[i]);
  }
  REQUIRE(lines.size() == expectedCount);
  std::vector<size_t> roots;
  std::vector<double> lengths;
  for (size_t i = 0; i < lines.size(); ++i) {
    const SwcLine& line = lines[i];
    CHECK(line.id == static_cast<int64_t>(i) + 1);
    CHECK(line.type == 0);
    CHECK(line.radius > 0);
    CHECK(line.parent < line.id);
    if (line.parent == -1) {
      CHECK(line.radius == doctest::Approx(greatest[roots.size()] / 2).epsilon(1e-6));
      roots.push_back(i);
      lengths.push_back(0);
    } else {
      REQUIRE(line.parent > static_cast<int64_t>(roots.back()));  // In the tree of the last root.
      lengths.back() += length(line.place - lines[static_cast<size_t>(line.parent) - 1].place);
    }
  }
  REQUIRE(roots.size() == 3);
  roots.push_back(lines.size());
  for (size_t tree = 0; tree < 3; ++tree) {  // Prim's algorithm.
    const std::span<const SwcLine> points = std::span(lines).subspan(roots[tree], roots[tree + 1] - roots[tree]);
    std::vector<double> away(points.size(), 1e9);
    away[0] = 0;
    double sum = 0;
    for (size_t step = 0; step < points.size(); ++step) {
      const size_t next = static_cast<size_t>(std::min_element(away.begin(), away.end()) - away.begin());
      sum += away[next];
      for (size_t i = 0; i < points.size(); ++i)
        if (away[i] < 1e10) away[i] = std::min(away[i], length(points[i].place - points[next].place));
      away[next] = 1e10;
    }
    CHECK(lengths[tree] == doctest::Approx(sum).epsilon(1e-9));
  }
  fields.pop_back();
  const std::vector<SwcLine> together = swcOf(fields);
  CHECK(together.size() == expectedCount);
  CHECK(std::count_if(together.begin(), together.end(), [](const SwcLine& l) { return l.parent == -1; }) == 1);
  fields.push_back(makeField("component", std::vector<double>(kCount)));
  CHECK(codeOf(fields, "/dev/null") == ErrorCode::OptionConflict);
  fields.back() = makeField("component", std::vector<uint32_t>(3));
  CHECK(codeOf(fields, "/dev/null") == ErrorCode::OptionConflict);
}

TEST_CASE("a .swc without a point has its header only") {
  CHECK(swcOf({makeField("sdf", std::vector<double>{kNoValue, 0}),
               makeField("centre", std::vector<double>(6, 0), FieldLocation::PerFace, 3)})
            .empty());
}

TEST_CASE("a stop request ends the writing of trees, and leaves no file") {
  const Folder folder;
  test::requireFailure([&] { writePoints(folder / "points.swc", pointFields(), test::stoppedControl()); },
                       ErrorCode::Cancelled);
  CHECK(folder.names().empty());
}
