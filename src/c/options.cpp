#include <fmt/core.h>

#include "c/objects.h"
#include "core/text.h"

namespace asdfvk::c {
namespace {

constexpr OptionSpelling kSpelling = OptionSpelling::Name;

/// Returns null for an unknown name, and for an option that only the program has (its keyword is empty).
const OptionRow* rowOf(OptionRows rows, std::string_view name) {
  const OptionRow* const row = findOption(rows, name);
  return row == nullptr || isOfProgram(*row) ? nullptr : row;
}

void setText(const OptionRow& row, void* target, const std::string& text) {
  if (!isFlag(row)) return setOptionText(row, target, text, kSpelling);
  const std::string word = lowerCase(text);
  const bool isOn = word == "on" || word == "true", isOff = word == "off" || word == "false";
  if (!isOn && !isOff)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("{}: '{}' is not on or off", row.name, text),
                {{"option", row.name}});
  setOption(row, target, isOn, text, kSpelling);
}

/// Sets the options in the order of the rows. other: rows of options that are refused. use: the object that has the
/// refused options, for the message.
GivenOptions setAll(OptionRows rows, void* target, const asdf_vk_options* handle, OptionRows other, const char* use) {
  GivenOptions given{.names = {}, .spelling = kSpelling};
  if (handle == nullptr) return given;
  const auto options = handles<asdf_vk_options>().get(handle);
  for (const auto& [name, text] : options->texts)
    if (findOption(other, name) != nullptr)
      throw Error(ErrorCode::OptionConflict, fmt::format("{} is an option of a {}", name, use), {{"option", name}});
  for (const OptionRow& row : rows) {
    const auto found = options->texts.find(row.name);
    if (found == options->texts.end()) continue;
    setText(row, target, found->second);
    given.names.insert(row.name);
  }
  return given;
}

[[noreturn]] void failName(const std::string& name) {
  if (const std::string removed = removedOptionText(name, kSpelling); !removed.empty())
    throw Error(ErrorCode::UnknownName, removed, {{"option", name}});
  std::vector<std::string> names;
  for (const OptionRows rows : {computationRows(), sessionRows()})
    for (const OptionRow& row : rows)
      if (rowOf(rows, row.name) != nullptr) names.emplace_back(row.name);
  const std::string similar = similarNames(name, names);
  throw Error(ErrorCode::UnknownName,
              fmt::format("there is no option '{}'{}", name, similar.empty() ? "" : "; did you mean " + similar + "?"));
}

}  // namespace

SessionSettings sessionSettings(const asdf_vk_options* options) {
  SessionSettings session;
  (void)setAll(sessionRows(), &session, options, computationRows(), "computation");
  requireValid(session, kSpelling);
  return session;
}

ComputationSettings computationSettings(const asdf_vk_options* options, bool compares) {
  ComputationSettings computation;
  computation.compares = compares;
  complete(computation, setAll(computationRows(), &computation, options, sessionRows(), "session"));
  return computation;
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
  std::vector<std::string> names;
  for (const OptionRow& row : computationRows())
    if (hasEffect(row)) names.emplace_back(row.name);
  for (const auto& [name, text] : handles<asdf_vk_options>().get(handle)->texts)
    if (!hasEffect(*rowOf(computationRows(), name)))
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
    ComputationSettings computation;  // Used only to check the value.
    SessionSettings session;
    const OptionRow* const ofComputation = rowOf(computationRows(), name);
    const OptionRow* const ofSession = rowOf(sessionRows(), name);
    if (ofComputation == nullptr && ofSession == nullptr) failName(name);
    if (value == nullptr) {
      object->texts.erase(name);
      return;
    }
    if (ofComputation != nullptr) setText(*ofComputation, &computation, value);
    if (ofSession != nullptr) setText(*ofSession, &session, value);
    object->texts[name] = value;
  });
}

void asdf_vk_options_destroy(asdf_vk_options* options) { handles<asdf_vk_options>().destroy(options); }

}  // extern "C"
