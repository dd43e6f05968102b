#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct XML_ParserStruct;

namespace asdfvk {

/// Reads the tags of an XML document one after another, with resolved namespaces. Expat parses the document in pieces;
/// it reads UTF-8, UTF-16, ISO 8859-1 and ASCII. A
/// byte order mark of UTF-16 overrides the encoding that the document states. Document types are rejected, because they
/// can define entities. Memory: at most a few MB.
class XmlReader {
 public:
  /// Reads up to `size` bytes; fewer only at the end of the document.
  using Read = std::function<size_t(char* to, size_t size)>;
  enum class Event { Start, End, Finished };

  struct Attribute {
    std::string_view space;  ///< Namespace; empty for an attribute without prefix.
    std::string_view name, value;
  };

  /// How prefixes are read. Some programs write prefixes that they do not bind.
  enum class Prefixes { Resolved, PartOfName };

  XmlReader(Read read, std::string document, Prefixes prefixes = Prefixes::Resolved);
  ~XmlReader();
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;

  /// An empty element gives a Start and an End. Throws Error{UnreadableInput} with the byte if the document is not
  /// well-formed, or exceeds a limit: 64 levels, 64 attributes per element, 1 KiB per name, 1 MiB per tag or comment.
  Event next();
  /// Reads to the end of the element that has just started.
  void skipElement();

  // Views of the last start tag are valid until next().
  [[nodiscard]] std::string_view space() const { return space_; }
  [[nodiscard]] std::string_view name() const { return name_; }
  [[nodiscard]] std::span<const Attribute> attributes() const { return attributes_; }
  /// The value of the attribute without prefix.
  [[nodiscard]] std::optional<std::string_view> attribute(std::string_view name) const;
  /// The text between the last tag and the tag before it, without blanks at its beginning; at most 64 bytes.
  [[nodiscard]] std::string_view text() const { return text_; }
  /// The namespace that the root element binds to a prefix, or "".
  [[nodiscard]] std::string namespaceOf(const std::string& prefix) const;

  /// Throws Error{UnreadableInput} with the byte of the last tag.
  [[noreturn]] void fail(std::string_view reason) const;

 private:
  struct Handlers;
  /// A tag that expat has found. Its strings are the next ones in strings_: the text before it, and for a start tag its
  /// name and the names and values of the attributes.
  struct Tag {
    Event event;
    uint32_t attributeCount;
    uint64_t byte;
  };

  void parsePiece();
  void addString(std::string_view text);
  void addTag(Event event, const char* name, const char** attributes);
  void stop(std::string reason);
  [[nodiscard]] std::string_view takeString();
  [[nodiscard]] uint64_t currentByte() const;

  std::unique_ptr<XML_ParserStruct, void (*)(XML_ParserStruct*)> parser_;
  Read read_;
  std::string document_;
  uint64_t readBytes_ = 0;
  bool isAtEnd_ = false;
  uint32_t depth_ = 0;
  std::map<std::string, std::string> namespaces_;  ///< The bindings of the root element, by prefix.
  std::string openText_;                           ///< Text after the last tag that expat has found.

  std::vector<Tag> tags_;
  std::string strings_;
  std::vector<uint32_t> sizes_;  ///< Sizes of the strings.
  size_t nextTag_ = 0, nextString_ = 0, nextCharacter_ = 0;
  /// Why parsing stopped, and where. next() throws it after the last tag.
  std::string failure_;
  uint64_t failureByte_ = 0;
  std::exception_ptr exception_;

  uint64_t tagByte_ = 0;
  std::string_view text_, space_, name_;
  std::vector<Attribute> attributes_;
};

/// The text without the blanks of XML at its ends.
[[nodiscard]] std::string_view withoutBlanks(std::string_view text);

}  // namespace asdfvk
