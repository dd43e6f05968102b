#include <fmt/core.h>

#include "cli/command_line.h"
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

TEST_CASE("a limit implies the measure, and nothing about the seeds") {
  const CommandLine plain = parseCommandLine({"a.ply"});
  CHECK(plain.computation.options.measure == Measure::ShapeDiameter);
  for (const char* option : {"--thinner-than", "--fail-if-thinner"}) {
    const CommandLine line = parseCommandLine({"a.ply", option, "0.5"});
    CHECK(line.computation.options.measure == Measure::Thickness);
    CHECK(line.computation.options.seeds.share == plain.computation.options.seeds.share);
    CHECK(line.computation.options.seeds.kind == plain.computation.options.seeds.kind);
    CHECK_EQ(line.computation.options.thickness.thinnerThan.value(), 0.5);
    CHECK_FALSE(line.computation.options.thickness.countsDetails);
    CHECK_FALSE(line.computation.options.thickness.countsEdges);
    CHECK_FALSE(line.computation.options.thickness.findsNextWall);
    CHECK_FALSE(parseCommandLine({"a.ply", "--verbose"}).computation.options.thickness.findsNextWall);
    CHECK(parseCommandLine({"a.ply", option, "0.5", "--verbose"}).computation.options.thickness.findsNextWall);
    CHECK_EQ(fieldNames(line.outputs, line.computation.options),
             std::vector<std::string>{"thickness", "least_thickness"});
    CHECK_FALSE(line.computation.options.measuresDiameter());
    CHECK(line.outputs.pictureOf.empty());  // The thin places.
    CHECK(parseCommandLine({"a.ply", option, "0.5", "--count-edges"}).computation.options.thickness.countsEdges);
  }
  const CommandLine ofFields = parseCommandLine({"a.ply", "--measure", "thickness", "--fields", "sdf"});
  CHECK_EQ(ofFields.outputs.fields, std::vector<std::string>{"sdf"});
  CHECK(ofFields.computation.options.measure == Measure::Both);
  const CommandLine ofBoth = parseCommandLine({"a.ply", "--measure", "both", "--thinner-than", "1"});
  CHECK_EQ(fieldNames(ofBoth.outputs, ofBoth.computation.options),
           std::vector<std::string>{"thickness", "least_thickness", "sdf", "seed"});
  CHECK(parseCommandLine({"a.ply", "--thinner-than", "1", "--picture", "a.png", "--picture-of", "sdf"})
            .computation.options.measuresDiameter());
  CHECK(parseCommandLine({"a.ply", "--thinner-than", "1", "--segment"}).computation.options.measuresDiameter());
  const CommandLine both = parseCommandLine({"a.ply", "--thinner-than", "2", "--fail-if-thinner", "2.0"});
  CHECK_EQ(both.computation.options.thickness.thinnerThan.value(), 2);
  CHECK_EQ(both.computation.failIfThinner.value(), 2);
}

TEST_CASE("options of the thickness are refused where they contradict others") {
  const auto isRefused = [](const std::vector<std::string>& arguments, const std::string& part) {
    const std::string message = refusal(arguments);
    CHECK_MESSAGE(message.find(part) != std::string::npos, message);
  };
  isRefused({"a.ply", "--wall-angle", "120"}, "--wall-angle needs --measure thickness");
  isRefused({"a.ply", "--measure", "sdf", "--thinner-than", "1"}, "contradicts --measure sdf");
  isRefused({"a.ply", "--count-edges"}, "--count-edges needs --thinner-than or --closer-than");
  isRefused({"a.ply", "--measure", "thickness", "--count-details"},
            "--count-details needs --thinner-than or --closer-than");
  isRefused({"a.ply", "--thinner-than", "1", "--allow-sharp-edges"},
            "--allow-sharp-edges was removed: thin edges do not count any more; --count-edges counts them");
  for (const char* limit : {"0.5", "2"})
    isRefused({"a.ply", "--thinner-than", "1", "--fail-if-thinner", limit}, "have different limits");
  for (const std::string field : {"thickness", "least_thickness"}) {
    isRefused({"a.ply", "--fields", field}, "--fields " + field + " needs --measure thickness");
    isRefused({"a.ply", "--picture", "a.png", "--picture-of", field}, "--picture-of " + field + " needs");
  }
  for (const char* wrong : {"0", "-1", "nan", "thin", "1e999"}) {
    isRefused({"a.ply", "--thinner-than", wrong}, "--thinner-than: ");
    isRefused({"a.ply", "--fail-if-thinner", wrong}, "--fail-if-thinner: ");
  }
  for (const char* wrong : {"90", "181", "wide"})
    isRefused({"a.ply", "--measure", "thickness", "--wall-angle", wrong}, "--wall-angle: ");
  isRefused({"a.ply", "--measure", "diameter"}, "--measure: 'diameter' is not one of sdf|thickness|both|gap|");
}

