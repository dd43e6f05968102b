#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/vec3.h"
#include "reading.h"

using namespace asdfvk;
using asdfvk::test::errorOf;
using asdfvk::test::holds;

namespace {

const std::string kEmptyStep =
    "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
    "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n";

}  // namespace

TEST_CASE("STEP is recognised by its first line, and a truncated file is refused") {
  CHECK(detectFormat(std::span(kEmptyStep.data(), kEmptyStep.size()), "stl")->name == "step");
  for (const char* extension : {"step", "STP", ".p21"}) CHECK(formatOfExtension(extension)->name == "step");
  CHECK(errorOf("step", kEmptyStep.substr(0, 60)) ==
        "has no END-ISO-10303-21; the file is truncated; copy or export it again");
}

TEST_CASE("STEP without its module is refused with a remedy") {
  ::setenv("ASDF_VK_STEP_MODULE", "/nowhere/libasdf-vk-step.so", 1);
  CHECK(errorOf("step", kEmptyStep) ==
        "is STEP, which is read by a module that is not installed (libasdf-vk-step.so); export STL or 3MF, or install "
        "asdf-vk-step (docs/formats.md)");
  ::setenv("ASDF_VK_STEP_MODULE", ASDFVK_TEST_DIR, 1);
  CHECK(holds(errorOf("step", kEmptyStep), "its module cannot be loaded"));
  ::unsetenv("ASDF_VK_STEP_MODULE");
}

#ifndef ASDFVK_STEP_FILES
TEST_CASE("bodies of STEP files" * doctest::skip()) { MESSAGE("the module that reads STEP is not built"); }
#else

