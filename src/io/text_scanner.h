#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace asdfvk {

struct TextSyntax {
  char comment = '\0';              ///< From here to the end of the line nothing counts; '\0': there are no comments.
  bool backslashContinues = false;  ///< A backslash right before a line break joins the two lines.
};

/// Words and numbers of a text, with the line they stand on. Lines end with LF, CRLF or CR. Never reads beyond `bytes`,
/// and keeps views into them. What is not there or is not a number is an Error{Input} that names the line and `what`,
/// which may be words of the file.
class TextScanner {
 public:
  /// A UTF-8 byte order mark at the beginning is passed over.
  explicit TextScanner(std::span<const char> bytes, TextSyntax syntax = {}, uint64_t firstLine = 1);

  /// The line of the word read last, or of the one that a look ahead found.
  [[nodiscard]] uint64_t line() const { return line_; }
  [[nodiscard]] const char* position() const { return at_; }
  [[nodiscard]] uint64_t remaining() const { return static_cast<uint64_t>(end_ - at_); }

  /// Passes over blanks and comments; true where the line (not counting continued ones) has no more words.
  [[nodiscard]] bool atLineEnd() {
    skipBlanks();
    return at_ == end_ || classOf(*at_) == kLineBreak;
  }
  /// Passes over blanks, comments and line breaks; true at the end of the text.
  [[nodiscard]] bool atEnd() {
    while (atLineEnd()) {
      if (at_ == end_) return true;
      skipLineBreak();
    }
    return false;
  }

  /// The next word of this line; empty where there is none.
  [[nodiscard]] std::string_view wordOnLine() { return atLineEnd() ? std::string_view() : scanWord(); }
  /// The next word, on this line or a later one.
  [[nodiscard]] std::string_view word(std::string_view what);
  /// The next word as a number: decimal, with or without exponent, or inf or nan. Too small becomes 0, too large fails.
  [[nodiscard]] double number(std::string_view what);
  /// The next word as a whole number.
  [[nodiscard]] int64_t integer(std::string_view what);

  /// Fails if a word is left on this line.
  void requireLineEnd(std::string_view afterWhat);
  void skipLine();
  /// Precondition: that many bytes of a word lie ahead.
  void passOver(size_t byteCount) { at_ += byteCount; }

 private:
  enum CharClass : uint8_t { kWord, kBlank, kLineBreak, kComment, kBackslash };

  [[nodiscard]] CharClass classOf(char c) const { return classes_[static_cast<unsigned char>(c)]; }
  [[nodiscard]] bool isContinuation(const char* p) const {
    return classOf(*p) == kBackslash && p + 1 != end_ && classOf(p[1]) == kLineBreak;
  }
  [[nodiscard]] bool endsWord(const char* p) const {
    if (p == end_) return true;
    const CharClass c = classOf(*p);
    return c != kWord && (c != kBackslash || isContinuation(p));
  }
  void skipBlanks() {
    while (at_ != end_) {
      const CharClass c = classOf(*at_);
      if (c == kBlank) {
        ++at_;
      } else if (c == kComment) {
        while (at_ != end_ && classOf(*at_) != kLineBreak) ++at_;
      } else if (c == kBackslash && isContinuation(at_)) {
        ++at_;
        skipLineBreak();
      } else {
        return;
      }
    }
  }
  void skipLineBreak() {
    at_ += *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n' ? 2 : 1;
    ++line_;
  }
  [[nodiscard]] std::string_view scanWord();
  void requireWord(std::string_view what);

  std::array<CharClass, 256> classes_{};
  const char* at_;
  const char* end_;
  uint64_t line_;
};

}  // namespace asdfvk
