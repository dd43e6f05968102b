#include "describe/option.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/text.h"

namespace asdfvk {
namespace {

/// End of the name in reports, and placeholder in the help.
struct UnitTexts {
  const char* ending;
  const char* placeholder;
};
constexpr std::array kUnits{UnitTexts{"", ""}, UnitTexts{"Degrees", "DEGREES"}, UnitTexts{"Seconds", "SECONDS"}};

const UnitTexts& textsOf(OptionUnit unit) { return kUnits[static_cast<size_t>(unit)]; }

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

/// Converts a text to the type of the option; keeps the text if the conversion fails.
OptionValue typed(const OptionRow& row, const std::string& text) {
  const OptionKind kind = row.member.codec().kind;
  if (kind == OptionKind::Whole) {
    if (const auto whole = numberIn<uint64_t>(text)) return *whole;
  } else if (kind == OptionKind::Real) {
    const bool hasUnit = row.unit == OptionUnit::Seconds && text.ends_with('s');
    if (const auto real = numberIn<double>(std::string_view(text).substr(0, text.size() - (hasUnit ? 1 : 0))))
      return *real;
  }
  return text;
}

[[noreturn]] void fail(const OptionRow& row, const std::string& shown, OptionSpelling spelling) {
  const ErrorCode code = namesOf(row).empty() ? ErrorCode::OptionOutOfRange : ErrorCode::UnknownName;
  const std::string wanted = withSpelledOptions({}, wantedText(row), spelling);
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

OptionRows withGroups(OptionRows rows) {
  for (size_t i = 1; i < rows.size(); ++i)
    if (rows[i].group == nullptr) rows[i].group = rows[i - 1].group;
  return rows;
}

const OptionRow* findOption(const OptionRows& rows, std::string_view name) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const OptionRow& r) { return r.name == name; });
  return row == rows.end() ? nullptr : &*row;
}

std::string spelled(const OptionRow& row, OptionSpelling spelling) {
  switch (spelling) {
    case OptionSpelling::Flag: {
      if (row.where == OptionPlace::Library) return {};
      const std::string_view flags = row.flags == nullptr ? "" : row.flags;
      return flags.empty() ? std::string("--") + row.name : std::string(flags.substr(flags.find("--")));
    }
    case OptionSpelling::SnakeCase:
      return row.where == OptionPlace::Program ? "" : inCase(row.keyword != nullptr ? row.keyword : row.name, spelling);
    case OptionSpelling::CamelCase:
      return inCase(row.name, spelling) + textsOf(row.unit).ending;
    case OptionSpelling::Name:
      break;
  }
  return row.name;
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
  const OptionKind kind = row.member.codec().kind;
  const bool isNumber = kind == OptionKind::Real || kind == OptionKind::Whole;
  return spelling == OptionSpelling::SnakeCase && !isNumber ? fmt::format("{}='{}'", name, value)
                                                            : fmt::format("{}={}", name, value);
}

bool isFlag(const OptionRow& row) { return row.member.codec().kind == OptionKind::Flag; }

std::vector<std::string> namesOf(const OptionRow& row) {
  const auto names = row.member.codec().names != nullptr ? row.member.codec().names : row.names;
  return names == nullptr ? std::vector<std::string>() : names();
}

std::string placeholderOf(const OptionRow& row) {
  if (*row.placeholder != 0) return row.placeholder;
  if (row.unit != OptionUnit::None) return textsOf(row.unit).placeholder;
  return joined(namesOf(row), "|");
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
  if (row.member.codec().wanted != nullptr) return row.member.codec().wanted;
  const auto withRange = [&](std::string text) {
    const std::string range = rangeText(row);
    return range.empty() ? text : text + " " + range;
  };
  switch (row.member.codec().kind) {
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

void setOption(const OptionRow& row, const OptionValue& value, const std::string& shown, OptionSpelling spelling) {
  bool isRead = false;
  try {
    isRead = row.member.read(value, row);
  } catch (const Error& error) {
    throw Error(error.code(), spelled(row, spelling) + ": " + error.what(), {{"option", spelled(row, spelling)}});
  }
  if (!isRead) fail(row, shown, spelling);
  if (row.applied) row.applied();
}

void setOptionText(const OptionRow& row, const std::string& text, OptionSpelling spelling) {
  setOption(row, typed(row, text), "'" + text + "'", spelling);
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

std::string defaultText(const OptionRow& row) {
  return row.defaultText != nullptr ? row.defaultText : toText(row.member.write());
}

bool isNeedMet(const OptionRow& row, const OptionRows& rows) {
  const std::string_view needs = row.needs;
  if (needs.empty()) return true;
  const size_t sign = std::min(needs.find('='), needs.size());
  const auto valueAt = [&](std::string_view name) { return findOption(rows, name)->member.write(); };
  if (sign == needs.size()) {
    const std::vector<std::string> names = splitAt(needs, '|');
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      const OptionValue value = valueAt(name);
      return !std::holds_alternative<std::monostate>(value) && value != OptionValue(false);
    });
  }
  const OptionValue value = valueAt(needs.substr(0, sign));
  const std::vector<std::string> wanted = splitAt(needs.substr(sign + 1), '|');
  return std::find(wanted.begin(), wanted.end(), toText(value)) != wanted.end();
}

std::string neededText(const OptionRow& row, const OptionRows& rows, OptionSpelling spelling) {
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

void requireNeeds(const OptionRows& rows, const GivenOptions& given) {
  for (const OptionRow& row : rows) {
    if (!given.has(row.name) || isNeedMet(row, rows)) continue;
    throw Error(ErrorCode::OptionConflict,
                fmt::format("{} needs {}", spelled(row, given.spelling), neededText(row, rows, given.spelling)),
                {{"option", spelled(row, given.spelling)}});
  }
}

void requireInRange(const OptionRows& rows, OptionSpelling spelling) {
  for (const OptionRow& row : rows) {
    const OptionValue value = row.member.write();
    if (std::holds_alternative<std::monostate>(value) || row.member.read(value, row)) continue;
    fail(row, std::holds_alternative<std::string>(value) ? "'" + toText(value) + "'" : toText(value), spelling);
  }
}

std::string withSpelledOptions(const OptionRows& rows, std::string_view message, OptionSpelling spelling) {
  std::string text;
  while (!message.empty()) {
    const size_t begin = std::min(message.find('{'), message.size());
    text += message.substr(0, begin);
    if (begin == message.size()) break;
    const size_t end = message.find('}', begin);
    ASDFVK_CHECK(end != message.npos);
    const std::string_view option = message.substr(begin + 1, end - begin - 1);
    const size_t sign = std::min(option.find('='), option.size());
    const std::string name(option.substr(0, sign));
    const OptionRow byName{.name = name.c_str(), .member = static_cast<std::string*>(nullptr)};
    const OptionRow* const found = findOption(rows, name);
    const OptionRow& row = found == nullptr ? byName : *found;
    text += sign == option.size() ? spelled(row, spelling) : spelled(row, option.substr(sign + 1), spelling);
    message.remove_prefix(end + 1);
  }
  return text;
}

void refuse(const OptionRows& rows, std::string_view message, OptionSpelling spelling) {
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
