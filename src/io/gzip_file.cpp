#include "io/gzip_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "io/formats.h"
#include "io/inflater.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

constexpr size_t kMinGzipSize = 18;  // A member of no bytes: 10 bytes of header, 2 of data and 8 of checksum and size.

/// Reads one member after the other.
class GzipReader {
 public:
  explicit GzipReader(std::span<const char> bytes) : inflater_(MAX_WBITS + kGzipHeader), rest_(bytes) {}

  /// Reads up to `size` bytes; fewer only at the end of the file.
  size_t read(char* to, size_t size) {
    size_t count = 0;
    while (count < size && beginMember()) {
      count += inflater_.inflatePiece(rest_, to + count, size - count);
      const int result = inflater_.result();
      isInMember_ = result != Z_STREAM_END;
      if (result == Z_BUF_ERROR) failInput("is compressed by gzip and truncated; copy or download it again");
      if (result != Z_OK && result != Z_STREAM_END) endDamagedMember();
    }
    return count;
  }

 private:
  static constexpr int kGzipHeader = 16;  // Makes zlib expect the header of gzip.

  /// Returns false at the end of the file.
  bool beginMember() {
    if (isInMember_) return true;
    if (hasMember_ && std::all_of(rest_.begin(), rest_.end(), [](char c) { return c == '\0'; })) return false;
    if (!isGzip(rest_))
      failInput(
          fmt::format("is compressed by gzip and continues with {} after its end", counted(rest_.size(), "byte")));
    inflater_.reset();
    isInMember_ = hasMember_ = true;
    return true;
  }

  void endDamagedMember() {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION  // A fuzzer cannot guess checksums.
    if (inflater_.message().ends_with("check")) {
      rest_ = {};
      isInMember_ = false;
      return;
    }
#endif
    failInput("is compressed by gzip and damaged; copy or download it again");
  }

  Inflater inflater_;
  std::span<const char> rest_;
  bool isInMember_ = false, hasMember_ = false;
};

/// The size of the last member by the end of the file, or four times the packed size: a first capacity.
uint64_t expectedSize(std::span<const char> bytes) {
  uint32_t size = 0;
  std::memcpy(&size, bytes.data() + bytes.size() - sizeof size, sizeof size);
  constexpr uint64_t kGreatestRatio = 1032;  // The limit of deflate.
  return size > bytes.size() / 2 && size < kGreatestRatio * bytes.size() ? size : 4 * uint64_t{bytes.size()};
}

}  // namespace

bool isGzip(std::span<const char> bytes) {
  return bytes.size() >= kMinGzipSize && std::string_view(bytes.data(), bytes.size()).starts_with("\x1f\x8b\x08");
}

uint64_t maxUnpackedSize(uint64_t packedSize) {
  constexpr uint64_t kMinLimit = uint64_t{1} << 30;
  return std::max(kMinLimit, kMaxUnpackRatio * packedSize);
}

UnsetVector<char> unpackGzip(std::span<const char> bytes) {
  const uint64_t limit = maxUnpackedSize(bytes.size());
  GzipReader reader(bytes);
  // One byte more than expected, so that the read that detects the end needs no larger buffer.
  UnsetVector<char> unpacked(std::min(expectedSize(bytes), limit) + 1);
  for (size_t size = 0;;) {
    size += reader.read(unpacked.data() + size, unpacked.size() - size);
    if (size > limit)
      throw Error(
          ErrorCode::InputTooLarge,
          fmt::format("is compressed by gzip; its content exceeds the limit of {} MiB; unpack it first", limit >> 20));
    if (size < unpacked.size()) {
      unpacked.resize(size);
      return unpacked;
    }
    unpacked.resize(std::min(2 * uint64_t{size}, limit + 1));
  }
}

}  // namespace asdfvk
