#include "io/text_scanner.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>

#include "core/text.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

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

/// Whether the text of a number continues as in 1.#QNAN, -1.#IND or 1.#INF, which old C libraries of Windows write.
bool isUndefinedNumber(std::string_view rest) {
  return rest.starts_with("#QNAN") || rest.starts_with("#SNAN") || rest.starts_with("#IND") || rest.starts_with("#INF");
}

/// Whether the word is a number with a comma instead of the decimal point.
bool hasDecimalComma(std::string word) {
  const size_t comma = word.find(',');
  if (comma == std::string::npos) return false;
  word[comma] = '.';
  const size_t sign = word.starts_with('+') ? 1 : 0;
  return numberIn<double>(std::string_view(word).substr(sign)).has_value();
}

}  // namespace

TextScanner::TextScanner(std::span<const char> bytes, TextSyntax syntax, uint64_t firstLine)
    : at_(bytes.data()), end_(bytes.data() + bytes.size()), line_(firstLine) {
  for (const char c : {' ', '\t', '\v', '\f'}) classes_[static_cast<unsigned char>(c)] = CharClass::Blank;
  for (const char c : {'\n', '\r'}) classes_[static_cast<unsigned char>(c)] = CharClass::LineBreak;
  if (syntax.comment != '\0') classes_[static_cast<unsigned char>(syntax.comment)] = CharClass::Comment;
  if (syntax.backslashContinues) classes_['\\'] = CharClass::Backslash;
  at_ += bytes.size() - withoutByteOrderMark({at_, bytes.size()}).size();
}

bool TextScanner::isContinuation(const char* p) const {
  if (classOf(*p) != CharClass::Backslash) return false;
  do ++p;
  while (p != end_ && classOf(*p) == CharClass::Blank);
  return p != end_ && classOf(*p) == CharClass::LineBreak;
}

std::string_view TextScanner::scanWord() {
  const char* begin = at_;
  while (!endsWord(at_)) ++at_;
  return {begin, static_cast<size_t>(at_ - begin)};
}

void TextScanner::requireWord(std::string_view expected) {
  if (atEnd())
    failAtLine(line_, fmt::format("the file ends where {} is expected; it is truncated; copy or export it again",
                                  printable(expected)));
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
  // In a format with comments, the # of 1.#QNAN would begin a comment.
  if (ec == std::errc::invalid_argument || !endsWord(next) ||
      (next != end_ && *next == '#' && isUndefinedNumber({next, static_cast<size_t>(end_ - next)})))
    failAtNumber(expected);
  if (ec == std::errc::result_out_of_range) {
    const std::string_view text(begin, static_cast<size_t>(next - begin));
    if (!isTiny(text))
      failAtLine(line_, fmt::format("{} is too large for a double: {}", printable(expected), quoted(text)));
    value = *begin == '-' ? -0.0 : 0.0;
  }
  at_ = next;
  return value;
}

void TextScanner::failAtNumber(std::string_view expected) {
  const char* const begin = at_;
  const auto isInWord = [this](const char* p) {
    return !endsWord(p) || (p != end_ && classOf(*p) == CharClass::Comment);
  };
  while (isInWord(at_)) ++at_;
  const std::string_view word(begin, static_cast<size_t>(at_ - begin));
  failAtLine(line_, fmt::format("expected {}, found {}{}", printable(expected), quoted(word), remedyOfNumber(word)));
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

std::string_view TextScanner::takeLine() {
  const char* const begin = at_;
  skipToLineBreak();
  const std::string_view rest(begin, static_cast<size_t>(at_ - begin));
  if (at_ != end_) skipLineBreak();
  return rest;
}

std::string_view firstWord(std::span<const char> bytes, char comment) {
  TextScanner text(bytes, {.comment = comment});
  return text.atEnd() ? std::string_view() : text.wordOnLine();
}

std::string_view remedyOfNumber(std::string_view word) {
  if (isUndefinedNumber(word.substr(std::min(word.find('#'), word.size()))))
    return ", which is not a number: the program that wrote the file had an undefined value; repair the mesh there";
  if (hasDecimalComma(std::string(word))) return ": numbers have a decimal comma; write them with a point";
  return {};
}

}  // namespace asdfvk
