#include <csignal>
#include <filesystem>

#include "cli/sample_files.h"
#include "cli/scratch_folder.h"
#include "cli/served.h"
#include "io/base64_text.h"

namespace asdfvk::test {
namespace {

constexpr double kServePatienceSeconds = 120;

std::string requestLine(const ServedJson& id, const std::string& mesh, const ServedJson& options = ServedJson::object(),
                        const ServedJson& further = ServedJson::object()) {
  ServedJson request{{"id", id}, {"mesh", mesh}, {"options", options}};
  request.update(further);
  return request.dump();
}

/// Minutes of work.
const ServedJson kLongWork{{"seeds", "all"}, {"rays", 1024}};

ServedJson withoutTimes(ServedJson report) {
  for (const char* const key : {"stageSeconds", "raysPerSecond", "mesh", "output"}) report.erase(key);
  return report;
}

}  // namespace

TEST_CASE("serve answers with the report of the command line") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(10));
  const ServedJson report = ServedJson::parse(runAsdf({mesh, "--json", "--quiet", "--backend", "reference"}).output);
  const ServedJson checked = ServedJson::parse(
      runAsdf({mesh, "--json", "--quiet", "--backend", "reference", "--fail-if-thinner", "0.5"}).output);
  const auto answers = served({requestLine(1, mesh), requestLine("two", mesh, {{"failIfThinner", 0.5}}),
                               requestLine(3, mesh, {{"failIfThinner", 1e9}})});
  REQUIRE_EQ(answers.size(), 3);
  CHECK_EQ(answers[0].at("id"), 1);
  CHECK_EQ(answers[0].at("report").at("mesh"), mesh);
  CHECK_EQ(withoutTimes(answers[0].at("report")).dump(), withoutTimes(report).dump());
  CHECK(answers[0].at("report").at("output").is_null());
  CHECK_EQ(answers[1].at("id"), "two");
  CHECK_EQ(withoutTimes(answers[1].at("report")).dump(), withoutTimes(checked).dump());
  CHECK_FALSE(answers[1].contains("failure"));
  CHECK_EQ(answers[2].at("failure").at("code"), "tooThin");
  CHECK_EQ(answers[2].at("failure").at("exitCode"), 6);
  CHECK_EQ(answers[2].at("report").at("thickness").at("verdict"), "failed");
  CHECK_EQ(folder.names().size(), 2);  // The result of the command line, and none of serve.
}

TEST_CASE("the options of a report can be sent back") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(8));
  for (const ServedJson& options : {ServedJson::object(), ServedJson{{"thinnerThan", 0.5}, {"closerThan", 0.1}},
                                    ServedJson{{"recipe", "quality"}, {"segment", "parts"}, {"detail", 2}},
                                    ServedJson{{"definition", "cgal"}, {"segment", "cgal"}, {"clusters", 3}},
                                    ServedJson{{"maxError", "5%"}, {"smooth", "2x1"}, {"per", "vertex"}}}) {
    CAPTURE(options.dump());
    const auto first = served({requestLine(1, mesh, options)});
    REQUIRE(first.at(0).contains("report"));
    const auto second = served({requestLine(1, mesh, first[0].at("report").at("options"))});
    INFO(second.at(0).dump());
    REQUIRE(second[0].contains("report"));
    CHECK_EQ(second[0].at("report").at("options").dump(), first[0].at("report").at("options").dump());
  }
}

TEST_CASE("a request can carry its mesh as bytes or as arrays") {
  const ScratchFolder folder;
  const std::string bytes = cubeBinaryStl(), mesh = folder.write("cube.stl", bytes);
  ServedJson arrays{{"id", 3}, {"options", {{"measure", "thickness"}}}};
  arrays["vertices"] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  arrays["faces"] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  const ServedJson data{
      {"id", 2}, {"format", "stl"}, {"data", base64Text(bytes)}, {"options", {{"measure", "thickness"}}}};
  const auto answers = served({requestLine(1, mesh, {{"measure", "thickness"}}), data.dump(), arrays.dump()});
  REQUIRE_EQ(answers.size(), 3);
  for (const ServedJson& answer : answers) REQUIRE(answer.contains("report"));
  CHECK_EQ(answers[1].at("report").at("mesh"), "mesh.stl");
  CHECK_EQ(withoutTimes(answers[0].at("report")).dump(), withoutTimes(answers[1].at("report")).dump());
  CHECK_EQ(answers[2].at("report").at("mesh"), "mesh");
  CHECK_EQ(answers[2].at("report").at("faceCount"), 6);
  CHECK_EQ(answers[2].at("report").at("thickness").at("max").get<double>(), doctest::Approx(1));
}

