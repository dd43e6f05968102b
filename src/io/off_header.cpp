#include "io/off_header.h"

#include <fmt/format.h>

#include <optional>

#include "io/input_failure.h"

namespace asdfvk {
namespace {

struct OffKeyword {
  OffHeader header;
  bool hasFourCoordinates = false;  ///< 4OFF, nOFF, 4nOFF.
};

/// Programs disagree on the order of the prefixes; it makes no difference here.
std::optional<OffKeyword> parseKeyword(std::string_view word) {
  const size_t at = word.find("OFF");
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view behind = word.substr(at + 3);
  if (!behind.empty() && !(behind[0] >= '0' && behind[0] <= '9')) return std::nullopt;
  OffKeyword keyword;
  keyword.header.keyword = word.substr(0, at + 3);
  for (std::string_view prefixes = word.substr(0, at); !prefixes.empty();) {
    bool* flag = nullptr;
    size_t length = 1;
    if (prefixes.starts_with("ST")) {
      flag = &keyword.header.hasTexture;
      length = 2;
    } else if (prefixes[0] == 'C') {
      flag = &keyword.header.hasColours;
    } else if (prefixes[0] == 'N') {
      flag = &keyword.header.hasNormals;
    } else if (prefixes[0] == '4' || prefixes[0] == 'n') {
      flag = &keyword.hasFourCoordinates;
    }
    if (flag == nullptr || (*flag && flag != &keyword.hasFourCoordinates)) return std::nullopt;
    *flag = true;
    prefixes.remove_prefix(length);
  }
  return keyword;
}

}  // namespace

bool isOffKeyword(std::string_view word) { return parseKeyword(word).has_value(); }

OffHeader readOffHeader(TextScanner& text) {
  TextScanner ahead = text;
  const std::string_view word = ahead.word("OFF");
  const std::optional<OffKeyword> keyword = parseKeyword(word);
  if (!keyword) {
    if (word[0] >= '0' && word[0] <= '9') return {};
    failAtLine(ahead.line(), fmt::format("OFF or the vertex count should stand here, not {}", quoted(word)));
  }
  if (keyword->hasFourCoordinates)
    failAtLine(ahead.line(), fmt::format("{} has other than three coordinates per vertex", quoted(word)));
  static_cast<void>(text.atEnd());
  text.passOver(keyword->header.keyword.size());
  TextScanner behind = text;
  if (!behind.atLineEnd() && behind.wordOnLine() == "BINARY")
    failAtLine(behind.line(), "binary OFF is not read; convert the mesh to PLY");
  return keyword->header;
}

}  // namespace asdfvk
