#pragma once

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

/// The rows of options. The flags and their help, the range checks, the JSON, the keywords of Python and the documents
/// come from these rows.
namespace asdfvk {

/// A value of an option, as front ends pass it and reports show it. std::monostate: none.
using OptionValue = std::variant<std::monostate, bool, uint64_t, double, std::string>;

/// How messages and reports spell the name of an option: --time-budget, timeBudgetSeconds, time_budget, time-budget.
enum class OptionSpelling { Flag, CamelCase, SnakeCase, Name };

/// A member whose values have names.
struct ChoiceMember {
  void* member;
  const char* (*get)(const void* member);
  bool (*set)(void* member, std::string_view name);  ///< False for an unknown name.
};

/// The member of a struct of options that an option sets.
using OptionMember = std::variant<bool*, double*, uint32_t*, uint64_t*, std::string*, std::optional<double>*,
                                  std::optional<uint32_t>*, ChoiceMember>;

enum class OptionKind { Special, Flag, Real, Whole, Text, Choice };

/// How a row reaches its member; see ASDFVK_MEMBER and ASDFVK_CHOICE.
struct OptionAccess {
  OptionKind kind = OptionKind::Special;  ///< Special: OptionRow::read and `write` are set.
  OptionMember (*member)(void* target) = nullptr;
  std::string (*names)() = nullptr;  ///< "paper|balanced|quality"
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

/// OptionRow::access of a member of Target, and of one whose values have names.
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

/// Allowed numbers. The bounds of whole numbers are included.
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

/// An option. `target` is the struct of the table that has the row, for example ComputationSettings.
struct OptionRow {
  const char* name;  ///< "time-budget"
  const char* group;
  OptionAccess access = {};
  OptionRange range = {};
  const char* text = "";         ///< For the help: without range, default and full stop.
  const char* more = "";         ///< Further sentences for man page and docs/options.md.
  const char* placeholder = "";  ///< Stands for the value; not of flags, nor of options with names.
  const char* needs = "";        ///< Without it the option has no effect: "measure=thickness|both", "thinner-than".
  const char* defaultText = nullptr;  ///< Replaces that of the default value.
  const char* flags = nullptr;        ///< "-o,--output"; null: -- and the name; empty: no flag.
  const char* keyword = nullptr;      ///< The keyword of Python; null: the name of the option; empty: there is none.
  const char* keywordType = nullptr;  ///< Type of the keyword in Python; null: the type of the member.
  const char* valueNames = nullptr;   ///< Names of a string: "auto|seed|ray".
  bool emptyIsAuto = false;           ///< The member of the name "auto" is empty.
  std::vector<std::string> (*moreNames)() = nullptr;  ///< Further names of a string.
  const char* bareValue = nullptr;                    ///< The value of a flag without one; null: a value is needed.
  const char* wanted = nullptr;                       ///< What is not read: "an error such as 1%".
  bool (*read)(void* target, const OptionValue& value) = nullptr;  ///< False, or throws, for a wrong value.
  OptionValue (*write)(const void* target) = nullptr;
  void (*apply)(void* target) = nullptr;  ///< Called after the member is set.
};

using OptionRows = std::span<const OptionRow>;

/// Null where no row has the name.
[[nodiscard]] ASDFVK_API const OptionRow* findOption(OptionRows rows, std::string_view name);

[[nodiscard]] ASDFVK_API std::string spelled(const OptionRow& row, OptionSpelling spelling);
/// The option with a value: --segment cgal, segment=cgal, segment="cgal".
[[nodiscard]] std::string spelled(const OptionRow& row, std::string_view value, OptionSpelling spelling);

[[nodiscard]] ASDFVK_API bool isFlag(const OptionRow& row);
/// The names of the values, empty without.
[[nodiscard]] ASDFVK_API std::vector<std::string> namesOf(const OptionRow& row);
/// The placeholder, or the names between bars. Empty for a flag.
[[nodiscard]] ASDFVK_API std::string placeholderOf(const OptionRow& row);
/// "from 0 to 1"; empty without a range.
[[nodiscard]] ASDFVK_API std::string rangeText(const OptionRow& row);
/// What a value must be: "a number from 0 to 1".
[[nodiscard]] ASDFVK_API std::string wantedText(const OptionRow& row);

/// Sets an option. The string of a command line is converted. Throws Error{OptionOutOfRange} and Error{UnknownName}
/// with the detail "option": "--rays: '0' is not a whole number from 1 to 1024".
void setOptionText(const OptionRow& row, void* target, const std::string& text,
                   OptionSpelling spelling = OptionSpelling::Flag);
/// Sets a value that has a type. shown: the value in the message.
ASDFVK_API void setOption(const OptionRow& row, void* target, const OptionValue& value, const std::string& shown,
                          OptionSpelling spelling);

[[nodiscard]] ASDFVK_API OptionValue valueOf(const OptionRow& row, const void* target);
/// "-" for none, "off" and "on" for flags.
[[nodiscard]] std::string toText(const OptionValue& value);

/// The default as documents show it. defaults: the target as it is constructed.
[[nodiscard]] ASDFVK_API std::string defaultText(const OptionRow& row, const void* defaults);

/// Whether the option that `row` needs has one of the values it needs.
[[nodiscard]] bool isNeedMet(const OptionRow& row, OptionRows rows, const void* target);

/// "--segment cgal"; empty where the row needs none.
[[nodiscard]] ASDFVK_API std::string neededText(const OptionRow& row, OptionRows rows, OptionSpelling spelling);

/// The options that the caller named.
struct GivenOptions {
  std::set<std::string, std::less<>> names;
  OptionSpelling spelling = OptionSpelling::CamelCase;

  [[nodiscard]] bool has(std::string_view name) const { return names.contains(name); }
};

/// Throws Error{OptionConflict} where a given option has no effect: "--clusters needs --segment cgal".
void requireNeeds(OptionRows rows, const void* target, const GivenOptions& given);

/// Throws Error{OptionOutOfRange} and Error{UnknownName} for a value out of its range. target: a copy, whose members
/// are set again.
void requireInRange(OptionRows rows, void* target, OptionSpelling spelling);

/// Throws Error{OptionConflict} with the option. message: names of rows in braces are spelled.
[[noreturn]] ASDFVK_API void refuse(OptionRows rows, std::string_view message, OptionSpelling spelling);

/// "--seeds or --rng-seed" for "--seed": at most three names that differ in few letters, or one of whose words begins
/// with the name. Empty where there is none.
[[nodiscard]] ASDFVK_API std::string similarNames(std::string_view name, const std::vector<std::string>& names);

}  // namespace asdfvk
