#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "asdf_vk/field.h"
#include "asdf_vk/report.h"
#include "describe/session_options.h"

namespace asdfvk {

/// The key formatVersion of each JSON document. A change of the meaning of a key increases it.
inline constexpr int kReportFormatVersion = 1;

void to_json(nlohmann::ordered_json& json, const TraceVariant& variant);

[[nodiscard]] nlohmann::ordered_json toJson(const OptionValue& value);

[[nodiscard]] nlohmann::ordered_json toJson(const Report& report);

/// The value of the key "options" in the JSON report: the options that affect the result.
[[nodiscard]] nlohmann::ordered_json optionValues(const ComputationSettings& computation,
                                                  const SessionSettings& session);

/// The JSON report of docs/formats.md, without the names of files.
[[nodiscard]] nlohmann::ordered_json resultJson(const Report& report, std::span<const Field> fields,
                                                const ComputationSettings& computation, const SessionSettings& session);

}  // namespace asdfvk
