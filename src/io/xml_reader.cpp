#include "io/xml_reader.h"

#include <expat.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>
#include <utility>

#include "io/input_failure.h"

namespace asdfvk {
namespace {

constexpr int kPieceSize = 1 << 14;
constexpr uint64_t kMaxToken = uint64_t{1} << 20;
constexpr uint32_t kMaxXmlDepth = 64, kMaxAttributes = 64;
constexpr size_t kMaxName = 1024, kMaxText = 64;
// Expat joins namespace and name with this character. A namespace cannot contain it unescaped, and expat refuses it
// escaped.
constexpr char kSeparator = '\n';
constexpr std::string_view kXmlBlanks = " \t\r\n";

std::pair<std::string_view, std::string_view> splitName(std::string_view name) {
  const size_t end = name.rfind(kSeparator);
  if (end == std::string_view::npos) return {{}, name};
  return {name.substr(0, end), name.substr(end + 1)};
}

}  // namespace

std::string_view withoutBlanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kXmlBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kXmlBlanks) + 1);
}

/// The functions that expat calls. An exception must not pass through expat.
struct XmlReader::Handlers {
  template <typename Work>
  static void guarded(void* data, const Work& work) {
    XmlReader& reader = *static_cast<XmlReader*>(data);
    if (!reader.failure_.empty() || reader.exception_) return;
    try {
      work(reader);
    } catch (...) {
      reader.exception_ = std::current_exception();
      XML_StopParser(reader.parser_.get(), XML_FALSE);
    }
  }
  static void start(void* data, const XML_Char* name, const XML_Char** attributes) {
    guarded(data, [&](XmlReader& reader) {
      if (++reader.depth_ > kMaxXmlDepth) return reader.stop(fmt::format("nested more than {} levels deep", kMaxXmlDepth));
      reader.addTag(Event::Start, name, attributes);
    });
  }
  static void end(void* data, const XML_Char* name) {
    guarded(data, [&](XmlReader& reader) {
      --reader.depth_;
      reader.addTag(Event::End, name, nullptr);
    });
  }
  static void text(void* data, const XML_Char* text, int size) {
    guarded(data, [&](XmlReader& reader) {
      std::string& open = reader.openText_;
      std::string_view added(text, static_cast<size_t>(size));
      if (open.empty()) added.remove_prefix(std::min(added.find_first_not_of(kXmlBlanks), added.size()));
      open += added.substr(0, kMaxText - open.size());
    });
  }
  static void bindPrefix(void* data, const XML_Char* prefix, const XML_Char* space) {
    guarded(data, [&](XmlReader& reader) {
      if (reader.depth_ > 0) return;
      if (reader.namespaces_.size() == kMaxAttributes)
        return reader.stop(fmt::format("more than {} namespaces", kMaxAttributes));
      reader.namespaces_[prefix == nullptr ? "" : prefix] = space == nullptr ? "" : space;
    });
  }
  static void documentType(void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
    guarded(data, [&](XmlReader& reader) { reader.stop("a document type is not allowed"); });
  }
};

XmlReader::XmlReader(Read read, std::string document)
    : parser_(XML_ParserCreateNS(nullptr, kSeparator), XML_ParserFree),
      read_(std::move(read)),
      document_(std::move(document)) {
  if (!parser_) throw std::bad_alloc();
  XML_SetUserData(parser_.get(), this);
  XML_SetElementHandler(parser_.get(), Handlers::start, Handlers::end);
  XML_SetCharacterDataHandler(parser_.get(), Handlers::text);
  XML_SetStartNamespaceDeclHandler(parser_.get(), Handlers::bindPrefix);
  XML_SetStartDoctypeDeclHandler(parser_.get(), Handlers::documentType);
}

XmlReader::~XmlReader() = default;

uint64_t XmlReader::currentByte() const {
  return static_cast<uint64_t>(std::max(XML_GetCurrentByteIndex(parser_.get()), XML_Index{0}));
}

void XmlReader::stop(std::string reason) {
  failure_ = std::move(reason);
  failureByte_ = currentByte();
  XML_StopParser(parser_.get(), XML_FALSE);
}

