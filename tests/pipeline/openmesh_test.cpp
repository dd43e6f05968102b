#include <doctest/doctest.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "asdf_vk/openmesh.h"
#include "generate/shapes.h"
#include "support/shared_session.h"

using namespace asdfvk;

TEST_CASE("an OpenMesh mesh in memory gets its values as a face property") {
  const Mesh torus = makeTorus(1000).mesh;
  OpenMesh::TriMesh_ArrayKernelT<> halfEdges;
  for (const Vec3d& v : torus.vertices)
    halfEdges.add_vertex({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
  for (const auto& [a, b, c] : torus.faces)
    halfEdges.add_face(OpenMesh::VertexHandle(static_cast<int>(a)), OpenMesh::VertexHandle(static_cast<int>(b)),
                       OpenMesh::VertexHandle(static_cast<int>(c)));

  computeOnOpenMesh(halfEdges, [](const Mesh& mesh) { return test::vulkanSession().compute(mesh, {}).sdf(); });

  const auto property = OpenMesh::getProperty<OpenMesh::FaceHandle, double>(halfEdges, "sdf");
  const std::vector<double> expected = test::vulkanSession().compute(torus, {}).sdf();
  for (const auto face : halfEdges.faces())
    CHECK(property[face] == doctest::Approx(expected[static_cast<size_t>(face.idx())]).epsilon(1e-3));
}
