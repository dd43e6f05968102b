#pragma once

#include <zlib.h>

#include <cstddef>
#include <span>
#include <string_view>

namespace asdfvk {

/// Inflates data of deflate piece by piece, by zlib.
class Inflater {
 public:
  /// windowBits: see inflateInit2() of zlib. Throws std::bad_alloc.
  explicit Inflater(int windowBits);
  ~Inflater();
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Inflates a piece of `from` into at most `size` bytes at `to`. Removes the bytes that were used from `from`.
  /// Returns the number of bytes that were written. Throws std::bad_alloc.
  [[nodiscard]] size_t inflatePiece(std::span<const char>& from, char* to, size_t size);
  /// The result of inflate() for the last piece: Z_OK, Z_STREAM_END, or an error.
  [[nodiscard]] int result() const { return result_; }
  /// The message of zlib for an error; may be empty.
  [[nodiscard]] std::string_view message() const { return stream_.msg == nullptr ? "" : stream_.msg; }
  void reset() { inflateReset(&stream_); }

 private:
  z_stream stream_{};
  int result_ = Z_OK;
};

}  // namespace asdfvk
