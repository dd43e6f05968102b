// The options --with and --compare.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/program_under_test.h"
#include "cli/refusal.h"
#include "cli/sample_files.h"
#include "cli/scratch_folder.h"

namespace asdfvk::test {
namespace {

using OtherJson = nlohmann::json;

ChildOutcome runOnCpu(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--backend", "reference"});
  return runAsdf(arguments);
}

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_CASE("--with adds bodies, and the result has the faces of the first mesh") {
  const ScratchFolder folder;
  const std::string lid = folder.write("lid.obj", boxObj({0, 0, 0}, {1, 1, 1})),
                    base = folder.write("base.obj", boxObj({0, 0, -1.2}, {1, 1, -0.2})), out = folder / "out.csv",
                    points = folder / "out.ply";
  checkFailure(runOnCpu({lid, "--with", base, "--fail-if-closer", "0.3", "--quiet"}), 6,
               "FAIL: 1 gap closer than 0.3: 0.2 at (");
  checkFailure(runOnCpu({lid, "--with", base, "--fail-if-closer", "0.3", "--quiet"}), 6, "between lid and base");
  CHECK_EQ(runOnCpu({lid, "--with", base, "--fail-if-closer", "0.1", "--quiet"}).exitCode, 0);
  const ChildOutcome outcome = runOnCpu(
      {lid, "--with", base, "--measure", "sdf,gap", "--json", "--fields", "gap,sdf", "-o", out, "--points", points});
  REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.error);
  const std::string table = contentOf(out);
  CHECK_EQ(std::count(table.begin(), table.end(), '\n'), 7);
  const OtherJson json = OtherJson::parse(outcome.output);
  CHECK_EQ(json.at("with"), OtherJson({base}));
  CHECK(json.at("former").is_null());
  CHECK_EQ(json.at("faceCount"), 12);
  CHECK_EQ(json.at("regionFaceCount"), 6);
  for (const OtherJson& field : json.at("fields"))
    if (field.at("name") == "sdf") CHECK_EQ(field.at("missingCount"), 0);
  CHECK(std::filesystem::file_size(points) > 100);
  // A second body beside the first one.
  const std::string side = folder.write("side.obj", boxObj({1.1, 0, 0}, {2, 1, 1}));
  checkFailure(runOnCpu({lid, "--with", base, "--with", side, "--fail-if-closer", "0.3", "--quiet"}), 6,
               "FAIL: 2 gaps closer than 0.3: 0.1 at (");
}

TEST_CASE("--with and --orient auto measure the wall between an outer and an inner surface") {
  const ScratchFolder folder;
  const std::string outer = folder.write("outer.obj", boxObj({0, 0, 0}, {5, 5, 5})),
                    inner = folder.write("inner.obj", boxObj({0.5, 1, 1}, {4, 4, 4}));
  checkFailure(runOnCpu({outer, "--with", inner, "--orient", "auto", "--fail-if-thinner", "0.6", "--quiet"}), 6,
               "thinner than 0.6: 0.5 at (");
  CHECK_EQ(runOnCpu({outer, "--with", inner, "--orient", "auto", "--fail-if-thinner", "0.4", "--quiet"}).exitCode, 0);
}

TEST_CASE("an open or a branching other mesh prevents a verdict, whichever side its faces have") {
  const ScratchFolder folder;
  const std::string outer = folder.write("outer.obj", boxObj({0, 0, 0}, {5, 5, 5})),
                    innerBox = boxObj({0.5, 1, 1}, {4, 4, 4});
  const auto without = [](std::string box) { return box.erase(box.rfind("f ")); };
  const std::string open = folder.write("open.obj", without(innerBox)),
                    cavity = folder.write("cavity.obj", without(boxObj({0.5, 1, 1}, {4, 4, 4}, true))),
                    branching = folder.write("branching.obj", innerBox + "v 9 9 9\nf -2 -3 -1\n");
  const auto check = [&](const std::string& other, const char* limit) {
    return runOnCpu({outer, "--with", other, "--fail-if-thinner", limit, "--quiet"});
  };
  // The near side of the cavity is 0.5 from the box.
  for (const char* const limit : {"0.3", "0.8"})
    for (const std::string& other : {open, branching}) CHECK_EQ(check(other, limit).exitCode, 5);
  CHECK_EQ(check(cavity, "0.3").exitCode, 5);
  checkFailure(check(cavity, "0.8"), 6, "thinner than 0.8: 0.5 at (");
  checkFailure(check(open, "0.8"), 5, "open edges");

  // The face is named by its body, and by its index in its file.
  const ChildOutcome named = runOnCpu({outer, "--with", open, "--fail-if-thinner", "0.8", "--json"});
  CHECK_MESSAGE(named.error.find("warning: " + outer + " with " + open + ": ") != std::string::npos, named.error);
  CHECK_MESSAGE(named.error.find("face 0, in open; close the mesh\n") != std::string::npos, named.error);
  const OtherJson json = OtherJson::parse(named.output);
  CHECK_EQ(json.at("withFaceCounts"), OtherJson({5}));
  CHECK_EQ(json.at("thickness").at("unjudged").at("reasons").at(0).at("face"), 6);

  const std::string side = folder.write("side.obj", without(boxObj({5.2, 0, 0}, {9, 5, 5})));
  const auto checkGap = [&](const char* limit) {
    return runOnCpu({outer, "--with", side, "--fail-if-closer", limit, "--quiet"}).exitCode;
  };
  CHECK_EQ(checkGap("0.1"), 5);
  CHECK(checkGap("0.3") >= 5);
}

TEST_CASE("--compare fails only for walls that are new or became thinner") {
  const ScratchFolder folder;
  const auto part = [&](const std::string& name, double first, double second) {
    return folder.write(name, boxObj({0, 0, 0}, {5, 5, first}) + boxObj({10, 0, 0}, {15, 5, second}));
  };
  const std::string former = part("former.obj", 0.5, 2), same = part("same.obj", 0.5, 2),
                    worse = part("worse.obj", 0.5, 0.6), thinner = part("thinner.obj", 0.3, 2);
  const auto check = [&](const std::string& mesh) {
    return runOnCpu({mesh, "--compare", former, "--fail-if-thinner", "0.8"});
  };
  const ChildOutcome passed = check(same);
  CHECK_EQ(passed.exitCode, 0);
  CHECK_MESSAGE(passed.error.find("PASS: no new wall thinner than 0.8; 1 wall kept\n") != std::string::npos,
                passed.error);
  CHECK_MESSAGE(passed.error.find("in all    1 wall thinner than 0.8: 0.5 at (") != std::string::npos, passed.error);
  CHECK_EQ(runOnCpu({same, "--fail-if-thinner", "0.8", "--quiet"}).exitCode, 6);
  const ChildOutcome isNew = check(worse), isThinner = check(thinner);
  CHECK_EQ(isNew.exitCode, 6);
  CHECK_MESSAGE(isNew.error.find("FAIL: 1 new wall (limit 0.8): 0.6 at (") != std::string::npos, isNew.error);
  CHECK_EQ(isThinner.exitCode, 6);
  CHECK_MESSAGE(isThinner.error.find("FAIL: 1 wall that became thinner (limit 0.8): 0.3 instead of 0.5 at (") !=
                    std::string::npos,
                isThinner.error);
  CHECK_MESSAGE(isThinner.error.find("change    thinner than before at ") != std::string::npos, isThinner.error);
  const std::string page = folder / "page.html";
  const ChildOutcome outcome =
      runOnCpu({worse, "--compare", former, "--thinner-than", "0.8", "--json", "-o", page, "--quiet"});
  REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.error);
  const OtherJson comparison = OtherJson::parse(outcome.output).at("comparison");
  CHECK_EQ(comparison.at("verdict"), "failed");
  CHECK_EQ(comparison.at("newCount"), 1);
  CHECK_EQ(comparison.at("keptCount"), 1);
  // The upper side moved by more than half of the thickness, so it has no counterpart.
  CHECK(comparison.at("thinnerArea").get<double>() == doctest::Approx(25 + 12));
  CHECK(contentOf(page).find("thickness_change") != std::string::npos);
}

