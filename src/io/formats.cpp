#include "io/formats.h"

#include <fmt/core.h>

#include <algorithm>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "io/files_beside.h"

namespace asdfvk {
// Each format is defined in src/io/NAME_*.cpp.
extern const FileFormat kStlFormat, kPlyFormat, kOffFormat, kObjFormat, kGlbFormat, k3mfFormat, kStepFormat, kVtuFormat,
    kNpyFormat, kNpzFormat, kCsvFormat;

namespace {

// STL first: the exact size of a binary STL is stronger evidence than the first word of the other formats.
constexpr std::array<const FileFormat*, 11> kFormats{&kStlFormat, &kPlyFormat, &kOffFormat,  &kObjFormat,
                                                     &kGlbFormat, &k3mfFormat, &kStepFormat, &kVtuFormat,
                                                     &kNpyFormat, &kNpzFormat, &kCsvFormat};

const FileFormat* firstWith(Match match, std::span<const char> bytes) {
  const auto found = std::find_if(kFormats.begin(), kFormats.end(), [&](const FileFormat* format) {
    return format->detect != nullptr && format->detect(bytes) == match;
  });
  return found == kFormats.end() ? nullptr : *found;
}

}  // namespace

uint64_t MeshSource::sizeForLimits() const {
  const uint64_t own = packedSize == 0 ? bytes.size() : std::min<uint64_t>(bytes.size(), kMaxUnpackRatio * packedSize);
  return own + (beside == nullptr ? 0 : beside->byteCount());
}

uint64_t MeshSource::maxFaceCount() const {
  constexpr uint64_t kFacesPerByte = 100, kSmallestLimit = 100'000;
  return options.maxFaces != 0 ? options.maxFaces : limit(kSmallestLimit, kFacesPerByte);
}

void requireFaceCount(uint64_t faceCount, const MeshSource& source) {
  const uint64_t limit = source.maxFaceCount();
  if (faceCount <= limit) return;
  const std::string which =
      source.options.maxFaces != 0 ? "" : fmt::format(" for a file of {}", counted(source.sizeForLimits(), "byte"));
  throw Error(ErrorCode::TooManyFaces,
              fmt::format("has {}{}; the limit{} is {}", faceCount == kSaturatedCount ? "at least " : "",
                          counted(faceCount, "face"), which, groupDigits(limit)),
              {{"limit", std::to_string(limit)}});
}

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

std::filesystem::path unpackedName(const std::filesystem::path& name) {
  return lowerCase(name.extension().string()) == ".gz" ? name.parent_path() / name.stem() : name;
}

std::string meshExtension(const std::filesystem::path& name) { return unpackedName(name).extension().string(); }

const FileFormat* certainFormat(std::span<const char> bytes) { return firstWith(Match::Certain, bytes); }

const FileFormat* detectFormat(std::span<const char> bytes, std::string_view extension) {
  const FileFormat* const certain = certainFormat(bytes);
  return certain != nullptr ? certain : uncertainFormat(bytes, extension);
}

const FileFormat* uncertainFormat(std::span<const char> bytes, std::string_view extension) {
  const FileFormat* const named = formatOfExtension(extension);
  return named != nullptr ? named : firstWith(Match::Possible, bytes);
}

}  // namespace asdfvk
