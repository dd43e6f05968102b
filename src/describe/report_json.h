#pragma once

#include <span>
#include <string>
#include <vector>

#include "asdf_vk/field.h"
#include "asdf_vk/report.h"
#include "core/json.h"
#include "describe/session_options.h"

namespace asdfvk {

/// A field of the result.
struct ReportedField {
  std::string name;         ///< Name of the field.
  std::string unit;         ///< `length`, or empty.
  std::string per;          ///< `face` or `vertex`.
  uint32_t components;      ///< Numbers per face or vertex.
  std::string type;         ///< Type in memory: `float64`, `uint8` or `uint32`.
  double min, median, max;  ///< Minimum, median and maximum of the values.
  uint64_t missingCount;    ///< Faces or vertices without a value.
};
ASDFVK_JSON_KEYS(ReportedField, name, unit, per, components, type, min, median, max, missingCount)

/// What a JSON report has beside the keys of Report.
struct ResultFacts {
  int formatVersion = kJsonFormatVersion;  ///< Version of the format of JSON documents.
  std::vector<ReportedField> fields;       ///< Fields of the result, also those that are not written to a file.
  std::string version, commit;             ///< Version and commit of the program.
  Json options;                            ///< Options that affect the result.
};
ASDFVK_JSON_KEYS(ResultFacts, formatVersion, fields, version, commit, options)

void to_json(Json& json, const TraceVariant& variant);

[[nodiscard]] Json toJson(const OptionValue& value);

[[nodiscard]] Json toJson(const Report& report);

/// The value of the key "options" in the JSON report: the options that affect the result.
[[nodiscard]] Json optionValues(const ComputationSettings& computation, const SessionSettings& session);

/// The JSON report of docs/formats.md, without the names of files.
[[nodiscard]] Json resultJson(const Report& report, std::span<const Field> fields,
                              const ComputationSettings& computation, const SessionSettings& session);

}  // namespace asdfvk
