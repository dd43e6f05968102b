#include "serve/mcp_protocol.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
#include <string_view>
#include <utility>

#include "asdf_vk/error.h"
#include "asdf_vk/version.h"
#include "describe/option_json.h"
#include "serve/mcp_tools.h"

namespace asdfvk {
namespace {

constexpr std::array<std::string_view, 4> kVersions{"2024-11-05", "2025-03-26", "2025-06-18", "2025-11-25"};
/// The first version with structured content.
constexpr std::string_view kStructuredVersion = "2025-06-18";

constexpr auto kProgressTime = std::chrono::milliseconds(100);

constexpr const char* kInstructions =
    "Lengths and limits are in the unit of the mesh; a limit may have a unit, such as 0.8mm, if the file states its "
    "unit. Call check_walls for a verdict before printing, and picture to see the thin places.";

/// An error of JSON-RPC, as opposed to an error of a tool.
struct ProtocolError {
  int code;
  std::string message;
};
constexpr int kParseError = -32700, kInvalidMessage = -32600, kUnknownMethod = -32601, kInvalidParams = -32602;

Json responseOf(const Json& id, Json result) { return {{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}}; }

Json errorResponse(const Json& id, const ProtocolError& error) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", error.code}, {"message", error.message}}}};
}

/// The value of a key of an object; null if there is none.
Json valueAt(const Json& object, const char* key) {
  const auto value = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && value != object.end() ? *value : Json();
}

Json initialization(const std::string& version) {
  return {{"protocolVersion", version},
          {"capabilities", {{"tools", {{"listChanged", false}}}}},
          {"serverInfo", {{"name", "asdf-vk"}, {"title", "asdf-vk: thickness of meshes"}, {"version", ASDFVK_VERSION}}},
          {"instructions", kInstructions}};
}

/// Sends notifications of the progress, at most one per kProgressTime.
class ProgressNotifier {
 public:
  ProgressNotifier(RequestQueue& queue, Json token) : queue_(queue), token_(std::move(token)) {}

  void update(double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (fraction <= sent_ || (sent_ > 0 && now - time_ < kProgressTime)) return;  // The progress must increase.
    sent_ = fraction;
    time_ = now;
    const Json params{{"progressToken", token_}, {"progress", fraction}, {"total", 1}};
    queue_.answer(jsonText({{"jsonrpc", "2.0"}, {"method", "notifications/progress"}, {"params", params}}));
  }

 private:
  RequestQueue& queue_;
  Json token_;
  double sent_ = 0;
  std::chrono::steady_clock::time_point time_;
};

}  // namespace

class McpProtocol::Reply {
 public:
  /// messageCount: number of messages of a list; 0: the line has one message.
  Reply(RequestQueue& queue, size_t messageCount)
      : queue_(queue), isList_(messageCount > 0), openCount_(messageCount) {}

  /// The response to one message; null: the message has no response.
  [[nodiscard]] std::string lineFor(Json response) {
    if (!isList_) return response.is_null() ? "" : jsonText(response);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!response.is_null()) responses_.push_back(std::move(response));
    return --openCount_ > 0 || responses_.empty() ? "" : jsonText(responses_);
  }
  void send(Json response) {
    if (const std::string line = lineFor(std::move(response)); !line.empty()) queue_.answer(line);
  }

 private:
  RequestQueue& queue_;
  bool isList_;
  std::mutex mutex_;
  size_t openCount_;
  Json responses_ = Json::array();
};

void McpProtocol::receive(const RequestLine& line) {
  Json message;
  try {
    if (line.isTooLong) throw Error(ErrorCode::UnreadableInput, "the line is too long");
    message = parsedRequest(line.text);
  } catch (const Error& error) {
    return queue_.answer(jsonText(errorResponse(nullptr, {kParseError, error.what()})));
  }
  const bool isList = message.is_array() && !message.empty();
  const auto reply = std::make_shared<Reply>(queue_, isList ? message.size() : 0);
  if (!isList) return receiveMessage(message, line.text.size(), reply);
  for (const Json& part : message) receiveMessage(part, line.text.size() / message.size(), reply);
}