TEST_CASE("results and pictures are files, or parts of the answer") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("sphere.off", sphereOff(8)), output = folder / "out.csv";
  CHECK_EQ(runAsdf({mesh, "-o", folder / "direct.csv", "--backend", "reference", "--quiet"}).exitCode, 0);
  const auto answers =
      served({requestLine(1, mesh, ServedJson::object(), {{"output", output}}),
              requestLine(2, mesh, ServedJson::object(), {{"output", {{"inline", true}, {"format", "csv"}}}}),
              requestLine(3, mesh, {{"thinnerThan", 0.5}},
                          {{"picture", {{"inline", true}}},
                           {"output", {{"path", folder / "t"}, {"format", "csv"}, {"fields", {"least_thickness"}}}}})});
  REQUIRE_EQ(answers.size(), 3);
  CHECK_EQ(answers[0].at("report").at("output"), output);
  CHECK_EQ(folder.read("out.csv"), folder.read("direct.csv"));
  const auto decoded = base64Bytes(answers[1].at("output").at("data").get<std::string>());
  CHECK_EQ(std::string(decoded->begin(), decoded->end()), folder.read("direct.csv"));
  CHECK_EQ(answers[1].at("output").at("format"), "csv");
  CHECK(answers[1].at("report").at("output").is_null());
  const auto picture = base64Bytes(answers[2].at("picture").at("data").get<std::string>());
  CHECK(std::string(picture->begin(), picture->end()).starts_with("\x89PNG"));
  CHECK(folder.read("t").starts_with("face,least_thickness"));
}

