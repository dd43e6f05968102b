#include "render/thin_places.h"

#include <doctest/doctest.h>

#include <cmath>

#include "mesh/coincident_faces.h"
#include "mesh/face_geometry.h"
#include "render/picture.h"
#include "support/shapes.h"

namespace asdfvk {
namespace {

constexpr int kThinWidth = 320, kThinHeight = 240;

/// A box from `low` to `high`; as a cavity with its faces inwards.
void addBox(Mesh& mesh, const Vec3d& low, const Vec3d& high, bool isCavity = false) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const Mesh cube = shapes::cube();
  Box3d box;
  for (const Vec3d& vertex : cube.vertices) box.add(vertex);
  for (const Vec3d& vertex : cube.vertices) {
    Vec3d moved;
    for (size_t axis = 0; axis < 3; ++axis) moved[axis] = vertex[axis] > box.centre()[axis] ? high[axis] : low[axis];
    mesh.vertices.push_back(moved);
  }
  for (const auto& [a, b, c] : cube.faces)
    mesh.faces.push_back({first + a, first + (isCavity ? c : b), first + (isCavity ? b : c)});
}

/// A mesh with everything that a picture needs, and places on it.
struct DrawnPlaces {
  explicit DrawnPlaces(Mesh drawn)
      : owned(std::move(drawn)),
        geometry(computeFaceGeometry(mesh)),
        representatives(coincidentRepresentatives(mesh, surveyEdges(mesh))),
        bvh(buildBvh(mesh, geometry, representatives)) {}

  [[nodiscard]] Image draw(const View& view, std::vector<Callout> callouts = {}) const {
    Picture picture{.scene = scene, .width = kThinWidth, .height = kThinHeight, .view = view};
    picture.thinPlaces = ThinPlaces{surface, std::move(callouts), "", false};
    return render(picture);
  }

