#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace asdfvk {

class AtomicFile;

using Bytes = std::vector<uint8_t>;

/// Compresses bytes to the zlib format (RFC 1950). Throws std::bad_alloc.
[[nodiscard]] Bytes deflated(const Bytes& bytes);

/// The compressed, numbered arrays of a page. Equal arrays are stored once and have the same number.
class PageArrays {
 public:
  using Source = std::function<std::vector<int32_t>()>;

  /// Calls the sources and compresses their arrays, in parallel. Returns the number of each array. Long arrays should
  /// come first, because their compression takes the longest time.
  [[nodiscard]] std::vector<uint32_t> add(std::span<const Source> sources);

  /// Writes one HTML element per array, with the bytes in base64.
  void write(AtomicFile& file) const;

  [[nodiscard]] std::span<const Bytes> all() const { return arrays_; }

 private:
  std::vector<Bytes> arrays_;
};

}  // namespace asdfvk
