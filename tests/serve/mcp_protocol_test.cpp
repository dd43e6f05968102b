#include "serve/mcp_protocol.h"

#include <doctest/doctest.h>

#include "asdf_vk/version.h"
#include "serve/fake_computer.h"

namespace asdfvk::test {
namespace {

std::string rpc(const Json& id, const std::string& method, const Json& params) {
  Json message{{"jsonrpc", "2.0"}, {"method", method}, {"params", params}};
  if (!id.is_null()) message["id"] = id;
  return message.dump();
}

std::string initialize(const std::string& version) {
  return rpc(0, "initialize",
             {{"protocolVersion", version},
              {"capabilities", Json::object()},
              {"clientInfo", {{"name", "test"}, {"version", "1"}}}});
}

std::string call(const Json& id, const std::string& tool, const Json& arguments) {
  return rpc(id, "tools/call", {{"name", tool}, {"arguments", arguments}});
}

Json resultOfCall(const std::string& version, const std::string& tool, const Json& arguments) {
  KeptAnswers kept;
  const std::vector<Json> answers = kept.answersTo<McpProtocol>({initialize(version), call(1, tool, arguments)});
  REQUIRE_EQ(answers.size(), 2);
  return answers[1].at("result");
}

}  // namespace

TEST_CASE("the version of the client is used if it is known, else the latest one") {
  for (const std::string version : {"2024-11-05", "2025-03-26", "2025-06-18", "2025-11-25"}) {
    KeptAnswers kept;
    const Json answer = kept.answersTo<McpProtocol>({initialize(version)}).at(0);
    CHECK_EQ(answer.at("jsonrpc"), "2.0");
    CHECK_EQ(answer.at("id"), 0);
    const Json& result = answer.at("result");
    CHECK_EQ(result.at("protocolVersion"), version);
    CHECK(result.at("capabilities").contains("tools"));
    CHECK_EQ(result.at("serverInfo").at("version"), ASDFVK_VERSION);
  }
  KeptAnswers kept;
  const Json answer = kept.answersTo<McpProtocol>({initialize("1999-01-01")}).at(0);
  CHECK_EQ(answer.at("result").at("protocolVersion"), "2025-11-25");
}

TEST_CASE("requests of the life cycle are answered, and notifications are not") {
  KeptAnswers kept;
  const std::vector<Json> answers = kept.answersTo<McpProtocol>(
      {initialize("2025-06-18"), rpc(nullptr, "notifications/initialized", Json::object()),
       rpc("p", "ping", Json::object()), rpc(nullptr, "notifications/unknown", Json::object()),
       R"({"jsonrpc":"2.0","id":9,"result":{}})", rpc(2, "tools/list", Json::object())});
  REQUIRE_EQ(answers.size(), 3);
  CHECK_EQ(answers[1].dump(), R"({"jsonrpc":"2.0","id":"p","result":{}})");
  const Json& tools = answers[2].at("result").at("tools");
  REQUIRE_EQ(tools.size(), 4);
  for (const Json& tool : tools) {
    CHECK(tool.at("description").get<std::string>().size() > 50);
    const Json& schema = tool.at("inputSchema");
    CHECK_EQ(schema.at("type"), "object");
    CHECK_EQ(schema.at("required").dump(), R"(["mesh"])");
    CHECK_EQ(schema.at("additionalProperties"), false);
    for (const auto& property : schema.at("properties").items()) {
      CAPTURE(property.key());
      CHECK(property.value().contains("type"));
      CHECK(property.value().at("description").get<std::string>().find('{') == std::string::npos);
    }
  }
  CHECK(tools[0].at("inputSchema").at("properties").contains("thinnerThan"));
}

TEST_CASE("a call of a tool answers with the verdict, the report and a picture") {
  const Json checked = resultOfCall("2025-06-18", "check_walls", {{"mesh", "part.stl"}, {"thinnerThan", 0.8}});
  CHECK_EQ(checked.at("isError"), false);
  REQUIRE_EQ(checked.at("content").size(), 1);
  CHECK_EQ(checked.at("content")[0].at("text"), "FAIL: 1 wall thinner than 0.8\nmesh: 12 faces");
  CHECK_EQ(checked.at("structuredContent").at("verdict"), "failed");

  const Json old = resultOfCall("2024-11-05", "check_walls", {{"mesh", "part.stl"}, {"thinnerThan", "0.8mm"}});
  REQUIRE_EQ(old.at("content").size(), 2);
  CHECK_EQ(Json::parse(old.at("content")[1].at("text").get<std::string>()).at("mesh"), "part.stl");

  const Json drawn = resultOfCall("2025-06-18", "picture", {{"mesh", "part.stl"}, {"thinnerThan", 0.8}});
  REQUIRE_EQ(drawn.at("content").size(), 2);
  CHECK_EQ(drawn.at("content")[1].dump(), R"({"type":"image","data":"cGljdHVyZQ==","mimeType":"image/png"})");
}

TEST_CASE("a tool sets the options of its request") {
  KeptAnswers kept;
  (void)kept.answersTo<McpProtocol>(
      {initialize("2025-06-18"), call(1, "find_parts", {{"mesh", "a"}, {"parts", 4}, {"output", "a.asdf.ply"}}),
       call(2, "picture", {{"mesh", "a"}, {"of", "sdf"}, {"view", "30,18"}}), call(3, "measure", {{"mesh", "a"}})});
  const std::vector<MeshRequest> requests = kept.computer.requests();
  REQUIRE_EQ(requests.size(), 3);
  CHECK_EQ(requests[0].options.dump(), R"({"segment":"parts","parts":4})");
  CHECK_EQ(requests[0].output->path, "a.asdf.ply");
  CHECK_EQ(requests[1].picture->options.dump(), R"({"of":"sdf","view":"30,18"})");
  CHECK_EQ(requests[2].options.dump(), "{}");
}

TEST_CASE("wrong arguments and failed computations are results with isError") {
  const auto messageOf = [](const std::string& tool, const Json& arguments) {
    const Json result = resultOfCall("2025-06-18", tool, arguments);
    CHECK_EQ(result.at("isError"), true);
    return result.at("content").at(0).at("text").get<std::string>();
  };
  CHECK_EQ(messageOf("measure", {{"mesh", "missing"}}), "missing: cannot be opened");
  CHECK(messageOf("check_walls", {{"mesh", "a"}}).find("needs a limit") != std::string::npos);
  CHECK(messageOf("check_walls", {{"mesh", "a"}, {"thinner_than", 1}}).find("did you mean thinnerThan?") !=
        std::string::npos);
  CHECK(messageOf("measure", Json::object()).find("no mesh") != std::string::npos);
  CHECK(messageOf("measure", {{"data", "AAAA"}, {"format", "stl"}}).find("has no key 'data'") != std::string::npos);
  CHECK(messageOf("check_walls", {{"mesh", 5}, {"thinnerThan", 1}}).find("mesh: 5 is not a text") != std::string::npos);
}

TEST_CASE("messages that are no requests have errors of JSON-RPC") {
  const auto codeOfAnswer = [](const std::string& line) {
    KeptAnswers kept;
    const std::vector<Json> answers = kept.answersTo<McpProtocol>({line});
    REQUIRE_EQ(answers.size(), 1);
    return answers[0].at("error").at("code").get<int>();
  };
  CHECK_EQ(codeOfAnswer("nonsense"), -32700);
  CHECK_EQ(codeOfAnswer("[]"), -32600);
  CHECK_EQ(codeOfAnswer("5"), -32600);
  CHECK_EQ(codeOfAnswer(R"({"id": 1, "method": "ping"})"), -32600);
  CHECK_EQ(codeOfAnswer(R"({"jsonrpc": "2.0", "id": [1], "method": "ping"})"), -32600);
  CHECK_EQ(codeOfAnswer(R"({"jsonrpc": "2.0", "id": 1, "method": 5})"), -32600);
  CHECK_EQ(codeOfAnswer(rpc(1, "resources/list", Json::object())), -32601);
  CHECK_EQ(codeOfAnswer(rpc(1, "initialize", Json::object())), -32602);
  CHECK_EQ(codeOfAnswer(call(1, "chek_walls", Json::object())), -32602);
  CHECK_EQ(codeOfAnswer(call(1, "measure", Json::array({1}))), -32602);
}

TEST_CASE("a cancelled call has no answer, and the next call has one") {
  KeptAnswers kept;
  McpProtocol protocol(kept.queue, kept.computer);
  protocol.receive({call(1, "measure", {{"mesh", "slow"}})});
  protocol.receive({call(2, "measure", {{"mesh", "a"}})});
  kept.computer.waitForRequests(1);
  protocol.receive({rpc(nullptr, "notifications/cancelled", {{"requestId", 1}, {"reason", "test"}})});
  kept.queue.finish();
  REQUIRE_EQ(kept.lines.size(), 1);
  CHECK_EQ(Json::parse(kept.lines[0]).at("id"), 2);
}

TEST_CASE("progress is sent if the client gave a token, and increases") {
  KeptAnswers kept;
  const std::vector<Json> answers = kept.answersTo<McpProtocol>({rpc(
      1, "tools/call", {{"name", "measure"}, {"arguments", {{"mesh", "a"}}}, {"_meta", {{"progressToken", "t"}}}})});
  std::vector<double> fractions;
  for (size_t i = 0; i + 1 < answers.size(); ++i) {
    CHECK_EQ(answers[i].at("method"), "notifications/progress");
    CHECK_EQ(answers[i].at("params").at("progressToken"), "t");
    fractions.push_back(answers[i].at("params").at("progress").get<double>());
  }
  CHECK(fractions == std::vector<double>{0.1, 0.6, 1.0});
  CHECK_EQ(answers.back().at("id"), 1);
}

TEST_CASE("a list of messages has a list of answers") {
  KeptAnswers kept;
  const std::string list = "[" + rpc(1, "ping", Json::object()) + "," + call(2, "measure", {{"mesh", "a"}}) + "," +
                           rpc(nullptr, "notifications/initialized", Json::object()) + "]";
  const std::vector<Json> answers =
      kept.answersTo<McpProtocol>({list, "[" + rpc(nullptr, "notifications/initialized", Json::object()) + "]"});
  REQUIRE_EQ(answers.size(), 1);
  REQUIRE_EQ(answers[0].size(), 2);
  CHECK_EQ(answers[0][0].at("id"), 1);
  CHECK_EQ(answers[0][1].at("id"), 2);
}

}  // namespace asdfvk::test
