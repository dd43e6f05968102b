#include "serve/line_protocol.h"

#include <memory>
#include <string_view>
#include <utility>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

std::string errorAnswer(const Json& id, const RequestFailure& failure) {
  return jsonText(ErrorAnswer{.id = id, .error = failure});
}

template <typename T>
OptionalKey<T> keyOf(const std::optional<T>& value) {
  return value ? OptionalKey<T>(*value) : OptionalKey<T>();
}

std::string answerOf(const Json& id, const MeshAnswer& answer) {
  if (answer.report.empty()) return errorAnswer(id, answer.failure.value_or(RequestFailure{"internal", "", 70}));
  // The report is a text already. To parse it and to write it again would take longer than to compute a small mesh.
  std::string text = jsonText(ReportAnswer{.id = id,
                                           .failure = keyOf(answer.failure),
                                           .output = keyOf(answer.output),
                                           .picture = keyOf(answer.picture),
                                           .report = nullptr});
  text.resize(text.size() - std::string_view("null}").size());
  return text + answer.report + "}";
}

}  // namespace

void LineProtocol::receive(const RequestLine& line) {
  if (line.isTooLong)
    return refuse(nullptr, "the line is too long; name the file of the mesh, or give --max-memory more");
  Json id;
  try {
    const Json json = parsedRequest(line.text);
    if (!json.is_object()) throw Error(ErrorCode::UnreadableInput, "the line is not a JSON object");
    id = json.value("id", Json());
    receiveObject(json, line.text.size());
  } catch (const Error& error) {
    refuse(id, error.what());
  }
}

void LineProtocol::refuse(const Json& id, const std::string& message) {
  queue_.add(id, 0, [answer = errorAnswer(id, invalidRequest(message))](const RequestContext&) { return answer; });
}

void LineProtocol::receiveObject(const Json& json, size_t byteCount) {
  if (const auto cancelled = json.find("cancel"); cancelled != json.end()) {
    const bool isFound = queue_.cancel(*cancelled);
    return queue_.answer(jsonText(CancelAnswer{.cancel = *cancelled, .found = isFound}));
  }
  const auto request = std::make_shared<const MeshRequest>(meshRequestOf(json));
  const Json id = json.value("id", Json());
  queue_.add(id, byteCount, [this, id, request](const RequestContext& context) {
    return answerOf(id, computer_.compute(*request, context, {}));
  });
}

}  // namespace asdfvk
