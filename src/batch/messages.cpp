#include "batch/messages.h"

namespace asdfvk {

std::string encode(const Json& json) {
  std::string message;
  Json::to_cbor(json, message);
  return message;
}

Json decode(std::string_view message) { return Json::from_cbor(message); }

Json toJson(const Greeting& greeting) {
  return {{"settings", greeting.settings},
          {"threadCount", greeting.threadCount},
          {"threadCountOnGpu", greeting.threadCountOnGpu}};
}

Greeting greetingOf(const Json& json) {
  return {json.at("settings"), json.at("threadCount").get<uint32_t>(), json.at("threadCountOnGpu").get<uint32_t>()};
}

Json toJson(const Job& job) { return {{"input", job.input}, {"output", job.output}}; }

Job jobOf(const Json& json) { return {json.at("input").get<std::string>(), json.at("output").get<std::string>()}; }

Json toJson(const JobResult& result) {
  return {{"record", toJson(result.record)}, {"report", result.report}, {"messages", result.messages}};
}

JobResult resultOf(const Json& json) {
  return {recordOf(json.at("record")).value(), json.at("report").get<std::string>(),
          json.at("messages").get<std::string>()};
}

Json toJson(const ComputerDescription& description) {
  return {{"backend", description.backend}, {"deviceLines", description.deviceLines}, {"isCpu", description.isCpu}};
}

Json toJson(const OpenFailure& failure) {
  return {{"failure", failure.what()}, {"name", failure.name}, {"code", failure.code}};
}

ComputerDescription descriptionOf(const Json& json) {
  if (json.contains("failure"))
    throw OpenFailure(json.at("code").get<int>(), json.at("name").get<std::string>(),
                      json.at("failure").get<std::string>());
  return {json.at("backend").get<std::string>(), json.at("deviceLines").get<std::string>(),
          json.at("isCpu").get<bool>()};
}

}  // namespace asdfvk
