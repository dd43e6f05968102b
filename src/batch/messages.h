#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "batch/job.h"

/// What the main process and its workers send each other: CBOR. Strings may have any bytes.
namespace asdfvk {

using Json = nlohmann::ordered_json;

[[nodiscard]] std::string encode(const Json& json);
[[nodiscard]] Json decode(std::string_view message);

/// The first message to a worker. settings: those of the front end.
struct Greeting {
  Json settings;
  uint32_t threadCount = 1, threadCountOnGpu = 1;
};
[[nodiscard]] Json toJson(const Greeting& greeting);
[[nodiscard]] Greeting greetingOf(const Json& json);

/// A job to compute; its size is not sent.
[[nodiscard]] Json toJson(const Job& job);
[[nodiscard]] Job jobOf(const Json& json);

[[nodiscard]] Json toJson(const JobResult& result);
[[nodiscard]] JobResult resultOf(const Json& json);

/// The answer to the greeting: what the worker has opened, or why it cannot.
[[nodiscard]] Json toJson(const ComputerDescription& description);
[[nodiscard]] Json toJson(const OpenFailure& failure);
/// Throws OpenFailure.
[[nodiscard]] ComputerDescription descriptionOf(const Json& json);

}  // namespace asdfvk