TEST_CASE("other meshes are refused where they have no effect, and their errors name the file") {
  const auto isRefused = [](const std::vector<std::string>& arguments, const std::string& part) {
    const std::string message = refusal(arguments);
    CHECK_MESSAGE(message.find(part) != std::string::npos, message);
  };
  isRefused({"a.ply", "b.ply", "--with", "c.ply"}, "--with takes one mesh");
  isRefused({"a.ply", "--compare", "c.ply", "--log", "x.jsonl"}, "--compare takes one mesh");
  isRefused({"a.ply", "--with", "b.ply", "--compare", "c.ply"}, "--with and --compare exclude each other");
  isRefused({"a.ply", "--with", "-"}, "--with: '-' is not the name of a file");
  isRefused({"a.ply", "--compare", ""}, "--compare: '' is not the name of a file");
  isRefused({"a.ply", "--with", "b.ply", "--segment"}, "drop --with, or --segment and --postprocess");
  isRefused({"a.ply", "--fields", "thickness_change"}, "--fields thickness_change needs --compare");
  isRefused({"a.ply", "--compare", "b.ply", "--measure", "sdf"}, "a comparison needs --measure thickness");
  CHECK(parseCommandLine({"a.ply", "--compare", "b.ply"}).computation.options.measure == Measure::Thickness);
  const ScratchFolder folder;
  const std::string cube = folder.write("cube.off", cubeOff()), broken = folder.write("broken.off", "OFF\n1 1\n");
  for (const char* const option : {"--with", "--compare"}) {
    checkFailure(runOnCpu({cube, option, folder / "missing.stl", "--quiet"}), 2, "missing.stl");
    checkFailure(runOnCpu({cube, option, broken, "--quiet"}), 2, "broken.off");
    CHECK_FALSE(std::filesystem::exists(folder / "cube.asdf.ply"));
  }
}

