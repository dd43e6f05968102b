#include "io/zip_archive.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include "core/text.h"
#include "io/inflater.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

static_assert(std::endian::native == std::endian::little, "ZIP is read by copying its bytes");

constexpr uint32_t kLocalHeader = 0x04034b50, kDirectoryHeader = 0x02014b50, kDirectoryEnd = 0x06054b50;
constexpr uint32_t kWideDirectoryEnd = 0x06064b50, kWideLocator = 0x07064b50;
constexpr size_t kLocalHeaderSize = 30, kDirectoryHeaderSize = 46, kDirectoryEndSize = 22;
constexpr size_t kWideDirectoryEndSize = 56, kWideLocatorSize = 20;
constexpr uint16_t kStored = 0, kDeflated = 8;
constexpr uint16_t kIsEncrypted = 1;
constexpr uint32_t kIsWide = std::numeric_limits<uint32_t>::max();

[[noreturn]] void failDamagedZip() {
  failInput("ZIP archive is damaged: a number points beyond its end; copy or export it again");
}

template <typename T>
T zipNumber(std::span<const char> bytes, uint64_t at) {
  if (at > bytes.size() || sizeof(T) > bytes.size() - at) failDamagedZip();
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::span<const char> zipPart(std::span<const char> bytes, uint64_t at, uint64_t size) {
  if (at > bytes.size() || size > bytes.size() - at) failDamagedZip();
  return bytes.subspan(at, size);
}

/// The offset of the last end-of-directory record whose comment ends at the end of the file. If there is none, the last
/// record that other bytes follow.
uint64_t findDirectoryEnd(std::span<const char> bytes) {
  constexpr size_t kMaxRest = std::numeric_limits<uint16_t>::max();
  std::optional<uint64_t> last;
  for (size_t rest = 0; rest <= kMaxRest && rest + kDirectoryEndSize <= bytes.size(); ++rest) {
    const uint64_t at = bytes.size() - kDirectoryEndSize - rest;
    if (zipNumber<uint32_t>(bytes, at) != kDirectoryEnd) continue;
    const auto comment = zipNumber<uint16_t>(bytes, at + 20);
    if (comment == rest) return at;
    if (comment < rest && !last) last = at;
  }
  if (last) return *last;
  failInput("ZIP archive is truncated: it has no directory at its end; copy or export it again");
}

struct ZipDirectory {
  uint64_t count = 0, size = 0, offset = 0;
  uint64_t trailingByteCount = 0;
};

ZipDirectory findDirectory(std::span<const char> bytes) {
  const uint64_t end = findDirectoryEnd(bytes);
  const uint64_t trailing = bytes.size() - end - kDirectoryEndSize - zipNumber<uint16_t>(bytes, end + 20);
  if (end >= kWideLocatorSize && zipNumber<uint32_t>(bytes, end - kWideLocatorSize) == kWideLocator) {
    const auto at = zipNumber<uint64_t>(bytes, end - kWideLocatorSize + 8);
    const std::span<const char> wide = zipPart(bytes, at, kWideDirectoryEndSize);
    if (zipNumber<uint32_t>(wide, 0) != kWideDirectoryEnd) failInput("ZIP archive has a wrong offset of its directory");
    return {zipNumber<uint64_t>(wide, 32), zipNumber<uint64_t>(wide, 40), zipNumber<uint64_t>(wide, 48), trailing};
  }
  return {zipNumber<uint16_t>(bytes, end + 10), zipNumber<uint32_t>(bytes, end + 12),
          zipNumber<uint32_t>(bytes, end + 16), trailing};
}

/// Replaces numbers that do not fit into 32 bits by the numbers of the ZIP64 extra field.
void readWideNumbers(std::span<const char> extra, ZipEntry& entry) {
  while (extra.size() >= 4) {
    const auto id = zipNumber<uint16_t>(extra, 0), size = zipNumber<uint16_t>(extra, 2);
    const std::span<const char> field = zipPart(extra, 4, size);
    if (id == 1) {
      uint64_t at = 0;
      for (uint64_t* const number : {&entry.size, &entry.storedSize, &entry.headerOffset})
        if (*number == kIsWide) {
          *number = zipNumber<uint64_t>(field, at);
          at += sizeof(uint64_t);
        }
    }
    extra = extra.subspan(size_t{4} + size);
  }
}

std::string zipName(const ZipEntry& entry) { return asdfvk::quoted(entry.name); }

/// Files that share bytes would let a small archive contain any amount of data.
void requireDisjoint(std::span<const ZipEntry> entries, uint64_t directoryOffset) {
  std::vector<const ZipEntry*> byOffset;
  byOffset.reserve(entries.size());
  for (const ZipEntry& entry : entries) byOffset.push_back(&entry);
  std::sort(byOffset.begin(), byOffset.end(),
            [](const ZipEntry* a, const ZipEntry* b) { return a->headerOffset < b->headerOffset; });
  for (size_t i = 0; i < byOffset.size(); ++i) {
    const ZipEntry& entry = *byOffset[i];
    const uint64_t end = i + 1 < byOffset.size() ? byOffset[i + 1]->headerOffset : directoryOffset;
    const uint64_t used = kLocalHeaderSize + entry.name.size();
    if (end < entry.headerOffset || end - entry.headerOffset < used ||
        end - entry.headerOffset - used < entry.storedSize)
      failInput(fmt::format("ZIP archive: {} overlaps other content", zipName(entry)));
  }
}

}  // namespace

