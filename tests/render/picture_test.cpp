#include "render/picture.h"

#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>

#include "asdf_vk/error.h"
#include "generate/shapes.h"
#include "mesh/coincident_faces.h"
#include "mesh/face_geometry.h"

namespace asdfvk {
namespace {

constexpr int kWidth = 320, kHeight = 240;

/// Geometry and hierarchy of a mesh, which must outlive it.
struct DrawnMesh {
  explicit DrawnMesh(const Mesh& drawn)
      : mesh(drawn),
        geometry(computeFaceGeometry(mesh)),
        representatives(coincidentRepresentatives(mesh, surveyEdges(mesh))),
        bvh(buildBvh(mesh, geometry, representatives)) {}

  TriangleMesh mesh;
  FaceGeometry geometry;
  UnsetVector<uint32_t> representatives;
  Bvh bvh;
  TraceScene scene{mesh, geometry, representatives, bvh};
};

Image renderSmall(const Mesh& mesh, std::span<const double> values = {}, std::span<const uint8_t> highlighted = {},
                  const std::string& title = "", const View& view = {}) {
  return render({.scene = DrawnMesh(mesh).scene,
                 .values = values,
                 .highlighted = highlighted,
                 .title = title,
                 .range = {},
                 .width = kWidth,
                 .height = kHeight,
                 .view = view});
}

int brightness(const Rgb& colour) { return colour[0] + colour[1] + colour[2]; }

int countInk(const Image& image) {
  int count = 0;
  for (const Rgb& pixel : image.pixels()) count += pixel != kWhite;
  return count;
}

TEST_CASE("a sphere's silhouette is the disk that fills the height, and lies in the middle") {
  const Mesh mesh = generateShape("sphere", 20000).mesh;
  const std::vector<uint8_t> all(mesh.faceCount(), 1);
  const Image image = renderSmall(mesh, {}, all);
  // On white, the green of the highlight is a measure of the coverage of a pixel; 188 is half the light.
  double count = 0, sumX = 0, sumY = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (image.at(x, y)[1] < 188) {
        ++count;
        sumX += x + 0.5;
        sumY += y + 0.5;
      }
  const double radius = kHeight * (1 - 2 * 0.04) / 2;
  CHECK_EQ(count, doctest::Approx(std::numbers::pi * radius * radius).epsilon(0.004));
  CHECK_EQ(sumX / count, doctest::Approx(kWidth / 2.0).epsilon(0.002));
  CHECK_EQ(sumY / count, doctest::Approx(kHeight / 2.0).epsilon(0.002));
}

TEST_CASE("edges are antialiased, against the background and between colours") {
  // A square seen from above; its diagonal separates highlighted from plain.
  Mesh mesh;
  mesh.vertices = {{-1, 0, 1}, {1, 0, 1}, {0.9, 0, -1}, {-0.9, 0, -1}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<uint8_t> highlighted{1, 0};
  const Image image = renderSmall(mesh, {}, highlighted, "", {Up::Y, 0, 90});
  const int y = kHeight / 3;
  std::set<Rgb> colours;
  for (int row = y; row < y + 20; ++row)
    for (int x = 0; x < kWidth; ++x) colours.insert(image.at(x, row));
  int betweenPlainAndWhite = 0, betweenRedAndPlain = 0;
  for (const Rgb& colour : colours) {
    betweenPlainAndWhite += colour[1] > 225 && colour != kWhite;
    betweenRedAndPlain += colour[0] > colour[1] + 30 && colour[1] > 70 && colour[1] < 180;
  }
  CHECK_GE(betweenPlainAndWhite, 4);
  CHECK_GE(betweenRedAndPlain, 4);
}

TEST_CASE("hidden faces change no pixel") {
  const Mesh outer = generateShape("sphere", 2000).mesh;
  Mesh both = outer;
  for (const double scale : {0.95, 0.7, 0.2}) {
    const auto first = static_cast<uint32_t>(both.vertices.size());
    for (const Vec3d& vertex : outer.vertices) both.vertices.push_back(vertex * scale);
    for (const auto& [a, b, c] : outer.faces) both.faces.push_back({first + a, first + b, first + c});
  }
  CHECK(renderSmall(both) == renderSmall(outer));
}

TEST_CASE("light comes from the upper left") {
  const Mesh mesh = generateShape("sphere", 20000).mesh;
  const Image image = renderSmall(mesh);
  const int lit = brightness(image.at(kWidth / 2 - 40, kHeight / 2 - 40));
  const int dark = brightness(image.at(kWidth / 2 + 60, kHeight / 2 + 60));
  CHECK_GT(lit, dark + 100);
}

TEST_CASE("a body in the key light's way casts a shadow") {
  // A floor seen from above, with and without a plate over the middle of it.
  Mesh mesh;
  mesh.vertices = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  const View fromAbove{Up::Y, 0, 90};
  const Image bare = renderSmall(mesh, {}, {}, "", fromAbove);
  for (const Vec3d& p : {Vec3d{-0.2, 0.3, 0.2}, {0.2, 0.3, 0.2}, {0.2, 0.3, -0.2}, {-0.2, 0.3, -0.2}})
    mesh.vertices.push_back(p);
  mesh.faces.push_back({4, 5, 6});
  mesh.faces.push_back({4, 6, 7});
  const Image shaded = renderSmall(mesh, {}, {}, "", fromAbove);
  int darkest = 1000, floor = brightness(bare.at(kWidth / 2, kHeight / 2));
  for (int y = kHeight / 4; y < kHeight * 3 / 4; ++y)
    for (int x = kWidth / 3; x < kWidth * 2 / 3; ++x) darkest = std::min(darkest, brightness(shaded.at(x, y)));
  CHECK_LT(darkest, floor * 85 / 100);
  CHECK_GT(darkest, floor * 30 / 100);
}

TEST_CASE("a plane does not shade itself, at any angle to the light") {
  Mesh mesh;
  mesh.vertices = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  for (const double elevation : {8.0, 35.0, 90.0}) {
    CAPTURE(elevation);
    const Image image = renderSmall(mesh, {}, {}, "", {Up::Y, 20, elevation});
    for (int x = kWidth * 2 / 5; x < kWidth * 3 / 5; ++x)
      CHECK_EQ(brightness(image.at(x, kHeight / 2)), brightness(image.at(kWidth / 2, kHeight / 2)));
  }
}

TEST_CASE("a round body of flat faces is shaded evenly") {
  // Coarse: without interpolated normals neighbours would differ by ten times as much.
  const Mesh mesh = generateShape("sphere", 320).mesh;
  const Image image = renderSmall(mesh);
  for (int x = kWidth / 2 - 60; x < kWidth / 2 + 60; ++x)
    for (const int y : {kHeight / 2 - 30, kHeight / 2, kHeight / 2 + 30})
      CHECK_LE(std::abs(brightness(image.at(x, y)) - brightness(image.at(x + 1, y))), 18);
}

TEST_CASE("the same bits on one thread and on two") {
  const Mesh mesh = generateShape("animal", 3000).mesh;
  std::vector<double> values(mesh.faceCount());
  for (size_t i = 0; i < values.size(); ++i) values[i] = double(i % 97);
  using oneapi::tbb::global_control;
  const auto renderOn = [&](size_t threadCount) {
    const global_control limit(global_control::max_allowed_parallelism, threadCount);
    return renderSmall(mesh, values, {}, "title");
  };
  CHECK(renderOn(1) == renderOn(2));
}

TEST_CASE("unit and place of the mesh do not matter") {
  Mesh mesh = generateShape("animal", 3000).mesh;
  const Image image = renderSmall(mesh);
  for (Vec3d& vertex : mesh.vertices) vertex = vertex * 1024.0;
  CHECK(renderSmall(mesh) == image);
}

TEST_CASE("faces without a value are grey, those with one are coloured") {
  const Mesh mesh = generateShape("sphere", 2000).mesh;
  std::vector<double> values(mesh.faceCount(), kNoValue);
  const Image grey = renderSmall(mesh, values);
  for (const Rgb& pixel : grey.pixels()) CHECK((pixel[0] == pixel[1] && pixel[1] == pixel[2]));
  const Rgb middle = grey.at(kWidth / 2, kHeight / 2);
  CHECK_GT(middle[0], 60);
  CHECK_LT(middle[0], 200);
  CHECK_EQ(countInk(grey), countInk(renderSmall(mesh)));  // No bar either.

  const FaceGeometry geometry = computeFaceGeometry(mesh);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    if (geometry.barycentres[face].y > 0) values[face] = geometry.barycentres[face].y;
  const Image half = renderSmall(mesh, values, {}, "", {Up::Y, 0, 0});
  const Rgb& top = half.at(kWidth / 3, kHeight / 4);
  const Rgb& bottom = half.at(kWidth / 3, kHeight * 3 / 4);
  CHECK_GT(std::abs(top[0] - top[1]) + std::abs(top[1] - top[2]), 40);
  CHECK_EQ(std::abs(bottom[0] - bottom[1]) + std::abs(bottom[1] - bottom[2]), 0);
}

TEST_CASE("equal values, a range that is a point, infinite ones: a picture all the same") {
  const Mesh mesh = generateShape("sphere", 500).mesh;
  std::vector<double> values(mesh.faceCount(), 0.25);
  const Rgba middle = colourOf(0.25, {0.25, 0.25});
  const Rgb seen = renderSmall(mesh, values, {}, "flat").at(kWidth / 3, kHeight / 2);
  // The middle of the map is a bluish green; shading keeps the order of its channels.
  CHECK_EQ(middle[1] > middle[2], seen[1] > seen[2]);
  CHECK_GT(seen[1], seen[0] + 30);
  values[0] = std::numeric_limits<double>::infinity();
  values[1] = -std::numeric_limits<double>::infinity();
  CHECK_GT(countInk(renderSmall(mesh, values)), 1000);
  std::fill(values.begin(), values.end(), std::numeric_limits<double>::infinity());
  CHECK_GT(countInk(renderSmall(mesh, values)), 1000);
}

TEST_CASE("the bar is at the side, with the colours of the map") {
  const Mesh mesh = generateShape("sphere", 500).mesh;
  std::vector<double> values(mesh.faceCount());
  for (size_t i = 0; i < values.size(); ++i) values[i] = double(i);
  const Image image = renderSmall(mesh, values, {}, "shape diameter");
  const std::set<Rgb> colours(image.pixels().begin(), image.pixels().end());
  const auto holds = [&](const Rgb& wanted) {
    return std::any_of(colours.begin(), colours.end(), [&](const Rgb& colour) {
      int difference = 0;
      for (size_t i = 0; i < 3; ++i) difference = std::max(difference, std::abs(colour[i] - wanted[i]));
      return difference <= 4;
    });
  };
  CHECK(holds({253, 231, 37}));
  CHECK(holds({68, 1, 84}));
}

TEST_CASE("a given range decides the colours") {
  const Mesh mesh = generateShape("sphere", 500).mesh;
  const std::vector<double> values(mesh.faceCount(), 1.0);
  const DrawnMesh drawn(mesh);
  Picture picture{.scene = drawn.scene,
                  .values = values,
                  .highlighted = {},
                  .title = "",
                  .range = ColourRange{0, 1},
                  .width = kWidth,
                  .height = kHeight,
                  .view = {}};
  const Rgb high = render(picture).at(kWidth / 3, kHeight / 2);
  picture.range = ColourRange{1, 2};
  const Rgb low = render(picture).at(kWidth / 3, kHeight / 2);
  CHECK_GT(high[1], high[2] + 60);  // Yellow.
  CHECK_GT(low[2], low[1] + 30);    // Violet.
}

TEST_CASE("highlighted faces stand out of a light body, and their legend above it") {
  const Mesh mesh = generateShape("sphere", 500).mesh;
  std::vector<uint8_t> highlighted(mesh.faceCount(), 0);
  const auto redPixels = [&](const Image& image) {
    int count = 0;
    for (const Rgb& pixel : image.pixels()) count += pixel[0] > 2 * pixel[1] && pixel[0] > 80;
    return count;
  };
  const int ofLegend = redPixels(renderSmall(mesh, {}, highlighted, "seeds"));
  CHECK_GT(ofLegend, 10);
  CHECK_EQ(redPixels(renderSmall(mesh, {}, {}, "seeds")), 0);
  for (size_t face = 0; face < highlighted.size(); face += 4) highlighted[face] = 1;
  CHECK_GT(redPixels(renderSmall(mesh, {}, highlighted, "seeds")), ofLegend + 2000);
}

TEST_CASE("text grows with its scale, and the mesh makes room") {
  const Mesh mesh;
  const DrawnMesh drawn(mesh);
  Picture picture{.scene = drawn.scene,
                  .values = {},
                  .highlighted = {},
                  .title = "seeds",
                  .range = {},
                  .width = kWidth,
                  .height = kHeight,
                  .view = {}};
  const int usual = countInk(render(picture));
  picture.textScale = 2;
  CHECK_GT(countInk(render(picture)), 2 * usual);
}

TEST_CASE("degenerate meshes by name") {
  Mesh mesh;
  CHECK_EQ(countInk(renderSmall(mesh)), 0);
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {kNoValue, 0, 0}};
  mesh.faces = {{0, 1, 1}, {0, 1, 3}};
  CHECK_EQ(countInk(renderSmall(mesh)), 0);
  mesh.faces.push_back({0, 1, 2});
  CHECK_GT(countInk(renderSmall(mesh)), 1000);
  const std::vector<double> values{1, 2, 3};
  CHECK_GT(countInk(renderSmall(mesh, values, {}, "one triangle")), 1000);
}

TEST_CASE("both sides of a face are seen") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.faces = {{0, 1, 2}};
  const Image front = renderSmall(mesh);
  mesh.faces = {{0, 2, 1}};
  CHECK_EQ(countInk(renderSmall(mesh)), countInk(front));
  CHECK(renderSmall(mesh).at(kWidth / 2, kHeight / 2) == front.at(kWidth / 2, kHeight / 2));
}

TEST_CASE("a stop request ends the rendering, progress goes from 0 to 1") {
  const Mesh mesh = generateShape("sphere", 500).mesh;
  const DrawnMesh drawn(mesh);
  const Picture picture{.scene = drawn.scene,
                        .values = {},
                        .highlighted = {},
                        .title = "",
                        .range = {},
                        .width = kWidth,
                        .height = kHeight,
                        .view = {}};
  std::stop_source source;
  std::vector<double> fractions;
  RunControl control{source.get_token(), [&](double fraction) { fractions.push_back(fraction); }};
  (void)render(picture, control);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK_EQ(fractions.back(), 1);
  control.progress = [&](double fraction) {
    if (fraction > 0.3) source.request_stop();
  };
  CHECK_THROWS_AS((void)render(picture, control), Error);
}

}  // namespace
}  // namespace asdfvk
