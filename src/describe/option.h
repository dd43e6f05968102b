#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/choices.h"

/// Flags, help, range checks, JSON, keywords of Python and documents are derived from rows, one per option.
namespace asdfvk {

/// std::monostate means no value.
using OptionValue = std::variant<std::monostate, bool, uint64_t, double, std::string>;

/// Spelling of option names in messages and reports: --cone-angle, coneAngleDegrees, cone_angle, cone-angle.
enum class OptionSpelling { Flag, CamelCase, SnakeCase, Name };

struct ChoiceMember {
  void* member;
  const char* (*get)(const void* member);
  bool (*set)(void* member, std::string_view name);  ///< False for an unknown name.
};

/// The types of the members that options set.
using OptionMember = std::variant<bool*, double*, uint32_t*, uint64_t*, std::string*, std::optional<double>*,
                                  std::optional<uint32_t>*, ChoiceMember>;

enum class OptionKind { Special, Flag, Real, Whole, Text, Choice };

/// Access of a row to its member; see ASDFVK_MEMBER and ASDFVK_CHOICE.
struct OptionAccess {
  /// Special: there is no member; OptionRow::read and OptionRow::write are used instead.
  OptionKind kind = OptionKind::Special;
  OptionMember (*member)(void* target) = nullptr;
  std::string (*names)() = nullptr;  ///< The names of a Choice, for example "paper|balanced|quality".
};

template <typename Member>
[[nodiscard]] constexpr OptionKind kindOfMember() {
  using T = std::remove_reference_t<Member>;
  if (std::is_same_v<T, bool>) return OptionKind::Flag;
  if (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>) return OptionKind::Real;
  return std::is_same_v<T, std::string> ? OptionKind::Text : OptionKind::Whole;
}

template <const auto& kNames, typename T>
[[nodiscard]] ChoiceMember choiceMember(T& member) {
  return {&member, [](const void* from) { return nameOf(kNames, *static_cast<const T*>(from)); },
          [](void* to, std::string_view name) {
            const auto* found = findChoice(kNames, name);
            if (found != nullptr) *static_cast<T*>(to) = *found;
            return found != nullptr;
          }};
}

/// Makes the OptionRow::access of a member of Target. ASDFVK_CHOICE does so for a member with named values.
#define ASDFVK_MEMBER(Target, path)                                            \
  OptionAccess {                                                               \
    kindOfMember<decltype((std::declval<Target&>().path))>(),                  \
        [](void* t) -> OptionMember { return &static_cast<Target*>(t)->path; } \
  }
#define ASDFVK_CHOICE(Target, path, choices)                                                                          \
  OptionAccess {                                                                                                      \
    OptionKind::Choice, [](void* t) -> OptionMember { return choiceMember<choices>(static_cast<Target*>(t)->path); }, \
        [] { return joined(choices); }                                                                                \
  }

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

/// An option. target: the struct that the options of the table set, for example ComputationSettings.
struct OptionRow {
  const char* name;             ///< "max-error"
  const char* group = nullptr;  ///< Heading in the help; null: the group of the row before, see withGroups().
  OptionAccess access = {};
  OptionRange range = {};
  const char* text = "";  ///< Text of the help, without range, default and final full stop.
  const char* more = "";  ///< Further sentences for the man page and docs/options.md.
  /// Stands for the value in the help. Empty if the option has no value or if its values have names.
  const char* placeholder = "";
  /// The option that this option needs, with the values that it may have, for example "measure=thickness|both"; or one
  /// of several options: "thinner-than|closer-than".
  const char* needs = "";
  AtPoints atPoints = AtPoints::None;
  const char* defaultText = nullptr;  ///< Shown instead of the default value.
  const char* flags = nullptr;        ///< "-o,--output"; null: "--" and the name; empty: the program has no flag.
  const char* keyword = nullptr;      ///< Keyword of Python; null: the name of the option; empty: see isOfProgram().
  const char* keywordType = nullptr;  ///< Type of the keyword of Python; null: the type of the member.
  const char* valueNames = nullptr;   ///< Allowed values of a string option: "auto|seed|ray".
  bool emptyIsAuto = false;           ///< The name "auto" sets the member to an empty string.
  std::vector<std::string> (*moreNames)() = nullptr;  ///< Returns further allowed values of a string option.
  const char* bareValue = nullptr;  ///< Value of an option that is given without a value; null: a value is required.
  /// Description of valid values for messages: "an error such as 1%". Options of the computation are in braces.
  const char* wanted = nullptr;
  bool isRepeatable = false;  ///< The program calls `read` for each occurrence of the option.
  /// Returns false or throws for an invalid value.
  bool (*read)(void* target, const OptionValue& value) = nullptr;
  OptionValue (*write)(const void* target) = nullptr;
  void (*apply)(void* target) = nullptr;  ///< Called after the option is set.
};

using OptionRows = std::span<const OptionRow>;

/// Sets OptionRow::group in rows where it is null.
template <size_t N>
[[nodiscard]] std::array<OptionRow, N> withGroups(std::array<OptionRow, N> rows) {
  for (size_t i = 1; i < N; ++i)
    if (rows[i].group == nullptr) rows[i].group = rows[i - 1].group;
  return rows;
}

/// An option of earlier versions.
struct RemovedOption {
  const char* name;     ///< "allow-sharp-edges"
  const char* message;  ///< What has changed, and what to do. Options of the computation are in braces.
};

/// Null if there is no such row.
[[nodiscard]] ASDFVK_API const OptionRow* findOption(OptionRows rows, std::string_view name);

[[nodiscard]] ASDFVK_API std::string spelled(const OptionRow& row, OptionSpelling spelling);
/// The option and its value, spelled for the front end: --segment cgal, segment=cgal, segment='cgal'.
[[nodiscard]] std::string spelled(const OptionRow& row, std::string_view value, OptionSpelling spelling);

[[nodiscard]] ASDFVK_API bool isFlag(const OptionRow& row);
/// Whether only the program has the option, not C and Python.
[[nodiscard]] inline bool isOfProgram(const OptionRow& row) { return row.keyword != nullptr && *row.keyword == 0; }
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
void setOptionText(const OptionRow& row, void* target, const std::string& text,
                   OptionSpelling spelling = OptionSpelling::Flag);
/// shown: the value in the message. Throws as setOptionText().
ASDFVK_API void setOption(const OptionRow& row, void* target, const OptionValue& value, const std::string& shown,
                          OptionSpelling spelling);

[[nodiscard]] ASDFVK_API OptionValue valueOf(const OptionRow& row, const void* target);
/// The value as a text: "-" for no value, "on" or "off" for a flag.
[[nodiscard]] std::string toText(const OptionValue& value);

/// The default value for documents. defaults: a target with default values.
[[nodiscard]] ASDFVK_API std::string defaultText(const OptionRow& row, const void* defaults);

[[nodiscard]] bool isNeedMet(const OptionRow& row, OptionRows rows, const void* target);

/// The needed option with its value, for example "--segment cgal". Empty if the row needs no option.
[[nodiscard]] ASDFVK_API std::string neededText(const OptionRow& row, OptionRows rows, OptionSpelling spelling);

/// The options that the caller has set, and their spelling in messages.
struct GivenOptions {
  std::set<std::string, std::less<>> names;
  OptionSpelling spelling = OptionSpelling::CamelCase;

