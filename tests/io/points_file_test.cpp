#include <doctest/doctest.h>

#include <cstring>

#include "asdf_vk/error.h"
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