std::string partName(std::string_view name) {
  if (name.starts_with('/') || name.starts_with('\\')) name.remove_prefix(1);
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  return lowerCase(percentDecoded(path));
}

ZipArchive::ZipArchive(std::span<const char> bytes) : bytes_(bytes) {
  const ZipDirectory directory = findDirectory(bytes);
  trailingByteCount_ = directory.trailingByteCount;
  std::span<const char> rest = zipPart(bytes, directory.offset, directory.size);
  if (directory.count > rest.size() / kDirectoryHeaderSize)
    failInput(fmt::format("ZIP archive: its directory is too small for {}", counted(directory.count, "file")));
  entries_.reserve(directory.count);
  for (uint64_t i = 0; i < directory.count; ++i) {
    if (zipNumber<uint32_t>(rest, 0) != kDirectoryHeader) failInput("ZIP archive: its directory is damaged");
    const auto nameLength = zipNumber<uint16_t>(rest, 28), extraLength = zipNumber<uint16_t>(rest, 30),
               commentLength = zipNumber<uint16_t>(rest, 32);
    const std::span<const char> name = zipPart(rest, kDirectoryHeaderSize, nameLength);
    ZipEntry entry{.name = {name.data(), name.size()},
                   .headerOffset = zipNumber<uint32_t>(rest, 42),
                   .storedSize = zipNumber<uint32_t>(rest, 20),
                   .size = zipNumber<uint32_t>(rest, 24),
                   .checksum = zipNumber<uint32_t>(rest, 16),
                   .method = zipNumber<uint16_t>(rest, 10)};
    if ((zipNumber<uint16_t>(rest, 8) & kIsEncrypted) != 0) entry.method = std::numeric_limits<uint16_t>::max();
    readWideNumbers(zipPart(rest, kDirectoryHeaderSize + nameLength, extraLength), entry);
    entries_.push_back(entry);
    const uint64_t size = uint64_t{kDirectoryHeaderSize} + nameLength + extraLength + commentLength;
    rest = rest.subspan(zipPart(rest, 0, size).size());
  }
  requireDisjoint(entries_, directory.offset);
  for (const ZipEntry& entry : entries_) ++entriesOf_.try_emplace(partName(entry.name), &entry, 0).first->second.second;
}

const ZipEntry* ZipArchive::find(std::string_view name) const {
  const auto found = entriesOf_.find(partName(name));
  if (found == entriesOf_.end()) return nullptr;
  const auto& [entry, count] = found->second;
  if (count > 1) failInput(fmt::format("ZIP archive: {} files have the name {}", count, zipName(*entry)));
  return entry;
}

ZipStream::ZipStream(const ZipArchive& archive, const ZipEntry& entry) : entry_(entry) {
  const std::span<const char> header = zipPart(archive.bytes(), entry.headerOffset, kLocalHeaderSize);
  if (zipNumber<uint32_t>(header, 0) != kLocalHeader)
    failInput(fmt::format("ZIP archive has a wrong offset of {}", zipName(entry)));
  const uint64_t begin = entry.headerOffset + kLocalHeaderSize + zipNumber<uint16_t>(header, 26) +
                         uint64_t{zipNumber<uint16_t>(header, 28)};
  stored_ = zipPart(archive.bytes(), begin, entry.storedSize);
  if (entry.method == kDeflated)
    inflater_ = std::make_unique<Inflater>(-MAX_WBITS);
  else if (entry.method != kStored)
    failInput(
        fmt::format("ZIP archive: {} is encrypted, or compressed by a method other than deflate", zipName(entry)));
}

ZipStream::~ZipStream() = default;

size_t ZipStream::read(char* to, size_t size) {
  size_t count = 0;
  if (!inflater_) {
    count = std::min(size, stored_.size());
    if (count > 0) std::memcpy(to, stored_.data(), count);
    stored_ = stored_.subspan(count);
  } else {
    while (count < size && inflater_->result() != Z_STREAM_END) {
      count += inflater_->inflatePiece(stored_, to + count, size - count);
      if (inflater_->result() != Z_OK && inflater_->result() != Z_STREAM_END)
        failInput(fmt::format("ZIP archive: {} is damaged", zipName(entry_)));
    }
  }
  checksum_ = static_cast<uint32_t>(crc32_z(checksum_, reinterpret_cast<const Bytef*>(to), count));
  doneSize_ += count;
  if (doneSize_ > entry_.size)
    failInput(fmt::format("ZIP archive: {} is larger than its directory entry says", zipName(entry_)));
  if (count < size) finish();
  return count;
}

void ZipStream::finish() {
  if (isFinished_) return;
  isFinished_ = true;
  bool isIntact = doneSize_ == entry_.size && stored_.empty();
#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION  // A fuzzer cannot guess checksums.
  isIntact = isIntact && checksum_ == entry_.checksum;
#endif
  if (!isIntact) failInput(fmt::format("ZIP archive: {} is damaged: its size or checksum differs", zipName(entry_)));
}

}  // namespace asdfvk
