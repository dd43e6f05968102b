#include "io/text_scanner.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "io/input_failure.h"

namespace asdfvk {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Whether a decimal number outside of the range of double is too small (and not too large). from_chars reports the
/// same error for both.
bool isTiny(std::string_view number) {
  const size_t exponentAt = number.find_first_of("eE");
  int64_t exponent = 0;
  if (exponentAt != std::string_view::npos) {
    constexpr int64_t kHugeExponent = int64_t{1} << 60;
    std::string_view digits = number.substr(exponentAt + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (result.ec != std::errc() || exponent > kHugeExponent || exponent < -kHugeExponent)
      return digits.starts_with('-');
  }
  const std::string_view mantissa = number.substr(0, exponentAt);
  const size_t firstDigit = mantissa.find_first_of("123456789");
  if (firstDigit == std::string_view::npos) return true;
  const size_t point = std::min(mantissa.find('.'), mantissa.size());
  return static_cast<int64_t>(point) - static_cast<int64_t>(firstDigit) + exponent < 0;
}

}  // namespace

TextScanner::TextScanner(std::span<const char> bytes, TextSyntax syntax, uint64_t firstLine)
    : at_(bytes.data()), end_(bytes.data() + bytes.size()), line_(firstLine) {
  for (const char c : {' ', '\t', '\v', '\f'}) classes_[static_cast<unsigned char>(c)] = CharClass::Blank;
  for (const char c : {'\n', '\r'}) classes_[static_cast<unsigned char>(c)] = CharClass::LineBreak;
  if (syntax.comment != '\0') classes_[static_cast<unsigned char>(syntax.comment)] = CharClass::Comment;
  if (syntax.backslashContinues) classes_['\\'] = CharClass::Backslash;
  if (std::string_view(at_, bytes.size()).starts_with(kByteOrderMark)) at_ += kByteOrderMark.size();
}

std::string_view TextScanner::scanWord() {
  const char* begin = at_;
  while (!endsWord(at_)) ++at_;
  return {begin, static_cast<size_t>(at_ - begin)};
}

void TextScanner::requireWord(std::string_view expected) {
  if (atEnd())
    failAtLine(line_, fmt::format("the file ends where {} is expected; it is truncated", printable(expected)));
}

std::string_view TextScanner::word(std::string_view expected) {
  requireWord(expected);
  return scanWord();
}

double TextScanner::number(std::string_view expected) {
  requireWord(expected);
  const char* begin = at_;
  if (*begin == '+' && begin + 1 != end_ && begin[1] != '-') ++begin;
  double value = 0;
  const auto [next, ec] = std::from_chars(begin, end_, value);
  if (ec == std::errc::invalid_argument || !endsWord(next))
    failAtLine(line_, fmt::format("expected {}, found {}", printable(expected), quoted(scanWord())));
  if (ec == std::errc::result_out_of_range) {
    const std::string_view text(begin, static_cast<size_t>(next - begin));
    if (!isTiny(text))
      failAtLine(line_, fmt::format("{} is too large for a double: {}", printable(expected), quoted(text)));
    value = *begin == '-' ? -0.0 : 0.0;
  }
  at_ = next;
  return value;
}

int64_t TextScanner::integer(std::string_view expected) {
  requireWord(expected);
  const char* begin = at_;
  if (*begin == '+' && begin + 1 != end_ && begin[1] != '-') ++begin;
  int64_t value = 0;
  const auto [next, ec] = std::from_chars(begin, end_, value);
  if (ec != std::errc() || !endsWord(next))
    failAtLine(line_, fmt::format("expected {}, an integer, found {}", printable(expected), quoted(scanWord())));
  at_ = next;
  return value;
}

void TextScanner::requireLineEnd(std::string_view after) {
  if (!atLineEnd()) failAtLine(line_, fmt::format("unexpected {} after {}", quoted(scanWord()), after));
}

void TextScanner::requireEnd(std::string_view after) {
  if (!atEnd()) failAtLine(line_, fmt::format("unexpected {} after {}", quoted(scanWord()), after));
}

void TextScanner::skipLine() {
  while (!atLineEnd()) static_cast<void>(scanWord());
  if (at_ != end_) skipLineBreak();
}

std::string_view firstWord(std::span<const char> bytes, char comment) {
  TextScanner text(bytes, {.comment = comment});
  return text.atEnd() ? std::string_view() : text.wordOnLine();
}

}  // namespace asdfvk
