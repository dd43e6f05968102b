#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "arguments/arguments.h"
#include "asdf_vk/choices.h"
#include "asdf_vk/options.h"
#include "cli/options.h"

/// Kinds of options with a value, and the values themselves. A wrong value is Error of kind Usage.
namespace asdfvk {

/// Groups of --help=all. --help shows the first one only.
inline constexpr const char* kBasicGroup = "Options";
inline constexpr const char* kExperimentGroup = "Experiments (the defaults are best)";

/// Name, description and every option of the program, which set `line`.
void addOptions(ArgumentParser& parser, CommandLine& line);

/// Adds the options of the computation, which set line.computation.options and line.computation.recipe.
void addComputation(ArgumentParser& parser, CommandLine& line);

/// Throws Error{OptionConflict} where --fields or --picture-of names a field that only the option `needed` computes.
void refuseField(const CommandLine& line, const std::string& field, const std::string& needed);

/// Adds the options of post-processing and segmentation.
void addSegments(ArgumentParser& parser, Options& options);

/// --segment without a value, at the end or before an option or a file, becomes --segment=parts. A file is a name that
/// has a dot or a slash, is "-", or exists; the names of kSegmentations are values, also where such a file exists.
void expandBareSegment(std::vector<std::string>& arguments);

/// After parsing: validates the options of post-processing and segmentation and applies what they imply; refuses their
/// fields where they are not computed.
void completeSegments(const ArgumentParser& parser, CommandLine& line);

/// The same for the options of the measured quantity.
void addMeasure(ArgumentParser& parser, CommandLine& line);
void completeMeasure(const ArgumentParser& parser, CommandLine& line);

/// The same for the options of a page; after completeMeasure().
void addPage(ArgumentParser& parser, CommandLine& line);
void completePage(const ArgumentParser& parser, CommandLine& line);

/// The same for the options of many meshes; after completePage().
void addBatch(ArgumentParser& parser, CommandLine& line);
void completeBatch(const ArgumentParser& parser, CommandLine& line);

/// receive: reads the value and throws Error; the name of the option is put before its message.
Argument addValue(ArgumentParser& parser, std::string_view name, std::string_view placeholder, std::string_view text,
                  std::function<void(const std::string&)> receive);

/// One of several names. receive: gets the index of the name.
Argument addChoice(ArgumentParser& parser, std::string_view name, std::vector<std::string> names, std::string_view text,
                   std::function<void(size_t)> receive);

/// The same. target: a string that outlives the parsing.
Argument addName(ArgumentParser& parser, std::string_view name, std::string& target, std::vector<std::string> names,
                 std::string_view text);

/// The first members of a table of pairs: the names of its rows.
template <typename Table>
[[nodiscard]] std::vector<std::string> namesOf(const Table& table) {
  std::vector<std::string> names;
  for (const auto& row : table) names.emplace_back(row.first);
  return names;
}

/// "auto", then the names.
[[nodiscard]] std::vector<std::string> withAuto(std::vector<std::string> names);

/// One of several named values. target: a variable, or a function that takes the value. Variable and choices outlive
/// the parsing.
template <typename Target, typename T, size_t N>
Argument addChoice(ArgumentParser& parser, std::string_view name, Target&& target, const ChoiceNames<T, N>& choices,
                   std::string_view text) {
  if constexpr (std::is_invocable_v<Target, const T&>) {
    return addChoice(parser, name, namesOf(choices), text,
                     [target, &choices](size_t index) { target(choices[index].second); });
  } else {
    return addChoice(parser, name, namesOf(choices), text,
                     [&target, &choices](size_t index) { target = choices[index].second; });
  }
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

/// "10%" (above 0, at most 100), "2000" (at least 1), "all" or "auto".
[[nodiscard]] SeedCount parseSeedCount(const std::string& text);

/// "2000" (at least 1) or "all" (parsed as the largest number).
[[nodiscard]] uint64_t parseCheckCount(const std::string& text);

/// In the form that parseSeedCount() reads.
[[nodiscard]] std::string toText(const SeedCount& seeds);

/// Throws Error{OptionConflict}.
[[noreturn]] void refuseOptions(const std::string& message);

}  // namespace asdfvk
