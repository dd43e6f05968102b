#pragma once

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "asdf_vk/choices.h"
#include "asdf_vk/error.h"
#include "asdf_vk/options.h"
#include "cli/options.h"

/// Kinds of options with a value, and the values themselves. A wrong value is Error of kind Usage.
namespace asdfvk {

/// Groups of --help=all. --help shows the first one only.
inline constexpr const char* kBasicGroup = "Options";
inline constexpr const char* kExperimentGroup = "Experiments (the defaults are best)";

/// Name, description and every option of the program, which set `line`. The type name of an option, if it contains "|",
/// lists its values for completions where the placeholder in the help is only a name for them: "sdf|seed",
/// "FILE.ply|FILE.off".
void addOptions(CLI::App& app, CommandLine& line);

/// Adds the options of the computation, which set line.options and line.recipe.
void addComputation(CLI::App& app, CommandLine& line);

/// Throws Error{OptionConflict} where --fields or --picture-of names a field that only the option `needed` computes.
void refuseField(const CommandLine& line, const std::string& field, const std::string& needed);

/// Adds the options of post-processing and segmentation.
void addSegments(CLI::App& app, Options& options);

/// --segment without a value, at the end or before an option or a file, becomes --segment=parts. A file is a name that
/// has a dot or a slash, is "-", or exists; the names of kSegmentations are values, also where such a file exists.
void expandBareSegment(std::vector<std::string>& arguments);

/// After parsing: validates the options of post-processing and segmentation and applies what they imply; adds their
/// fields to line.fields unless --fields is given.
void completeSegments(const CLI::App& app, CommandLine& line);

/// The same for the options of the measured quantity.
void addMeasure(CLI::App& app, CommandLine& line);
void completeMeasure(const CLI::App& app, CommandLine& line);

/// The same for the options of a page; after completeMeasure(). Sets line.compared.
void addPage(CLI::App& app, CommandLine& line);
void completePage(const CLI::App& app, CommandLine& line);

/// The same for the options of many meshes; after completePage().
void addBatch(CLI::App& app, CommandLine& line);
void completeBatch(const CLI::App& app, CommandLine& line);

/// parse: reads the value and throws Error; the name of the option is put before its message.
template <typename Parse>
CLI::Option* addValue(CLI::App& app, const std::string& name, const std::string& placeholder, const std::string& text,
                      Parse parse) {
  return app
      .add_option_function<std::string>(
          name,
          [name, parse](const std::string& value) {
            try {
              parse(value);
            } catch (const Error& error) {
              throw Error(error.code(), name.substr(name.find("--")) + ": " + error.what());
            }
          },
          text)
      ->option_text(placeholder);
}

/// One of several names. target: a string that outlives the parsing.
inline CLI::Option* addName(CLI::App& app, const std::string& name, std::string& target,
                            const std::vector<std::string>& names, const std::string& text) {
  const std::string joinedNames = fmt::format("{}", fmt::join(names, "|"));
  return addValue(app, name, joinedNames, text, [&target, names, joinedNames](const std::string& choice) {
    if (std::find(names.begin(), names.end(), choice) == names.end())
      throw Error(ErrorCode::UnknownName, fmt::format("'{}' is not one of {}", choice, joinedNames));
    target = choice;
  });
}

/// "auto", then the names of a table: a range of strings, or of pairs of a name and a value.
template <typename Names>
[[nodiscard]] std::vector<std::string> withAuto(const Names& names) {
  std::vector<std::string> result{"auto"};
  for (const auto& entry : names) {
    if constexpr (requires { entry.first; }) {
      result.emplace_back(entry.first);
    } else {
      result.emplace_back(entry);
    }
  }
  return result;
}

/// One of several named values. target: a variable that outlives the parsing, or a function that takes the value.
template <typename Target, typename T, size_t N>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Target&& target, const ChoiceNames<T, N>& choices,
                       const std::string& text) {
  auto set = [&] {
    if constexpr (std::is_invocable_v<Target, const T&>) {
      return target;
    } else {
      return [&target](const T& value) { target = value; };
    }
  }();
  const std::string names = joined(choices);
  return addValue(app, name, names, text, [set, choices, names](const std::string& choice) {
    const auto found =
        std::find_if(choices.begin(), choices.end(), [&](const auto& candidate) { return candidate.first == choice; });
    if (found == choices.end())
      throw Error(ErrorCode::UnknownName, fmt::format("'{}' is not one of {}", choice, names));
    set(found->second);
  });
}

/// A whole number within [minimum, maximum], without sign.
[[nodiscard]] uint64_t parseWholeNumber(const std::string& text, uint64_t minimum, uint64_t maximum);

/// A finite number.
[[nodiscard]] double parseNumber(const std::string& text);

/// A finite number for which `accepts` returns true. complaint: the end of the error message, as in "'7' is not from 0
/// to 1".
[[nodiscard]] double parseNumber(const std::string& text, const std::function<bool(double)>& accepts,
                                 const char* complaint);

/// "2s" or "2": above 0, at most 1e9.
[[nodiscard]] double parseSeconds(const std::string& text);

/// "10%" (above 0, at most 100), "2000" (at least 1) or "all".
[[nodiscard]] SeedCount parseSeedCount(const std::string& text);

/// "2000" (at least 1) or "all" (parsed as the largest number).
[[nodiscard]] uint64_t parseCheckCount(const std::string& text);

/// In the form that parseSeedCount() reads.
[[nodiscard]] std::string toText(const SeedCount& seeds);

/// Throws Error{OptionConflict}.
[[noreturn]] void refuseOptions(const std::string& message);

}  // namespace asdfvk
