#include <doctest/doctest.h>

#include <filesystem>
#include <map>

#include "reading.h"

using namespace asdfvk;
using asdfvk::test::holds;

namespace {

/// A mesh of these counts, or an error that contains `reason`.
struct Expectation {
  size_t vertexCount = 0;
  size_t inputFaceCount = 0;
  std::string_view reason;
};

Expectation mesh(size_t vertexCount, size_t inputFaceCount) { return {vertexCount, inputFaceCount, {}}; }
Expectation error(std::string_view reason) { return {0, 0, reason}; }

const std::map<std::string, Expectation> kExpectations = {
    {"off_keyword_only", error("vertex count")},
    {"obj_corner_without_vertex.obj", error("line 4: '/1' is not a corner")},
    {"obj_index_out_of_range.obj", error("line 4: vertex index 9 is out of range")},
    {"obj_index_zero.obj", error("line 4: vertex index 0")},
    {"obj_mtllib_dev_zero.obj", error("neither points nor faces")},
    {"obj_corner_with_normal_only.obj", error("line 3: '//1' is not a corner")},
    {"obj_continued_line.obj", mesh(3, 1)},
    {"obj_index_int_min.obj", error("line 2: vertex index -2147483648 is out of range")},
    {"obj_repeated_corner.obj", mesh(3, 1)},
    {"obj_beyond_float_range.obj", mesh(4, 1)},
    {"obj_mtllib_without_name.obj", error("1 point and no face")},
    {"off_huge_face_count.off", error("line 2: 1 vertex and 4,000,000,000 faces do not fit")},
    {"off_huge_corner_count.off", error("line 4: face 0 with 4,000,000,000 corners does not fit")},
    {"off_keyword_only.off", error("vertex count")},
    {"off_comment.off", mesh(3, 1)},
    {"off_counts_on_keyword_line.off", mesh(3, 1)},
    {"off_negative_index.off", error("line 6: vertex index -1 of face 0 is out of range")},
    {"off_binary.off", error("binary OFF")},
    {"off_truncated.off", error("truncated")},
    {"off_beyond_float_range.off", mesh(3, 1)},
    {"off_negative_count.off", error("line 2: the vertex count is negative")},
    {"off_crlf.off", mesh(3, 1)},
    {"ply_ends_in_header.ply", error("end_header")},
    {"ply_header_without_elements.ply", error("end_header")},
    {"ply_property_before_element.ply", error("line 3: a property before the first element")},
    {"ply_list_before_element.ply", error("line 3: a property before the first element")},
    {"ply_huge_vertex_count.ply", error("no element 'face'")},
    {"ply_huge_face_count.ply", error("4,000,000,000 rows of element 'face' do not fit")},
    {"ply_huge_list_length.ply", error("a list of length 4000000000 does not fit")},
    {"ply_negative_list_length.ply", error("a list of length -1")},
    {"ply_truncated_ascii.ply", error("truncated")},
    {"ply_nan_coordinate.ply", mesh(3, 1)},
    {"ply_beyond_float_range.ply", mesh(3, 1)},
    {"ply_below_float_range.ply", mesh(3, 1)},
    {"ply_second_list.ply", mesh(3, 2)},
    {"ply_property_before_list.ply", mesh(3, 1)},
    {"ply_obj_info.ply", mesh(3, 1)},
    {"ply_obj_info_with_keywords.ply", mesh(3, 1)},
    {"ply_faces_before_vertices.ply", mesh(3, 1)},
    {"ply_uint_list_length.ply", mesh(3, 1)},
    {"ply_crlf_point_cloud.ply", error("1 point and no element 'face'")},
    {"ply_ushort_indices.ply", mesh(3, 1)},
    {"ply_int_coordinates.ply", mesh(3, 1)},
    {"stl_empty_file.stl", error("is empty")},
    {"stl_solid_only.stl", error("endsolid")},
    {"stl_two_bytes.stlb", error("at least 84 bytes")},
    {"stl_huge_face_count.stlb", error("truncated")},
    {"stl_outer_only.stl", error("which begins with 'solid'")},
    {"stl_nan_coordinates.stl", mesh(3, 1)},
    {"stl_truncated.stl", error("truncated")},
    {"stl_trailing_bytes.stl", error("continues after the last face")},
    {"stl_no_facet.st", error("line 2: expected 'facet' or 'endsolid'")},
    {"off_stcoff_keyword_only.off", error("vertex count")},
    {"off_stcnoff_keyword_only.off", error("vertex count")},
    {"obj_no_vertices_corner_without_vertex.obj", error("line 1: '/1' is not a corner")},
    {"obj_no_vertices_index_zero.obj", error("line 1: vertex index 0")},
    {"obj_no_vertices_corner_with_normal_only.obj", error("line 2: '//1' is not a corner")},
    {"ply_property_without_element.ply", error("line 3: a property before the first element")},
    {"ply_unknown_keyword.ply", error("line 2: 'a' is not a PLY header keyword")},
    {"ply_header_on_one_line.ply", error("the file ends where end_header is expected")},
};

}  // namespace

TEST_CASE("every file of the corpus is read as the right mesh or rejected with the reason") {
  size_t fileCount = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ASDFVK_TEST_DIR "/io/corpus")) {
    const std::string name = entry.path().filename().string();
    CAPTURE(name);
    ++fileCount;
    REQUIRE(kExpectations.contains(name));
    const Expectation& expected = kExpectations.at(name);
    const std::optional<Mesh> mesh = test::readAsExpected(entry.path(), expected.reason);
    const Mesh read = mesh.value_or(Mesh{});
    CHECK(read.vertices.size() == expected.vertexCount);
    CHECK(read.inputFaceCount() == expected.inputFaceCount);
    if (mesh && name != "obj_repeated_corner.obj") CHECK(read.faces[0] == Face{0, 1, 2});
  }
  CHECK(fileCount == kExpectations.size());
}

TEST_CASE("numbers beyond the range of float, and NaN, are read exactly") {
  const std::string folder = ASDFVK_TEST_DIR "/io/corpus/";
  CHECK(readMesh(folder + "obj_beyond_float_range.obj").vertices[1] == Vec3d{1e39, 0, 0});
  CHECK(readMesh(folder + "off_beyond_float_range.off").vertices[1] == Vec3d{1e39, 0, 0});
  CHECK(readMesh(folder + "ply_beyond_float_range.ply").vertices[1] == Vec3d{1e39, 0, 0});
  CHECK(readMesh(folder + "ply_below_float_range.ply").vertices[1] == Vec3d{1e-50, 0, 0});
  const Mesh nan = readMesh(folder + "ply_nan_coordinate.ply");
  CHECK(nan.vertices[1].y != nan.vertices[1].y);
  CHECK(nan.vertices[2] == Vec3d{0, 1, 0});
}
