#include "describe/option.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "describe/computation_options.h"

namespace asdfvk {
namespace {

constexpr const char* kAutomatic = "auto";

/// Returns "max_error" or "maxError" for "max-error".
std::string inCase(std::string_view name, OptionSpelling spelling) {
  std::string text;
  for (size_t i = 0; i < name.size(); ++i) {
    const bool isBreak = name[i] == '-';
    if (isBreak && spelling == OptionSpelling::CamelCase && i + 1 < name.size()) ++i;
    const char c = name[i];
    if (isBreak && spelling == OptionSpelling::CamelCase)
      text += static_cast<char>('a' <= c && c <= 'z' ? c - 'a' + 'A' : c);
    else
      text += isBreak ? '_' : c;
  }
  return text;
}

bool isInRange(const OptionRange& range, double value) {
  const bool isAbove = range.excludesMin ? value > range.min : value >= range.min;
  return isAbove && (range.excludesMax ? value < range.max : value <= range.max) && std::isfinite(value);
}

/// Returns nothing if the value is not a number.
std::optional<double> numberOf(const OptionValue& value) {
  if (const auto* whole = std::get_if<uint64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return std::nullopt;
}

uint64_t greatestWhole(const OptionRow& row, uint64_t ofType) {
  return row.range.max < static_cast<double>(ofType) ? static_cast<uint64_t>(row.range.max) : ofType;
}

template <typename T>
bool assignNumber(const OptionRow& row, const OptionValue& value, T& member) {
  const auto* whole = std::get_if<uint64_t>(&value);
  const uint64_t max = greatestWhole(row, std::numeric_limits<T>::max());
  if (whole == nullptr || static_cast<double>(*whole) < row.range.min || *whole > max) return false;
  member = static_cast<T>(*whole);
  return true;
}

bool assignNumber(const OptionRow& row, const OptionValue& value, double& member) {
  const std::optional<double> number = numberOf(value);
  if (!number || !isInRange(row.range, *number)) return false;
  member = *number;
  return true;
}

bool hasName(const OptionRow& row, const std::string& name) {
  const std::vector<std::string> names = namesOf(row);
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns false for an invalid value.
bool assign(const OptionRow& row, void* target, const OptionValue& value) {
  if (row.read != nullptr) return row.read(target, value);
  const auto set = [&](auto member) -> bool {
    using T = decltype(member);
    if constexpr (std::is_same_v<T, bool*>) {
      const bool* const flag = std::get_if<bool>(&value);
      if (flag != nullptr) *member = *flag;
      return flag != nullptr;
    } else if constexpr (std::is_same_v<T, std::string*>) {
      const auto* text = std::get_if<std::string>(&value);
      if (text == nullptr || !hasName(row, *text)) return false;
      *member = row.emptyIsAuto && *text == kAutomatic ? "" : *text;
      return true;
    } else if constexpr (std::is_same_v<T, ChoiceMember>) {
      const auto* text = std::get_if<std::string>(&value);
      return text != nullptr && member.set(member.member, *text);
    } else if constexpr (requires { member->value(); }) {
      auto number = member->value_or(0);
      if (!assignNumber(row, value, number)) return false;
      *member = number;
      return true;
    } else {
      return assignNumber(row, value, *member);
    }
  };
  return std::visit(set, row.access.member(target));
}

/// Converts a text to the type of the option; keeps the text if the conversion fails.
OptionValue typed(const OptionRow& row, const std::string& text) {
  const OptionKind kind = row.access.kind;
  if (kind == OptionKind::Whole) {
    if (const auto whole = numberIn<uint64_t>(text)) return *whole;
  } else if (kind == OptionKind::Real) {
    const bool hasUnit = std::string_view(row.placeholder) == "SECONDS" && text.ends_with('s');
    if (const auto real = numberIn<double>(std::string_view(text).substr(0, text.size() - (hasUnit ? 1 : 0))))
      return *real;
  }
  return text;
}

[[noreturn]] void fail(const OptionRow& row, const std::string& shown, OptionSpelling spelling) {
  const ErrorCode code = namesOf(row).empty() ? ErrorCode::OptionOutOfRange : ErrorCode::UnknownName;
  const std::string wanted = withSpelledOptions(computationRows(), wantedText(row), spelling);
  throw Error(code, fmt::format("{}: {} is not {}", spelled(row, spelling), shown, wanted),
              {{"option", spelled(row, spelling)}});
}

/// The Levenshtein distance (1966): the number of letters to insert, remove or replace to turn `a` into `b`.
size_t distanceOf(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i + 1);
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, replaced}));
    }
  }
  return row.back();
}

/// Whether a word of `name` begins with `beginning`. Dashes and underscores separate words.
bool hasWord(std::string_view name, std::string_view beginning) {
  constexpr size_t kMinSize = 3;
  const size_t at = beginning.size() < kMinSize ? std::string_view::npos : name.find(beginning);
  return at != std::string_view::npos && (at == 0 || name[at - 1] == '-' || name[at - 1] == '_');
}

}  // namespace