void XmlReader::addTag(Event event, const char* name, const char** attributes) {
  const auto add = [&](const char* text) { strings_.append(text, std::strlen(text) + 1); };
  strings_ += openText_;
  strings_ += '\0';
  openText_.clear();
  const auto requireShort = [&](const char* text) {
    const size_t size = std::strlen(text);
    if (size > kMaxName) stop(fmt::format("a name of more than {} bytes", kMaxName));
    return size <= kMaxName;
  };
  if (!requireShort(name)) return;
  add(name);
  uint32_t count = 0;
  for (const char** a = attributes; a != nullptr && *a != nullptr; a += 2, ++count) {
    if (count == kMaxAttributes) return stop(fmt::format("more than {} attributes", kMaxAttributes));
    if (!requireShort(a[0])) return;
    add(a[0]);
    add(a[1]);
  }
  tags_.push_back({event, count, currentByte()});
}

/// Reads and parses the next piece. Its tags replace those of the last piece.
void XmlReader::parsePiece() {
  tags_.clear();
  strings_.clear();
  nextTag_ = nextString_ = 0;
  void* const buffer = XML_GetBuffer(parser_.get(), kPieceSize);
  if (buffer == nullptr) throw std::bad_alloc();
  const size_t count = read_(static_cast<char*>(buffer), kPieceSize);
  isAtEnd_ = count < kPieceSize;
  readBytes_ += count;
  const XML_Status status = XML_ParseBuffer(parser_.get(), static_cast<int>(count), isAtEnd_ ? XML_TRUE : XML_FALSE);
  if (!failure_.empty() || exception_) return;
  if (status == XML_STATUS_ERROR) {
    const XML_Error error = XML_GetErrorCode(parser_.get());
    if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    const bool isCut = isAtEnd_ && (error == XML_ERROR_NO_ELEMENTS || error == XML_ERROR_UNCLOSED_TOKEN);
    failure_ = isCut && depth_ > 0 ? "truncated: an element has no end" : XML_ErrorString(error);
    failureByte_ = currentByte();
  } else if (readBytes_ - std::min(currentByte(), readBytes_) > kMaxToken) {
    stop(fmt::format("a tag or comment of more than {} KiB", kMaxToken >> 10));
  }
}

std::string_view XmlReader::takeString() {
  const std::string_view text(strings_.data() + nextString_);
  nextString_ += text.size() + 1;
  return text;
}

XmlReader::Event XmlReader::next() {
  while (nextTag_ == tags_.size()) {
    if (exception_) std::rethrow_exception(exception_);
    if (!failure_.empty()) {
      tagByte_ = failureByte_;
      fail(failure_);
    }
    if (isAtEnd_) return Event::Finished;
    parsePiece();
  }
  const Tag& tag = tags_[nextTag_++];
  tagByte_ = tag.byte;
  text_ = takeString();
  std::tie(space_, name_) = splitName(takeString());
  attributes_.clear();
  for (uint32_t i = 0; i < tag.attributeCount; ++i) {
    const auto [space, name] = splitName(takeString());
    attributes_.push_back({space, name, takeString()});
  }
  return tag.event;
}

void XmlReader::skipElement() {
  for (size_t depth = 1; depth > 0;) depth = next() == Event::Start ? depth + 1 : depth - 1;
}

std::optional<std::string_view> XmlReader::attribute(std::string_view name) const {
  const auto found = std::find_if(attributes_.begin(), attributes_.end(),
                                  [&](const Attribute& a) { return a.space.empty() && a.name == name; });
  return found == attributes_.end() ? std::nullopt : std::optional(found->value);
}

std::string XmlReader::namespaceOf(const std::string& prefix) const {
  const auto found = namespaces_.find(prefix);
  return found == namespaces_.end() ? std::string() : found->second;
}

void XmlReader::fail(std::string_view reason) const {
  failInput(fmt::format("{}, byte {}: {}", printable(document_), tagByte_, reason));
}

}  // namespace asdfvk
