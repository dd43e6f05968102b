#include "serve/line_protocol.h"

#include <doctest/doctest.h>

#include "serve/fake_computer.h"

namespace asdfvk::test {
namespace {

struct BadLine {
  std::string line, part;
};

}  // namespace

TEST_CASE("a request is answered with its id and its report") {
  KeptAnswers kept;
  const std::vector<Json> answers = kept.answersTo<LineProtocol>(
      {R"({"id": {"any": [1]}, "mesh": "part.stl", "options": {"thinnerThan": 0.8}, "timeout": 2.5})",
       R"({"mesh": "thin"})", R"({"id": null, "mesh": "missing"})",
       R"({"id": 4, "mesh": "a", "picture": {"of": "sdf"}})"});
  REQUIRE_EQ(answers.size(), 4);
  CHECK_EQ(answers[0].dump(),
           R"({"formatVersion":1,"id":{"any":[1]},"report":{"mesh":"part.stl","verdict":"failed"}})");
  CHECK_EQ(answers[1].at("failure").dump(),
           R"({"code":"tooThin","message":"FAIL: 1 wall thinner than 0.8","exitCode":6})");
  CHECK_EQ(answers[1].at("report").at("mesh"), "thin");
  CHECK_EQ(
      answers[2].dump(),
      R"({"formatVersion":1,"id":null,"error":{"code":"unreadableInput","message":"missing: cannot be opened","exitCode":2}})");
  CHECK_EQ(answers[3].at("picture").dump(), R"({"format":"png","data":"cGljdHVyZQ=="})");
  const std::vector<MeshRequest> requests = kept.computer.requests();
  REQUIRE_EQ(requests.size(), 4);
  CHECK_EQ(requests[0].options.dump(), R"({"thinnerThan":0.8})");
  CHECK_EQ(requests[0].timeoutSeconds, 2.5);
  CHECK_FALSE(requests[0].picture);
  REQUIRE(requests[3].picture);
  CHECK(requests[3].picture->path.empty());
  CHECK_EQ(requests[3].picture->options.dump(), R"({"of":"sdf"})");
}

TEST_CASE("a request can carry the mesh, and have outputs with a path or in the answer") {
  KeptAnswers kept;
  (void)kept.answersTo<LineProtocol>(
      {R"({"format": "stl", "data": "AAAA", "output": "out.npy", "with": ["b.stl"], "former": "old.stl"})",
       R"({"vertices": [[0, 0, 0]], "faces": [[0, 0, 0]], "output": {"inline": true, "format": "npy"}})",
       R"({"mesh": "a", "output": {"path": "out", "format": "csv"}})"});
  const std::vector<MeshRequest> requests = kept.computer.requests();
  REQUIRE_EQ(requests.size(), 3);
  CHECK_EQ(requests[0].data, "AAAA");
  CHECK_EQ(requests[0].format, "stl");
  CHECK_EQ(requests[0].output->path, "out.npy");
  CHECK(requests[0].with == std::vector<std::string>{"b.stl"});
  CHECK_EQ(requests[0].former, "old.stl");
  CHECK_EQ(requests[1].faces.dump(), "[[0,0,0]]");
  CHECK(requests[1].output->path.empty());
  CHECK_EQ(requests[2].output->path, "out");
  CHECK_EQ(requests[2].output->options.dump(), R"({"format":"csv"})");
}

TEST_CASE("every invalid line has an answer with the reason, and the next request is answered") {
  const std::string deep = R"({"id": )" + std::string(100'000, '[') + std::string(100'000, ']') + "}";
  const std::vector<BadLine> bad{
      {"nonsense", "not JSON"},
      {"{\"mesh\": \"\xff\"}", "not JSON"},
      {R"({"mesh": "a", "timeout": 1e999})", "not JSON"},
      {R"({"mesh": "a", "vertices": [[NaN, 0, 0]]})", "not JSON"},
      {"[1, 2]", "not a JSON object"},
      {"12", "not a JSON object"},
      {deep, "nested deeper than 64"},
      {R"({"id": 1})", "has no mesh"},
      {R"({"id": 1, "mesh": 5})", "mesh: 5 is not a text"},
      {R"({"id": 1, "mesh": ""})", "the text is empty"},
      {R"({"id": 1, "mesch": "a"})", "did you mean mesh?"},
      {R"({"id": 1, "mesh": "a", "data": "AAAA", "format": "stl"})", "several meshes"},
      {R"({"id": 1, "data": "AAAA"})", "format and data belong together"},
      {R"({"id": 1, "mesh": "a", "format": "stl"})", "format and data belong together"},
      {R"({"id": 1, "mesh": "a", "options": [1]})", "not an object"},
      {R"({"id": 1, "mesh": "a", "timeout": 0})", "timeout: 0 is not a number of seconds above 0"},
      {R"({"id": 1, "mesh": "a", "timeout": "fast"})", "timeout"},
      {R"({"id": 1, "mesh": "a", "output": 5})", "neither a path nor an object"},
      {R"({"id": 1, "mesh": "a", "output": {"path": "b", "inline": true}})", R"(either "path" or "inline")"},
      {R"({"id": 1, "mesh": "a", "output": {"inline": false}})", R"(either "path" or "inline")"},
      {R"({"id": 1, "mesh": "a", "with": "b"})", "not a list of paths"},
  };
  KeptAnswers kept;
  std::vector<std::string> lines;
  for (const BadLine& b : bad) lines.push_back(b.line);
  lines.emplace_back(R"({"id": "last", "mesh": "a"})");
  const std::vector<Json> answers = kept.answersTo<LineProtocol>(lines);
  REQUIRE_EQ(answers.size(), lines.size());
  for (size_t i = 0; i < bad.size(); ++i) {
    const auto message = answers[i].at("error").at("message").get<std::string>();
    INFO(bad[i].line.substr(0, 100) << ": " << message);
    CHECK(message.find(bad[i].part) != std::string::npos);
    CHECK_EQ(answers[i].at("error").at("code"), "invalidRequest");
    CHECK_EQ(answers[i].at("error").at("exitCode"), 1);
    CHECK(message.size() < 300);
    CHECK(answers[i].at("id") == (bad[i].line.starts_with(R"({"id": 1)") ? Json(1) : Json()));
  }
  CHECK_EQ(answers.back().at("id"), "last");
  CHECK(answers.back().contains("report"));
}

TEST_CASE("a line that is too long has an answer") {
  KeptAnswers kept;
  LineProtocol(kept.queue, kept.computer).receive({"", true});
  kept.queue.finish();
  REQUIRE_EQ(kept.lines.size(), 1);
  CHECK(kept.lines[0].find("too long") != std::string::npos);
}

TEST_CASE("a cancel is answered at once, and its request has the error cancelled") {
  KeptAnswers kept;
  LineProtocol protocol(kept.queue, kept.computer);
  protocol.receive({R"({"id": [7], "mesh": "slow"})"});
  kept.computer.waitForRequests(1);
  protocol.receive({R"({"cancel": 7})"});
  protocol.receive({R"({"cancel": [7]})"});
  kept.queue.finish();
  REQUIRE_EQ(kept.lines.size(), 3);
  CHECK_EQ(kept.lines[0], R"({"formatVersion":1,"cancel":7,"found":false})");
  CHECK(std::count(kept.lines.begin(), kept.lines.end(), R"({"formatVersion":1,"cancel":[7],"found":true})") == 1);
  CHECK(std::count(
            kept.lines.begin(), kept.lines.end(),
            R"({"formatVersion":1,"id":[7],"error":{"code":"cancelled","message":"cancelled","exitCode":130}})") == 1);
}

}  // namespace asdfvk::test
