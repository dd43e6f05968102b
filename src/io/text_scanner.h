#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace asdfvk {

struct TextSyntax {
  char comment = '\0';              ///< Character that starts a comment up to the end of the line; '\0': no comments.
  bool backslashContinues = false;  ///< A backslash at the end of a line, before optional blanks, joins two lines.
};

/// Words and numbers of a text, with their line numbers. Lines end with LF, CRLF or CR. Words are views into `bytes`.
/// expected: name of an item, which may contain words of the file. If the item is missing or is not a number, functions
/// throw Error{UnreadableInput} with the line and `expected`.
class TextScanner {
 public:
  /// Skips a UTF-8 byte order mark at the beginning.
  explicit TextScanner(std::span<const char> bytes, TextSyntax syntax = {}, uint64_t firstLine = 1);

  /// The line of the last word. After atLineEnd() or atEnd(), the line at which the skipped text ends.
  [[nodiscard]] uint64_t line() const { return line_; }
  [[nodiscard]] const char* position() const { return at_; }
  [[nodiscard]] uint64_t remaining() const { return static_cast<uint64_t>(end_ - at_); }

  /// Skips blanks and comments. Returns true if the line, continuation lines included, has no more words.
  [[nodiscard]] bool atLineEnd() {
    skipBlanks();
    return at_ == end_ || classOf(*at_) == CharClass::LineBreak;
  }
  /// Skips blanks, comments and line breaks. Returns true at the end of the text.
  [[nodiscard]] bool atEnd() {
    while (atLineEnd()) {
      if (at_ == end_) return true;
      skipLineBreak();
    }
    return false;
  }

  /// The next word of this line; empty if there is none.
  [[nodiscard]] std::string_view wordOnLine() { return atLineEnd() ? std::string_view() : scanWord(); }
  [[nodiscard]] std::string_view word(std::string_view expected);
  /// Reads a decimal number, with or without an exponent, or inf or nan. Numbers that are too small for double become
  /// 0; numbers that are too large are errors.
  [[nodiscard]] double number(std::string_view expected);
  [[nodiscard]] int64_t integer(std::string_view expected);

  /// after: the preceding item, for the message.
  void requireLineEnd(std::string_view after);
  /// after: the preceding item, for the message.
  void requireEnd(std::string_view after);
  /// The rest of the line without its line break, with blanks and comments. Continues on the next line. Here a
  /// backslash does not join lines.
  std::string_view takeLine();
  /// takeLine() without the result.
  void skipLine() { static_cast<void>(takeLine()); }
  /// Precondition: the next byteCount bytes belong to one word.
  void skipBytes(size_t byteCount) { at_ += byteCount; }

 private:
  enum class CharClass : uint8_t { Word, Blank, LineBreak, Comment, Backslash };

  [[nodiscard]] CharClass classOf(char c) const { return classes_[static_cast<unsigned char>(c)]; }
  [[nodiscard]] bool isContinuation(const char* p) const;
  [[nodiscard]] bool endsWord(const char* p) const {
    if (p == end_) return true;
    const CharClass c = classOf(*p);
    return c != CharClass::Word && (c != CharClass::Backslash || isContinuation(p));
  }
  void skipBlanks() {
    while (at_ != end_) {
      const CharClass c = classOf(*at_);
      if (c == CharClass::Blank) {
        ++at_;
      } else if (c == CharClass::Comment) {
        skipToLineBreak();
      } else if (c == CharClass::Backslash && isContinuation(at_)) {
        skipToLineBreak();
        skipLineBreak();
      } else {
        return;
      }
    }
  }
  void skipToLineBreak() {
    while (at_ != end_ && classOf(*at_) != CharClass::LineBreak) ++at_;
  }
  void skipLineBreak() {
    at_ += *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n' ? 2 : 1;
    ++line_;
  }
  [[nodiscard]] std::string_view scanWord();
  void requireWord(std::string_view expected);
  [[noreturn]] void failAtNumber(std::string_view expected);

  std::array<CharClass, 256> classes_{};
  const char* at_;
  const char* end_;
  uint64_t line_;
};

/// Why a word is no number, and what to do, for the end of a message: a decimal comma or an undefined value such as
/// 1.#QNAN. Empty for other words.
[[nodiscard]] std::string_view remedyOfNumber(std::string_view word);

/// The first word of a text; empty if the text has no word.
[[nodiscard]] std::string_view firstWord(std::span<const char> bytes, char comment = '\0');

}  // namespace asdfvk
