// ASCII STL: one or more of `solid NAME`, facets, `endsolid NAME`. Words may be divided among lines in any way; a name
// is any text up to the end of its line. Each solid is an object. Comments, lines of colours, further lines of a name
// and a repeated line `solid` are ignored and reported. The words `facet normal` always begin a face, also within a
// name, so that no face is taken for a part of a name.
#include "io/stl_ascii.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "core/text.h"
#include "io/corner_welder.h"
#include "io/input_failure.h"
#include "io/object_names.h"
#include "io/stl_reader.h"
#include "io/text_scanner.h"

namespace asdfvk {
namespace {

/// keyword: lower-case letters. Ignores the case of the word: bit 5 of a letter.
bool isStlWord(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return (a | 0x20) == b; });
}

bool beginsStlComment(std::string_view word) {
  return word.starts_with('#') || word.starts_with(';') || word.starts_with("//");
}

/// Whether the word is part of a face. A text with such a word may be a damaged face.
bool isOfFacet(std::string_view word) {
  constexpr auto kWords =
      std::to_array<std::string_view>({"facet", "normal", "outer", "loop", "vertex", "endloop", "endfacet"});
  return std::any_of(kWords.begin(), kWords.end(), [&](std::string_view keyword) { return isStlWord(word, keyword); });
}

class AsciiStlReader {
 public:
  explicit AsciiStlReader(std::span<const char> bytes) : text_(bytes), welder_(0) {}

  Mesh read() {
    while (!atEnd()) {
      requireKeyword("solid");
      readSolid();
    }
    std::vector<NamedFaces> objects = names_.finish(triangles_.size());
    Mesh mesh = stlMesh(std::move(welder_.points()), std::move(triangles_));
    mesh.objects = std::move(objects);
    if (commentCount_ > 0) mesh.skipped.push_back(counted(commentCount_, "comment"));
    if (textLineCount_ > 0) mesh.skipped.push_back(counted(textLineCount_, "line") + " of text between the faces");
    return mesh;
  }

 private:
  /// Reads a solid after the word `solid`.
  void readSolid() {
    uint64_t nameLineCount = 0;  // Ignored lines before the first face; they may be repeated after `endsolid`.
    bool isInName = true;
    for (bool isFacet = readName();;) {
      if (isFacet) {
        readFacet();
        isInName = isFacet = false;
      }
      const std::string_view word = nextWord("'facet' or 'endsolid'");
      if (isStlWord(word, "facet")) {
        isFacet = true;
      } else if (isEnd(word, "solid")) {
        isFacet = skipName();
        if (!isFacet) break;
        names_.begin(triangles_.size(), {});  // The skipped text may have the name of a further solid.
      } else if (isStlWord(word, "color") || isInName) {
        if (isInName) ++nameLineCount;
        isFacet = skipTextLine(word);
      } else {
        failAtWord(word);
      }
    }
    while (nameLineCount-- > 0 && !atEnd() && !isStlWord(peekedWord(), "solid"))
      if (skipTextLine(text_.wordOnLine())) failAtLine(text_.line(), "expected 'solid', found 'facet'");
  }

  void readFacet() {
    requireKeyword("normal");
    // The words of the normal may be anything, because some programs write 1.#IND for a face of zero area.
    for (int i = 0; i < 3; ++i) static_cast<void>(text_.word("a number of the normal"));
    requireKeyword("outer");
    requireKeyword("loop");
    Face& face = triangles_.emplace_back();
    for (uint32_t& corner : face) {
      requireKeyword("vertex");
      Vec3d p;
      for (size_t axis = 0; axis < 3; ++axis) p[axis] = readCoordinate();
      corner = welder_.indexOf(p);
    }
    requireKeyword("endloop");
    requireKeyword("endfacet");
  }

  /// Coordinates are rounded to float32, the type of coordinates in STL. In the text of some programs, equal corners
  /// differ in further digits.
  double readCoordinate() {
    const double value = text_.number("a vertex coordinate");
    if (std::isfinite(value) && std::abs(value) > std::numeric_limits<float>::max())
      failAtLine(text_.line(), fmt::format("a vertex coordinate is too large for STL, which has float32: {}", value));
    return static_cast<float>(value);
  }