namespace {

/// The number of directed edges without the opposite edge.
uint64_t openEdgeCount(const Mesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int64_t> edges;
  for (const Face& face : mesh.faces)
    for (int i = 0; i < 3; ++i) {
      const uint32_t from = face[i], to = face[(i + 1) % 3];
      edges[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  uint64_t count = 0;
  for (const auto& edge : edges) count += static_cast<uint64_t>(std::abs(edge.second));
  return count;
}

double volumeOf(const Mesh& mesh) {
  double volume = 0;
  for (const Face& face : mesh.faces)
    volume += dot(mesh.vertices[face[0]], cross(mesh.vertices[face[1]], mesh.vertices[face[2]])) / 6;
  return volume;
}

std::pair<Vec3d, Vec3d> boundsOf(const Mesh& mesh) {
  std::pair<Vec3d, Vec3d> bounds{mesh.vertices.at(0), mesh.vertices.at(0)};
  for (const Vec3d& p : mesh.vertices)
    for (size_t axis = 0; axis < 3; ++axis) {
      bounds.first[axis] = std::min(bounds.first[axis], p[axis]);
      bounds.second[axis] = std::max(bounds.second[axis], p[axis]);
    }
  return bounds;
}

void checkPoint(const Vec3d& point, const Vec3d& expected) {
  for (size_t axis = 0; axis < 3; ++axis) CHECK(point[axis] == doctest::Approx(expected[axis]).epsilon(1e-9));
}

struct StepModuleOfBuild {
  StepModuleOfBuild() { ::setenv("ASDF_VK_STEP_MODULE", ASDFVK_STEP_MODULE, 1); }
  ~StepModuleOfBuild() { ::unsetenv("ASDF_VK_STEP_MODULE"); }
  StepModuleOfBuild(const StepModuleOfBuild&) = delete;
  StepModuleOfBuild& operator=(const StepModuleOfBuild&) = delete;
};

/// asdfvk-write-step-files writes the files.
std::string stepPath(const std::string& name) { return std::string(ASDFVK_STEP_FILES) + "/" + name + ".step"; }

std::string stepText(const std::string& name) {
  std::ifstream in(stepPath(name), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Mesh readStep(const std::string& name, const ReadOptions& options = {}) {
  const StepModuleOfBuild module;
  return readMesh(stepPath(name), options);
}

/// Replaces the contents of a string of an entity. start: the entity up to its first string, with the quote. Counts
/// from 0 on.
void setString(std::string& text, const std::string& start, size_t entity, size_t string, const std::string& value) {
  size_t begin = text.find(start);
  for (size_t i = 0; i < entity; ++i) begin = text.find(start, begin + 1);
  REQUIRE(begin != text.npos);
  begin += start.size();
  for (size_t i = 0; i < 2 * string; ++i) begin = text.find('\'', begin) + 1;
  text.replace(begin, text.find('\'', begin) - begin, value);
}

std::vector<NamedFaces> objectsOf(const std::string& text) {
  const StepModuleOfBuild module;
  return asdfvk::test::parse("step", text).objects;
}

std::string stepErrorOf(std::string_view text) {
  const StepModuleOfBuild module;
  return errorOf("step", text);
}

}  // namespace

TEST_CASE("a box in STEP is read in the unit of its file") {
  for (const auto& [name, unit, perMillimetre] :
       {std::tuple("box", "mm", 1.0), std::tuple("inch", "in", 1 / 25.4), std::tuple("metre", "m", 1e-3)}) {
    const std::string file = name;
    CAPTURE(file);
    const Mesh mesh = readStep(file);
    CHECK(mesh.faces.size() == 12);
    CHECK(mesh.vertices.size() == 8);
    CHECK(openEdgeCount(mesh) == 0);
    CHECK(mesh.unit == unit);
    CHECK(mesh.statedPartCount == 1);
    CHECK(mesh.skipped.empty());
    checkPoint(boundsOf(mesh).first, {0, 0, 0});
    checkPoint(boundsOf(mesh).second, Vec3d{10, 20, 30} * perMillimetre);
    CHECK(volumeOf(mesh) == doctest::Approx(6000 * std::pow(perMillimetre, 3)));
    CHECK(mesh.chordError == doctest::Approx(0.001 * std::sqrt(1400.0) * perMillimetre));
  }
}

TEST_CASE("curved bodies of STEP are closed, and their faces are within the chord error") {
  for (const char* name : {"tube", "sphere", "torus", "cone", "rounded"})
    for (const double chordError : {0.5, 0.1, 0.02}) {
      const std::string file = name;
      CAPTURE(file);
      CAPTURE(chordError);
      const Mesh mesh = readStep(file, {.chordError = chordError});
      CHECK(mesh.chordError == doctest::Approx(chordError));
      CHECK(openEdgeCount(mesh) == 0);
      CHECK(volumeOf(mesh) > 0);
      CHECK(mesh.skipped.empty());
      if (file != "sphere") continue;
      double greatest = 0;
      for (const Face& face : mesh.faces) {
        const Vec3d &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]], &c = mesh.vertices[face[2]];
        for (const Vec3d& p : {a, (a + b) / 2.0, (a + b + c) / 3.0})
          greatest = std::max(greatest, std::abs(length(p) - 10));
      }
      CHECK(greatest < chordError);
    }
}

TEST_CASE("the chord error has a unit, is at least the resolution, and costs faces") {
  const Mesh inMesh = readStep("tube", {.chordError = 0.02}),
             inMicrometres = readStep("tube", {.chordError = 20, .chordErrorUnit = LengthUnit::Micrometre}),
             finest = readStep("tube", {.chordError = 1e-12});
  CHECK(inMicrometres.chordError == doctest::Approx(0.02));
  CHECK(inMicrometres.faces == inMesh.faces);
  CHECK(inMicrometres.vertices == inMesh.vertices);
  CHECK(finest.chordError == doctest::Approx(30 * 0x1p-21).epsilon(1e-6));
  CHECK(readStep("inch", {.chordError = 0.254, .chordErrorUnit = LengthUnit::Millimetre}).chordError ==
        doctest::Approx(0.01));
  CHECK(inMesh.faces.size() > readStep("tube", {.chordError = 5}).faces.size());
  try {
    static_cast<void>(readStep("tube", {.maxFaces = 100, .chordError = 1e-4}));
    FAIL_CHECK("no error");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::TooManyFaces);
  }
}

TEST_CASE("the bodies of an assembly in STEP are placed, and a mirrored one stays outside out") {
  const Mesh mesh = readStep("assembly");
  CHECK(mesh.statedPartCount == 3);
  CHECK(mesh.faces.size() == 36);
  CHECK(openEdgeCount(mesh) == 0);
  CHECK(volumeOf(mesh) == doctest::Approx(18000));
  checkPoint(boundsOf(mesh).first, {-20, 0, 0});
  checkPoint(boundsOf(mesh).second, {110, 20, 30});
}

TEST_CASE("bodies of STEP have the name of their representation item, or else of their product") {
  using Objects = std::vector<NamedFaces>;
  const std::string kProduct = "PRODUCT('", kSolid = "MANIFOLD_SOLID_BREP('";
  std::string text = stepText("assembly");
  CHECK(objectsOf(text).empty());  // Its names are those that Open CASCADE makes up.
  setString(text, kProduct, 0, 1, "machine");
  setString(text, kProduct, 1, 1, "left arm");
  setString(text, kProduct, 2, 1, "");
  setString(text, kProduct, 2, 0, "A-113");
  CHECK(objectsOf(text) == Objects{{0, "left arm"}, {24, "A-113"}});
  setString(text, kSolid, 1, 0, "it''s \\X2\\00E4\\X0\\");
  CHECK(objectsOf(text) == Objects{{0, "left arm"}, {24, "it's \u00e4"}});
  setString(text, kSolid, 0, 0, "NONE");
  CHECK(objectsOf(text) == Objects{{0, "left arm"}, {24, "it's \u00e4"}});
  setString(text, kProduct, 1, 1, "");
  setString(text, kProduct, 1, 0, "");
  CHECK(objectsOf(text) == Objects{{0, "machine"}, {24, "it's \u00e4"}});
  setString(text, kProduct, 0, 1, "");
  setString(text, kProduct, 0, 0, "");
  CHECK(objectsOf(text) == Objects{{24, "it's \u00e4"}});

  std::string shell = stepText("shell");
  setString(shell, kProduct, 0, 1, "product");
  CHECK(objectsOf(shell) == Objects{{0, "product"}});
  setString(shell, "SHELL_BASED_SURFACE_MODEL('", 0, 0, "surface");
  CHECK(objectsOf(shell) == Objects{{0, "surface"}});
  setString(shell, "SHELL_BASED_SURFACE_MODEL('", 0, 0, "");
  setString(shell, "OPEN_SHELL('", 0, 0, "shell");
  CHECK(objectsOf(shell) == Objects{{0, "shell"}});
  std::string mixed = stepText("box_curve_point");
  setString(mixed, kSolid, 0, 0, std::string(300, 'x'));
  CHECK(objectsOf(mixed) == Objects{{0, std::string(200, 'x')}});
}

TEST_CASE("open surfaces of STEP are read; curves and points are reported") {
  CHECK(readStep("shell").faces.size() == 10);
  CHECK(openEdgeCount(readStep("shell")) == 4);
  CHECK(readStep("face").faces.size() == 2);
  const Mesh mixed = readStep("box_curve_point");
  CHECK(mixed.faces.size() == 12);
  CHECK(mixed.skipped == std::vector<std::string>{"1 curve", "1 point"});
  CHECK(stepErrorOf(stepText("curve")) == "has no body, only 1 curve");
}

TEST_CASE("STEP files without bodies, or with damage, are refused or report what was left out") {
  CHECK(stepErrorOf(kEmptyStep) == "cannot be read as STEP: no product of the file has a shape");
  const std::string box = stepText("box");
  std::string damaged = box;
  damaged.replace(damaged.find("PLANE("), 6, "PLANK(");
  const std::string error = stepErrorOf(damaged);
  CAPTURE(error);
  CHECK(error.starts_with("cannot be read as STEP: #"));
  CHECK(holds(error, "(face_geometry)"));

  std::string incomplete = box;
  const size_t firstFace = incomplete.find("CLOSED_SHELL('',(") + 17;
  incomplete.erase(firstFace, incomplete.find(',', firstFace) + 1 - firstFace);
  const StepModuleOfBuild module;
  const Mesh mesh = asdfvk::test::parse("step", incomplete);
  CHECK(mesh.faces.size() == 10);
  CHECK(mesh.skipped == std::vector<std::string>{"1 face that Open CASCADE cannot convert"});
}

#endif