const OptionRow* findOption(OptionRows rows, std::string_view name) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const OptionRow& r) { return r.name == name; });
  return row == rows.end() ? nullptr : &*row;
}

std::string spelled(const OptionRow& row, OptionSpelling spelling) {
  if (spelling == OptionSpelling::Flag) {
    if (row.flags == nullptr) return std::string("--") + row.name;
    const std::string_view flags = row.flags;
    return std::string(flags.substr(std::min(flags.find("--"), flags.size())));
  }
  if (spelling == OptionSpelling::Name) return row.name;
  if (spelling == OptionSpelling::SnakeCase) return inCase(row.keyword != nullptr ? row.keyword : row.name, spelling);
  const std::string_view unit = row.placeholder;
  return inCase(row.name, spelling) + (unit == "DEGREES" ? "Degrees" : unit == "SECONDS" ? "Seconds" : "");
}

std::string spelled(const OptionRow& row, std::string_view value, OptionSpelling spelling) {
  const std::string name = spelled(row, spelling);
  if (isFlag(row)) {
    if (spelling == OptionSpelling::Flag) return name;
    if (spelling == OptionSpelling::Name) return fmt::format("{}={}", name, value);
    return name + (spelling == OptionSpelling::SnakeCase ? value == "off" ? "=False" : "=True"
                   : value == "off"                      ? "=false"
                                                         : "=true");
  }
  if (spelling == OptionSpelling::Flag) return fmt::format("{} {}", name, value);
  const bool isNumber = row.access.kind == OptionKind::Real || row.access.kind == OptionKind::Whole;
  return spelling == OptionSpelling::SnakeCase && !isNumber ? fmt::format("{}='{}'", name, value)
                                                            : fmt::format("{}={}", name, value);
}

bool isFlag(const OptionRow& row) { return row.access.kind == OptionKind::Flag; }

std::vector<std::string> namesOf(const OptionRow& row) {
  std::vector<std::string> names;
  if (row.valueNames != nullptr) names = splitAt(row.valueNames, '|');
  if (row.moreNames != nullptr)
    for (std::string& name : row.moreNames()) names.push_back(std::move(name));
  if (row.access.kind != OptionKind::Choice) return names;
  return splitAt(row.access.names(), '|');
}

std::string placeholderOf(const OptionRow& row) {
  return *row.placeholder != 0 ? row.placeholder : joined(namesOf(row), "|");
}

std::string rangeText(const OptionRow& row) {
  const OptionRange& range = row.range;
  const bool hasMin = std::isfinite(range.min), hasMax = std::isfinite(range.max);
  if (hasMin && hasMax && !range.excludesMin) return fmt::format("from {} to {}", range.min, range.max);
  std::string text;
  if (hasMin) text = fmt::format("{} {}", range.excludesMin ? "above" : "from", range.min);
  if (hasMax)
    text += fmt::format("{}{} {}", text.empty() ? "" : " and ", range.excludesMax ? "below" : "at most", range.max);
  return text;
}

std::string wantedText(const OptionRow& row) {
  if (row.wanted != nullptr) return row.wanted;
  const auto withRange = [&](std::string text) {
    const std::string range = rangeText(row);
    return range.empty() ? text : text + " " + range;
  };
  switch (row.access.kind) {
    case OptionKind::Flag:
      return "True or False";
    case OptionKind::Real:
      return withRange("a number");
    case OptionKind::Whole:
      return withRange("a whole number");
    default:
      break;
  }
  const std::vector<std::string> names = namesOf(row);
  return names.empty() ? "a text" : "one of " + joined(names, "|");
}

void setOption(const OptionRow& row, void* target, const OptionValue& value, const std::string& shown,
               OptionSpelling spelling) {
  bool isRead = false;
  try {
    isRead = assign(row, target, value);
  } catch (const Error& error) {
    throw Error(error.code(), spelled(row, spelling) + ": " + error.what(), {{"option", spelled(row, spelling)}});
  }
  if (!isRead) fail(row, shown, spelling);
  if (row.apply != nullptr) row.apply(target);
}

void setOptionText(const OptionRow& row, void* target, const std::string& text, OptionSpelling spelling) {
  setOption(row, target, typed(row, text), "'" + text + "'", spelling);
}

OptionValue valueOf(const OptionRow& row, const void* target) {
  if (row.write != nullptr) return row.write(target);
  const auto get = [](auto member) -> OptionValue {
    using T = decltype(member);
    if constexpr (std::is_same_v<T, ChoiceMember>) {
      return std::string(member.get(member.member));
    } else if constexpr (std::is_same_v<T, std::optional<double>*>) {
      return *member ? OptionValue(**member) : OptionValue();
    } else if constexpr (std::is_same_v<T, std::optional<uint32_t>*>) {
      return *member ? OptionValue(uint64_t{**member}) : OptionValue();
    } else if constexpr (std::is_same_v<T, uint32_t*>) {
      return uint64_t{*member};
    } else {
      return *member;
    }
  };
  const OptionValue value = std::visit(get, row.access.member(const_cast<void*>(target)));
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr || !text->empty()) return value;
  return row.emptyIsAuto ? OptionValue(std::string(kAutomatic)) : OptionValue();
}

