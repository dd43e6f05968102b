#include "io/formats.h"

#include <algorithm>

#include "core/text.h"

namespace asdfvk {
namespace {

// STL first: the exact size of a binary STL is stronger evidence than the first word of the other formats.
constexpr auto kFormats = std::to_array<FileFormat>({
    {"stl", {"stl", "stla", "stlb"}, detectStl, parseStl},
    {"ply", {"ply"}, detectPly, parsePly},
    {"off", {"off", "coff", "noff"}, detectOff, parseOff},
    {"obj", {"obj"}, detectObj, parseObj},
});

}  // namespace

std::span<const FileFormat> fileFormats() { return kFormats; }

const FileFormat* formatOfExtension(std::string_view extension) {
  if (extension.starts_with('.')) extension.remove_prefix(1);
  if (extension.empty()) return nullptr;
  const std::string lower = lowerCase(extension);
  for (const FileFormat& format : kFormats)
    if (std::find(format.extensions.begin(), format.extensions.end(), lower) != format.extensions.end()) return &format;
  return nullptr;
}

const FileFormat* detectFormat(std::span<const char> bytes, std::string_view extension) {
  const FileFormat* possible = nullptr;
  for (const FileFormat& format : kFormats) {
    const Match match = format.detect(bytes);
    if (match == Match::Certain) return &format;
    if (match == Match::Possible && possible == nullptr) possible = &format;
  }
  const FileFormat* const named = formatOfExtension(extension);
  return named != nullptr ? named : possible;
}

std::string meshFormatNames() {
  std::string names;
  const FileFormat* last = nullptr;
  for (const FileFormat& format : kFormats)
    if (format.parseMesh != nullptr) last = &format;
  for (const FileFormat& format : kFormats) {
    if (format.parseMesh == nullptr) continue;
    if (!names.empty()) names += &format == last ? " or " : ", ";
    names += format.name;
  }
  return names;
}

}  // namespace asdfvk