TEST_CASE("limits of gaps and of thick bodies imply what they limit, together with the other limits") {
  const auto measureOf = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "a.ply");
    return parseCommandLine(arguments).computation.options.measure;
  };
  CHECK(measureOf({"--closer-than", "1"}) == Measure::Gap);
  CHECK(measureOf({"--fail-if-closer", "1mm"}) == Measure::Gap);
  CHECK(measureOf({"--fail-if-voids"}) == Measure::Gap);
  CHECK(measureOf({"--fail-if-contact"}) == Measure::Gap);
  CHECK(measureOf({"--thicker-than", "1"}) == Measure::Thickness);
  CHECK(measureOf({"--fail-if-thicker", "1", "--fail-if-closer", "2"}) == Measure::ThicknessAndGap);
  CHECK(measureOf({"--thinner-than", "1", "--fail-if-voids"}) == Measure::ThicknessAndGap);
  CHECK(measureOf({"--measure", "both", "--closer-than", "1"}) == Measure::All);
  CHECK(measureOf({"--measure", "gap", "--thinner-than", "1"}) == Measure::ThicknessAndGap);
  CHECK(measureOf({"--measure", "gap", "--fields", "gap,sdf"}) == Measure::DiameterAndGap);
  const auto isRefused = [](std::vector<std::string> arguments, const std::string& reason) {
    arguments.insert(arguments.begin(), "a.ply");
    const std::string message = refusal(arguments);
    CHECK_MESSAGE(message.find(reason) != std::string::npos, message);
  };
  isRefused({"--closer-than", "1", "--fail-if-closer", "2"}, "have different limits");
  isRefused({"--thicker-than", "1", "--fail-if-thicker", "1mm"}, "have different limits");
  for (const std::string option : {"--closer-than", "--thicker-than"})
    isRefused({"--measure", "sdf", option, "1"}, option + " contradicts --measure sdf");
  for (const std::string option : {"--fail-if-voids", "--fail-if-contact"})
    isRefused({"--measure", "sdf", option}, option + " contradicts --measure sdf");
  isRefused({"--fields", "least_gap"}, "--fields least_gap needs --measure gap");
  for (const char* const option : {"--fail-if-closer", "--fail-if-thicker", "--closer-than", "--thicker-than"})
    isRefused({option, "0"}, option);
  for (const char* const option : {"--fail-if-voids", "--fail-if-contact"})
    CHECK_FALSE(parseCommandLine({"a.ply", option}).outputs.writesResult);
  CHECK(parseCommandLine({"a.ply", "--closer-than", "1", "--count-edges"}).computation.options.thickness.countsEdges);
}

TEST_CASE("gaps, voids and thick bodies end with 6, and with 5 if they cannot be judged") {
  const ScratchFolder folder;
  const std::string two = folder.write(
      "two.obj", "o left\n" + boxObj({0, 0, 0}, {1, 1, 1}) + "o right\n" + boxObj({1.2, 0, 0}, {2.2, 1, 1}));
  checkFailure(runThickness({two, "--fail-if-closer", "0.3"}), 6, "FAIL: 1 gap closer than 0.3: 0.2 at (");
  checkFailure(runThickness({two, "--fail-if-closer", "0.3"}), 6, "between left and right");
  checkFailure(runThickness({two, "--fail-if-thicker", "0.9"}), 6, "FAIL: 2 bodies thicker than 0.9: ");
  CHECK_EQ(runThickness({two, "--fail-if-closer", "0.1", "--fail-if-thicker", "1.1", "--fail-if-voids"}).exitCode, 0);
  // Each check that failed has a line.
  const ChildOutcome all = runThickness({two, "--fail-if-thinner", "1.1", "--fail-if-closer", "0.3"});
  CHECK_EQ(all.exitCode, 6);
  for (const char* const line : {"FAIL: 1 gap closer", "FAIL: 2 walls thinner"})
    CHECK_MESSAGE(all.error.find(line) != std::string::npos, all.error);
  const std::string hollow =
      folder.write("hollow.obj", boxObj({0, 0, 0}, {5, 5, 5}) + boxObj({1, 1, 1}, {4, 4, 4}, true));
  checkFailure(runThickness({hollow, "--fail-if-voids"}), 6, "FAIL: 1 sealed void, volume 27 at (");
  const std::string open = folder.write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  for (const std::vector<std::string>& check : {std::vector<std::string>{"--fail-if-closer", "1"},
                                                {"--fail-if-thicker", "1"},
                                                {"--fail-if-voids"},
                                                {"--fail-if-contact"}}) {
    std::vector<std::string> arguments{open};
    arguments.insert(arguments.end(), check.begin(), check.end());
    const ChildOutcome outcome = runThickness(arguments);
    checkFailure(outcome, 5, "NOT JUDGED: no ");
    checkFailure(outcome, 5, "3 open edges");
  }
}

