#include "cli/check_policy.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "asdf_vk/error.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

double thinnerOf(const LimitRules& limits, const std::string& mesh, const ComputationSettings& settings = {}) {
  const ComputationSettings applied = limits.applied(mesh, settings);
  CHECK_EQ(applied.failIfThinner.has_value(), applied.options.thickness.thinnerThan.has_value());
  return applied.failIfThinner ? applied.failIfThinner->value : 0;
}

std::string messageOf(const std::string& json) {
  const ScratchFolder folder;
  try {
    (void)readLimits(folder.write("limits.json", json));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST_CASE("all rules that match the path of a mesh apply, the last one wins, and null removes a limit") {
  const ScratchFolder folder;
  const LimitRules limits = readLimits(folder.write("limits.json", R"({"limits": [
      {"files": "*.stl", "fail-if-thinner": 0.8},
      {"files": "brackets/*", "fail-if-thinner": 1.2, "count-edges": true, "fail-if-voids": true},
      {"files": "vase.stl", "fail-if-thinner": null, "fail-if-thicker": "9mm"}]})"));
  CHECK_EQ(thinnerOf(limits, folder / "a.stl"), 0.8);
  CHECK_EQ(thinnerOf(limits, folder / "deep/a.stl"), 0.8);
  CHECK_EQ(thinnerOf(limits, folder / "brackets/deep/a.stl"), 1.2);
  CHECK_EQ(thinnerOf(limits, folder / "brackets/vase.stl"), 0);
  CHECK_EQ(thinnerOf(limits, folder / "a.ply"), 0);
  ComputationSettings settings;
  settings.failIfThinner = settings.options.thickness.thinnerThan = 0.5;
  CHECK_EQ(thinnerOf(limits, folder / "a.ply", settings), 0.5);  // No rule matches.
  CHECK_EQ(thinnerOf(limits, folder / "a.stl", settings), 0.8);
  const ComputationSettings bracket = limits.applied(folder / "brackets/a.stl", {});
  CHECK(bracket.options.thickness.countsEdges);
  CHECK(bracket.failsIfVoids);
  CHECK(bracket.options.measuresGap());
  CHECK(limits.applied(folder / "vase.stl", {}).options.thickness.thickerThan->unit == LengthUnit::Millimetre);
  const LimitRules copy = asdfvk::Json(limits).get<LimitRules>();
  CHECK_EQ(thinnerOf(copy, folder / "brackets/a.stl"), 1.2);
  CHECK_EQ(thinnerOf(copy, folder / "vase.stl"), 0);
}

TEST_CASE("a wrong file of limits is refused with its name and the reason") {
  CHECK(messageOf("{").find("limits.json is not a JSON object") != std::string::npos);
  CHECK(messageOf("{}").find("no list \"limits\"") != std::string::npos);
  CHECK(messageOf(R"({"limits": [{"fail-if-thinner": 1}]})").find("has no \"files\"") != std::string::npos);
  CHECK(messageOf(R"({"limits": [{"files": "*", "thinner": 1}]})").find("'thinner' is not one of fail-if-thinner|") !=
        std::string::npos);
  CHECK(messageOf(R"({"limits": [{"files": "*", "fail-if-thinner": -1}]})").find("'-1'") == std::string::npos);
  for (const char* const value : {"-1", "0", "\"thin\"", "[1]", "true"})
    CHECK(messageOf(R"({"limits": [{"files": "*", "fail-if-thinner": )" + std::string(value) + "}]}")
              .find("limits.json: ") != std::string::npos);
}

Finding findingAt(double x, double value = 0.5) {
  return {.kind = FindingKind::ThinWall,
          .value = value,
          .limit = 0.8,
          .place = Vec3d{x, 0, 0},
          .opposite = Vec3d{x, 0, value}};
}

std::vector<MeshRecord> recordsWith(const std::string& mesh, const asdfvk::Json& findings) {
  MeshRecord record;
  record.input = mesh;
  record.findings = findings;
  return {record};
}

asdfvk::Json failureAt(double x) {
  return {{"kind", "thinWall"}, {"level", "failure"}, {"value", 0.5},
          {"limit", 0.8},       {"place", {x, 0, 0}}, {"bodies", asdfvk::Json::array()}};
}

TEST_CASE("a place is known by its kind, bodies and position, unless it became worse") {
  const ScratchFolder folder;
  const std::string file = folder / "walls.json", mesh = folder / "parts/a.stl";
  updateBaseline(file, recordsWith(mesh, asdfvk::Json::array({failureAt(10)})));
  const Baseline baseline = readBaseline(file);
  const auto isKnown = [&](Finding finding, const std::string& of) {
    std::vector<Finding> findings{std::move(finding)};
    baseline.mark(of, findings);
    CHECK_EQ(findings[0].isKnown, findings[0].level == FindingLevel::Note);
    return findings[0].isKnown;
  };
  CHECK(isKnown(findingAt(10), mesh));
  CHECK(isKnown(findingAt(10.7, 0.48), mesh));
  CHECK_FALSE(isKnown(findingAt(10.9), mesh));
  CHECK_FALSE(isKnown(findingAt(10, 0.47), mesh));
  CHECK_FALSE(isKnown(findingAt(10), folder / "parts/b.stl"));
  Finding numbered = findingAt(10);  // The number of a component depends on the order of the faces.
  numbered.bodies = {"component 7"};
  CHECK(isKnown(numbered, mesh));
  Finding gap = findingAt(10), between = findingAt(10), far = findingAt(20);
  gap.kind = FindingKind::NarrowGap;
  between.bodies = {"lid", "base"};
  far.opposite = Vec3d{10.5, 0, 0};  // The baseline has the other side of the wall.
  CHECK_FALSE(isKnown(gap, mesh));
  CHECK_FALSE(isKnown(between, mesh));
  CHECK(isKnown(far, mesh));
}

TEST_CASE("an update replaces the places of its meshes, and keeps those of others and of failed meshes") {
  const ScratchFolder folder;
  const std::string file = folder / "walls.json", a = folder / "a.stl", b = folder / "b.stl";
  updateBaseline(file, recordsWith(a, asdfvk::Json::array({failureAt(1)})));
  updateBaseline(file, recordsWith(b, asdfvk::Json::array({failureAt(2), failureAt(3)})));
  updateBaseline(file, recordsWith(b, nullptr));  // Unreadable in this run.
  std::vector<MeshRecord> skipped = recordsWith(b, asdfvk::Json::array());
  CHECK_EQ(readBaseline(file).places.at("a.stl").size(), 1);
  CHECK_EQ(readBaseline(file).places.at("b.stl").size(), 2);
  skipped[0].findings = asdfvk::Json::array({failureAt(4)});
  skipped[0].status = MeshStatus::Skipped;  // An earlier run, also without a baseline, computed it.
  updateBaseline(file, skipped);
  CHECK_EQ(readBaseline(file).places.at("b.stl").size(), 1);
  updateBaseline(file, recordsWith(a, asdfvk::Json::array()));
  CHECK_EQ(readBaseline(file).places.count("a.stl"), 0);
  const std::string deep = R"({"x": )" + std::string(300'000, '[') + std::string(300'000, ']') +
                           R"(, "formatVersion": 1, "known": {}, "limits": []})";
  CHECK_THROWS_AS((void)readBaseline(folder.write("deep.json", deep)), Error);
  CHECK_THROWS_AS((void)readLimits(folder / "deep.json"), Error);
  CHECK_THROWS_AS((void)readBaseline(folder / std::string(300, 'a')), Error);
  for (const char* const text : {"{}", "[]", R"({"formatVersion": 2, "known": {}})",
                                 R"({"formatVersion": 1, "known": {"a": [{"kind": 3}]}})", R"({"formatVersion": 1})"}) {
    folder.write("walls.json", text);
    CHECK_THROWS_AS((void)readBaseline(file), Error);
  }
}

}  // namespace
}  // namespace asdfvk::test
