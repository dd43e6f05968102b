#include "page/page_contents.h"

#include <fmt/core.h>

#include <algorithm>

#include "asdf_vk/choices.h"
#include "describe/default_fields.h"

namespace asdfvk {

std::vector<std::reference_wrapper<const Field>> shownFields(const Result& result, const Options& options) {
  std::vector<std::reference_wrapper<const Field>> shown;
  for (const std::string& name : defaultFieldNames(options))
    if (const Field* const field = result.field(name)) shown.emplace_back(*field);
  for (const Field& field : result.fields) {
    const bool isShown = std::any_of(shown.begin(), shown.end(), [&](const Field& other) { return &other == &field; });
    if (field.location == FieldLocation::PerFace && field.componentCount == 1 && !isShown) shown.emplace_back(field);
  }
  std::stable_partition(shown.begin(), shown.end(), [](const Field& field) { return field.name == "segment"; });
  return shown;
}

std::string labelInPage(const std::string& name, const ComputationSettings& computation, const Report& report) {
  if (!computation.options.measuresDiameter()) return name;
  std::string label = fmt::format("{}, {}", name, nameOf(kRecipes, computation.recipe));
  if (computation.options.cone.definition != Definition::Paper)
    label += fmt::format(", definition {}", nameOf(kDefinitions, computation.options.cone.definition));
  if (report.seedCount >= report.triangleCount) return label + ", all faces";
  return label + fmt::format(", seeds {:.2g} %",
                             100.0 * static_cast<double>(report.seedCount) / static_cast<double>(report.triangleCount));
}

}  // namespace asdfvk
