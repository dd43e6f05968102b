#include <filesystem>
#include <set>

#include "cli/lavapipe.h"
#include "cli/mesh_tree.h"
#include "cli/refusal.h"

namespace asdfvk::test {
namespace {

/// A thin box, a thick one, an open one, and a file that is no mesh.
struct Parts {
  ScratchFolder folder;
  std::string root = folder / "in";
  Parts() {
    std::filesystem::create_directory(root);
    folder.write("in/thick.off", boxOff(2, true));
    folder.write("in/thin.off", boxOff(0.5, true));
    folder.write("in/open.off", boxOff(2, false));
    folder.write("in/bad.off", "nonsense");
  }

  static std::string boxOff(double height, bool isClosed) {
    const std::string z = std::to_string(height);
    std::string off = std::string("OFF\n8 ") + (isClosed ? "6" : "5") + " 0\n0 0 0\n9 0 0\n9 9 0\n0 9 0\n";
    for (const char* const corner : {"0 0 ", "9 0 ", "9 9 ", "0 9 "}) off += corner + z + "\n";
    off += "4 3 2 1 0\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
    return isClosed ? off + "4 4 5 6 7\n" : off;
  }
};

TEST_CASE("a check of a folder reports thin, unjudged and unreadable meshes, and the thin one determines the code") {
  const Parts parts;
  const std::string root = parts.root, log = parts.folder / "log.jsonl";
  for (const std::vector<std::string>& how : {std::vector<std::string>{}, {"--jobs", "2"}, {"--isolate"}}) {
    std::vector<std::string> arguments{"-r", root, "--fail-if-thinner", "0.8", "--report-format", "sarif"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    const ChildOutcome outcome = runAsdf(arguments);
    INFO(outcome.error);
    CHECK_EQ(outcome.exitCode, 6);
    CHECK(outcome.error.find("1 ok, 1 not judged, 1 thin, 1 unreadable; ") != std::string::npos);
    CHECK(outcome.error.find("error: " + root + "/thin.off") == std::string::npos);  // A verdict is no error.
    INFO(outcome.output);
    std::multiset<std::string> rules;
    const nlohmann::json sarif = nlohmann::json::parse(outcome.output);
    for (const auto& result : sarif.at("runs").at(0).at("results"))
      rules.insert(result.at("ruleId").get<std::string>());
    CHECK(rules == std::multiset<std::string>{"thinWall", "unjudged", "unreadableInput"});
  }
  CHECK_EQ(runAsdf({"-r", root, "--fail-if-thinner", "0.8", "--log", log, "--quiet"}).exitCode, 6);
  for (const auto& record : recordsIn(log))
    if (record.at("input").get<std::string>().ends_with("thin.off")) {
      CHECK_EQ(record.at("findings").at(0).at("kind").get<std::string>(), "thinWall");
      CHECK_EQ(record.at("thickness").at("minPlace").size(), 3);
    }
  for (const char* const format : {"sarif", "junit", "github"}) {
    const ChildOutcome summary = runAsdf({"summarize", log, "--format", format});
    CHECK_EQ(summary.exitCode, 0);
    CHECK(summary.output.find("thinWall") != std::string::npos);
    CHECK(summary.output.find("unreadableInput") != std::string::npos);
  }
}

TEST_CASE("limits of single meshes and known places determine the code, also in worker processes") {
  const Parts parts;
  const std::string limits = parts.folder.write(
      "limits.json",
      R"({"limits": [{"files": "in/*", "fail-if-thinner": 0.8}, {"files": "open.*", "fail-if-thinner": null},
                                    {"files": "bad.*", "fail-if-thinner": null}]})");
  const std::string baseline = parts.folder / "walls.json";
  std::filesystem::remove(parts.root + "/bad.off");
  for (const std::vector<std::string>& how : {std::vector<std::string>{}, {"--isolate"}}) {
    const auto run = [&](std::vector<std::string> more) {
      more.insert(more.end(), how.begin(), how.end());
      more.insert(more.end(), {"-r", parts.root, "--limits", limits});
      return runAsdf(more);
    };
    CHECK(run({}).error.find("2 ok, 1 thin; ") != std::string::npos);
    CHECK_EQ(run({}).exitCode, 6);
    checkFailure(run({"--baseline", baseline}), 2, "--update-baseline writes it");
    CHECK_EQ(run({"--baseline", baseline, "--update-baseline"}).exitCode, 0);
    const ChildOutcome known = run({"--baseline", baseline, "--report-format", "sarif"});
    CHECK_EQ(known.exitCode, 0);
    CHECK(known.error.find("thin.off: known by the baseline: 1 place") != std::string::npos);
    CHECK(known.error.find("3 ok; ") != std::string::npos);
    const nlohmann::json sarif = nlohmann::json::parse(known.output);
    CHECK_EQ(sarif.at("runs").at(0).at("results").at(1).at("baselineState"), "unchanged");
    std::filesystem::remove(baseline);
  }
  CHECK_FALSE(std::filesystem::exists(parts.root + "/thin.asdf.ply"));
}

TEST_CASE("--skip-existing keeps verdicts: exit code, report of checks, messages and counts of the first run") {
  const Parts parts;
  std::filesystem::remove(parts.root + "/bad.off");
  const std::string log = parts.folder / "log.jsonl";
  for (const std::string format : {"sarif", "junit", "github"}) {
    std::filesystem::remove_all(parts.folder / "out");
    const std::vector<std::string> arguments{"-r",  parts.root, "-o", parts.folder / "out", "--fail-if-thinner",
                                             "0.8", "--log",    log,  "--skip-existing",    "--report-format",
                                             format};
    const ChildOutcome first = runAsdf(arguments);
    INFO(first.error);
    CHECK_EQ(first.exitCode, 6);
    CHECK(first.error.find("1 ok, 1 not judged, 1 thin; ") != std::string::npos);
    std::filesystem::remove(log);
    const ChildOutcome second = runAsdf(arguments);
    INFO(second.error);
    CHECK_EQ(second.exitCode, 6);
    CHECK_EQ(second.output, first.output);
    CHECK(second.error.find("0 ok, 1 skipped, 1 not judged, 1 thin; ") != std::string::npos);
    CHECK(second.error.find("thin.off: FAIL: 1 wall thinner than 0.8") != std::string::npos);
    CHECK_EQ(statusesIn(log), StatusCounts{{"skipped", 3}});
  }
  CHECK_EQ(nlohmann::json::parse(runAsdf({"summarize", log, "--json"}).output).at("failedCount").get<int>(), 2);
  const auto run = [&](const std::vector<std::string>& more, const char* limit = "0.8") {
    std::vector<std::string> all{"-r", parts.root, "-o", parts.folder / "out", "--skip-existing", "--fail-if-thinner"};
    all.emplace_back(limit);
    all.insert(all.end(), more.begin(), more.end());
    return runAsdf(all);
  };
  // The baseline has the places of a skipped mesh; other options and a changed mesh are computed.
  const std::string baseline = parts.folder / "walls.json";
  CHECK(run({"--baseline", baseline, "--update-baseline"}).error.find("1 skipped, 1 not judged, 1 thin; ") !=
        std::string::npos);
  CHECK(run({"--baseline", baseline}).error.find("2 ok, 1 not judged; ") != std::string::npos);
  CHECK_EQ(run({"--baseline", baseline}).exitCode, 5);
  CHECK(run({}, "0.4").error.find("2 ok, 1 not judged; ") != std::string::npos);
  CHECK_EQ(run({}).exitCode, 6);
  parts.folder.write("in/thin.off", Parts::boxOff(1, true));
  CHECK_EQ(run({}).exitCode, 5);
}

TEST_CASE("a folder of pictures has the parts that fail, and a part that passes later has none") {
  const Parts parts;
  const std::string log = parts.folder / "log", thin = parts.folder / "shown/thin.asdf.png";
  for (const std::vector<std::string>& how : {std::vector<std::string>{"--isolate"}, {}}) {
    std::vector<std::string> arguments{
        "-r", parts.root,           "--fail-if-thinner", "0.8", "--picture", parts.folder / "shown/", "--log", log,
        "-o", parts.folder / "out", "--skip-existing"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    std::filesystem::remove_all(parts.folder / "out");
    parts.folder.write("in/thin.off", Parts::boxOff(0.5, true));
    const auto run = [&] {
      std::filesystem::remove(log);
      CHECK_EQ(runAsdf(arguments).exitCode, 6);
      CHECK(parts.folder.read("shown/thin.asdf.png").starts_with("\x89PNG"));
      CHECK_EQ(std::distance(std::filesystem::directory_iterator(parts.folder / "shown"), {}), 1);
      for (const auto& record : recordsIn(log)) {
        const bool isThin = record.at("input").get<std::string>().ends_with("thin.off");
        CHECK_EQ(record.at("picture"), isThin ? nlohmann::json(thin) : nlohmann::json());
      }
      return statusesIn(log);
    };
    CHECK_EQ(run(), StatusCounts{{"done", 1}, {"failed", 3}});
    CHECK_EQ(run(), StatusCounts{{"failed", 1}, {"skipped", 3}});
    std::filesystem::remove(thin);
    CHECK_EQ(run(), StatusCounts{{"failed", 2}, {"skipped", 2}});
    arguments.insert(arguments.end(), {"--picture-view", "0,0"});
    CHECK_EQ(run(), StatusCounts{{"done", 1}, {"failed", 3}});
    parts.folder.write("in/thin.off", Parts::boxOff(1, true));
    CHECK_EQ(runAsdf(arguments).exitCode, 7);
    CHECK_FALSE(std::filesystem::exists(thin));
    parts.folder.write("in/thin.off", Parts::boxOff(0.5, true));
    CHECK_EQ(run(), StatusCounts{{"failed", 2}, {"skipped", 2}});
    parts.folder.write("in/thin.off", "OFF\n");
    CHECK_EQ(runAsdf(arguments).exitCode, 7);
    CHECK_FALSE(std::filesystem::exists(thin));
  }
}

TEST_CASE("without a check each mesh has a picture, beside its result if the folder is that of -o") {
  const Parts parts;
  std::filesystem::remove(parts.root + "/bad.off");
  const ChildOutcome outcome =
      runAsdf({parts.root + "/thin.off", parts.root + "/open.off", "-o", parts.folder / "out/", "--picture",
               parts.folder / "out/", "--format", "npy", "--backend", "reference", "--json", "--quiet"});
  INFO(outcome.error);
  CHECK_EQ(outcome.exitCode, 0);
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(parts.folder / "out"))
    names.insert(entry.path().filename());
  CHECK(names == std::set<std::string>{"open.asdf.npy", "open.asdf.png", "thin.asdf.npy", "thin.asdf.png"});
  CHECK_EQ(nlohmann::json::parse(linesOf(outcome.output).at(0)).at("picture"), parts.folder / "out/thin.asdf.png");
  // One mesh; a passing one has no picture, and the report says so.
  const ChildOutcome thick = runAsdf(
      {parts.root + "/thick.off", "--fail-if-thinner", "0.8", "--picture", parts.folder / "one/", "--json", "--quiet"});
  CHECK_EQ(thick.exitCode, 0);
  CHECK(nlohmann::json::parse(thick.output).at("picture").is_null());
  CHECK(std::filesystem::is_empty(parts.folder / "one"));
  parts.folder.write("file", "");
  checkFailure(runAsdf({"-r", parts.root, "--picture", parts.folder / "file/", "--quiet"}), 4, "cannot be written");
}

TEST_CASE("a mesh with known places is not skipped in a run without the baseline, nor lost by an update") {
  const Parts parts;
  const std::string baseline = parts.folder / "walls.json";
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.end(), {parts.root + "/thin.off", parts.root + "/thick.off", "-o", parts.folder / "out/",
                             "--fail-if-thinner", "0.8"});
    return runAsdf(more).exitCode;
  };
  CHECK_EQ(run({"--baseline", baseline, "--update-baseline"}), 0);
  CHECK_EQ(run({"--baseline", baseline, "--skip-existing"}), 0);
  CHECK_EQ(run({"--skip-existing"}), 6);
  CHECK_EQ(run({"--baseline", baseline, "--skip-existing", "--update-baseline"}), 0);
  CHECK_EQ(run({"--baseline", baseline}), 0);
}

TEST_CASE("a run without a device reports each mesh as not computed") {
  const Parts parts;
  const ChildOutcome outcome = runAsdf({parts.root + "/thin.off", parts.root + "/thick.off", "--fail-if-thinner", "0.8",
                                        "--require-gpu", "--report-format", "junit"},
                                       withDrivers("/nonexistent.json"));
  CHECK_EQ(outcome.exitCode, 3);
  CHECK(outcome.output.find("tests=\"2\" failures=\"0\" errors=\"2\"") != std::string::npos);
}

TEST_CASE("the report of one mesh goes to a file, beside its usual report") {
  const Parts parts;
  const std::string report = parts.folder / "report.xml";
  const ChildOutcome outcome =
      runAsdf({parts.root + "/thin.off", "--fail-if-thinner", "0.8", "--report-format", "junit", "--report", report});
  CHECK_EQ(outcome.exitCode, 6);
  CHECK_EQ(outcome.output, "");
  CHECK(outcome.error.find("FAIL: 1 wall thinner than 0.8: 0.5") != std::string::npos);
  CHECK(parts.folder.read("report.xml").find("<failure type=\"tooThin\"") != std::string::npos);
}

TEST_CASE("a report of checks does not share standard output or a file") {
  const Parts parts;
  const std::string mesh = parts.root + "/thick.off";
  checkFailure(runAsdf({mesh, "--report-format", "github", "--json"}), 1, "--report");
  checkFailure(runAsdf({mesh, "--report-format", "github", "-o", "-"}), 1, "--report");
  checkFailure(runAsdf({mesh, "--report-format", "xml"}), 1, "sarif");
  checkFailure(runAsdf({mesh, "--report", "x.json"}), 1, "--report-format");
  checkFailure(runAsdf({mesh, "--report-format", "sarif", "--report", mesh}), 1, "choose another --report");
  checkFailure(runAsdf({mesh, "--report-format", "sarif", "--report", "/missing/x.sarif", "--quiet"}), 4, "/missing");
}

}  // namespace
}  // namespace asdfvk::test
