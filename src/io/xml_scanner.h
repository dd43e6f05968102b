#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asdfvk {

/// Reads the tags of an XML document in pieces and skips the text between the tags. Rejects UTF-16 and malformed
/// documents. Also rejects document types, because they could define entities. Memory: some 100 KB.
class XmlScanner {
 public:
  /// Reads up to `size` bytes; fewer only at the end of the document.
  using Read = std::function<size_t(char* to, size_t size)>;
  enum class Event { Start, End, Finished };

  XmlScanner(Read read, std::string name);

  /// An empty element gives a Start and an End. Throws Error{UnreadableInput} with the byte.
  Event next();
  void skipElement();

  /// The name of the last tag, with its prefix. Valid until next().
  [[nodiscard]] std::string_view name() const { return tagName_; }
  /// An attribute of the last start tag, as it is in the file. Valid until next().
  [[nodiscard]] std::optional<std::string_view> attribute(std::string_view name) const;
  [[nodiscard]] const std::vector<std::pair<std::string_view, std::string_view>>& attributes() const {
    return attributes_;
  }

  /// Throws Error{UnreadableInput} with the byte of the last tag.
  [[noreturn]] void fail(std::string_view reason) const;

 private:
  static constexpr size_t kBufferSize = 1u << 16;

  [[nodiscard]] std::string_view left() const { return std::string_view(buffer_).substr(at_); }
  bool fill();
  bool hasNext(std::string_view text);
  void skipPast(std::string_view end);
  [[nodiscard]] std::string_view takeTag();
  void readStart(std::string_view tag);
  void readAttributes(std::string_view text);
  void readEnd(std::string_view tag);

  Read read_;
  std::string document_;
  std::string buffer_;
  size_t at_ = 0;
  uint64_t bufferOffset_ = 0;  ///< Offset of the buffer in the document.
  uint64_t tagOffset_ = 0;
  bool isAtEnd_ = false, hasRoot_ = false, endsElement_ = false;
  std::vector<std::string> open_;
  std::string tag_;  ///< The last tag; names and values are views into this text.
  std::string_view tagName_;
  std::vector<std::pair<std::string_view, std::string_view>> attributes_;
};

/// Decodes the five entities of XML and the references to a space. Returns nothing if the text has other references.
[[nodiscard]] std::optional<std::string> xmlDecoded(std::string_view text);

}  // namespace asdfvk
