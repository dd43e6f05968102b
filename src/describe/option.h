#pragma once

#include <functional>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/api.h"
#include "describe/option_member.h"

/// Flags, help, range checks, JSON, keywords of Python and documents are derived from rows, one per option.
namespace asdfvk {

/// Spelling of option names in messages and reports: --cone-angle, coneAngleDegrees, cone_angle, cone-angle.
enum class OptionSpelling { Flag, CamelCase, SnakeCase, Name };

/// Where an option exists. Library: in C and Python.
enum class OptionPlace { Everywhere, Program, Library };

/// The unit ends the name in reports: coneAngleDegrees.
enum class OptionUnit { None, Degrees, Seconds };

/// A range of whole numbers must include its bounds.
struct OptionRange {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  bool excludesMin = false, excludesMax = false;
};
[[nodiscard]] constexpr OptionRange fromTo(double min, double max) { return {min, max, false, false}; }
[[nodiscard]] constexpr OptionRange above(double min) {
  return {min, std::numeric_limits<double>::infinity(), true, false};
}
[[nodiscard]] constexpr OptionRange aboveAndBelow(double min, double max) { return {min, max, true, true}; }
[[nodiscard]] constexpr OptionRange aboveUpTo(double min, double max) { return {min, max, true, false}; }

/// The values at points (Scene::valuesAt(), Scene::thicknessAt()) that an option changes.
enum class AtPoints { None, Diameter, Thickness, Both };

/// An option and the member that it sets. In all texts, options are in braces: {seeds}, {seeds=all}; see
/// withSpelledOptions(). A text without these is the same for all front ends.
struct OptionRow {
  const char* name;             ///< "max-error"
  const char* group = nullptr;  ///< Heading in the help; null: the group of the row before, see withGroups().
  OptionMember member;
  OptionRange range = {};
  OptionUnit unit = OptionUnit::None;
  const char* text = "";  ///< Text of the help, without range, default and final full stop.
  const char* more = "";  ///< Further sentences for the man page and docs/options.md.
  /// Stands for the value in the help. Empty if the option has no value, a unit, or values with names.
  const char* placeholder = "";
  /// The option that this option needs, with the values that it may have, for example "measure=thickness|both"; or one
  /// of several options: "thinner-than|closer-than".
  const char* needs = "";
  AtPoints atPoints = AtPoints::None;
  const char* defaultText = nullptr;  ///< Shown instead of the default value.
  const char* flags = nullptr;        ///< Such as "-o,--output"; null: "--" and the name.
  const char* keyword = nullptr;      ///< Keyword of Python; null: the name of the option.
  OptionPlace where = OptionPlace::Everywhere;
  std::vector<std::string> (*names)() = nullptr;  ///< Returns the allowed values if the codec has none.
  const char* bareValue = nullptr;  ///< Value of an option that is given without a value; null: a value is required.
  /// Description of valid values for messages, such as "an error such as 1%"; null: that of the codec. Options in
  /// braces are spelled by their names.
  const char* wanted = nullptr;
  bool isRepeatable = false;           ///< The program reads each occurrence of the option.
  std::function<void()> applied = {};  ///< Called after the option is set.
};

using OptionRows = std::vector<OptionRow>;

/// Sets OptionRow::group in rows where it is null.
[[nodiscard]] OptionRows withGroups(OptionRows rows);

/// An option of earlier versions.
struct RemovedOption {
  const char* name;     ///< "allow-sharp-edges"
  const char* message;  ///< What has changed, and what to do. Options of the computation are in braces.
};

/// Null if there is no such row.
[[nodiscard]] ASDFVK_API const OptionRow* findOption(const OptionRows& rows, std::string_view name);

/// Empty if the front end does not have the option.
[[nodiscard]] ASDFVK_API std::string spelled(const OptionRow& row, OptionSpelling spelling);
/// The option and its value, spelled for the front end: --segment cgal, segment=cgal, segment='cgal'.
[[nodiscard]] std::string spelled(const OptionRow& row, std::string_view value, OptionSpelling spelling);

[[nodiscard]] ASDFVK_API bool isFlag(const OptionRow& row);
/// The allowed values; empty if the values have no names.
[[nodiscard]] ASDFVK_API std::vector<std::string> namesOf(const OptionRow& row);
/// The placeholder, or the names of the values with bars between them. Empty for a flag.
[[nodiscard]] ASDFVK_API std::string placeholderOf(const OptionRow& row);
/// A text such as "from 0 to 1". Empty without a range.
[[nodiscard]] ASDFVK_API std::string rangeText(const OptionRow& row);
/// A text such as "a number from 0 to 1".
[[nodiscard]] ASDFVK_API std::string wantedText(const OptionRow& row);

/// Throws Error{OptionOutOfRange} and Error{UnknownName} with the detail "option" and a message such as "--rays: '0' is
/// not a whole number from 1 to 1024".
void setOptionText(const OptionRow& row, const std::string& text, OptionSpelling spelling = OptionSpelling::Flag);
/// shown: the value in the message. Throws as setOptionText().
ASDFVK_API void setOption(const OptionRow& row, const OptionValue& value, const std::string& shown,
                          OptionSpelling spelling);

/// The value as a text: "-" for no value, "on" or "off" for a flag.
[[nodiscard]] ASDFVK_API std::string toText(const OptionValue& value);

/// The default value for documents. Precondition: the member has its default value.
[[nodiscard]] ASDFVK_API std::string defaultText(const OptionRow& row);

[[nodiscard]] bool isNeedMet(const OptionRow& row, const OptionRows& rows);

/// The needed option with its value, for example "--segment cgal". Empty if the row needs no option.
[[nodiscard]] ASDFVK_API std::string neededText(const OptionRow& row, const OptionRows& rows, OptionSpelling spelling);

/// The options that the caller has set, and their spelling in messages.
struct GivenOptions {
  std::set<std::string, std::less<>> names;
  OptionSpelling spelling = OptionSpelling::CamelCase;

  [[nodiscard]] bool has(std::string_view name) const { return names.contains(name); }
};

/// Throws Error{OptionConflict} if a given option has no effect, with a message such as "--clusters needs --segment
/// cgal".
void requireNeeds(const OptionRows& rows, const GivenOptions& given);

/// Throws Error{OptionOutOfRange} or Error{UnknownName} for a value out of range. To check a member, the function
/// assigns the value of the member to the member.
void requireInRange(const OptionRows& rows, OptionSpelling spelling);

/// Returns the message with the options in braces, such as {seeds=all}, replaced by their spelling in the front end.
/// An option that is not in `rows` is spelled by its name.
[[nodiscard]] ASDFVK_API std::string withSpelledOptions(const OptionRows& rows, std::string_view message,
                                                        OptionSpelling spelling);

/// Throws Error{OptionConflict} with the message withSpelledOptions(message). The detail "option" is the first option
/// in braces.
[[noreturn]] ASDFVK_API void refuse(const OptionRows& rows, std::string_view message, OptionSpelling spelling);

/// Up to three names that are similar to `name`, for example "--seeds or --rng-seed" for "--seed". Similar names differ
/// in few letters, or have a word that begins with `name`. May be empty.
[[nodiscard]] ASDFVK_API std::string similarNames(std::string_view name, const std::vector<std::string>& names);

}  // namespace asdfvk
