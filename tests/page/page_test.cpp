#include "page/page.h"

#include <doctest/doctest.h>

#include "page/decoded_page.h"
#include "page/page_template.h"
#include "support/shapes.h"

namespace asdfvk {
namespace {

const std::string kAttack = "</script><img src=x onerror=alert(1)>\"'<!--&\xe2\x80\xa8\x01";

size_t countOf(std::string_view text, std::string_view part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

TEST_CASE("names with markup stay text") {
  Page page("test");
  Field field{.name = "sdf", .label = kAttack, .unit = kAttack, .values = std::vector<double>(12, 1.0)};
  PageTexts texts{.name = kAttack, .label = kAttack, .picture = {'P', 'N', 'G'}};
  ReportTexts& report = texts.report;
  report = {{{kAttack, kAttack}}, kAttack, {kAttack}, {kAttack}};
  page.add(shapes::cube(), std::vector<std::reference_wrapper<const Field>>{field}, texts);
  const test::DecodedPage decoded = test::decodePage(test::htmlOf(page));
  const auto& mesh = decoded.json["meshes"][0];
  CHECK_EQ(mesh["name"], kAttack);
  CHECK_EQ(mesh["summary"][0]["title"], kAttack);
  CHECK_EQ(mesh["warnings"][0], kAttack);
  CHECK_EQ(mesh["fields"][0]["title"], kAttack);
  const size_t json = decoded.html.find("application/json");
  CHECK(decoded.html.find("\xe2\x80\xa8", json) == std::string::npos);
  // Nothing that a name could add to the page: as many elements as with a plain name.
  Page plain("test");
  for (std::string* text : {&texts.name, &texts.label, &report.errorSentence, &report.summary[0].first,
                            &report.summary[0].second, &report.warnings[0], &report.defects[0]})
    *text = "plain";
  field.label = field.unit = "plain";
  plain.add(shapes::cube(), std::vector<std::reference_wrapper<const Field>>{field}, texts);
  const std::string plainHtml = test::htmlOf(plain);
  for (const char* part : {"<", ">", "onerror=alert(1)>", "<!--"})
    CHECK_MESSAGE(countOf(decoded.html, part) == countOf(plainHtml, part), part);
}

TEST_CASE("a name that is no UTF-8 does not end the program") {
  Page page("test");
  page.add(shapes::cube(), {}, {.name = "\xff\xfe.ply", .label = "\xff"});
  CHECK_EQ(test::decodePage(test::htmlOf(page)).json["meshes"][0]["name"], "\xef\xbf\xbd\xef\xbf\xbd.ply");
}

TEST_CASE("a page is one file without references to others") {
  Page page("asdf-vk 1.2 (abc)");
  page.add(shapes::cube(), {}, {.name = "cube.ply", .label = "cube.ply, balanced"});
  const test::DecodedPage decoded = test::decodePage(test::htmlOf(page));
  CHECK_EQ(decoded.json["generator"], "asdf-vk 1.2 (abc)");
  CHECK(decoded.html.find("<title>cube.ply, balanced") != std::string::npos);
  CHECK(decoded.html.find("default-src 'none'") != std::string::npos);
  for (const char* place : {"@TITLE@", "@CSP@", "@STYLE@", "@SCRIPT@", "@DATA@", "@FALLBACK@"})
    CHECK(decoded.html.find(place) == std::string::npos);
  for (const char* reference : {"src=\"http", "href=\"http", "@import", "eval(", "new Function"})
    CHECK_MESSAGE(kPageTemplate.find(reference) == std::string_view::npos, reference);
  CHECK_LT(kPageTemplate.size(), 60'000);
}

TEST_CASE("values that are not finite are null in lists") {
  Page page("test");
  PageTexts texts{.name = "a"};
  texts.thin = PageThinPlaces{.shown = {.limit = 0.5, .verdict = ThicknessVerdict::Failed, .regions = {ThinRegion{}}},
                              .surface = {}};
  texts.thin->shown.regions[0].min = texts.thin->shown.regions[0].place.z = kNoValue;
  texts.segments = {{7, 5, 1.5, kNoValue, {1, 2, 3}}};
  page.add(shapes::cube(), {}, texts);
  const auto mesh = test::decodePage(test::htmlOf(page)).json["meshes"][0];
  CHECK_EQ(mesh["thin"]["regions"][0]["face"], 0);
  CHECK(mesh["thin"]["regions"][0]["value"].is_null());
  CHECK(mesh["thin"]["regions"][0]["place"][2].is_null());
  CHECK_EQ(mesh["segments"][0]["label"], 7);
  CHECK(mesh["segments"][0]["median"].is_null());
}

TEST_CASE("the thin surface is a mesh in the grid of the mesh, with regions") {
  const Mesh cube = shapes::cube();
  PageTexts texts{.name = "a"};
  texts.thin = PageThinPlaces{
      .shown = {.limit = 0.5, .verdict = ThicknessVerdict::Failed, .regions = {ThinRegion{}, ThinRegion{}}},
      .surface = {}};
  texts.thin->shown.regions[1].minFace = 7;
  texts.thin->shown.voids = {{.volume = 8, .face = 3, .place = {1, 2, 3}, .looseBodies = {"ball"}}};
  texts.thin->shown.regions[0].kind = ThinKind::Wall;
  texts.thin->shown.regions[1].kind = ThinKind::Detail;
  texts.thin->shown.regions[1].least = 0.125;
  texts.thin->shown.sentence = "FAIL: 1 wall thinner than 0.5: 0.25 at (1, 2, 3), face 0";
  // A whole face, and a part of another one that shares two corners with it.
  const auto& [a, b, c] = cube.faces[0];
  const Vec3d p = cube.vertices[a], q = cube.vertices[b], r = cube.vertices[c];
  ThinSurface& surface = texts.thin->surface;
  surface.triangles = {{p, q, r}, {q, p, (p + q) * 0.5 + (r - p) * 0.25}};
  surface.regions = {1, 0};
  texts.least = {.kind = "wall", .value = 0.25, .face = 4, .place = {1, 2, 3}, .opposite = {1, 2, 3.25}};
  Page page("test");
  page.add(cube, {}, std::move(texts));
  const test::DecodedPage decoded = test::decodePage(test::htmlOf(page));
  const auto& mesh = decoded.json["meshes"][0];
  CHECK_EQ(mesh["least"]["kind"], "wall");
  CHECK_EQ(mesh["least"]["value"], 0.25);
  CHECK_EQ(mesh["least"]["face"], 4);
  CHECK_EQ(mesh["least"]["opposite"][2], 3.25);
  CHECK_EQ(mesh["thin"]["limit"], 0.5);
  CHECK_EQ(mesh["thin"]["verdict"], "failed");
  CHECK_EQ(mesh["thin"]["regions"][1]["face"], 7);
  REQUIRE_EQ(mesh["thin"]["regions"].size(), 3);
  const auto& sealedVoid = mesh["thin"]["regions"][2];
  CHECK_EQ(sealedVoid["kind"], "void");
  CHECK_EQ(sealedVoid["value"], 8);
  CHECK_EQ(sealedVoid["face"], 3);
  CHECK_EQ(sealedVoid["place"][2], 3);
  CHECK_EQ(sealedVoid["bodies"][0], "ball");
  CHECK_EQ(mesh["thin"]["sentence"], "FAIL: 1 wall thinner than 0.5: 0.25 at (1, 2, 3), face 0");
  CHECK_EQ(mesh["thin"]["countsDetails"], false);
  CHECK_EQ(mesh["thin"]["countsEdges"], false);
  CHECK_EQ(mesh["thin"]["regions"][0]["kind"], "wall");
  CHECK_EQ(mesh["thin"]["regions"][1]["kind"], "detail");
  CHECK_EQ(mesh["thin"]["regions"][1]["least"], 0.125);
  const test::DecodedMesh& thin = decoded.meshes[0].thinSurface.at(0);
  CHECK_EQ(thin.positions.size(), 4);
  CHECK_EQ(thin.description["boxMin"], mesh["boxMin"]);
  CHECK_EQ(thin.description["step"], mesh["step"]);
  REQUIRE_EQ(thin.faces.size(), 2);
  for (size_t i = 0; i < 2; ++i) {
    const uint32_t triangle = thin.faceIds[i];
    CHECK_EQ(thin.fields.at("region")[i], triangle == 0 ? 1 : 0);
    Vec3d wanted, found;
    for (size_t k = 0; k < 3; ++k) {
      found += thin.positions[thin.faces[i][k]];
      wanted += triangle == 0 ? std::array{p, q, r}[k] : std::array{q, p, (p + q) * 0.5 + (r - p) * 0.25}[k];
    }
    CHECK(length(found - wanted) < 1e-4);
  }
}

TEST_CASE("segments have area, median and centre") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 5, 0}};
  mesh.faces = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {0, 1, 4}};
  const std::vector<double> areas{0.5, 0.5, 2, 0}, values{1, 2, kNoValue, 4};
  const std::vector<Vec3d> barycentres{{0, 0, 0}, {3, 0, 0}, {1, 1, 0}, {9, 9, 9}};
  const auto segments = listSegments(mesh, areas, barycentres, std::vector<uint32_t>{4, 4, 1, 0xffffffff}, values);
  REQUIRE_EQ(segments.size(), 2);
  CHECK_EQ(segments[0].label, 1);
  CHECK(std::isnan(segments[0].median));
  CHECK_EQ(segments[1].faceCount, 2);
  CHECK_EQ(segments[1].area, 1);
  CHECK_EQ(segments[1].median, 2);
  CHECK_EQ(segments[1].centre.x, 1.5);
}

}  // namespace
}  // namespace asdfvk
