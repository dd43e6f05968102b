#include <filesystem>

#include "cli/sample_files.h"
#include "cli/scratch_folder.h"
#include "cli/served.h"
#include "io/base64_text.h"

namespace asdfvk::test {
namespace {

std::string mcpMessage(int id, const std::string& method, const ServedJson& params) {
  return ServedJson{{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", params}}.dump();
}

std::string toolCall(int id, const std::string& tool, const ServedJson& arguments) {
  return mcpMessage(id, "tools/call", {{"name", tool}, {"arguments", arguments}});
}

/// The results of the calls, in their order.
std::vector<ServedJson> mcpResults(const std::string& root, std::vector<std::string> calls) {
  const ServedJson initialization{{"protocolVersion", "2025-06-18"},
                                  {"capabilities", ServedJson::object()},
                                  {"clientInfo", {{"name", "test"}, {"version", "1"}}}};
  calls.insert(calls.begin(), {mcpMessage(0, "initialize", initialization),
                               R"({"jsonrpc": "2.0", "method": "notifications/initialized"})"});
  std::vector<ServedJson> results;
  for (ServedJson& answer : served(calls, {"--jobs", "1", "--root", root}, "mcp"))
    results.push_back(answer.at("result"));
  REQUIRE_EQ(results.size(), calls.size() - 1);
  results.erase(results.begin());
  return results;
}

std::string textOfResult(const ServedJson& result) { return result.at("content").at(0).at("text").get<std::string>(); }

}  // namespace

TEST_CASE("the tools of mcp compute meshes below the folder") {
  const ScratchFolder folder;
  folder.write("cube.stl", cubeBinaryStl());
  folder.write("sphere.off", sphereOff(12));
  const std::vector<ServedJson> results = mcpResults(
      folder / "", {toolCall(1, "check_walls", {{"mesh", "cube.stl"}, {"thinnerThan", 100}}),
                    toolCall(2, "check_walls", {{"mesh", "cube.stl"}, {"thinnerThan", 0.001}}),
                    toolCall(3, "measure", {{"mesh", "sphere.off"}, {"measure", "sdf"}, {"output", "values.npy"}}),
                    toolCall(4, "find_parts", {{"mesh", "sphere.off"}}),
                    toolCall(5, "picture", {{"mesh", "cube.stl"}, {"thinnerThan", 100}}),
                    toolCall(6, "picture", {{"mesh", "sphere.off"}, {"of", "sdf"}})});
  for (const ServedJson& result : results) {
    INFO(result.dump().substr(0, 300));
    CHECK_EQ(result.at("isError"), false);
    CHECK(result.at("structuredContent").contains("faceCount"));
  }
  CHECK(textOfResult(results[0]).starts_with("FAIL"));
  CHECK(textOfResult(results[0]).find("\nto do: ") != std::string::npos);
  CHECK(textOfResult(results[1]).find("\nto do: ") == std::string::npos);
  CHECK_FALSE(results[0].at("structuredContent").at("findings").empty());
  CHECK_EQ(results[0].at("structuredContent").at("thickness").at("verdict"), "failed");
  CHECK(textOfResult(results[1]).starts_with("PASS"));
  CHECK(std::filesystem::exists(folder / "values.npy"));
  CHECK_FALSE(results[3].at("structuredContent").at("parts").is_null());
  for (size_t i = 4; i < 6; ++i) {
    const ServedJson& image = results[i].at("content").at(1);
    CHECK_EQ(image.at("mimeType"), "image/png");
    const auto bytes = base64Bytes(image.at("data").get<std::string>());
    CHECK(std::string(bytes->begin(), bytes->end()).starts_with("\x89PNG"));
  }
}

TEST_CASE("mcp refuses files outside of the folder, and does not replace other files than results") {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "root");
  const std::string outside = folder.write("outside.off", sphereOff(6));
  folder.write("root/part.off", sphereOff(6));
  folder.write("root/notes.csv", "mine");
  const std::vector<ServedJson> results =
      mcpResults(folder / "root", {toolCall(1, "measure", {{"mesh", outside}}),
                                   toolCall(2, "measure", {{"mesh", "part.off"}, {"output", "../out.csv"}}),
                                   toolCall(3, "measure", {{"mesh", "part.off"}, {"output", "notes.csv"}}),
                                   toolCall(4, "measure", {{"mesh", "part.off"}, {"output", "part.asdf.csv"}}),
                                   toolCall(5, "measure", {{"mesh", "part.off"}, {"output", "part.asdf.csv"}})});
  for (size_t i = 0; i < 3; ++i) CHECK_EQ(results[i].at("isError"), true);
  CHECK(textOfResult(results[0]).find("is outside of") != std::string::npos);
  CHECK(textOfResult(results[1]).find("is outside of") != std::string::npos);
  CHECK(textOfResult(results[2]).find("notes.csv exists") != std::string::npos);
  for (size_t i = 3; i < 5; ++i) CHECK_EQ(results[i].at("isError"), false);
  CHECK_EQ(folder.read("root/notes.csv"), "mine");
}

}  // namespace asdfvk::test
