#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

namespace asdfvk {

class AtomicFile;

using Bytes = std::vector<uint8_t>;

/// Bytes in the format of zlib (RFC 1950). Throws std::bad_alloc.
[[nodiscard]] Bytes deflated(const Bytes& bytes);

/// The least significant bytes of all numbers, then the next ones, up to the most significant byte that is not 0.
[[nodiscard]] Bytes bytePlanesOf(std::span<const uint32_t> numbers);

/// A bit per entry, 1 where it is not 0, the first in the lowest bit of the first byte.
[[nodiscard]] Bytes bitsOf(std::span<const uint8_t> entries);

/// The numbered streams of a page, compressed. Streams with the same bytes have one number.
class PageStreams {
 public:
  /// Makes the bytes of new streams and compresses them, in parallel; returns their numbers. Put the longest
  /// sources first: they take longest.
  [[nodiscard]] std::vector<uint32_t> add(std::span<const std::function<Bytes()>> sources);

  /// Bytes of the streams, compressed, by number.
  [[nodiscard]] std::vector<size_t> sizes() const;

  /// Writes one element of HTML per stream, with the stream as base64.
  void write(AtomicFile& file) const;

 private:
  std::vector<Bytes> streams_;
  std::unordered_multimap<uint64_t, uint32_t> numbersByHash_;
};

}  // namespace asdfvk
