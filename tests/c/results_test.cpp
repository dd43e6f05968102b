// Results of the interface in C are those of the C++ library.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "asdf_vk/choices.h"
#include "asdf_vk/scene.h"
#include "c/c_objects.h"
#include "core/json.h"
#include "generate/creatures.h"
#include "support/bits.h"
#include "support/shapes.h"
#include "support/shared_session.h"

using namespace asdfvk;
using namespace asdfvk::test;

TEST_CASE("a comparison is that of the library, and needs scenes of one session") {
  const Mesh former = shapes::box({10, 10, 2}), mesh = shapes::box({10, 10, 0.5}, 3);
  const Owned<asdf_vk_session> own = sessionOfC("cpu"), otherSession = sessionOfC("cpu");
  const Owned<asdf_vk_scene> scene = sceneOfC(own.get(), mesh), before = sceneOfC(own.get(), former),
                             foreign = sceneOfC(otherSession.get(), former);
  const Owned<asdf_vk_options> options = optionsOfC({{"thinner-than", "0.8"}});
  asdf_vk_result* handle = nullptr;
  requireDone(asdf_vk_compare(scene.get(), before.get(), options.get(), nullptr, nullptr, &handle));
  const Owned<asdf_vk_result> result(handle);
  CHECK(jsonAt(result.get(), "/comparison/verdict") == "\"failed\"");
  CHECK(jsonAt(result.get(), "/comparison/newCount") == "1");
  Options same;
  same.measure = Measure::Thickness;
  same.thickness.thinnerThan = 0.8;
  Scene prepared(referenceSession(), mesh), preparedFormer(referenceSession(), former);
  const Result expected = prepared.compare(preparedFormer, same);
  for (const char* name : {"thickness", "thickness_change"})
    CHECK(haveSameBits(numbersOf(result.get(), name), *expected.field(name)->reals()));
  handle = nullptr;
  CHECK(asdf_vk_compare(scene.get(), foreign.get(), options.get(), nullptr, nullptr, &handle) != ASDF_VK_OK);
  CHECK(std::string(asdf_vk_last_error()).find("different sessions") != std::string::npos);
  CHECK(asdf_vk_compare(scene.get(), nullptr, options.get(), nullptr, nullptr, &handle) != ASDF_VK_OK);
  CHECK(handle == nullptr);
}

TEST_CASE("values, labels and the report are those of the library, with the backends cpu and vulkan") {
  const Mesh mesh = makeAnimal(4000).mesh;
  (void)vulkanSession();  // Turns the validation layers on.
  for (const BackendChoice choice : {BackendChoice::Cpu, BackendChoice::Vulkan}) {
    const char* const backend = nameOf(kBackendNames, choice);
    CAPTURE(backend);
    Session session({.backend = choice});
    Options options;
    options.seeds = SeedCount::ofShare(0.2);
    options.segmentation = Segmentation::Parts;
    options.measure = Measure::Both;
    const Result expected = session.compute(mesh, options);

    const Owned<asdf_vk_session> own = sessionOfC(backend);
    const Owned<asdf_vk_scene> scene = sceneOfC(own.get(), mesh);
    const Owned<asdf_vk_result> result =
        resultOfC(scene.get(), {{"seeds", "20%"}, {"segment", "parts"}, {"measure", "both"}});
    for (const char* name : {"sdf", "error", "thickness", "least_thickness"}) {
      CAPTURE(name);
      CHECK(haveSameBits(numbersOf(result.get(), name), *expected.field(name)->reals()));
    }
    size_t count = 0;
    requireDone(asdf_vk_result_field_count(result.get(), &count));
    REQUIRE(count == expected.fields.size());
    for (size_t i = 0; i < count; ++i) {
      asdf_vk_field field{};
      requireDone(asdf_vk_result_field(result.get(), i, &field));
      CHECK(field.name == expected.fields[i].name);
      CHECK(field.unit == expected.fields[i].unit);
      CHECK(field.count == expected.fields[i].itemCount());
    }
    const std::vector<double>& sdf = expected.sdf();
    std::vector<float> singles(sdf.size());
    requireDone(
        asdf_vk_result_copy(result.get(), "sdf", ASDF_VK_PER_FACE, ASDF_VK_FLOAT32, singles.data(), sdf.size()));
    CHECK(haveSameBits(singles, std::vector<float>(sdf.begin(), sdf.end())));
    std::vector<int32_t> labels(sdf.size());
    requireDone(
        asdf_vk_result_copy(result.get(), "segment", ASDF_VK_PER_FACE, ASDF_VK_INT32, labels.data(), labels.size()));
    CHECK(*std::max_element(labels.begin(), labels.end()) + 1 == std::stoi(jsonAt(result.get(), "/segmentCount")));
    CHECK(std::stod(jsonAt(result.get(), "/sdf/median")) == expected.report.sdf.median);
    CHECK(std::stod(jsonAt(result.get(), "/stageSeconds/bvh")) > 0);
    CHECK(std::stod(jsonAt(resultOfC(scene.get()).get(), "/stageSeconds/bvh")) == 0);  // The scene is prepared once.
    const Json report = Json::parse(jsonAt(result.get(), ""));
    CHECK(report.at("options").at("seeds") == "20%");
    CHECK(report.at("fields").size() == count);
  }
}

