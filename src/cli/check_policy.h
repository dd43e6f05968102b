#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/baseline.h"
#include "describe/computation_options.h"

namespace asdfvk {

/// Options for the meshes whose paths match a pattern. An unset value removes a limit.
struct LimitRule {
  std::string files;  ///< A pattern of the shell; * also matches /. Without a / it is compared with the file name.
  std::vector<std::pair<std::string, OptionValue>> options;
};

/// The file of --limits: all rules that match a mesh apply, the last one wins.
struct LimitRules {
  std::string folder;  ///< The folder of the file, to which the patterns refer.
  std::vector<LimitRule> rules;

  /// The settings with the options for this mesh. Throws the errors of complete().
  [[nodiscard]] ComputationSettings applied(const std::string& mesh, const ComputationSettings& settings) const;
};

/// What the checks of single meshes depend on.
struct CheckPolicy {
  LimitRules limits;
  Baseline baseline;
};

/// Throws Error{UnreadableInput}, and the errors of setOption() for wrong values.
[[nodiscard]] LimitRules readLimits(const std::string& path);

/// The JSON Schemas of the file and of a rule, by their names in docs/schema.json.
[[nodiscard]] Json limitDefinitions();

void to_json(Json& json, const LimitRules& limits);
void from_json(const Json& json, LimitRules& limits);

}  // namespace asdfvk
