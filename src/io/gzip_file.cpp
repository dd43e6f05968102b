#include "io/gzip_file.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string_view>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "io/formats.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

constexpr size_t kMinGzipSize = 18;  // A member of no bytes: 10 bytes of header, 2 of data and 8 of checksum and size.

/// Inflates one member after the other.
class GzipInflater {
 public:
  explicit GzipInflater(std::span<const char> bytes) : rest_(bytes) {
    constexpr int kGzipHeader = 16;
    if (inflateInit2(&stream_, MAX_WBITS + kGzipHeader) != Z_OK) throw std::bad_alloc();
  }
  ~GzipInflater() { inflateEnd(&stream_); }
  GzipInflater(const GzipInflater&) = delete;
  GzipInflater& operator=(const GzipInflater&) = delete;

  /// Reads up to `size` bytes; fewer only at the end of the file.
  size_t read(char* to, size_t size) {
    size_t count = 0;
    while (count < size && beginMember()) {
      constexpr size_t kMaxStep = size_t{1} << 30;  // zlib counts in 32 bits.
      const size_t given = std::min(rest_.size(), kMaxStep), wanted = std::min(size - count, kMaxStep);
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));
      stream_.avail_in = static_cast<uInt>(given);
      stream_.next_out = reinterpret_cast<Bytef*>(to + count);
      stream_.avail_out = static_cast<uInt>(wanted);
      const int result = inflate(&stream_, Z_NO_FLUSH);
      rest_ = rest_.subspan(given - stream_.avail_in);
      count += wanted - stream_.avail_out;
      isInMember_ = result != Z_STREAM_END;
      if (result == Z_MEM_ERROR) throw std::bad_alloc();
      if (result == Z_BUF_ERROR) failInput("is compressed by gzip and truncated");
      if (result != Z_OK && result != Z_STREAM_END) endDamagedMember();
    }
    return count;
  }

 private:
  /// Returns false at the end of the file.
  bool beginMember() {
    if (isInMember_) return true;
    if (hasMember_ && std::all_of(rest_.begin(), rest_.end(), [](char c) { return c == '\0'; })) return false;
    if (!isGzip(rest_))
      failInput(
          fmt::format("is compressed by gzip and continues with {} after its end", counted(rest_.size(), "byte")));
    inflateReset(&stream_);
    isInMember_ = hasMember_ = true;
    return true;
  }

  void endDamagedMember() {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION  // A fuzzer cannot guess checksums.
    if (stream_.msg != nullptr && std::string_view(stream_.msg).ends_with("check")) {
      rest_ = {};
      isInMember_ = false;
      return;
    }
#endif
    failInput("is compressed by gzip and damaged; copy or download it again");
  }

  z_stream stream_{};
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
  GzipInflater inflater(bytes);
  // One byte more than expected, so that the read that detects the end needs no larger buffer.
  UnsetVector<char> unpacked(std::min(expectedSize(bytes), limit) + 1);
  for (size_t size = 0;;) {
    size += inflater.read(unpacked.data() + size, unpacked.size() - size);
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