TEST_CASE("float vertices, signed corners, polygons and units") {
  const Owned<asdf_vk_session> session = sessionOfC("reference");
  const Mesh cube = shapes::cube();
  std::vector<float> vertices;
  for (const Vec3d& v : cube.vertices)
    for (const double x : {v.x, v.y, v.z}) vertices.push_back(static_cast<float>(x));
  asdf_vk_scene* handle = nullptr;
  requireDone(asdf_vk_scene_create(session.get(), vertices.data(), ASDF_VK_FLOAT32, cube.vertices.size(),
                                   cube.faces.data(), ASDF_VK_INT32, cube.faces.size(), "mm", &handle));
  const Owned<asdf_vk_scene> triangles(handle);
  const Owned<asdf_vk_result> ofTriangles = resultOfC(triangles.get(), {{"thinner-than", "0.3cm"}});
  CHECK(jsonAt(ofTriangles.get(), "/thickness/min") == "2.0");
  CHECK(jsonAt(ofTriangles.get(), "/thickness/verdict") == "\"failed\"");
  CHECK(jsonAt(ofTriangles.get(), "/unit") == "\"mm\"");
  CHECK(numbersOf(ofTriangles.get(), "thickness") == std::vector<double>(12, 2.0));

  const std::vector<double> corners{-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1};
  const std::vector<uint32_t> quads{0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
  const std::vector<uint64_t> first{0, 4, 8, 12, 16, 20, 24};
  requireDone(asdf_vk_scene_create_polygons(session.get(), corners.data(), ASDF_VK_FLOAT64, 8, quads.data(),
                                            ASDF_VK_UINT32, first.data(), 6, nullptr, &handle));
  const Owned<asdf_vk_scene> polygons(handle);
  asdf_vk_mesh mesh{};
  requireDone(asdf_vk_scene_mesh(polygons.get(), &mesh));
  CHECK(mesh.vertex_count == 8);
  CHECK(mesh.face_count == 6);
  CHECK(mesh.triangle_count == 12);
  CHECK(mesh.face_of_triangle[11] == 5);
  CHECK(std::string(mesh.unit).empty());
  Options thickness;
  thickness.measure = Measure::Thickness;
  const Result expected = referenceSession().compute(MeshView(corners, quads, first), thickness);
  const Owned<asdf_vk_result> ofPolygons = resultOfC(polygons.get(), {{"measure", "thickness"}, {"per", "vertex"}});
  CHECK(haveSameBits(numbersOf(ofPolygons.get(), "thickness"), *expected.field("thickness")->reals()));
  asdf_vk_field perVertex{};
  requireDone(asdf_vk_result_find(ofPolygons.get(), "thickness", ASDF_VK_PER_VERTEX, &perVertex));
  CHECK(perVertex.count == 8);
}

TEST_CASE("values at points; the orientation is that of each call") {
  const Owned<asdf_vk_session> session = sessionOfC("cpu");
  const Mesh sphere = shapes::inverted(shapes::sphere(4));
  const Owned<asdf_vk_scene> scene = sceneOfC(session.get(), sphere);
  CHECK(std::isnan(numbersOf(resultOfC(scene.get()).get(), "sdf")[0]));
  const std::vector<double> points{1, 0, 0, 0, 0, 1}, normals{1, 0, 0, 0, 0, 1};
  std::vector<double> values(2);
  const auto valuesAt = [&](const OptionTexts& texts) {
    return asdf_vk_values_at(scene.get(), optionsOfC(texts).get(), points.data(), normals.data(), 2, values.data(),
                             nullptr, nullptr);
  };
  requireDone(valuesAt({{"orient", "auto"}}));
  Session own({.backend = BackendChoice::Cpu});
  CHECK(haveSameBits(values, Scene(own, sphere, Orientation::Auto).valuesAt(points, normals)));
  requireDone(valuesAt({{"orient", "auto"}, {"measure", "thickness"}}));
  CHECK(values[0] == doctest::Approx(2).epsilon(0.01));
  CHECK(valuesAt({{"measure", "both"}}) == ASDF_VK_USAGE);
  for (const OptionTexts& accepted :
       {OptionTexts{{"rays", "12"}, {"angle", "90"}, {"false-hit-angle", "80"}},
        OptionTexts{{"outlier-deviations", "2"}, {"cone-rotation", "hashed"}, {"measure", "sdf"}},
        OptionTexts{{"definition", "cgal"}}, OptionTexts{{"recipe", "quality"}},
        OptionTexts{{"measure", "thickness"}, {"wall-angle", "150"}}})
    requireDone(valuesAt(accepted));
  for (const OptionTexts& refused :
       {OptionTexts{{"seeds", "all"}}, OptionTexts{{"smooth", "auto"}}, OptionTexts{{"per", "vertex"}},
        OptionTexts{{"thinner-than", "1"}}, OptionTexts{{"rays", "12"}, {"measure", "thickness"}}}) {
    CHECK(valuesAt(refused) == ASDF_VK_USAGE);
    CHECK_MESSAGE(
        std::string(asdf_vk_last_error()).starts_with(std::string(refused[0].first) + " has no effect on the"),
        std::string(asdf_vk_last_error()));
  }
  CHECK(numbersOf(resultOfC(scene.get(), {{"orient", "flip"}}).get(), "sdf")[0] == doctest::Approx(1.7).epsilon(0.03));
  CHECK(std::isnan(numbersOf(resultOfC(scene.get()).get(), "sdf")[0]));
}
