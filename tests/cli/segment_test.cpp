#include "cli/program_under_test.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

using Json = nlohmann::json;

/// Runs with the reference backend and all seeds, quietly.
ChildOutcome runSegment(const std::vector<std::string>& further) {
  std::vector<std::string> arguments{"--backend", "reference", "--seeds", "all", "--rays", "10", "--quiet"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return runAsdf(arguments);
}

Json documentOf(const std::vector<std::string>& further) {
  const ChildOutcome outcome = runSegment(further);
  INFO(outcome.error);
  REQUIRE_EQ(outcome.exitCode, 0);
  return Json::parse(outcome.output);
}

Json fieldOf(const Json& document, const std::string& name) {
  for (const Json& field : document.at("fields"))
    if (field.at("name") == name) return field;
  return nullptr;
}

TEST_CASE("the document has the options, the smoothed range, the number of segments and the fields") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(10));
  const Json plain = documentOf({mesh, "--json"});
  CHECK(plain.at("postprocess").is_null());
  CHECK(plain.at("segmentCount").is_null());
  CHECK_EQ(plain.at("options").at("postprocess"), "none");
  CHECK_EQ(plain.at("options").at("segment"), "none");
  CHECK(fieldOf(plain, "normalized").is_null());

  const Json json = documentOf(
      {mesh, "--json", "--segment", "cgal", "--clusters", "3", "--smoothness", "0.1", "--cgal-expansion", "first"});
  const Json& options = json.at("options");
  CHECK_EQ(options.at("postprocess"), "cgal");
  CHECK_EQ(options.at("segment"), "cgal");
  CHECK_EQ(options.at("clusters"), 3);
  CHECK_EQ(options.at("smoothness"), 0.1);
  CHECK_EQ(options.at("cgalExpansion"), "first");
  CHECK(json.at("postprocess").at("min").get<double>() >= json.at("sdf").at("min").get<double>());
  CHECK(json.at("postprocess").at("max").get<double>() <= json.at("sdf").at("max").get<double>());
  CHECK_EQ(fieldOf(json, "normalized").at("type"), "float64");
  CHECK_EQ(fieldOf(json, "normalized").at("unit"), "");
  CHECK_EQ(fieldOf(json, "normalized").at("max"), 1);
  CHECK_EQ(fieldOf(json, "segment").at("type"), "uint32");
  CHECK_EQ(fieldOf(json, "segment").at("max").get<int>() + 1, json.at("segmentCount").get<int>());
  for (const char* stage : {"postprocess", "segment"}) CHECK(json.at("stageSeconds").at(stage).get<double>() > 0);
}

TEST_CASE("the report has the smoothed range and the number of segments") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(10));
  const ChildOutcome outcome =
      runAsdf({mesh, "--backend", "reference", "--seeds", "all", "--segment", "cgal", "--clusters", "2", "--verbose"});
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 0);
  for (const char* part : {"\n  smoothed  ", "\n  segments  ", ", postprocess ", ", segment "})
    CHECK_MESSAGE(outcome.error.find(part) != std::string::npos, part);
}

TEST_CASE("the fields that are computed are written, unless --fields chooses") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(10));
  const auto headerOf = [&](const std::vector<std::string>& further) {
    std::vector<std::string> arguments{mesh, "-o", folder / "out.csv"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    const ChildOutcome outcome = runSegment(arguments);
    INFO(outcome.error);
    REQUIRE_EQ(outcome.exitCode, 0);
    return linesOf(folder.read("out.csv")).at(0);
  };
  CHECK_EQ(headerOf({}), "face,sdf,seed");
  CHECK_EQ(headerOf({"--postprocess", "cgal"}), "face,sdf,seed,normalized");
  CHECK_EQ(headerOf({"--segment", "cgal"}), "face,sdf,seed,normalized,segment");
  CHECK_EQ(headerOf({"--segment", "cgal", "--fields", "segment,sdf"}), "face,segment,sdf");
  // In PLY, the colours are those of the shape diameter.
  CHECK_EQ(runSegment({mesh, "-o", folder / "out.ply", "--segment", "cgal"}).exitCode, 0);
  const std::string ply = folder.read("out.ply");
  for (const char* part : {"quality is sdf (shape diameter)", "property float normalized\n", "property uint segment\n"})
    CHECK_MESSAGE(ply.find(part) != std::string::npos, part);
}

