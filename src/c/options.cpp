#include "c/options.h"

#include <fmt/core.h>

#include "c/call_guard.h"
#include "c/handles.h"
#include "core/text.h"
#include "describe/option_json.h"
#include "describe/option_rules.h"

namespace asdfvk::c {
namespace {

constexpr OptionSpelling kSpelling = OptionSpelling::Name;

/// Returns null for an unknown name, and for an option that only the program has.
const OptionRow* rowOf(const OptionRows& rows, std::string_view name) {
  const OptionRow* const row = findOption(rows, name);
  return row == nullptr || row->where == OptionPlace::Program ? nullptr : row;
}

void setText(const OptionRow& row, const std::string& text) {
  if (!isFlag(row)) return setOptionText(row, text, kSpelling);
  const std::string word = lowerCase(text);
  const bool isOn = word == "on" || word == "true", isOff = word == "off" || word == "false";
  if (!isOn && !isOff)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("{}: '{}' is not on or off", row.name, text),
                {{"option", row.name}});
  setOption(row, isOn, text, kSpelling);
}

/// Sets the options in the order of the rows. other: rows of options that are refused. use: the object that has the
/// refused options, for the message.
GivenOptions setAll(const OptionRows& rows, const asdf_vk_options* handle, const OptionRows& other, const char* use) {
  GivenOptions given{.names = {}, .spelling = kSpelling};
  if (handle == nullptr) return given;
  const auto options = handles<asdf_vk_options>().get(handle);
  for (const auto& [name, text] : options->texts)
    if (findOption(other, name) != nullptr)
      throw Error(ErrorCode::OptionConflict, fmt::format("{} is an option of a {}", name, use), {{"option", name}});
  for (const OptionRow& row : rows) {
    const auto found = options->texts.find(row.name);
    if (found == options->texts.end()) continue;
    setText(row, found->second);
    given.names.insert(row.name);
  }
  return given;
}

[[noreturn]] void failName(const std::string& name, const SettingsWithRows& all) {
  if (const std::string removed = removedOptionText(name, kSpelling); !removed.empty())
    throw Error(ErrorCode::UnknownName, removed, {{"option", name}});
  std::vector<std::string> names;
  for (const OptionRows* const rows : {&all.ofComputation, &all.ofSession})
    for (const OptionRow& row : *rows)
      if (rowOf(*rows, row.name) != nullptr) names.emplace_back(row.name);
  throw Error(ErrorCode::UnknownName, fmt::format("there is no option '{}'{}", name, similarNameQuestion(name, names)));
}

}  // namespace

SessionSettings sessionSettings(const asdf_vk_options* options) {
  SettingsWithRows all;
  (void)setAll(all.ofSession, options, all.ofComputation, "computation");
  requireValid(all.session, kSpelling);
  return all.session;
}

ComputationSettings computationSettings(const asdf_vk_options* options, bool compares) {
  SettingsWithRows all;
  all.computation.compares = compares;
  complete(all.computation, setAll(all.ofComputation, options, all.ofSession, "session"));
  return all.computation;
}

Options pointOptions(const asdf_vk_options* handle) {
  Options options = computationSettings(handle, false).options;
  if (options.measure != Measure::ShapeDiameter && options.measure != Measure::Thickness)
    throw Error(ErrorCode::OptionConflict,
                fmt::format("measure={} is for faces only; at points, measure either the diameter or the thickness",
                            nameOf(kMeasures, options.measure)));
  if (handle == nullptr) return options;
  const bool isThickness = options.measure == Measure::Thickness;
  const auto hasEffect = [&](const OptionRow& row) {
    return row.atPoints == AtPoints::Both || row.atPoints == (isThickness ? AtPoints::Thickness : AtPoints::Diameter);
  };
  const SettingsWithRows all;
  std::vector<std::string> names;
  for (const OptionRow& row : all.ofComputation)
    if (hasEffect(row)) names.emplace_back(row.name);
  for (const auto& [name, text] : handles<asdf_vk_options>().get(handle)->texts)
    if (!hasEffect(*rowOf(all.ofComputation, name)))
      throw Error(ErrorCode::OptionConflict,
                  fmt::format("{} has no effect on the {} at points; remove it (the options are {})", name,
                              isThickness ? "thickness" : "shape diameter", joined(names, ", ")),
                  {{"option", name}});
  return options;
}

}  // namespace asdfvk::c

using namespace asdfvk;     // NOLINT: the functions of C have no namespace.
using namespace asdfvk::c;  // NOLINT

extern "C" {

asdf_vk_status asdf_vk_options_create(asdf_vk_options** options) {
  return guarded([&] {
    requireArgument(options, "the output");
    *options = handles<asdf_vk_options>().add(std::make_shared<asdf_vk_options>());
  });
}

asdf_vk_status asdf_vk_options_set(asdf_vk_options* options, const char* name, const char* value) {
  return guarded([&] {
    const auto object = handles<asdf_vk_options>().get(options);
    requireArgument(name, "the name of the option");
    SettingsWithRows all;  // Used only to check the value.
    const OptionRow* const ofComputation = rowOf(all.ofComputation, name);
    const OptionRow* const row = ofComputation != nullptr ? ofComputation : rowOf(all.ofSession, name);
    if (row == nullptr) failName(name, all);
    if (value == nullptr) {
      object->texts.erase(name);
      return;
    }
    setText(*row, value);
    object->texts[name] = value;
  });
}

void asdf_vk_options_destroy(asdf_vk_options* options) { handles<asdf_vk_options>().destroy(options); }

}  // extern "C"
