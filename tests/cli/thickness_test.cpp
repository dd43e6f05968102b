#include "cli/options.h"
#include "cli/program_under_test.h"
#include "cli/refusal.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

using Json = nlohmann::json;

ChildOutcome runThickness(const std::vector<std::string>& further) {
  std::vector<std::string> arguments{"--backend", "reference", "--quiet"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return runAsdf(arguments);
}

TEST_CASE("a limit implies the measure and all seeds, unless seeds are given") {
  const CommandLine plain = parseCommandLine({"a.ply"});
  CHECK(plain.options.measure == Measure::ShapeDiameter);
  for (const char* option : {"--thinner-than", "--fail-if-thinner"}) {
    const CommandLine line = parseCommandLine({"a.ply", option, "0.5"});
    CHECK(line.options.measure == Measure::Thickness);
    CHECK(line.options.seeds.kind == SeedCount::Kind::All);
    CHECK_EQ(line.options.thickness.thinnerThan.value(), 0.5);
    CHECK_EQ(line.fields, std::vector<std::string>{"thickness", "sdf", "seed"});
    CHECK_EQ(line.pictureOf, "thickness");
  }
  CHECK(parseCommandLine({"a.ply", "--thinner-than", "1", "--seeds", "5%"}).options.seeds.kind ==
        SeedCount::Kind::Share);
  CHECK(parseCommandLine({"a.ply", "--thinner-than", "1", "--max-error", "1%"}).options.seeds.kind ==
        SeedCount::Kind::Share);
  CHECK(parseCommandLine({"a.ply", "--measure", "thickness"}).options.seeds.kind == SeedCount::Kind::Share);
  CHECK_EQ(parseCommandLine({"a.ply", "--measure", "thickness", "--fields", "sdf"}).fields,
           std::vector<std::string>{"sdf"});
  const CommandLine both = parseCommandLine({"a.ply", "--thinner-than", "2", "--fail-if-thinner", "1"});
  CHECK_EQ(both.options.thickness.thinnerThan.value(), 2);
  CHECK_EQ(both.failIfThinner.value(), 1);
}

TEST_CASE("options of the thickness are refused where they contradict others") {
  const auto isRefused = [](const std::vector<std::string>& arguments, const std::string& part) {
    const std::string message = refusal(arguments);
    CHECK_MESSAGE(message.find(part) != std::string::npos, message);
  };
  isRefused({"a.ply", "--wall-angle", "120"}, "--wall-angle needs --measure thickness");
  isRefused({"a.ply", "--measure", "sdf", "--thinner-than", "1"}, "contradict --measure sdf");
  isRefused({"a.ply", "--thinner-than", "1", "--fail-if-thinner", "2"}, "--fail-if-thinner is above --thinner-than");
  isRefused({"a.ply", "--fields", "thickness"}, "--fields thickness needs --measure thickness");
  isRefused({"a.ply", "--picture", "a.png", "--picture-of", "thickness"}, "--picture-of thickness needs");
  for (const char* wrong : {"0", "-1", "nan", "thin", "1e999"}) {
    isRefused({"a.ply", "--thinner-than", wrong}, "--thinner-than: ");
    isRefused({"a.ply", "--fail-if-thinner", wrong}, "--fail-if-thinner: ");
  }
  for (const char* wrong : {"90", "181", "wide"})
    isRefused({"a.ply", "--measure", "thickness", "--wall-angle", wrong}, "--wall-angle: ");
  isRefused({"a.ply", "--measure", "diameter"}, "--measure: 'diameter' is not one of sdf|thickness");
}

TEST_CASE("the document has the percentiles and the regions") {
  const ScratchFolder folder;
  const std::string cube = folder.write("cube.off", cubeOff());
  const ChildOutcome outcome = runThickness({cube, "--json", "--thinner-than", "1.5", "-o", folder / "out.csv"});
  INFO(outcome.error);
  REQUIRE_EQ(outcome.exitCode, 0);
  const Json json = Json::parse(outcome.output), thickness = json.at("thickness");
  for (const char* key : {"min", "percentile1", "percentile5", "median", "percentile95", "max"})
    CHECK_EQ(thickness.at(key).get<double>(), doctest::Approx(1));
  CHECK_EQ(thickness.at("noValueCount"), 0);
  REQUIRE_EQ(thickness.at("thinRegions").size(), 1);
  const Json& region = thickness.at("thinRegions").at(0);
  CHECK_EQ(region.at("faceCount"), 12);
  CHECK_EQ(region.at("area").get<double>(), doctest::Approx(6));
  CHECK_EQ(region.at("areaShare").get<double>(), doctest::Approx(1));
  CHECK_EQ(region.at("min").get<double>(), doctest::Approx(1));
  CHECK_EQ(region.at("place").size(), 3);
  CHECK_EQ(json.at("options").at("measure"), "thickness");
  CHECK_EQ(json.at("options").at("thinnerThan"), 1.5);
  CHECK(json.at("options").at("failIfThinner").is_null());
  CHECK_EQ(json.at("options").at("wallAngleDegrees"), 120);
  CHECK(json.at("stageSeconds").at("thickness").get<double>() > 0);
  CHECK_EQ(linesOf(folder.read("out.csv")).at(0), "face,thickness,sdf,seed");

  const Json plain = Json::parse(runThickness({cube, "--json", "-o", folder / "out.csv"}).output);
  CHECK(plain.at("thickness").is_null());
  CHECK_EQ(plain.at("options").at("measure"), "sdf");
  CHECK(plain.at("options").at("wallAngleDegrees").is_null());
}

TEST_CASE("a mesh that is thinner than allowed ends with 6, after its result was written") {
  const ScratchFolder folder;
  const std::string cube = folder.write("cube.off", cubeOff());
  const ChildOutcome thin = runThickness({cube, "--fail-if-thinner", "1.5", "-o", folder / "thin.csv", "--json"});
  checkFailure(thin, 6, "thinner than 1.5: thickness 1 at (");
  CHECK_FALSE(folder.read("thin.csv").empty());
  CHECK_EQ(Json::parse(thin.output).at("thickness").at("thinRegions").size(), 1);
  CHECK_EQ(runThickness({cube, "--fail-if-thinner", "0.9", "-o", folder / "out.csv"}).exitCode, 0);
  CHECK_EQ(runThickness({cube, "--thinner-than", "1.5", "-o", folder / "out.csv"}).exitCode, 0);
  // Several meshes: all are computed, and the code of the first failure is returned.
  const std::string sphere = folder.write("sphere.off", sphereOff(6));
  CHECK_EQ(runThickness({sphere, cube, "--fail-if-thinner", "1.5"}).exitCode, 6);
  // A limit that could not be checked is not passed.
  const std::string open = folder.write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const ChildOutcome none = runThickness({open, "--fail-if-thinner", "1", "-o", folder / "out.csv"});
  INFO(none.error);
  CHECK_EQ(none.exitCode, 2);
  CHECK(none.error.find("no face has a thickness") != std::string::npos);
}

TEST_CASE("the report lists percentiles and the largest regions") {
  const ScratchFolder folder;
  const std::string cube = folder.write("cube.off", cubeOff());
  const ChildOutcome outcome =
      runAsdf({cube, "--backend", "reference", "--thinner-than", "1.5", "-o", folder / "out.csv"});
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 0);
  for (const char* part : {"\n  thickness min 1, by area p1 1, p5 1, p50 1, p95 1, max 1\n",
                           "\n  thin      1 region below 1.5: area 6 (100 %)\n", "12 faces, area 6"})
    CHECK_MESSAGE(outcome.error.find(part) != std::string::npos, part);
  const ChildOutcome none =
      runAsdf({cube, "--backend", "reference", "--thinner-than", "0.5", "-o", folder / "out.csv"});
  CHECK(none.error.find("\n  thin      no face below 0.5\n") != std::string::npos);
}

}  // namespace
}  // namespace asdfvk::test
