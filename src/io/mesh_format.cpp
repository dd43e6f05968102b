#include "io/mesh_format.h"

#include <cstring>
#include <string>

#include "core/text.h"
#include "io/obj_keywords.h"
#include "io/off_header.h"
#include "io/text_scanner.h"

namespace asdfvk {
namespace {

/// The first word of a text in which `comment` begins comments; empty where there is none.
std::string_view firstWord(std::span<const char> bytes, char comment) {
  TextScanner text(bytes, {.comment = comment});
  return text.atEnd() ? std::string_view() : text.wordOnLine();
}

std::optional<MeshFormat> formatOfExtension(std::string_view extension) {
  if (extension.starts_with('.')) extension.remove_prefix(1);
  const std::string lower = lowerCase(extension.substr(0, 8));
  if (lower == "ply") return MeshFormat::Ply;
  if (lower == "off" || lower == "coff" || lower == "noff") return MeshFormat::Off;
  if (lower == "obj") return MeshFormat::Obj;
  if (lower == "stl" || lower == "stla" || lower == "stlb") return MeshFormat::Stl;
  return std::nullopt;
}

}  // namespace

uint64_t binaryStlFaceCount(std::span<const char> bytes) {
  uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kStlHeaderSize - sizeof count, sizeof count);
  return count;
}

bool isBinaryStlSize(std::span<const char> bytes) {
  return bytes.size() >= kStlHeaderSize && bytes.size() == kStlHeaderSize + binaryStlFaceCount(bytes) * kStlFaceSize;
}

bool beginsWithSolid(std::span<const char> bytes) { return lowerCase(firstWord(bytes, '\0').substr(0, 6)) == "solid"; }

std::optional<MeshFormat> detectFormat(std::span<const char> bytes, std::string_view extension) {
  if (isBinaryStlSize(bytes)) return MeshFormat::Stl;
  if (firstWord(bytes, '\0') == "ply") return MeshFormat::Ply;
  if (beginsWithSolid(bytes)) return MeshFormat::Stl;
  const std::string_view word = firstWord(bytes, '#');
  if (isOffKeyword(word)) return MeshFormat::Off;
  if (const auto format = formatOfExtension(extension)) return format;
  if (isObjKeyword(word)) return MeshFormat::Obj;
  return std::nullopt;
}

}  // namespace asdfvk
