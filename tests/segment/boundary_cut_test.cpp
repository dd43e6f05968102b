#include "segment/boundary_cut.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "generate/analytic_shapes.h"
#include "part_samples.h"
#include "support/shapes.h"

using namespace asdfvk;
using namespace asdfvk::test;

namespace {

using Labels = std::vector<uint32_t>;

/// A strip of unit squares folded upwards after half of its length, so that the fold is concave; two triangles each.
Mesh foldedStrip(uint32_t length, uint32_t width) {
  Mesh mesh;
  for (uint32_t i = 0; i <= length; ++i)
    for (uint32_t j = 0; j <= width; ++j) {
      const double x = i, half = length / 2.0;
      mesh.vertices.push_back({x < half ? x : half, static_cast<double>(j), x < half ? 0 : x - half});
    }
  for (uint32_t i = 0; i < length; ++i)
    for (uint32_t j = 0; j < width; ++j) {
      const uint32_t a = i * (width + 1) + j, b = a + width + 1;
      mesh.faces.push_back({a, b, b + 1});
      mesh.faces.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

Labels cut(const Mesh& mesh, const Labels& labels, uint32_t labelCount) {
  const PartSample sample(mesh, std::vector<double>(mesh.faces.size(), 1.0));
  const PartSurface surface = makePartSurface(sample.mesh, sample.geometry, sample.edges.graph, sample.values);
  return cutBoundaries(surface, labels, labelCount);
}

/// The number of the column of squares of a face.
uint32_t columnOf(uint32_t face, uint32_t width) { return face / 2 / width; }

}  // namespace

TEST_CASE("a ragged boundary near a concave fold moves into the fold") {
  constexpr uint32_t kLength = 80, kWidth = 40;
  const Mesh mesh = foldedStrip(kLength, kWidth);
  Labels labels(mesh.faces.size());
  for (uint32_t face = 0; face < labels.size(); ++face)
    labels[face] = columnOf(face, kWidth) < 38 + face / 2 % 3 ? 0 : 1;
  const Labels result = cut(mesh, labels, 2);
  for (uint32_t face = 0; face < labels.size(); ++face)
    REQUIRE(result[face] == (columnOf(face, kWidth) < kLength / 2 ? 0 : 1));
}

TEST_CASE("faces without a label keep none, next to faces with a label, too") {
  constexpr uint32_t kLength = 40, kWidth = 20;
  Labels labels(foldedStrip(kLength, kWidth).faces.size());
  for (uint32_t face = 0; face < labels.size(); ++face)
    labels[face] = face % 97 == 5 || (columnOf(face, kWidth) == 17 && face % 3 == 0) ? kNoLabel
                   : columnOf(face, kWidth) < 18                                     ? 0
                                                                                     : 1;
  const Labels result = cut(foldedStrip(kLength, kWidth), labels, 2);
  for (uint32_t face = 0; face < labels.size(); ++face)
    CHECK((labels[face] == kNoLabel ? result[face] == kNoLabel : result[face] < 2));
}

TEST_CASE("a boundary farther than the reach from the fold is straightened where it is") {
  constexpr uint32_t kLength = 80, kWidth = 40;
  const Mesh mesh = foldedStrip(kLength, kWidth);
  Labels labels(mesh.faces.size());
  for (uint32_t face = 0; face < labels.size(); ++face)
    labels[face] = columnOf(face, kWidth) < 20 + face / 2 % 2 ? 0 : 1;
  const Labels result = cut(mesh, labels, 2);
  for (uint32_t face = 0; face < labels.size(); ++face) {
    if (columnOf(face, kWidth) < 16) CHECK(result[face] == 0);
    if (columnOf(face, kWidth) > 24) CHECK(result[face] == 1);
  }
  CHECK(result != labels);
}

TEST_CASE("labels that are fine stay, and every label keeps a face") {
  const Mesh mesh = makeCube(12 * 64).mesh;
  CHECK(cut(mesh, Labels(mesh.faces.size(), 0), 1) == Labels(mesh.faces.size(), 0));
  Labels spots(mesh.faces.size(), 0);  // Labels of one face each, within the reach of the first.
  for (uint32_t label = 1; label < 6; ++label) spots[label * 100] = label;
  CHECK(areConsecutive(cut(mesh, spots, 6), 6));
}

TEST_CASE("a small label keeps its inner half") {
  constexpr uint32_t kLength = 60, kWidth = 60;
  const Mesh mesh = foldedStrip(kLength, kWidth);
  Labels labels(mesh.faces.size());
  for (uint32_t face = 0; face < labels.size(); ++face) {
    const uint32_t i = columnOf(face, kWidth), j = face / 2 % kWidth;
    labels[face] = i >= 10 && i < 14 && j >= 10 && j < 14 ? 1 : 0;
  }
  const Labels result = cut(mesh, labels, 2);
  // The label has 32 faces before the cut. If labels had no core, one face would remain.
  CHECK(std::count(result.begin(), result.end(), 1) >= 8);
}

TEST_CASE("faces without a label keep none") {
  Mesh mesh = makeSphere(320).mesh;
  mesh = shapes::joined(std::move(mesh), shapes::scaledAndShifted(makeSphere(20).mesh, 0.1), {3, 0, 0});
  Labels labels(mesh.faces.size(), 0);
  for (uint32_t face = 100; face < 320; ++face) labels[face] = 1;
  std::fill(labels.begin() + 320, labels.end(), kNoLabel);
  const Labels result = cut(mesh, labels, 2);
  CHECK(std::count(result.begin(), result.begin() + 320, kNoLabel) == 0);
  CHECK(std::count(result.begin() + 320, result.end(), kNoLabel) == 20);
}
