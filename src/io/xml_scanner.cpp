#include "io/xml_scanner.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "io/input_failure.h"

namespace asdfvk {
namespace {

constexpr size_t kMaxXmlDepth = 64, kMaxAttributes = 64;

bool isXmlBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

void trimStart(std::string_view& text) {
  while (!text.empty() && isXmlBlank(text.front())) text.remove_prefix(1);
}

bool isNameCharacter(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_' || c == '-' ||
         c == '.' || c == ':' || static_cast<unsigned char>(c) >= 0x80;
}

std::string_view takeName(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), isNameCharacter);
  const std::string_view name = text.substr(0, static_cast<size_t>(end - text.begin()));
  text.remove_prefix(name.size());
  return name;
}

}  // namespace

XmlScanner::XmlScanner(Read read, std::string name) : read_(std::move(read)), document_(std::move(name)) {
  constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";
  buffer_.reserve(2 * kBufferSize);
  fill();
  if (buffer_.starts_with(kUtf8Mark)) at_ = kUtf8Mark.size();
  if (buffer_.starts_with("\xff\xfe") || buffer_.starts_with("\xfe\xff")) fail("is UTF-16; UTF-8 is read");
}

void XmlScanner::fail(std::string_view reason) const {
  failInput(fmt::format("{}, byte {}: {}", printable(document_), tagOffset_, reason));
}

/// Reads more bytes after the unread bytes. Returns false at the end of the document.
bool XmlScanner::fill() {
  if (isAtEnd_) return false;
  buffer_.erase(0, at_);
  bufferOffset_ += at_;
  at_ = 0;
  const size_t size = buffer_.size();
  buffer_.resize(size + kBufferSize);
  const size_t count = read_(buffer_.data() + size, kBufferSize);
  buffer_.resize(size + count);
  isAtEnd_ = count < kBufferSize;
  return count > 0;
}

bool XmlScanner::hasNext(std::string_view text) {
  while (left().size() < text.size() && fill()) continue;
  return left().starts_with(text);
}

void XmlScanner::skipPast(std::string_view end) {
  for (;;) {
    const size_t found = left().find(end);
    if (found != std::string_view::npos) {
      at_ += found + end.size();
      return;
    }
    at_ = std::max(at_, buffer_.size() - std::min(buffer_.size(), end.size() - 1));
    if (!fill()) fail(fmt::format("truncated: no {}", end));
  }
}

/// Returns the text between < and >, copied to tag_.
std::string_view XmlScanner::takeTag() {
  size_t i = 1;
  char quote = 0;
  for (;; ++i) {
    if (i == left().size()) {
      if (i > kBufferSize) fail("a tag of more than 64 KiB");
      if (!fill()) fail("truncated in a tag");
    }
    const char c = left()[i];
    if (c == '<') fail("'<' in a tag");
    if (quote != 0)
      quote = c == quote ? char{0} : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '>')
      break;
  }
  tag_.assign(left().substr(1, i - 1));
  at_ += i + 1;
  return tag_;
}

XmlScanner::Event XmlScanner::next() {
  attributes_.clear();
  if (endsElement_) {
    endsElement_ = false;
    open_.pop_back();
    return Event::End;
  }
  for (;;) {
    const size_t text = std::min(left().find('<'), left().size());
    if (open_.empty() && !std::all_of(left().begin(), left().begin() + static_cast<ptrdiff_t>(text), isXmlBlank)) {
      tagOffset_ = bufferOffset_ + at_;
      fail(hasRoot_ ? "text after the end of the document" : "is not XML");
    }
    at_ += text;
    tagOffset_ = bufferOffset_ + at_;
    if (left().empty()) {
      if (fill()) continue;
      if (!open_.empty()) fail(fmt::format("truncated: {} has no end tag", asdfvk::quoted(open_.back())));
      if (!hasRoot_) fail("has no root element");
      return Event::Finished;
    }
    if (hasNext("<!--")) {
      at_ += 4;
      skipPast("-->");
    } else if (hasNext("<?")) {
      skipPast("?>");
    } else if (!open_.empty() && hasNext("<![CDATA[")) {
      skipPast("]]>");
    } else if (hasNext("<!")) {
      fail("a document type is not allowed");
    } else if (hasNext("</")) {
      readEnd(takeTag().substr(1));
      return Event::End;
    } else {
      readStart(takeTag());
      return Event::Start;
    }
  }
}

void XmlScanner::readStart(std::string_view tag) {
  if (open_.empty() && hasRoot_) fail("a second root element");
  hasRoot_ = true;
  endsElement_ = tag.ends_with('/');
  if (endsElement_) tag.remove_suffix(1);
  tagName_ = takeName(tag);
  if (tagName_.empty()) fail("a tag without a name");
  readAttributes(tag);
  if (open_.size() == kMaxXmlDepth) fail(fmt::format("nested more than {} levels deep", kMaxXmlDepth));
  open_.emplace_back(tagName_);
}

void XmlScanner::readAttributes(std::string_view text) {
  for (;;) {
    const bool hasBlank = !text.empty() && isXmlBlank(text.front());
    trimStart(text);
    if (text.empty()) return;
    const std::string_view name = takeName(text);
    trimStart(text);
    if (!hasBlank || name.empty() || !text.starts_with('='))
      fail(fmt::format("{} is damaged", asdfvk::quoted(tagName_)));
    text.remove_prefix(1);
    trimStart(text);
    const char quote = text.empty() ? char{0} : text.front();
    const size_t end = quote == '"' || quote == '\'' ? text.find(quote, 1) : std::string_view::npos;
    if (end == std::string_view::npos) fail(fmt::format("attribute {} has no value", asdfvk::quoted(name)));
    if (attribute(name)) fail(fmt::format("attribute {} occurs twice", asdfvk::quoted(name)));
    if (attributes_.size() == kMaxAttributes) fail(fmt::format("more than {} attributes", kMaxAttributes));
    attributes_.emplace_back(name, text.substr(1, end - 1));
    text.remove_prefix(end + 1);
  }
}

void XmlScanner::readEnd(std::string_view tag) {
  tagName_ = takeName(tag);
  trimStart(tag);
  if (open_.empty() || open_.back() != tagName_ || !tag.empty())
    fail(fmt::format("unexpected end tag {}", asdfvk::quoted(tagName_)));
  open_.pop_back();
}

void XmlScanner::skipElement() {
  for (size_t depth = 1; depth > 0;) depth = next() == Event::Start ? depth + 1 : depth - 1;
}

std::optional<std::string_view> XmlScanner::attribute(std::string_view name) const {
  const auto found =
      std::find_if(attributes_.begin(), attributes_.end(), [&](const auto& entry) { return entry.first == name; });
  return found == attributes_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::string> xmlDecoded(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, char>, 7> kEntities{{{"&lt;", '<'},
                                                                        {"&gt;", '>'},
                                                                        {"&amp;", '&'},
                                                                        {"&quot;", '"'},
                                                                        {"&apos;", '\''},
                                                                        {"&#32;", ' '},
                                                                        {"&#x20;", ' '}}};
  std::string decoded;
  while (!text.empty()) {
    if (text.front() != '&') {
      const size_t end = std::min(text.find('&'), text.size());
      decoded += text.substr(0, end);
      text.remove_prefix(end);
      continue;
    }
    const auto entity =
        std::find_if(kEntities.begin(), kEntities.end(), [&](const auto& e) { return text.starts_with(e.first); });
    if (entity == kEntities.end()) return std::nullopt;
    decoded += entity->second;
    text.remove_prefix(entity->first.size());
  }
  return decoded;
}

}  // namespace asdfvk