TEST_CASE("--timeout ends the wait for a FIFO that is another mesh") {
  const ScratchFolder folder;
  const std::string cube = folder.write("cube.off", cubeOff()), fifo = folder / "fifo.off";
  REQUIRE_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const char* const option : {"--with", "--compare"})
    checkFailure(runOnCpu({cube, option, fifo, "--timeout", "0.2", "--quiet"}), 8, "took longer than --timeout 0.2");
}

TEST_CASE("bodies of other meshes are not judged") {
  const ScratchFolder folder;
  const std::string small = folder.write("small.obj", boxObj({0, 0, 0}, {1, 1, 1})),
                    large = folder.write("large.obj", boxObj({2, 0, 0}, {7, 5, 5}));
  CHECK_EQ(runOnCpu({small, "--with", large, "--fail-if-thicker", "2", "--quiet"}).exitCode, 0);
  checkFailure(runOnCpu({large, "--with", small, "--fail-if-thicker", "2", "--quiet"}), 6, "1 body thicker than 2: ");
  const std::string hollow =
      folder.write("hollow.obj", boxObj({10, 0, 0}, {15, 5, 5}) + boxObj({11, 1, 1}, {14, 4, 4}, true));
  const std::string beside = folder.write("beside.obj", boxObj({15, 0, 0}, {16, 5, 5}));
  CHECK_EQ(runOnCpu({small, "--with", hollow, "--fail-if-voids", "--quiet"}).exitCode, 0);
  checkFailure(runOnCpu({hollow, "--with", small, "--fail-if-voids", "--quiet"}), 6,
               "FAIL: 1 sealed void, volume 27 at (");
  CHECK_EQ(runOnCpu({small, "--with", hollow, "--with", beside, "--fail-if-contact", "--quiet"}).exitCode, 0);
  checkFailure(runOnCpu({beside, "--with", hollow, "--with", small, "--fail-if-contact", "--quiet"}), 6,
               "FAIL: 1 pair of bodies in contact: beside and hollow");
}

TEST_CASE("a mesh without a unit takes that of the other mesh, and units that differ are named with their files") {
  const ScratchFolder folder;
  const std::string part = folder.write("part.obj", boxObj({0, 0, 0}, {5, 5, 0.5})),
                    corpus = ASDFVK_TEST_DIR "/io/assembly_corpus/", inMillimetres = corpus + "3mf_default_unit.3mf",
                    inInches = corpus + "3mf_inch.3mf";
  for (const char* const option : {"--with", "--compare"}) {
    const ChildOutcome outcome = runOnCpu({part, option, inMillimetres, "--thinner-than", "0.8mm", "--json"});
    REQUIRE_MESSAGE(outcome.exitCode == 0, outcome.error);
    CHECK_EQ(OtherJson::parse(outcome.output).at("unit"), "mm");
    checkFailure(runOnCpu({part, option, inInches, "--thinner-than", "0.8", "--quiet"}), 2,
                 "part.obj states no unit, and " + inInches + " has the unit in; save both");
  }
  checkFailure(runOnCpu({part, "--with", inMillimetres, "--with", inInches, "--quiet"}), 2,
               inMillimetres + " has the unit mm, and " + inInches + " has the unit in;");
}

}  // namespace
}  // namespace asdfvk::test