  [[nodiscard]] bool has(std::string_view name) const { return names.contains(name); }
};

/// Throws Error{OptionConflict} if a given option has no effect, with a message such as "--clusters needs --segment
/// cgal".
void requireNeeds(OptionRows rows, const void* target, const GivenOptions& given);

/// Throws Error{OptionOutOfRange} or Error{UnknownName} for a value out of range. target: a copy of the settings. To
/// check a member, the function assigns the value of the member to the member.
void requireInRange(OptionRows rows, void* target, OptionSpelling spelling);

/// Returns the message with the options in braces, such as {seeds=all}, replaced by their spelling in the front end.
[[nodiscard]] std::string withSpelledOptions(OptionRows rows, std::string_view message, OptionSpelling spelling);

/// Throws Error{OptionConflict} with the message withSpelledOptions(message). The detail "option" is the first option
/// in braces.
[[noreturn]] ASDFVK_API void refuse(OptionRows rows, std::string_view message, OptionSpelling spelling);

/// Up to three names that are similar to `name`, for example "--seeds or --rng-seed" for "--seed". Similar names differ
/// in few letters, or have a word that begins with `name`. May be empty.
[[nodiscard]] ASDFVK_API std::string similarNames(std::string_view name, const std::vector<std::string>& names);

}  // namespace asdfvk