std::string toText(const OptionValue& value) {
  return std::visit(
      [](const auto& v) -> std::string {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, std::monostate>)
          return "-";
        else if constexpr (std::is_same_v<T, bool>)
          return v ? "on" : "off";
        else
          return fmt::format("{}", v);
      },
      value);
}

std::string defaultText(const OptionRow& row, const void* defaults) {
  return row.defaultText != nullptr ? row.defaultText : toText(valueOf(row, defaults));
}

bool isNeedMet(const OptionRow& row, OptionRows rows, const void* target) {
  const std::string_view needs = row.needs;
  if (needs.empty()) return true;
  const size_t sign = std::min(needs.find('='), needs.size());
  const auto valueAt = [&](std::string_view name) { return valueOf(*findOption(rows, name), target); };
  if (sign == needs.size()) {
    const std::vector<std::string> names = splitAt(needs, '|');
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return !std::holds_alternative<std::monostate>(valueAt(name)); });
  }
  const OptionValue value = valueAt(needs.substr(0, sign));
  const std::vector<std::string> wanted = splitAt(needs.substr(sign + 1), '|');
  return std::find(wanted.begin(), wanted.end(), toText(value)) != wanted.end();
}

std::string neededText(const OptionRow& row, OptionRows rows, OptionSpelling spelling) {
  const std::string_view needs = row.needs;
  if (needs.empty()) return "";
  const size_t sign = needs.find('=');
  std::vector<std::string> texts;
  for (const std::string& first : splitAt(needs, '|')) {
    const OptionRow& needed = *findOption(rows, std::string_view(first).substr(0, sign));
    if (sign != needs.npos) return spelled(needed, std::string_view(first).substr(sign + 1), spelling);
    texts.push_back(spelled(needed, spelling));
  }
  return joined(texts, " or ");
}

void requireNeeds(OptionRows rows, const void* target, const GivenOptions& given) {
  for (const OptionRow& row : rows) {
    if (!given.has(row.name) || isNeedMet(row, rows, target)) continue;
    throw Error(ErrorCode::OptionConflict,
                fmt::format("{} needs {}", spelled(row, given.spelling), neededText(row, rows, given.spelling)),
                {{"option", spelled(row, given.spelling)}});
  }
}

void requireInRange(OptionRows rows, void* target, OptionSpelling spelling) {
  for (const OptionRow& row : rows) {
    const OptionKind kind = row.access.kind;
    if (kind == OptionKind::Flag || kind == OptionKind::Choice) continue;
    const OptionValue value = valueOf(row, target);
    if (!std::holds_alternative<std::monostate>(value) && !assign(row, target, value))
      fail(row, kind == OptionKind::Text ? "'" + toText(value) + "'" : toText(value), spelling);
  }
}

std::string withSpelledOptions(OptionRows rows, std::string_view message, OptionSpelling spelling) {
  std::string text;
  while (!message.empty()) {
    const size_t begin = std::min(message.find('{'), message.size());
    text += message.substr(0, begin);
    if (begin == message.size()) break;
    const size_t end = message.find('}', begin);
    const std::string_view name = message.substr(begin + 1, end - begin - 1);
    const size_t sign = std::min(name.find('='), name.size());
    const OptionRow& row = *findOption(rows, name.substr(0, sign));
    text += sign == name.size() ? spelled(row, spelling) : spelled(row, name.substr(sign + 1), spelling);
    message.remove_prefix(end + 1);
  }
  return text;
}

void refuse(OptionRows rows, std::string_view message, OptionSpelling spelling) {
  const size_t begin = message.find('{') + 1;
  const OptionRow* const first = findOption(rows, message.substr(begin, message.find_first_of("=}") - begin));
  throw Error(ErrorCode::OptionConflict, withSpelledOptions(rows, message, spelling),
              {{"option", spelled(*first, spelling)}});
}

std::string similarNames(std::string_view name, const std::vector<std::string>& names) {
  constexpr size_t kMaxCount = 3, kLettersPerError = 4;
  const std::string_view word = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  std::vector<std::pair<size_t, std::string>> found;
  for (const std::string& other : names) {
    const size_t distance = distanceOf(name, other);
    if (distance <= 1 + word.size() / kLettersPerError || hasWord(other, word)) found.emplace_back(distance, other);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  found.resize(std::min(found.size(), kMaxCount));
  std::vector<std::string> similar;
  for (auto& [distance, other] : found) similar.push_back(std::move(other));
  return joined(similar, " or ");
}

}  // namespace asdfvk