TEST_CASE("every failure is an answer, and the next request is computed") {
  const ScratchFolder folder;
  const std::string good = folder.write("good.off", sphereOff(6));
  const std::string truncated = folder.write("bad.stl", cubeBinaryStl().substr(0, 300));
  const std::string nonFinite = folder.write("nan.off", "OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  struct Bad {
    std::string line, code;
    int exitCode;
  };
  const auto arrays = [](const char* vertices, const char* faces) {
    return std::string(R"({"vertices": )") + vertices + R"(, "faces": )" + faces + "}";
  };
  const std::vector<Bad> bad{
      {"{", "invalidRequest", 1},
      {requestLine(1, folder / "missing.stl"), "unreadableInput", 2},
      {requestLine(1, truncated), "unreadableInput", 2},
      {requestLine(1, folder / ""), "unreadableInput", 2},
      {requestLine(1, "/dev/zero"), "unreadableInput", 2},
      {requestLine(1, "-"), "unreadableInput", 2},
      {requestLine(1, good, {{"thinner", 1}}), "unknownName", 1},
      {requestLine(1, good, {{"thinnerThan", 0}}), "optionOutOfRange", 1},
      {requestLine(1, good, {{"clusters", 3}}), "optionConflict", 1},
      {requestLine(1, good, {{"thinnerThan", "1mm"}}), "optionConflict", 1},
      {requestLine(1, good, {{"backend", "cpu"}}), "optionConflict", 1},
      {requestLine(1, good, ServedJson::object(), {{"output", "-"}}), "outputNotWritable", 4},
      {requestLine(1, good, ServedJson::object(), {{"output", folder / "no/out.ply"}}), "outputNotWritable", 4},
      {requestLine(1, good, ServedJson::object(), {{"output", {{"path", good}, {"format", "ply"}}}}), "optionConflict",
       1},
      {requestLine(1, good, ServedJson::object(), {{"output", folder / "out.xyz"}}), "unknownFormat", 1},
      {requestLine(1, good, ServedJson::object(), {{"output", {{"inline", true}}}}), "optionConflict", 1},
      {requestLine(1, good, ServedJson::object(), {{"output", {{"inline", true}, {"format", "doc"}}}}), "unknownName",
       1},
      {requestLine(1, good, ServedJson::object(), {{"picture", folder / "p.jpg"}}), "optionOutOfRange", 1},
      {requestLine(1, good, ServedJson::object(), {{"picture", {{"inline", true}, {"of", "x"}}}}), "unknownName", 1},
      {requestLine(1, good, ServedJson::object(), {{"with", {folder / "none.stl"}}}), "unreadableInput", 2},
      {requestLine(1, good, kLongWork, {{"timeout", 0.01}}), "timeLimit", 8},
      {R"({"format": "doc", "data": "AAAA"})", "unknownFormat", 1},
      {R"({"format": "stl", "data": "A?AA"})", "unreadableInput", 2},
      {R"({"format": "stl", "data": "AAAA"})", "unreadableInput", 2},
      {arrays("[[0, 0, 0]]", "[]"), "emptyMesh", 2},
      {arrays("[[0, 0]]", "[[0, 0, 0]]"), "arraySize", 2},
      {arrays("[[0, 0, null]]", "[[0, 0, 0]]"), "arraySize", 2},
      {arrays("[[0, 0, 0]]", "[[0, 0]]"), "arraySize", 2},
      {arrays("[[0, 0, 0]]", "[[0, 0, 1]]"), "indexOutOfRange", 2},
      {arrays("[[0, 0, 0]]", "[[0, 0, -1]]"), "indexOutOfRange", 2},
      {arrays("[[0, 0, 0]]", "[[0, 0, 0.5]]"), "indexOutOfRange", 2},
      {arrays("5", "[[0, 0, 0]]"), "arraySize", 2},
      {R"({"vertices": [[0, 0, 0]]})", "arraySize", 2},
  };
  std::vector<std::string> lines;
  for (const Bad& b : bad) {
    lines.push_back(b.line);
    lines.push_back(requestLine("good", good));
  }
  lines.push_back(requestLine("nan", nonFinite));
  const auto answers = served(lines);
  REQUIRE_EQ(answers.size(), lines.size());
  CHECK_EQ(answers.back().at("report").at("defects").at("nonFiniteVertexCount"), 1);
  for (size_t i = 0; i < bad.size(); ++i) {
    INFO(bad[i].line << ": " << answers[2 * i].dump().substr(0, 300));
    REQUIRE(answers[2 * i].contains("error"));
    CHECK_EQ(errorOf(answers[2 * i], "code"), bad[i].code);
    CHECK_EQ(answers[2 * i].at("error").at("exitCode"), bad[i].exitCode);
    CHECK(answers[2 * i + 1].contains("report"));
  }
  CHECK(folder.names() == std::vector<std::string>{"bad.stl", "good.off", "nan.off"});
}

TEST_CASE("requests at once have one answer each, by their ids") {
  const ScratchFolder folder;
  const std::string mesh = folder.write("cube.stl", cubeBinaryStl());
  std::vector<std::string> lines;
  for (int i = 0; i < 60; ++i) lines.push_back(requestLine(i, mesh, {{"measure", i % 2 ? "thickness" : "sdf"}}));
  std::vector<int> counts(lines.size(), 0);
  for (const ServedJson& answer : served(lines, {"--jobs", "4"})) {
    ++counts.at(answer.at("id").get<size_t>());
    CHECK(answer.contains("report"));
  }
  CHECK(counts == std::vector<int>(lines.size(), 1));
}

TEST_CASE("a cancel ends a computation in progress and one that waits") {
  const ScratchFolder folder;
  const std::string slow = folder.write("slow.off", sphereOff(150)), quick = folder.write("quick.off", sphereOff(6));
  const auto answers = served({requestLine("slow", slow, kLongWork), requestLine("waiting", slow, kLongWork),
                               requestLine("quick", quick), R"({"cancel": "waiting"})", R"({"cancel": "slow"})"});
  REQUIRE_EQ(answers.size(), 5);
  std::map<std::string, ServedJson> byId;
  for (const ServedJson& answer : answers)
    if (answer.contains("id")) byId[answer.at("id").get<std::string>()] = answer;
  CHECK_EQ(errorOf(byId["slow"], "code"), "cancelled");
  CHECK_EQ(errorOf(byId["waiting"], "code"), "cancelled");
  CHECK(byId["quick"].contains("report"));
}

