#include <doctest/doctest.h>

#include <cstdint>
#include <random>

#include "serve/fake_computer.h"
#include "serve/line_protocol.h"
#include "serve/mcp_protocol.h"

namespace asdfvk::test {
namespace {

const std::vector<std::string> kLines{
    R"({"id": 1, "mesh": "a.stl", "options": {"thinnerThan": 0.8, "measure": "both"}, "timeout": 3})",
    R"({"id": "x", "format": "stl", "data": "AAECAw==", "output": {"inline": true, "format": "npy"}})",
    R"({"id": null, "vertices": [[0,0,0],[1,0,0],[0,1,0]], "faces": [[0,1,2]], "picture": {"of": "sdf"}})",
    R"({"cancel": 1})",
    R"({"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"protocolVersion": "2025-06-18"}})",
    R"({"jsonrpc": "2.0", "id": 2, "method": "tools/list"})",
    R"({"jsonrpc": "2.0", "id": 3, "method": "tools/call", "params": {"name": "check_walls", "arguments": {"mesh": "a", "thinnerThan": 1}, "_meta": {"progressToken": 5}}})",
    R"({"jsonrpc": "2.0", "method": "notifications/cancelled", "params": {"requestId": 3}})",
    R"([{"jsonrpc": "2.0", "id": 4, "method": "ping"}])",
};

/// The line with bytes that are replaced, removed, repeated or taken from another line.
std::string mutated(std::string line, std::mt19937& random) {
  const auto below = [&](size_t count) { return static_cast<size_t>(random()) % std::max<size_t>(count, 1); };
  constexpr std::string_view kBytes = "{}[]\",:0123456789eE+-.ntf\\u \x7f\xff";
  for (size_t i = 0; i <= below(4); ++i) {
    const size_t at = below(line.size());
    switch (below(4)) {
      case 0:
        line[at] = kBytes[below(kBytes.size())];
        break;
      case 1:
        line.erase(at, 1 + below(8));
        break;
      case 2:
        line.insert(at, line.substr(below(line.size()), 1 + below(20)));
        break;
      default:
        line.insert(at, kLines[below(kLines.size())].substr(below(13), 1 + below(40)));
    }
    if (line.empty()) line = " ";
  }
  std::erase(line, '\n');
  return line;
}

template <typename Protocol>
void checkMutations(uint32_t seed) {
  KeptAnswers kept(2);
  std::mt19937 random(seed);
  Protocol protocol(kept.queue, kept.computer);
  for (int i = 0; i < 4000; ++i) protocol.receive({mutated(kLines[random() % kLines.size()], random)});
  kept.queue.finish();
  CHECK_GT(kept.lines.size(), 1000);
  for (const std::string& line : kept.lines) {
    REQUIRE_FALSE(Json::parse(line, nullptr, false).is_discarded());
    REQUIRE_EQ(line.find('\n'), std::string::npos);
  }
}

}  // namespace

TEST_CASE("mutated requests never end the loop, and each answer is one line of JSON") {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    checkMutations<LineProtocol>(seed);
    checkMutations<McpProtocol>(seed);
  }
}

}  // namespace asdfvk::test