void McpProtocol::receiveMessage(const Json& message, size_t byteCount, const std::shared_ptr<Reply>& reply) {
  const Json id = valueAt(message, "id"), method = valueAt(message, "method"), params = valueAt(message, "params");
  const bool isNotification = message.is_object() && !message.contains("id");
  const bool isResponse =
      message.is_object() && method.is_null() && (message.contains("result") || message.contains("error"));
  if (isResponse) return reply->send(nullptr);  // The server sends no requests.
  try {
    if (!method.is_string() || valueAt(message, "jsonrpc") != "2.0" || id.is_structured())
      throw ProtocolError{kInvalidMessage, "the message is no request of JSON-RPC 2.0"};
    const auto name = method.get<std::string>();
    if (isNotification) {
      if (name == "notifications/cancelled") (void)queue_.cancel(valueAt(params, "requestId"));
      return reply->send(nullptr);
    }
    if (name == "tools/call") return callTool(id, params, byteCount, reply);
    reply->send(responseOf(id, resultOf(name, params)));
  } catch (const ProtocolError& error) {
    reply->send(errorResponse(id.is_structured() ? Json() : id, error));
  }
}

Json McpProtocol::resultOf(const std::string& method, const Json& params) {
  if (method == "initialize") {
    const Json wanted = valueAt(params, "protocolVersion");
    if (!wanted.is_string()) throw ProtocolError{kInvalidParams, "protocolVersion is missing"};
    const bool isKnown = std::find(kVersions.begin(), kVersions.end(), wanted.get<std::string>()) != kVersions.end();
    version_ = isKnown ? wanted.get<std::string>() : std::string(kVersions.back());
    return initialization(version_);
  }
  if (method == "ping") return Json::object();
  if (method == "tools/list") {
    Json tools = Json::array();
    for (const McpTool& tool : mcpTools()) tools.push_back(descriptionOf(tool));
    return {{"tools", std::move(tools)}};
  }
  throw ProtocolError{kUnknownMethod, fmt::format("there is no method {}", method)};
}

void McpProtocol::callTool(const Json& id, const Json& params, size_t byteCount, const std::shared_ptr<Reply>& reply) {
  const Json name = valueAt(params, "name");
  const McpTool* const tool = name.is_string() ? findMcpTool(name.get<std::string>()) : nullptr;
  if (tool == nullptr) {
    std::vector<std::string> names;
    for (const McpTool& other : mcpTools()) names.emplace_back(other.name);
    throw ProtocolError{kInvalidParams,
                        fmt::format("there is no tool {}{}", shownJson(name),
                                    name.is_string() ? similarNameQuestion(name.get<std::string>(), names) : "")};
  }
  Json arguments = valueAt(params, "arguments");
  if (arguments.is_null()) arguments = Json::object();
  if (!arguments.is_object()) throw ProtocolError{kInvalidParams, "arguments is not an object"};
  const Json token = valueAt(valueAt(params, "_meta"), "progressToken");
  std::shared_ptr<const MeshRequest> request;
  try {
    request = std::make_shared<const MeshRequest>(requestOf(*tool, arguments));
  } catch (const Error& error) {  // A model can correct its arguments, so that the client must show it the error.
    return reply->send(responseOf(id, toolErrorOf(invalidRequest(error.what()))));
  }
  const bool repeatsReport = version_ < kStructuredVersion;
  queue_.add(id, byteCount, [this, id, request, token, repeatsReport, reply](const RequestContext& context) {
    ProgressNotifier notifier(queue_, token);
    std::function<void(double)> progress;
    if (!token.is_null()) progress = [&notifier](double fraction) { notifier.update(fraction); };
    const MeshAnswer answer = computer_.compute(*request, context, progress);
    const bool isCancelled = answer.failure && answer.failure->code == nameOf(ErrorCode::Cancelled);
    return reply->lineFor(isCancelled ? Json() : responseOf(id, toolResultOf(answer, repeatsReport)));
  });
}

}  // namespace asdfvk
