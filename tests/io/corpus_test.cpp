#include <doctest/doctest.h>

#include <filesystem>
#include <map>

#include "reading.h"

using namespace asdfvk;
using asdfvk::test::holds;

namespace {

/// What a file must give: a mesh of these counts, or an error that holds `reason`.
struct Expectation {
  size_t vertexCount = 0;
  size_t inputFaceCount = 0;
  std::string_view reason;
};

Expectation mesh(size_t vertexCount, size_t inputFaceCount) { return {vertexCount, inputFaceCount, {}}; }
Expectation error(std::string_view reason) { return {0, 0, reason}; }

const std::map<std::string, Expectation> kExpectations = {
    {"noext", error("vertex count")},
    {"obj_a_slash.obj", error("line 4: '/1' is no corner")},
    {"obj_b_oob.obj", error("line 4: vertex index 9 is out of range")},
    {"obj_c_zero.obj", error("line 4: vertex index 0")},
    {"obj_d_devzero.obj", error("neither points nor faces")},
    {"obj_e_slashes.obj", error("line 3: '//1' is no corner")},
    {"obj_f_cont.obj", mesh(3, 1)},
    {"obj_g_intmin.obj", error("line 2: vertex index -2147483648 is out of range")},
    {"obj_h_lead.obj", mesh(3, 1)},
    {"obj_i_over.obj", mesh(4, 1)},
    {"obj_j_mtldir.obj", error("1 point and no face")},
    {"off_a_hugef.off", error("line 2: 1 vertex and 4000000000 faces do not fit")},
    {"off_b_poly.off", error("line 4: face 0 claims 4000000000 corners")},
    {"off_c_empty.off", error("vertex count")},
    {"off_d_comment.off", mesh(3, 1)},
    {"off_e_oneline.off", mesh(3, 1)},
    {"off_f_neg.off", error("line 6: vertex index -1 of face 0 is out of range")},
    {"off_g_bin.off", error("binary OFF")},
    {"off_h_trunc.off", error("cut short")},
    {"off_i_over.off", mesh(3, 1)},
    {"off_j_negcount.off", error("line 2: the vertex count is negative")},
    {"off_k_cr.off", mesh(3, 1)},
    {"ply_a_eof.ply", error("end_header")},
    {"ply_b_noend.ply", error("end_header")},
    {"ply_c_propfirst.ply", error("line 3: a property stands before any element")},
    {"ply_d_listfirst.ply", error("line 3: a property stands before any element")},
    {"ply_e_hugev.ply", error("no element 'face'")},
    {"ply_f_hugeface.ply", error("4000000000 rows of element 'face' cannot fit")},
    {"ply_g_hugepoly.ply", error("claims a length of 4000000000")},
    {"ply_h_binneg.ply", error("a list of length -1")},
    {"ply_i_trunc_ascii.ply", error("cut short")},
    {"ply_j_garb.ply", mesh(3, 1)},
    {"ply_k_over.ply", mesh(3, 1)},
    {"ply_l_denorm.ply", mesh(3, 1)},
    {"ply_m_listprop.ply", mesh(3, 2)},
    {"ply_n_propbefore.ply", mesh(3, 1)},
    {"ply_o_objinfo.ply", mesh(3, 1)},
    {"ply_p_objinfo2.ply", mesh(3, 1)},
    {"ply_q_faceB4.ply", mesh(3, 1)},
    {"ply_r_listint8.ply", mesh(3, 1)},
    {"ply_s_crlf.ply", error("1 point and no element 'face'")},
    {"ply_t_endian_int.ply", mesh(3, 1)},
    {"ply_u_intcoord.ply", mesh(3, 1)},
    {"stl_a_empty.stl", error("is empty")},
    {"stl_b_short.stl", error("endsolid")},
    {"stl_c_b.stlb", error("at least 84 bytes")},
    {"stl_d_huge.stlb", error("cut short")},
    {"stl_e_outer.stl", error("does not begin with 'solid'")},
    {"stl_f_nan.stl", mesh(3, 1)},
    {"stl_g_trunc.stl", error("cut short")},
    {"stl_h_trail.stl", error("followed by something else")},
    {"sub_a.st", error("line 2: 'facet' or 'endsolid'")},
    {"x_6.off", error("vertex count")},
    {"x_7.off", error("vertex count")},
    {"y1.obj", error("line 1: '/1' is no corner")},
    {"y2.obj", error("line 1: vertex index 0")},
    {"y3.obj", error("line 2: '//1' is no corner")},
    {"z1.ply", error("line 3: a property stands before any element")},
    {"z2.ply", error("line 2: 'a' is no PLY header keyword")},
    {"z3.ply", error("line 2: 'a' is no PLY header keyword")},
};

}  // namespace

TEST_CASE("every file of the fuzzing corpus gives the right mesh or a clear error") {
  size_t fileCount = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ASDFVK_TEST_DIR "/io/corpus")) {
    const std::string name = entry.path().filename().string();
    CAPTURE(name);
    ++fileCount;
    REQUIRE(kExpectations.contains(name));
    const Expectation& expected = kExpectations.at(name);
    std::string message;
    Mesh read;
    try {
      read = readMesh(entry.path());
    } catch (const Error& thrown) {
      CHECK(thrown.kind() == ErrorKind::Input);
      message = thrown.what();
    }
    CAPTURE(message);
    CHECK(message.empty() == expected.reason.empty());
    CHECK(holds(message, expected.reason));
    if (!message.empty()) CHECK(message.starts_with(entry.path().string() + ": "));
    CHECK(message.find('\n') == std::string::npos);
    CHECK(read.vertices.size() == expected.vertexCount);
    CHECK(read.inputFaceCount() == expected.inputFaceCount);
    if (message.empty() && name != "obj_h_lead.obj") CHECK(read.faces[0] == Face{0, 1, 2});
  }
  CHECK(fileCount == kExpectations.size());
}

TEST_CASE("the numbers of the corpus that other readers lose are kept") {
  const std::string folder = ASDFVK_TEST_DIR "/io/corpus/";
  CHECK(readMesh(folder + "obj_i_over.obj").vertices[1] == Vec3d{1e39, 0, 0});
  CHECK(readMesh(folder + "off_i_over.off").vertices[1] == Vec3d{1e39, 0, 0});
  CHECK(readMesh(folder + "ply_k_over.ply").vertices[1] == Vec3d{1e39, 0, 0});
  CHECK(readMesh(folder + "ply_l_denorm.ply").vertices[1] == Vec3d{1e-50, 0, 0});
  const Mesh nan = readMesh(folder + "ply_j_garb.ply");
  CHECK(nan.vertices[1].y != nan.vertices[1].y);
  CHECK(nan.vertices[2] == Vec3d{0, 1, 0});
}
