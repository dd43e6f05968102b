// What a file states beside its arrays: parts, unit, and what was left out.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "generate/shapes.h"
#include "support/shared_session.h"
#include "wall_check.h"

using namespace asdfvk;
using test::referenceSession;
using test::reportHas;

namespace {

/// `part` after the others, moved and scaled.
void addInstance(Mesh& mesh, const Mesh& part, double scale, const Vec3d& translation) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (const Vec3d& p : part.vertices) mesh.vertices.push_back(scale * p + translation);
  for (const Face& face : part.faces) mesh.faces.push_back({first + face[0], first + face[1], first + face[2]});
  ++mesh.statedPartCount;
}

Options partOptions() {
  Options options;
  options.seeds = SeedCount::all();
  options.cone.rayCount = 10;
  options.segmentation = Segmentation::Parts;
  return options;
}

std::vector<uint32_t> labelsOfParts(const Mesh& mesh) {
  const Result result = referenceSession().compute(mesh, partOptions());
  return std::get<std::vector<uint32_t>>(result.field("segment")->values);
}

}  // namespace

TEST_CASE("each component of an assembly is divided as if it were alone, and small ones are parts") {
  const Mesh animal = makeAnimal(2000).mesh, bolt = makeSphere(80).mesh;
  Mesh assembly;
  addInstance(assembly, animal, 1, {});
  addInstance(assembly, animal, 0.5, {50, 0, 0});
  addInstance(assembly, bolt, 0.01, {0, 50, 0});
  const std::vector<uint32_t> alone = labelsOfParts(animal), together = labelsOfParts(assembly);
  const size_t count = animal.faces.size(), aloneCount = std::set(alone.begin(), alone.end()).size();
  CHECK(aloneCount > 2);
  CHECK(std::set(together.begin(), together.end()).size() == 2 * aloneCount + 1);
  for (size_t first : {size_t{0}, count}) {
    std::set<std::pair<uint32_t, uint32_t>> pairs;  // The same division: labels correspond one to one.
    for (size_t i = 0; i < count; ++i) pairs.emplace(alone[i], together[first + i]);
    CHECK(pairs.size() == aloneCount);
  }
  assembly.statedPartCount = 0;  // Meshes of a format without parts have this value. The bolt takes the nearest part.
  const std::vector<uint32_t> joint = labelsOfParts(assembly);
  CHECK(std::count(joint.begin(), joint.end(), joint.back()) > static_cast<ptrdiff_t>(bolt.faces.size()));
}

TEST_CASE("a limit with a unit is converted to the unit of the mesh") {
  Mesh mesh = makeCube(400).mesh;
  mesh.unit = "in";
  mesh.skipped = {"12 points"};
  Options options;
  options.thickness.thinnerThan = {2.54, LengthUnit::Centimetre};
  const Report report = referenceSession().compute(mesh, options).report;
  CHECK(report.unit == "in");
  CHECK(*report.thickness->thinnerThan == 1);
  CHECK(reportHas(report, WarningCode::SkippedContent));
  mesh.unit.clear();
  try {
    (void)referenceSession().compute(mesh, options);
    FAIL("a limit in cm on a mesh without a unit");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::OptionConflict);
    CHECK(std::string(error.what()).starts_with("the limit is in cm, and the mesh states no unit"));
  }
}

TEST_CASE("parts of faces that are large against the shape diameter have a warning") {
  CHECK(reportHas(referenceSession().compute(makeSlab(200, 2, 0.05).mesh, partOptions()).report,
                  WarningCode::CoarseParts));
  CHECK_FALSE(
      reportHas(referenceSession().compute(makeAnimal(6000).mesh, partOptions()).report, WarningCode::CoarseParts));
}
