#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "describe/option.h"

/// Options as JSON, with the names and values of the key "options" of the JSON report.
namespace asdfvk {

/// Returns no value for null, a list or an object.
[[nodiscard]] OptionValue optionValueOf(const nlohmann::ordered_json& json);

/// Sets the options of a JSON object, in the order of the rows, by their names in camel case. The value null leaves an
/// option as it is. Throws Error{OptionOutOfRange} and Error{UnknownName} for invalid values, and Error{UnknownName}
/// for a name without a row, with similar names.
[[nodiscard]] GivenOptions setOptions(std::span<const OptionRows> tables, const nlohmann::ordered_json& values);

/// A text such as "; did you mean thinnerThan?" for a misspelt name. Empty if no name is similar. Also finds names in
/// the spelling of another front end.
[[nodiscard]] std::string similarNameQuestion(std::string_view name, const std::vector<std::string>& names);

/// JSON Schema of the values of an option.
[[nodiscard]] nlohmann::ordered_json optionSchema(const OptionRow& row, const OptionRows& rows);

/// The schema of a value that may also be null.
[[nodiscard]] nlohmann::ordered_json orNull(nlohmann::ordered_json schema);

/// JSON Schema of an object with these options. The value null leaves an option as it is.
[[nodiscard]] nlohmann::ordered_json optionsSchema(std::span<const OptionRows> tables, OptionSpelling spelling);

}  // namespace asdfvk