TEST_CASE("bodies in contact end with 6 if that is asked, and the text has the verdicts on the space") {
  const ScratchFolder folder;
  const auto pair = [&](const std::string& name, double x) {
    return folder.write(name, "o lid\n" + boxObj({0, 0, 0}, {1, 1, 1}) + "o base\n" + boxObj({x, 0, 0}, {x + 1, 1, 1}));
  };
  const std::string apart = pair("apart.obj", 1.5), touching = pair("touching.obj", 1),
                    crossing = pair("crossing.obj", 0.5),
                    inside = folder.write("inside.obj", "o lid\n" + boxObj({0, 0, 0}, {5, 5, 5}) + "o base\n" +
                                                            boxObj({1, 1, 1}, {2, 2, 2})),
                    hollow =
                        folder.write("hollow.obj", boxObj({0, 0, 0}, {5, 5, 5}) + boxObj({1, 1, 1}, {4, 4, 4}, true)),
                    open = folder.write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  for (const std::string& mesh : {touching, crossing, inside}) {
    checkFailure(runThickness({mesh, "--fail-if-contact"}), 6, "FAIL: 1 pair of bodies in contact: lid and base");
    CHECK_EQ(runThickness({mesh, "--fail-if-closer", "0.3"}).exitCode, 0);
  }
  CHECK_EQ(runThickness({apart, "--fail-if-contact", "--fail-if-closer", "0.3"}).exitCode, 0);
  const auto hasLine = [](const std::vector<std::string>& arguments, int exitCode, const std::string& line) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--backend", "reference"});
    const ChildOutcome outcome = runAsdf(all);
    CHECK_EQ(outcome.exitCode, exitCode);
    CHECK_MESSAGE(outcome.error.find("\n  " + line) != std::string::npos, outcome.error);
  };
  hasLine({touching, "--fail-if-contact"}, 6, "contact   FAIL: 1 pair of bodies in contact: lid and base\n");
  hasLine({apart, "--fail-if-contact"}, 0, "contact   PASS: no bodies in contact\n");
  hasLine({touching, "--fail-if-closer", "0.3"}, 0, "contact   1 pair of bodies in contact: lid and base\n");
  hasLine({hollow, "--fail-if-voids"}, 6, "voids     FAIL: 1 sealed void, volume 27 at (");
  hasLine({hollow, "--fail-if-voids", "--verbose"}, 6, "voids     FAIL: 1 sealed void, volume 27 at (");
  hasLine({touching, "--fail-if-voids"}, 0, "voids     PASS: no sealed void\n");
  hasLine({open, "--fail-if-voids"}, 5, "voids     NOT JUDGED: no sealed void\n");
}

