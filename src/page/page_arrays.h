#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace asdfvk {

class AtomicFile;

using Bytes = std::vector<uint8_t>;

/// Bytes in the format of zlib (RFC 1950). Throws std::bad_alloc.
[[nodiscard]] Bytes deflated(const Bytes& bytes);

/// The numbered arrays of a page, compressed. Equal arrays have one number.
class PageArrays {
 public:
  using Source = std::function<std::vector<int32_t>()>;

  /// Makes the numbers of new arrays and compresses them, in parallel; returns the numbers of the arrays. Put the
  /// longest sources first: they take longest.
  [[nodiscard]] std::vector<uint32_t> add(std::span<const Source> sources);

  /// Writes one element of HTML per array, with the array as base64.
  void write(AtomicFile& file) const;

 private:
  std::vector<Bytes> arrays_;
};

}  // namespace asdfvk
