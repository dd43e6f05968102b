#include "render/label_colours.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "generate/shapes.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"

namespace asdfvk {
namespace {

using Labels = std::vector<uint32_t>;

std::vector<Rgb> coloursOf(const Mesh& mesh, const Labels& labels) {
  return labelColours(mesh, computeFaceGeometry(mesh).areas, labels);
}

/// A fan of faces around a vertex on an axis.
Mesh fan(uint32_t faceCount) {
  Mesh mesh;
  mesh.vertices.push_back({0, 0, 0});
  for (uint32_t i = 0; i <= faceCount; ++i) {
    const double x = i, y = 100;
    mesh.vertices.push_back({x, y, 0});
    if (i > 0) mesh.faces.push_back({0, i + 1, i});
  }
  return mesh;
}

TEST_CASE("labels that share an edge have different colours") {
  const Mesh mesh = generateShape("animal", 2000).mesh;
  Labels labels(mesh.faceCount());
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) labels[face] = face / 23 * 7;
  const std::vector<Rgb> colours = coloursOf(mesh, labels);
  const DualGraph graph = buildDualGraph(mesh);
  size_t equalCount = 0;
  for (uint32_t face = 0; face < graph.faceCount(); ++face)
    for (const uint32_t neighbour : graph.neighboursOf(face)) {
      if (labels[face] == labels[neighbour]) CHECK(colours[face] == colours[neighbour]);
      equalCount += labels[face] != labels[neighbour] && colours[face] == colours[neighbour];
    }
  CHECK_EQ(equalCount, 0);
}

TEST_CASE("up to 12 labels have colours of their own, the first for the largest area") {
  const Mesh mesh = fan(14);
  const Labels labels{9, 9, 9, 0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 11};
  const std::vector<Rgb> colours = coloursOf(mesh, labels);
  CHECK_EQ(std::set<Rgb>(colours.begin(), colours.end()).size(), 12);
  CHECK(colours[0] == kLabelColours[0]);
  CHECK_EQ(std::set<Rgb>(kLabelColours.begin(), kLabelColours.end()).size(), kLabelColours.size());
}

TEST_CASE("a label with more neighbours than colours shares one, and a mesh without faces has none") {
  // Label 0 is the fan's every second face.
  const Mesh mesh = fan(61);
  Labels labels(61, 0);
  for (uint32_t face = 1; face < 61; face += 2) labels[face] = face;
  const std::vector<Rgb> colours = coloursOf(mesh, labels);
  CHECK(std::all_of(colours.begin(), colours.end(), [](const Rgb& colour) {
    return std::find(kLabelColours.begin(), kLabelColours.end(), colour) != kLabelColours.end();
  }));
  for (size_t face = 1; face < 61; face += 2) CHECK(colours[face] != colours[0]);
  CHECK(coloursOf(Mesh{}, {}).empty());
}

}  // namespace
}  // namespace asdfvk
