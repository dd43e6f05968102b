#include "cli/option_parsing.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"

namespace asdfvk {
namespace {

template <typename T>
std::optional<T> parseWhole(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

[[noreturn]] void reject(const std::string& text, const std::string& wanted) {
  throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' is not {}", text, wanted));
}

}  // namespace

Argument addValue(ArgumentParser& parser, std::string_view name, std::string_view placeholder, std::string_view text,
                  std::function<void(const std::string&)> receive) {
  const std::string_view shown = name.substr(name.find("--"));
  return parser.addValue(name, placeholder, text,
                         [shown = std::string(shown), receive = std::move(receive)](const std::string& value) {
                           try {
                             receive(value);
                           } catch (const Error& error) {
                             throw Error(error.code(), shown + ": " + error.what());
                           }
                         });
}

Argument addChoice(ArgumentParser& parser, std::string_view name, std::vector<std::string> names, std::string_view text,
                   std::function<void(size_t)> receive) {
  const std::string placeholder = joined(names, "|");
  return addValue(parser, name, placeholder, text,
                  [names = std::move(names), placeholder, receive = std::move(receive)](const std::string& choice) {
                    const auto found = std::find(names.begin(), names.end(), choice);
                    if (found == names.end())
                      throw Error(ErrorCode::UnknownName, fmt::format("'{}' is not one of {}", choice, placeholder));
                    receive(static_cast<size_t>(found - names.begin()));
                  });
}

Argument addName(ArgumentParser& parser, std::string_view name, std::string& target, std::vector<std::string> names,
                 std::string_view text) {
  return addChoice(parser, name, names, text, [&target, names](size_t index) { target = names[index]; });
}

std::vector<std::string> withAuto(std::vector<std::string> names) {
  names.insert(names.begin(), "auto");
  return names;
}

uint64_t parseWholeNumber(const std::string& text, uint64_t minimum, uint64_t maximum) {
  const auto value = parseWhole<uint64_t>(text);
  if (!value || *value < minimum || *value > maximum) {
    if (maximum == std::numeric_limits<uint64_t>::max()) reject(text, fmt::format("a whole number from {}", minimum));
    reject(text, fmt::format("a whole number from {} to {}", minimum, maximum));
  }
  return *value;
}

double parseNumber(const std::string& text) {
  const auto value = parseWhole<double>(text);
  if (!value || !std::isfinite(*value)) reject(text, "a number");
  return *value;
}

double parseNumber(const std::string& text, const std::function<bool(double)>& accepts, const char* complaint) {
  const double value = parseNumber(text);
  if (!accepts(value)) throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' {}", text, complaint));
  return value;
}

double parseSeconds(const std::string& text) {
  constexpr double kMaxSeconds = 1e9;  // More would overflow the clocks that count them.
  const double seconds = parseNumber(text.ends_with('s') ? text.substr(0, text.size() - 1) : text);
  if (!(seconds > 0 && seconds <= kMaxSeconds)) reject(text, "a time above 0 s and at most 1e9 s");
  return seconds;
}

SeedCount parseSeedCount(const std::string& text) {
  const std::string wanted = "a share such as 10% (above 0%, at most 100%), a count of at least 1, all, or auto";
  if (text == "all") return SeedCount::all();
  if (text == "auto") return SeedCount::automatic();
  if (text.ends_with('%')) {
    const auto percent = parseWhole<double>(std::string_view(text).substr(0, text.size() - 1));
    if (!percent || !(*percent > 0 && *percent <= 100)) reject(text, wanted);
    return SeedCount::ofShare(*percent / 100);
  }
  const auto count = parseWhole<uint64_t>(text);
  if (!count || *count == 0) reject(text, wanted);
  return SeedCount::ofCount(*count);
}

uint64_t parseCheckCount(const std::string& text) {
  if (text == "all") return std::numeric_limits<uint64_t>::max();
  const auto count = parseWhole<uint64_t>(text);
  if (!count || *count == 0) reject(text, "a count of at least 1 or all");
  return *count;
}

std::string toText(const SeedCount& seeds) {
  switch (seeds.kind) {
    case SeedCount::Kind::Automatic:
      return "auto";
    case SeedCount::Kind::All:
      return "all";
    case SeedCount::Kind::Count:
      return fmt::format("{}", seeds.count);
    case SeedCount::Kind::Share:
      break;
  }
  return fmt::format("{:.6g}%", seeds.share * 100);
}

void refuseField(const CommandLine& line, const std::string& field, const std::string& needed) {
  const auto refuse = [&](const char* option) {
    throw Error(ErrorCode::OptionConflict, fmt::format("{} {} needs {}", option, field, needed));
  };
  if (std::count(line.outputs.fields.begin(), line.outputs.fields.end(), field) > 0) refuse("--fields");
  if (line.outputs.pictureOf == field) refuse("--picture-of");
}

void refuseOptions(const std::string& message) { throw Error(ErrorCode::OptionConflict, message); }

}  // namespace asdfvk