TEST_CASE("processes give the same segments, whatever their number of threads") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(16));
  const auto segmentsOn = [&](const char* threads) {
    CHECK_EQ(runSegment({mesh, "-o", folder / "out.csv", "--segment", "cgal", "--threads", threads}).exitCode, 0);
    return folder.read("out.csv");
  };
  const std::string expected = segmentsOn("1");
  CHECK(segmentsOn("2") == expected);
  CHECK(segmentsOn("4") == expected);
}

TEST_CASE("--segment without a value writes parts, in the file, the report and the document") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(10));
  const ChildOutcome outcome = runAsdf({"--segment", mesh, "--backend", "reference", "--seeds", "all", "--rays", "10",
                                        "-o", folder / "out.csv", "--json"});
  INFO(outcome.error);
  REQUIRE_EQ(outcome.exitCode, 0);
  CHECK_EQ(linesOf(folder.read("out.csv")).at(0), "face,sdf,seed,segment");
  CHECK(outcome.error.find("\n  parts     1\n") != std::string::npos);
  CHECK(outcome.error.find("of the area") == std::string::npos);
  const Json json = Json::parse(outcome.output);
  CHECK_EQ(json.at("options").at("segment"), "parts");
  CHECK_EQ(json.at("parts").at("areaShares").size(), json.at("segmentCount"));
  CHECK(json.at("postprocess").is_null());
  CHECK(json.at("stageSeconds").at("segment").get<double>() > 0);
  CHECK_EQ(fieldOf(json, "segment").at("type"), "uint32");
  const Json cut = documentOf({mesh, "--json", "--segment", "parts", "--parts", "4"});
  CHECK_EQ(cut.at("segmentCount"), 4);
  CHECK_EQ(cut.at("parts").at("areaShares").size(), 4);
  CHECK_EQ(cut.at("options").at("parts"), 4);
  const std::string cube = folder.write("cube.off", cubeOff());
  const Json few = documentOf({cube, "--json", "--segment", "parts", "--parts", "50"});
  REQUIRE_EQ(few.at("warnings").size(), 2);
  CHECK_EQ(few.at("warnings").at(0).at("code"), "coarseParts");
  CHECK_EQ(few.at("warnings").at(1).at("code"), "partCountDiffers");
}

TEST_CASE("a mesh without values, and one with too few, end with 2 and a remedy") {
  const ScratchFolder folder;
  const std::string open = folder.write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  checkFailure(runSegment({open, "--postprocess", "cgal"}), 2,
               "no face has a value; try --orient auto or flip, or drop --postprocess");
  const auto ending = [&](std::vector<std::string> options) {
    options.push_back(open);
    const std::string error = runSegment(options).error;
    return error.substr(std::min(error.size(), error.rfind(';')));
  };
  CHECK_EQ(ending({"--postprocess", "cgal"}), "; try --orient auto or flip, or drop --postprocess\n");
  CHECK_EQ(ending({"--segment"}), "; try --orient auto or flip, or drop --segment\n");
  CHECK_EQ(ending({"--segment", "cgal"}), "; try --orient auto or flip, or drop --segment\n");
  CHECK_EQ(ending({"--segment", "--postprocess", "cgal"}),
           "; try --orient auto or flip, or drop --postprocess and --segment\n");
  const std::string cube = folder.write("cube.off", cubeOff());
  const ChildOutcome outcome = runSegment({cube, "--segment", "cgal", "--clusters", "13", "--json"});
  checkFailure(outcome, 2, "fewer than 13 different values; 13 clusters need at least as many; give fewer --clusters");
  CHECK_EQ(Json::parse(outcome.output).at("code"), "tooFewValues");
  CHECK_EQ(folder.names(), std::vector<std::string>{"cube.off", "open.off"});
}

TEST_CASE("a picture of the segments and of the normalised values" * doctest::test_suite("slow")) {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(10));
  for (const std::string field : {"segment", "normalized"}) {
    const ChildOutcome outcome = runSegment({mesh, "-o", folder / "out.csv", "--segment", "cgal", "--smoothness", "0",
                                             "--picture", folder / (field + ".png"), "--picture-of", field});
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 0);
  }
  CHECK_NE(folder.read("segment.png"), folder.read("normalized.png"));
}

}  // namespace
}  // namespace asdfvk::test
