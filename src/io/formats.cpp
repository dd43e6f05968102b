#include "io/formats.h"

#include <algorithm>
#include <vector>

#include "core/text.h"

namespace asdfvk {
namespace {

// STL first: the exact size of a binary STL is stronger evidence than the first word of the other formats.
constexpr auto kFormats = std::to_array<FileFormat>({
    // name, extensions, detect, parseMesh, parseFields, write
    {"stl", {"stl", "stla", "stlb"}, detectStl, parseStl, nullptr, nullptr},
    {"ply", {"ply"}, detectPly, parsePly, parsePlyFields, writePly},
    {"off", {"off", "coff", "noff"}, detectOff, parseOff, nullptr, nullptr},
    {"obj", {"obj"}, detectObj, parseObj, nullptr, nullptr},
    {"vtu", {"vtu"}, detectVtu, nullptr, parseVtuFields, writeVtu},
    {"npy", {"npy"}, detectNpy, nullptr, parseNpyFields, writeNpy},
    {"npz", {"npz"}, detectNpz, nullptr, parseNpzFields, writeNpz},
    {"csv", {"csv"}, detectCsv, nullptr, parseCsvFields, writeCsv},
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

std::string namesOfFormatsWith(bool (*hasOperation)(const FileFormat& format)) {
  std::vector<std::string_view> names;
  for (const FileFormat& format : kFormats)
    if (hasOperation(format)) names.push_back(format.name);
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace asdfvk
