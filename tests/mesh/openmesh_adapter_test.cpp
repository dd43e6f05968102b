#include "asdf_vk/openmesh.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "mesh/face_geometry.h"
#include "support/require_failure.h"
#include "support/shapes.h"

using namespace asdfvk;

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using DoubleMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

template <typename HalfEdgeMesh>
HalfEdgeMesh toOpenMesh(const Mesh& mesh) {
  using Point = typename HalfEdgeMesh::Point;
  using Scalar = typename Point::value_type;
  HalfEdgeMesh result;
  std::vector<OpenMesh::VertexHandle> handles;
  for (const Vec3d& v : mesh.vertices)
    handles.push_back(
        result.add_vertex(Point(static_cast<Scalar>(v.x), static_cast<Scalar>(v.y), static_cast<Scalar>(v.z))));
  for (const auto& [a, b, c] : mesh.faces) result.add_face(handles[a], handles[b], handles[c]);
  return result;
}

// Equal up to which corner a face begins with.
bool isSameFace(const Face& a, const Face& b) {
  return a == b || a == Face{b[1], b[2], b[0]} || a == Face{b[2], b[0], b[1]};
}

template <typename HalfEdgeMesh>
void checkRoundTrip(const Mesh& expected) {
  const Mesh mesh = fromOpenMesh(toOpenMesh<HalfEdgeMesh>(expected));
  CHECK(mesh.vertices == expected.vertices);
  CHECK(mesh.polygons.isEmpty());
  REQUIRE(mesh.faceCount() == expected.faceCount());
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) CHECK(isSameFace(mesh.faces[f], expected.faces[f]));
}

}  // namespace

TEST_CASE("an OpenMesh mesh becomes the same vertices and faces in handle order") {
  checkRoundTrip<FloatMesh>(shapes::cube());
  checkRoundTrip<FloatMesh>(shapes::grid(4));
  checkRoundTrip<DoubleMesh>(shapes::scaledAndShifted(shapes::cube(), 0.1));
  checkRoundTrip<DoubleMesh>({});
}

TEST_CASE("values are written to a double face property by handle") {
  DoubleMesh mesh = toOpenMesh<DoubleMesh>(shapes::cube());
  computeOnOpenMesh(mesh, [](const Mesh& plain) {
    const UnsetVector<double> areas = computeFaceGeometry(plain).areas;
    std::vector<double> values(areas.begin(), areas.end());
    for (size_t f = 0; f < values.size(); ++f) values[f] += static_cast<double>(f);
    return values;
  });
  const auto property = OpenMesh::getProperty<OpenMesh::FaceHandle, double>(mesh, "sdf");
  for (const auto face : mesh.faces()) CHECK(property[face] == doctest::Approx(2.0 + face.idx()));
}

TEST_CASE("a property of the name is overwritten, one of another name is left") {
  FloatMesh mesh = toOpenMesh<FloatMesh>(shapes::tetrahedron());
  writeFaceProperty(mesh, std::vector<double>{1, 2, 3, 4}, "thickness");
  writeFaceProperty(mesh, std::vector<double>{5, 6, 7, kNoValue}, "thickness");
  writeFaceProperty(mesh, std::vector<double>{0, 0, 0, 0});
  const auto property = OpenMesh::getProperty<OpenMesh::FaceHandle, double>(mesh, "thickness");
  CHECK(property[OpenMesh::FaceHandle(2)] == 7);
  CHECK(std::isnan(property[OpenMesh::FaceHandle(3)]));
}

TEST_CASE("a wrong number of values is ArraySize, a deleted face is OptionConflict") {
  FloatMesh mesh = toOpenMesh<FloatMesh>(shapes::tetrahedron());
  test::requireFailure([&] { writeFaceProperty(mesh, std::vector<double>{1, 2, 3}); }, ErrorCode::ArraySize);
  mesh.request_face_status();
  mesh.request_edge_status();
  mesh.request_vertex_status();
  mesh.delete_face(OpenMesh::FaceHandle(1), false);
  test::requireFailure([&] { (void)fromOpenMesh(mesh); }, ErrorCode::OptionConflict);
  mesh.garbage_collection();
  CHECK(fromOpenMesh(mesh).faceCount() == 3);
}