  /// Begins an object with the name that skipName() skips. Returns the value of skipName().
  bool readName() {
    const char* const begin = text_.position();
    const char* end = begin;
    const bool isFacet = skipName(&end);
    names_.begin(triangles_.size(), {begin, static_cast<size_t>(end - begin)});
    return isFacet;
  }

  /// Skips the rest of the line. If it has the words `facet normal`, stops between them and returns true.
  /// end: receives the end of the last word of the name.
  bool skipName(const char** end = nullptr) {
    while (!text_.atLineEnd()) {
      const std::string_view word = text_.wordOnLine();
      if (isStlWord(word, "facet") && isStlWord(peekedWord(), "normal")) return true;
      if (isStlWord(word, "outer") && isStlWord(peekedWord(), "loop"))
        failAtLine(text_.line(), "'outer loop' without 'facet normal' before it");
      if (end != nullptr) *end = text_.position();
    }
    return false;
  }

  /// Skips a line that is no name, in the way of skipName(). word: the first word of the line. Refuses a line with a
  /// further word of a face.
  bool skipTextLine(std::string_view word) {
    ++textLineCount_;
    if (isStlWord(word, "solid") || isStlWord(word, "endsolid")) return skipName();
    for (; !word.empty(); word = text_.wordOnLine()) {
      if (isStlWord(word, "facet") && isStlWord(peekedWord(), "normal")) return true;
      if (isOfFacet(word)) failAtWord(word);
    }
    return false;
  }

  /// Skips comments.
  std::string_view nextWord(std::string_view expected) {
    for (;;) {
      const std::string_view word = text_.word(expected);
      if (!beginsStlComment(word)) return word;
      skipComment();
    }
  }
  bool atEnd() {
    while (!text_.atEnd()) {
      if (!beginsStlComment(peekedWord())) return false;
      skipComment();
    }
    return true;
  }
  /// Skips the numbers after the word `color` within a face.
  void skipColour() {
    ++textLineCount_;
    while (!text_.atLineEnd()) {
      TextScanner ahead = text_;
      if (!numberIn<double>(ahead.wordOnLine())) return;
      text_ = ahead;
    }
  }
  void skipComment() {
    ++commentCount_;
    text_.skipLine();
  }

  static std::string_view peekedWord(TextScanner ahead) {
    return ahead.atEnd() ? std::string_view() : ahead.wordOnLine();
  }
  [[nodiscard]] std::string_view peekedWord() const { return peekedWord(text_); }

  /// Whether the word is `endsolid`, or `end` before `solid`. The name may follow `endsolid` without a blank.
  bool isEnd(std::string_view word, std::string_view what) {
    if (!isStlWord(word.substr(0, 3), "end")) return false;
    const std::string_view rest = word.substr(3);
    if (rest.empty() && isStlWord(peekedWord(), what)) return !text_.word(what).empty();
    return isStlWord(what == "solid" ? rest.substr(0, what.size()) : rest, what);
  }
  /// keyword: also `endloop` or `endfacet`, which may be divided into two words.
  void requireKeyword(std::string_view keyword) {
    std::string_view word = text_.word(keyword);
    for (; !isStlWord(word, keyword); word = text_.word(keyword)) {
      if (beginsStlComment(word))
        skipComment();
      else if (isStlWord(word, "color"))
        skipColour();
      else
        break;
    }
    if (isStlWord(word, keyword)) return;
    if (!isStlWord(word, keyword) && !(keyword.starts_with("end") && isEnd(word, keyword.substr(3))))
      failAtLine(text_.line(), fmt::format("expected '{}', found {}", keyword, quoted(word)));
  }
  [[noreturn]] void failAtWord(std::string_view word) const {
    failAtLine(text_.line(), fmt::format("expected 'facet' or 'endsolid', found {}", quoted(word)));
  }

  TextScanner text_;
  CornerWelder welder_;
  std::vector<Face> triangles_;
  ObjectNames names_;
  uint64_t commentCount_ = 0, textLineCount_ = 0;
};

}  // namespace

bool beginsWithSolid(std::span<const char> bytes) {
  TextScanner text(bytes);
  while (!text.atEnd()) {
    const std::string_view word = text.wordOnLine();
    if (!beginsStlComment(word)) return isStlWord(word, "solid");
    text.skipLine();
  }
  return false;
}

Mesh parseAsciiStl(std::span<const char> bytes) { return AsciiStlReader(bytes).read(); }

}  // namespace asdfvk