TEST_CASE("a signal answers the open requests and ends with 130") {
  const ScratchFolder folder;
  const std::string slow = folder.write("slow.off", sphereOff(150));
  ChildOptions options;
  options.keepInputOpen = true;
  // The answer to the cancel comes when all lines were read.
  options.input = requestLine(1, slow, kLongWork) + "\n" + requestLine(2, slow, kLongWork) + "\n{\"cancel\": 3}\n";
  ChildProcess child(ASDFVK_PROGRAM, {"serve", "--backend", "reference", "--jobs", "1"}, options);
  REQUIRE(child.waitForOutput("\n", kServePatienceSeconds));
  child.send(SIGTERM);
  const ChildOutcome outcome = child.finish(kServePatienceSeconds);
  CHECK_EQ(outcome.exitCode, 130);
  const std::vector<std::string> lines = linesOf(outcome.output);
  REQUIRE_EQ(lines.size(), 3);
  for (const size_t i : {1, 2}) CHECK_EQ(errorOf(ServedJson::parse(lines[i]), "code"), "cancelled");
}

TEST_CASE("a lost device fails one request, and the next one opens it again") {
  const ScratchFolder folder;
  const std::string lost = folder.write("lose.off", sphereOff(6)), good = folder.write("good.off", sphereOff(6));
  ChildOptions options;
  options.input = requestLine(1, lost) + "\n" + requestLine(2, good) + "\n";
  const ChildOutcome outcome =
      runChild(ASDFVK_FAULTY_PROGRAM, {"serve", "--backend", "reference", "--jobs", "1"}, options);
  const std::vector<std::string> lines = linesOf(outcome.output);
  REQUIRE_EQ(lines.size(), 2);
  CHECK_EQ(errorOf(ServedJson::parse(lines[0]), "code"), "deviceLost");
  CHECK(ServedJson::parse(lines[1]).contains("report"));
}

TEST_CASE("--root refuses files of requests outside of the folder") {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "root");
  const std::string outside = folder.write("outside.off", sphereOff(6));
  folder.write("root/part.off", sphereOff(6));
  const auto answers = served({requestLine(1, "part.off"), requestLine(2, "../outside.off"), requestLine(3, outside),
                               requestLine(4, "part.off", {{"thinnerThan", 1}}, {{"with", {"../outside.off"}}}),
                               requestLine(5, "part.off", {{"thinnerThan", 1}}, {{"former", outside}}),
                               requestLine(6, "part.off", ServedJson::object(), {{"output", "../out.ply"}}),
                               requestLine(7, "part.off", ServedJson::object(), {{"picture", folder / "out.png"}}),
                               requestLine(8, "part.off", ServedJson::object(), {{"output", "out.ply"}})},
                              {"--jobs", "1", "--root", folder / "root"});
  REQUIRE_EQ(answers.size(), 8);
  CHECK(answers[0].contains("report"));
  for (size_t i = 1; i < 7; ++i) {
    INFO(answers[i].dump());
    CHECK(errorOf(answers[i], "message").find("is outside of") != std::string::npos);
  }
  CHECK(answers[7].contains("report"));
  CHECK(folder.names() == std::vector<std::string>{"outside.off", "root"});
  CHECK(std::filesystem::exists(folder / "root/out.ply"));
}

TEST_CASE("invalid options of the commands are refused") {
  checkFailure(runAsdf({"serve", "--backend", "cpu", "--device", "0"}), 1, "--device");
  checkFailure(runAsdf({"serve", "part.stl"}), 1, "part.stl");
  checkFailure(runAsdf({"serve", "--max-memory", "much"}), 1, "--max-memory");
  checkFailure(runAsdf({"mcp", "--root", "/nonexistent"}), 2, "--root");
  checkFailure(runAsdf({"serv"}), 1, "did you mean serve?");
}

}  // namespace asdfvk::test
