#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace asdfvk {

/// The text with A to Z in lower case, independent of the locale.
[[nodiscard]] inline std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

/// Control characters become spaces, so that a message with any file name is one line.
[[nodiscard]] inline std::string oneLine(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

/// Joins names: "sdf, seed" for the names "sdf" and "seed" with the separator ", ".
template <typename Names>
[[nodiscard]] std::string joined(const Names& names, std::string_view separator) {
  std::string text;
  for (const auto& name : names) {
    if (!text.empty()) text += separator;
    text += name;
  }
  return text;
}

/// "a", "a and b", or "a, b and c". last: the word before the last name.
[[nodiscard]] inline std::string enumeration(std::span<const std::string> names, std::string_view last = "and") {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? fmt::format(" {} ", last) : ", ";
    text += names[i];
  }
  return text;
}

/// Replaces "%20" by a blank, and so on. A '%' without two hexadecimal digits remains.
[[nodiscard]] inline std::string percentDecoded(std::string_view text) {
  std::string decoded;
  for (size_t i = 0; i < text.size(); ++i) {
    uint8_t code = 0;
    const char* const digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      decoded += static_cast<char>(code);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

/// The text without a byte order mark of UTF-8 at its beginning.
[[nodiscard]] inline std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  return text.substr(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
}

/// The parts between separators. An empty last part is left out.
[[nodiscard]] inline std::vector<std::string> splitAt(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const size_t end = std::min(text.find(separator), text.size());
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

/// Wraps a text into lines of at most `width` columns. Each line begins with `indent`.
[[nodiscard]] inline std::string wrapped(std::string_view text, size_t width, std::string_view indent) {
  std::string lines;
  size_t column = width;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, std::min(text.find_first_of(" \n"), text.size()));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    const bool isNewLine = column + 1 + word.size() > width;
    if (isNewLine) lines += lines.empty() ? "" : "\n";
    lines += isNewLine ? indent : " ";
    lines += word;
    column = isNewLine ? indent.size() + word.size() : column + 1 + word.size();
  }
  return lines;
}

/// The number with commas: "96,966" for 96966.
[[nodiscard]] inline std::string groupDigits(uint64_t number) {
  std::string text = std::to_string(number);
  for (size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, ",");
  return text;
}

/// A count with its noun: "1 vertex", "1,234 vertices". If `plural` is empty, the plural is the singular with an s.
[[nodiscard]] inline std::string counted(uint64_t count, std::string_view singular, std::string_view plural = {}) {
  if (count == 1 || !plural.empty()) return fmt::format("{} {}", groupDigits(count), count == 1 ? singular : plural);
  return fmt::format("{} {}s", groupDigits(count), singular);
}

/// The number that the whole text represents; empty if the text is not a number.
template <typename T>
[[nodiscard]] std::optional<T> numberIn(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Text of a diameter, thickness or area in a report, a picture or a legend: four significant digits. A length that
/// differs from `limit` gets up to nine digits, if fewer digits would give the text of `limit`.
[[nodiscard]] inline std::string lengthText(double length, std::optional<double> limit = {}) {
  for (int digits = 4; limit && digits <= 9; ++digits)
    if (std::string text = fmt::format("{:.{}g}", length, digits); text != fmt::format("{:.{}g}", *limit, digits))
      return text;
  return fmt::format("{:.4g}", length);
}

/// Text of a limit. The text has nine significant digits, so that rounding errors of unit conversions are not visible.
[[nodiscard]] inline std::string limitText(double limit) { return fmt::format("{:.9g}", limit); }

}  // namespace asdfvk
