#include "io/formats.h"

#include <algorithm>

#include "core/text.h"

namespace asdfvk {
// Each format is defined in src/io/NAME_*.cpp.
extern const FileFormat kStlFormat, kPlyFormat, kOffFormat, kObjFormat, kGlbFormat, k3mfFormat, kVtuFormat, kNpyFormat,
    kNpzFormat, kCsvFormat;

namespace {

// STL first: the exact size of a binary STL is stronger evidence than the first word of the other formats.
constexpr std::array<const FileFormat*, 10> kFormats{&kStlFormat, &kPlyFormat, &kOffFormat, &kObjFormat, &kGlbFormat,
                                                     &k3mfFormat, &kVtuFormat, &kNpyFormat, &kNpzFormat, &kCsvFormat};

}  // namespace

std::span<const FileFormat* const> fileFormats() { return kFormats; }

const FileFormat* formatOfExtension(std::string_view extension) {
  if (extension.starts_with('.')) extension.remove_prefix(1);
  if (extension.empty()) return nullptr;
  const std::string lower = lowerCase(extension);
  for (const FileFormat* const format : kFormats)
    if (std::find(format->extensions.begin(), format->extensions.end(), lower) != format->extensions.end())
      return format;
  return nullptr;
}

const FileFormat* detectFormat(std::span<const char> bytes, std::string_view extension) {
  const FileFormat* possible = nullptr;
  for (const FileFormat* const format : kFormats) {
    if (format->detect == nullptr) continue;
    const Match match = format->detect(bytes);
    if (match == Match::Certain) return format;
    if (match == Match::Possible && possible == nullptr) possible = format;
  }
  const FileFormat* const named = formatOfExtension(extension);
  return named != nullptr ? named : possible;
}

}  // namespace asdfvk