TEST_CASE("the document has the verdict, the percentiles and the regions") {
  const ScratchFolder folder;
  const std::string cube = folder.write("cube.off", cubeOff());
  const ChildOutcome outcome = runThickness({cube, "--json", "--thinner-than", "1.5", "-o", folder / "out.csv"});
  INFO(outcome.error);
  REQUIRE_EQ(outcome.exitCode, 0);
  const Json json = Json::parse(outcome.output), thickness = json.at("thickness");
  CHECK_EQ(json.at("size"), Json({1, 1, 1}));
  CHECK_EQ(thickness.at("verdict"), "failed");
  for (const char* key : {"min", "percentile1", "percentile5", "median", "percentile95", "max"})
    CHECK_EQ(thickness.at(key).get<double>(), doctest::Approx(1));
  CHECK(thickness.at("minFace").get<int>() < 12);
  CHECK_EQ(thickness.at("greatestSection").at("diameter").get<double>(), doctest::Approx(1).epsilon(2e-3));
  CHECK_EQ(thickness.at("noValueCount"), 0);
  const std::string sentence = thickness.at("sentence");
  CHECK_MESSAGE(sentence.starts_with("FAIL: 1 wall thinner than 1.5: 1 at ("), sentence);
  CHECK_EQ(thickness.at("unjudged").at("openCount"), 0);
  REQUIRE_EQ(thickness.at("regions").size(), 1);
  const Json& region = thickness.at("regions").at(0);
  CHECK_EQ(region.at("faceCount"), 12);
  CHECK_EQ(region.at("area").get<double>(), doctest::Approx(6));
  CHECK_EQ(region.at("areaShare").get<double>(), doctest::Approx(1));
  CHECK_EQ(region.at("min").get<double>(), doctest::Approx(1));
  CHECK_EQ(region.at("kind"), "wall");
  CHECK_EQ(region.at("place").size(), 3);
  CHECK_EQ(region.at("opposite").size(), 3);
  CHECK_EQ(json.at("options").at("measure"), "thickness");
  CHECK_EQ(json.at("options").at("thinnerThan"), 1.5);
  CHECK(json.at("options").at("failIfThinner").is_null());
  CHECK_EQ(json.at("options").at("countDetails"), false);
  CHECK_EQ(json.at("options").at("countEdges"), false);
  CHECK_EQ(json.at("options").at("wallAngleDegrees"), 120);
  CHECK(json.at("stageSeconds").at("thickness").get<double>() > 0);
  CHECK_EQ(linesOf(folder.read("out.csv")).at(0), "face,thickness,least_thickness");

  const Json plain = Json::parse(runThickness({cube, "--json", "-o", folder / "out.csv"}).output);
  CHECK(plain.at("thickness").is_null());
  CHECK_EQ(plain.at("options").at("measure"), "sdf");
  CHECK(plain.at("options").at("wallAngleDegrees").is_null());
  const Json unlimited =
      Json::parse(runThickness({cube, "--json", "--measure", "thickness", "-o", folder / "out.csv"}).output);
  for (const char* key : {"verdict", "thinnerThan", "thinArea", "thinAreaShare"})
    CHECK(unlimited.at("thickness").at(key).is_null());
}

