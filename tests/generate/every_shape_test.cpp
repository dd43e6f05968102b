#include <doctest/doctest.h>

#include <algorithm>

#include "generate/shapes.h"
#include "topology.h"

using namespace asdfvk;

TEST_CASE("every shape is closed and manifold at every resolution, with no degenerate face") {
  for (const std::string_view name : shapeNames()) {
    for (const uint64_t count : {20, 100, 333, 1000, 2000, 20000}) {
      CAPTURE(name);
      CAPTURE(count);
      const GeneratedShape shape = generateShape(name, count);
      CAPTURE(shape.mesh.faceCount());
      REQUIRE(shape.part.size() == shape.mesh.faces.size());
      REQUIRE(shape.diameter.size() == shape.mesh.faces.size());
      const Topology topology = topologyOf(shape.mesh);
      CHECK(topology.badEdgeCount == 0);
      CHECK(topology.badVertexCount == 0);
      CHECK(topology.componentCount == 1);
      if (count >= 2000) CHECK(topology.eulerCharacteristic == (name == "torus" ? 0 : 2));
      CHECK(volumeOf(shape.mesh) > 0);
      const std::vector<double> qualities = triangleQualities(shape.mesh);
      CHECK(*std::min_element(qualities.begin(), qualities.end()) > (count >= 20000 ? 0.1
                                                                     : count >= 100 ? 1e-3
                                                                                    : 1e-5));
    }
  }
}

TEST_CASE("every shape has about the requested number of faces") {
  for (const std::string_view name : shapeNames()) {
    if (name == "icosphere") continue;  // powers of four
    for (const uint64_t count : {1000, 5000, 20000, 100000}) {
      CAPTURE(name);
      CAPTURE(count);
      const double made = generateShape(name, count).mesh.faceCount();
      CHECK(made > 0.85 * double(count));
      CHECK(made < 1.15 * double(count));
    }
  }
}
