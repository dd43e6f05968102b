#include "batch/check_report.h"

#include <doctest/doctest.h>

#include <set>

namespace asdfvk {
namespace {

Json finding(const char* kind, const char* level, double x) {
  return {{"kind", kind},           {"level", level},          {"value", 0.5},   {"limit", 0.8},
          {"place", {x, 2.0, 3.0}}, {"message", "a, 50 %\nb"}, {"remedy", "<c>"}};
}

MeshRecord recordOf(const std::string& input, int code, const std::string& error, Json findings) {
  MeshRecord record;
  record.input = input;
  record.code = code;
  record.error = error;
  record.message = code == 0 ? "" : "the message";
  record.status = code == 0 ? MeshStatus::Done : MeshStatus::Failed;
  record.findings = std::move(findings);
  return record;
}

/// A mesh that passes, with a note; a thin one; one that is not judged; an unreadable one; and two whose log is not of
/// this program.
std::vector<MeshRecord> sampleRecords() {
  return {recordOf("good.stl", 0, "", Json::array({finding("sealedVoid", "note", 1)})),
          recordOf("/a b/thin,1:2.stl", 6, "tooThin",
                   Json::array({finding("thinWall", "failure", 1), finding("thinWall", "failure", 9),
                                finding("thinWall", "failure", 9.1)})),
          recordOf("open.stl", 5, "notJudged", Json::array({finding("unjudged", "notJudged", 1)})),
          recordOf("bad.stl", 2, "unreadableInput", nullptr),
          recordOf("foreign.stl", 0, "", Json::array({3, Json::object(), {{"kind", 7}, {"place", "nowhere"}}})),
          recordOf("strange.stl", 6, "tooThin", "no list")};
}

size_t countOf(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST_CASE("SARIF has the members that its specification requires, and a rule for each result") {
  const Json sarif = Json::parse(sarifOf(sampleRecords()));
  CHECK_EQ(sarif.at("version"), "2.1.0");
  const Json& run = sarif.at("runs").at(0);
  const Json& rules = run.at("tool").at("driver").at("rules");
  CHECK_EQ(run.at("tool").at("driver").at("name"), "asdf-vk");
  CHECK_EQ(run.at("artifacts").size(), 6);
  std::set<std::string> ids;
  for (const Json& rule : rules) {
    CHECK(ids.insert(rule.at("id").get<std::string>()).second);
    for (const char* const text : {"shortDescription", "fullDescription", "help"})
      CHECK_FALSE(rule.at(text).at("text").get<std::string>().empty());
  }
  std::multiset<std::string> levels, prints;
  for (const Json& result : run.at("results")) {
    CHECK_EQ(rules.at(result.at("ruleIndex").get<size_t>()).at("id"), result.at("ruleId"));
    CHECK(result.at("message").at("text").is_string());
    const Json& place = result.at("locations").at(0).at("physicalLocation");
    CHECK_EQ(run.at("artifacts").at(place.at("artifactLocation").at("index").get<size_t>()).at("location").at("uri"),
             place.at("artifactLocation").at("uri"));
    CHECK_GE(place.at("region").at("startLine").get<int>(), 1);
    levels.insert(result.at("level").get<std::string>());
    prints.insert(result.at("partialFingerprints").at("place/v1").get<std::string>());
  }
  CHECK_EQ(levels.count("note"), 1);
  CHECK_EQ(levels.count("warning"), 1);
  CHECK_EQ(levels.count("error"), run.at("results").size() - 2);
  CHECK_EQ(prints.count("thinWall/1/3/4"), 1);  // The place in steps of the limit.
  CHECK_EQ(prints.count("thinWall/11/3/4"), 1);
  CHECK_EQ(prints.count("thinWall/11/3/4#2"), 1);  // Another place in the same step.
  CHECK_EQ(run.at("artifacts").at(1).at("location").at("uri"), "file:///a%20b/thin%2C1%3A2.stl");
  const Json& invocation = run.at("invocations").at(0);
  CHECK_FALSE(invocation.at("executionSuccessful").get<bool>());
  CHECK_EQ(invocation.at("toolExecutionNotifications").at(0).at("message").at("text"), "bad.stl: the message");
}

TEST_CASE("SARIF of meshes without a finding is a successful run without results") {
  const std::vector<MeshRecord> good{recordOf("good.stl", 0, "", nullptr)};
  const Json run = Json::parse(sarifOf(good)).at("runs").at(0);
  CHECK(run.at("results").is_array());
  CHECK(run.at("results").empty());
  CHECK(run.at("invocations").at(0).at("executionSuccessful").get<bool>());
}

TEST_CASE("SARIF of no mesh is not a successful run") {
  const Json run = Json::parse(sarifOf({})).at("runs").at(0);
  CHECK_FALSE(run.at("invocations").at(0).at("executionSuccessful").get<bool>());
}

TEST_CASE("JUnit has a test case per mesh: failures of the check, errors without a verdict") {
  const std::string xml = junitOf(sampleRecords());
  CHECK(xml.find("<testsuites tests=\"6\" failures=\"1\" errors=\"3\" time=") != std::string::npos);
  CHECK_EQ(countOf(xml, "<testcase "), 6);
  CHECK_EQ(countOf(xml, "<failure "), 1);
  CHECK_EQ(countOf(xml, "<error "), 3);
  CHECK(xml.find("name=\"good.stl\" time=\"0.000\"/>") != std::string::npos);
  CHECK(xml.find("&lt;c&gt;") != std::string::npos);
  CHECK_EQ(countOf(xml, "file="), 0);  // The schemas of Jenkins and Maven Surefire do not allow it.
  CHECK_EQ(countOf(xml, "<"), countOf(xml, ">"));
  MeshRecord dropped = recordOf("late.stl", 130, "cancelled", nullptr);
  dropped.status = MeshStatus::Dropped;
  CHECK(junitOf(std::vector{dropped}).find("skipped=\"1\"") != std::string::npos);
}

TEST_CASE("GitHub gets a command in a line for each finding") {
  const std::string lines = githubAnnotationsOf(sampleRecords());
  CHECK(lines.find("::notice file=good.stl,title=sealedVoid::a, 50 %25%0Ab; <c>\n") != std::string::npos);
  CHECK(lines.find("::error file=/a b/thin%2C1%3A2.stl,title=thinWall::") != std::string::npos);
  CHECK(lines.find("::warning file=open.stl,title=unjudged::") != std::string::npos);
  CHECK(lines.find("::error file=bad.stl,title=unreadableInput::the message\n") != std::string::npos);
  for (const char* const name : {"sarif", "junit", "github"})
    CHECK_FALSE(checkReport(checkFormatOf(name), sampleRecords()).empty());
}

}  // namespace
}  // namespace asdfvk