TEST_CASE("a mesh that is thinner than allowed ends with 6, one that cannot be judged with 5, both with their result") {
  const ScratchFolder folder;
  const std::string cube = folder.write("cube.off", cubeOff());
  const ChildOutcome thin = runThickness({cube, "--fail-if-thinner", "1.5", "-o", folder / "thin.csv", "--json"});
  checkFailure(thin, 6, "FAIL: 1 wall thinner than 1.5: 1 at (");
  CHECK_FALSE(folder.read("thin.csv").empty());
  CHECK_EQ(Json::parse(thin.output).at("thickness").at("regions").size(), 1);
  CHECK_EQ(runThickness({cube, "--fail-if-thinner", "0.9", "-o", folder / "out.csv"}).exitCode, 0);
  CHECK_EQ(runThickness({cube, "--thinner-than", "1.5", "-o", folder / "out.csv"}).exitCode, 0);
  // The seeds do not concern the verdict.
  CHECK_EQ(runThickness({cube, "--fail-if-thinner", "1.5", "--seeds", "1", "-o", folder / "out.csv"}).exitCode, 6);
  // Several meshes: all are computed, and the code of the first failure is returned.
  const std::string sphere = folder.write("sphere.off", sphereOff(6));
  CHECK_EQ(runThickness({sphere, cube, "--fail-if-thinner", "1.5"}).exitCode, 6);
  const std::string open = folder.write("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const ChildOutcome none = runThickness({open, "--fail-if-thinner", "1", "-o", folder / "open.csv"});
  checkFailure(none, 5,
               "NOT JUDGED: no wall thinner than 1 was found; unjudged 3 open edges, first at (0.5, 0, 0), face 0; "
               "close the mesh");
  CHECK_FALSE(folder.read("open.csv").empty());
}

TEST_CASE("the report begins with the verdict") {
  const ScratchFolder folder;
  const std::string cube = folder.write("cube.off", cubeOff());
  const auto reportBelow = [&](const char* limit) {
    const ChildOutcome outcome =
        runAsdf({cube, "--backend", "reference", "--thinner-than", limit, "-o", folder / "out.csv", "--verbose"});
    CHECK_EQ(outcome.exitCode, 0);
    return outcome.error;
  };
  const std::string thin = reportBelow("1.5"), sound = reportBelow("0.5");
  for (const char* part :
       {"cube.off: FAIL: 1 wall thinner than 1.5: 1 at (", "\n  unit      the part is 1 x 1 x 1: inches or metres?\n",
        "\n  size      1 x 1 x 1, bounding box",
        "\n  thin      area 6 (100 %) below 1.5\n  walls     1 wall\n            wall 1 from (", "12 faces, area 6",
        "\n  thickness by area p1 1, p5 1, p50 1, p95 1, max 1\n", "\n  mesh      12 faces, 8 vertices, 1 component\n"})
    CHECK_MESSAGE(thin.find(part) != std::string::npos, thin);
  CHECK_MESSAGE(sound.find("cube.off: PASS: no wall thinner than 0.5") != std::string::npos, sound);
  CHECK_EQ(sound.find("\n  thin "), std::string::npos);
}

TEST_CASE("a run for a verdict writes no result without an option about the result") {
  const ScratchFolder folder;
  const std::string cube = folder.write("cube.off", cubeOff()), sphere = folder.write("sphere.off", sphereOff(6));
  for (int i = 0; i < 2; ++i) {  // The second run has the same inputs.
    const ChildOutcome one = runThickness({cube, "--fail-if-thinner", "0.5", "--json"});
    CHECK_EQ(one.exitCode, 0);
    CHECK(Json::parse(one.output).at("output").is_null());
    CHECK_EQ(runThickness({cube, sphere, "--fail-if-thinner", "1.5"}).exitCode, 6);
    CHECK_EQ(runThickness({"-r", folder / ".", "--fail-if-thinner", "1.5"}).exitCode, 6);
    CHECK_EQ(runThickness({"-r", folder / ".", "--fail-if-thinner", "1.5", "--isolate"}).exitCode, 6);
    CHECK_EQ(folder.names().size(), 2);
  }
  const ChildOutcome shown = runAsdf({cube, "--backend", "reference", "--fail-if-thinner", "0.5"});
  CHECK_MESSAGE(shown.error.find("\n  output") == std::string::npos, shown.error);
  CHECK_EQ(runThickness({"-r", folder / ".", "--fail-if-thinner", "1.5", "--log", folder / "log"}).exitCode, 6);
  CHECK_EQ(folder.names().size(), 3);
  CHECK(Json::parse(linesOf(folder.read("log")).at(0)).at("output").is_null());
  for (const std::vector<std::string>& about : std::vector<std::vector<std::string>>{
           {"--format", "csv"}, {"--fields", "thickness"}, {"-o", folder / "out.csv"}}) {
    std::vector<std::string> arguments{cube, "--fail-if-thinner", "0.5"};
    arguments.insert(arguments.end(), about.begin(), about.end());
    CHECK_EQ(runThickness(arguments).exitCode, 0);
  }
  CHECK_EQ(folder.names().size(), 6);
  const std::string message = refusal({"a.ply", "--fail-if-thinner", "1", "--skip-existing"});
  CHECK_MESSAGE(message.find("give -o") != std::string::npos, message);
}

TEST_CASE("a part that is thin everywhere and has no unit raises the question of the unit") {
  const ScratchFolder folder;
  std::string off = "OFF\n8 12 0\n";
  for (const char* z : {"0", "0.05"})
    for (const char* xy : {"0 0", "2 0", "2 1", "0 1"}) off += std::string(xy) + " " + z + "\n";
  for (const char* face :
       {"0 2 1", "0 3 2", "4 5 6", "4 6 7", "0 1 5", "0 5 4", "1 2 6", "1 6 5", "2 3 7", "2 7 6", "3 0 4", "3 4 7"})
    off += std::string("3 ") + face + "\n";
  const std::string plate = folder.write("plate.off", off);
  const auto reportBelow = [&](const char* limit) {
    return runAsdf({plate, "--backend", "reference", "--thinner-than", limit, "-o", folder / "out.csv"}).error;
  };
  const std::string thin = reportBelow("0.8"), sound = reportBelow("0.04");
  CHECK_MESSAGE(thin.find("\n  unit      the part is 2 x 1 x 0.05: inches or metres?\n") != std::string::npos, thin);
  CHECK_MESSAGE(sound.find("inches") == std::string::npos, sound);
}

}  // namespace
}  // namespace asdfvk::test