  Mesh owned;
  TriangleMesh mesh{owned};
  FaceGeometry geometry;
  UnsetVector<uint32_t> representatives;
  Bvh bvh;
  TraceScene scene{mesh, geometry, representatives, bvh};
  std::vector<std::array<Vec3d, 3>> surface;
  std::vector<uint32_t> regions;
};

/// Pixels that are red: as in the legend, or weaker.
struct RedCounts {
  int strong = 0, weak = 0;
};
RedCounts redOf(const Image& image) {
  RedCounts counts;
  for (const Rgb& pixel : image.pixels()) {
    if (pixel[0] > 3 * pixel[1]) {
      ++counts.strong;
    } else if (pixel[0] > pixel[1] + 25) {
      ++counts.weak;
    }
  }
  return counts;
}

const View kFront{Up::Y, 0, 0}, kBack{Up::Y, 180, 0};

/// A slab of 4 x 2 x 0.5 with a quarter of its front face as the thin surface.
DrawnPlaces slabWithQuarter() {
  Mesh mesh;
  addBox(mesh, {0, 0, 0}, {4, 2, 0.5});
  DrawnPlaces drawn(std::move(mesh));
  drawn.surface = {{Vec3d{0, 0, 0.5}, {2, 0, 0.5}, {2, 1, 0.5}}, {Vec3d{0, 0, 0.5}, {2, 1, 0.5}, {0, 1, 0.5}}};
  drawn.regions = {0, 0};
  return drawn;
}

TEST_CASE("a part of a face has the colour of the alarm, and shines through from behind") {
  const DrawnPlaces slab = slabWithQuarter();
  const RedCounts front = redOf(slab.draw(kFront)), back = redOf(slab.draw(kBack));
  // The slab fills the width: a quarter of 294 x 147 pixels, without its rim.
  const double quarter = 0.25 * std::pow(kThinWidth - 2 * 0.04 * kThinHeight, 2) / 2;
  CHECK_EQ(front.strong, doctest::Approx(quarter).epsilon(0.03));
  CHECK_LT(front.weak, 0.03 * quarter);
  CHECK_EQ(back.strong, 0);
  CHECK_EQ(back.weak, doctest::Approx(quarter).epsilon(0.03));
}

TEST_CASE("the best view shows the surface") {
  DrawnPlaces slab = slabWithQuarter();
  const View usual{Up::Y, 30, 18};
  const View front = bestViewOf(slab.scene, slab.surface, slab.regions, usual);
  CHECK_EQ(front.azimuthDegrees, usual.azimuthDegrees);
  CHECK_EQ(front.elevationDegrees, usual.elevationDegrees);
  CHECK_GT(redOf(slab.draw(front)).strong, 500);
  for (auto& triangle : slab.surface)
    for (Vec3d& corner : triangle) corner.z = 0;
  CHECK_EQ(redOf(slab.draw(usual)).strong, 0);
  const View back = bestViewOf(slab.scene, slab.surface, slab.regions, usual);
  CHECK_GT(redOf(slab.draw(back)).strong, 500);
  for (auto& triangle : slab.surface) triangle = {Vec3d{0, 0, 0}, {4, 0, 0}, {4, 0, 0.5}};
  const View below = bestViewOf(slab.scene, slab.surface, slab.regions, usual);
  CHECK_LT(below.elevationDegrees, 0);
}

TEST_CASE("a surface inside of the body keeps the view and shines through") {
  Mesh mesh;
  addBox(mesh, {0, 0, 0}, {4, 3, 3});
  addBox(mesh, {1, 1, 1}, {3, 2, 2}, true);
  DrawnPlaces drawn(std::move(mesh));
  for (size_t face = 12; face < 24; ++face) {
    const auto& [a, b, c] = drawn.mesh.faces[face];
    drawn.surface.push_back({drawn.mesh.vertices[a], drawn.mesh.vertices[b], drawn.mesh.vertices[c]});
    drawn.regions.push_back(0);
  }
  const View usual{Up::Y, 30, 18}, view = bestViewOf(drawn.scene, drawn.surface, drawn.regions, usual);
  CHECK_EQ(view.azimuthDegrees, usual.azimuthDegrees);
  const RedCounts red = redOf(drawn.draw(view));
  CHECK_EQ(red.strong, 0);
  CHECK_GT(red.weak, 1500);
}

TEST_CASE("callouts are at both sides, with rings at the places") {
  const DrawnPlaces slab = slabWithQuarter();
  const auto darkIn = [](const Image& image, int left, int right) {
    int count = 0;
    for (int y = kThinHeight / 5; y < kThinHeight; ++y)
      for (int x = left; x < right; ++x) count += image.at(x, y)[0] < 140 && image.at(x, y)[2] < 140;
    return count;
  };
  const std::vector<Callout> callouts{{{0.5, 1, 0.5}, {0.5, 1, 0}, "0.5"}, {{3.5, 1, 0}, {3.5, 1, 0.5}, "0.4"}};
  const Image image = slab.draw(kFront, callouts), plain = slab.draw(kFront);
  CHECK_EQ(darkIn(plain, 0, kThinWidth), 0);
  CHECK_GT(darkIn(image, 0, kThinWidth / 8), 10);
  CHECK_GT(darkIn(image, kThinWidth * 7 / 8, kThinWidth), 10);
  CHECK_GT(darkIn(image, kThinWidth / 8, kThinWidth / 3), 10);
  CHECK_EQ(darkIn(image, kThinWidth * 2 / 5, kThinWidth * 3 / 5), 0);
  // Many at one place: their texts are apart.
  const std::vector<Callout> many(8, callouts[0]);
  CHECK_GT(darkIn(slab.draw(kFront, many), 0, kThinWidth / 8), 5 * darkIn(image, 0, kThinWidth / 8));
}

TEST_CASE("nothing thin: a grey body") {
  DrawnPlaces slab = slabWithQuarter();
  slab.surface.clear();
  const RedCounts red = redOf(slab.draw(kFront));
  CHECK_EQ(red.strong + red.weak, 0);
  const View usual{Up::Y, 30, 18};
  CHECK_EQ(bestViewOf(slab.scene, slab.surface, {}, usual).azimuthDegrees, 30);
}

}  // namespace
}  // namespace asdfvk
