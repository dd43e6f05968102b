#include "io/xml_reader.h"

#include <expat.h>
#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <new>
#include <tuple>
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

bool isXmlBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

void dropXmlBlanks(std::string_view& text) {
  while (!text.empty() && isXmlBlank(text.front())) text.remove_prefix(1);
}

std::pair<std::string_view, std::string_view> splitName(std::string_view name) {
  const size_t end = name.rfind(kSeparator);
  if (end == std::string_view::npos) return {{}, name};
  return {name.substr(0, end), name.substr(end + 1)};
}

}  // namespace

std::string_view withoutBlanks(std::string_view text) {
  dropXmlBlanks(text);
  while (!text.empty() && isXmlBlank(text.back())) text.remove_suffix(1);
  return text;
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
      if (++reader.depth_ > kMaxXmlDepth)
        return reader.stop(fmt::format("nested more than {} levels deep", kMaxXmlDepth));
      reader.addTag(Event::Start, name, attributes);
    });
  }
  static void end(void* data, const XML_Char*) {
    guarded(data, [&](XmlReader& reader) {
      --reader.depth_;
      reader.addTag(Event::End, nullptr, nullptr);
    });
  }
  static void text(void* data, const XML_Char* text, int size) {
    guarded(data, [&](XmlReader& reader) {
      std::string& open = reader.openText_;
      std::string_view added(text, static_cast<size_t>(size));
      if (open.empty()) dropXmlBlanks(added);
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

XmlReader::XmlReader(Read read, std::string document, Prefixes prefixes)
    : parser_(prefixes == Prefixes::Resolved ? XML_ParserCreateNS(nullptr, kSeparator) : XML_ParserCreate(nullptr),
              XML_ParserFree),
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

void XmlReader::addString(std::string_view text) {
  strings_ += text;
  sizes_.push_back(static_cast<uint32_t>(text.size()));
}

/// name: null for an end tag. Its name is known, because expat matches the tags.
void XmlReader::addTag(Event event, const char* name, const char** attributes) {
  const uint64_t byte = currentByte();
  uint32_t count = 0;
  addString(openText_);
  openText_.clear();
  const auto addName = [&](std::string_view text) {
    addString(text);
    if (text.size() > kMaxName) stop(fmt::format("a name of more than {} bytes", kMaxName));
    return text.size() <= kMaxName;
  };
  if (name != nullptr && !addName(name)) return;
  for (const char** a = attributes; a != nullptr && *a != nullptr; a += 2, ++count) {
    if (count == kMaxAttributes) return stop(fmt::format("more than {} attributes", kMaxAttributes));
    if (!addName(a[0])) return;
    addString(a[1]);
  }
  tags_.push_back({event, count, byte});
}

/// Reads and parses the next piece. Its tags replace those of the last piece.
void XmlReader::parsePiece() {
  tags_.clear();
  strings_.clear();
  sizes_.clear();
  nextTag_ = nextString_ = nextCharacter_ = 0;
  void* const buffer = XML_GetBuffer(parser_.get(), kPieceSize);
  if (buffer == nullptr) throw std::bad_alloc();
  const size_t count = read_(static_cast<char*>(buffer), kPieceSize);
  isAtEnd_ = count < kPieceSize;
  const std::string_view begin(static_cast<const char*>(buffer), std::min(count, size_t{2}));
  if (readBytes_ == 0 && (begin == "\xff\xfe" || begin == "\xfe\xff")) XML_SetEncoding(parser_.get(), "UTF-16");
  readBytes_ += count;
  const XML_Status status = XML_ParseBuffer(parser_.get(), static_cast<int>(count), isAtEnd_ ? XML_TRUE : XML_FALSE);
  if (!failure_.empty() || exception_) return;
  if (status == XML_STATUS_ERROR) {
    const XML_Error error = XML_GetErrorCode(parser_.get());
    if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    const bool isCut = isAtEnd_ && (error == XML_ERROR_NO_ELEMENTS || error == XML_ERROR_UNCLOSED_TOKEN);
    failure_ = isCut && depth_ > 0 ? "truncated: an element has no end; copy or export the file again"
                                   : XML_ErrorString(error);
    failureByte_ = currentByte();
  } else if (readBytes_ - std::min(currentByte(), readBytes_) > kMaxToken) {
    stop(fmt::format("a tag or comment of more than {} KiB", kMaxToken >> 10));
  }
}

std::string_view XmlReader::takeString() {
  const size_t size = sizes_[nextString_++];
  const std::string_view text(strings_.data() + nextCharacter_, size);
  nextCharacter_ += size;
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
  attributes_.clear();
  if (tag.event == Event::End) return Event::End;
  std::tie(space_, name_) = splitName(takeString());
  for (uint32_t i = 0; i < tag.attributeCount; ++i) {
    const auto [space, name] = splitName(takeString());
    attributes_.push_back({space, name, takeString()});
  }
  return Event::Start;
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
