#pragma once

#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

namespace asdfvk {

static_assert(std::endian::native == std::endian::little, "the binary formats are written as they lie in memory");

/// Appends bytes and numbers to a buffer. A derived class empties or enlarges the full buffer.
class ByteOutput {
 public:
  ByteOutput(const ByteOutput&) = delete;
  ByteOutput& operator=(const ByteOutput&) = delete;

  /// Greatest size that reserve() allows in every derived class.
  static constexpr size_t kMaxReserve = size_t{1} << 16;

  /// Returns memory for `size` bytes into which the caller writes. advance() appends the written bytes.
  [[nodiscard]] char* reserve(size_t size) {
    if (size > capacity_ - used_) makeRoom(size);
    return buffer_.get() + used_;
  }
  void advance(size_t size) { used_ += size; }

  void write(std::string_view bytes) {
    if (bytes.size() > kMaxReserve) return writeLong(bytes);
    std::memcpy(reserve(bytes.size()), bytes.data(), bytes.size());
    advance(bytes.size());
  }
  void write(const void* bytes, size_t size) { write({static_cast<const char*>(bytes), size}); }
  /// Appends the bytes of a number in little-endian order, the order of every supported machine.
  template <typename T>
  void put(const T& value) {
    std::memcpy(reserve(sizeof(T)), &value, sizeof(T));
    advance(sizeof(T));
  }
  /// Appends the shortest text that reads back as the same number, or "nan" for NaN of either sign.
  template <typename T>
  void putNumber(T number) {
    if constexpr (std::is_floating_point_v<T>)
      if (std::isnan(number)) return write("nan");
    constexpr size_t kMaxTextSize = 32;
    char* const begin = reserve(kMaxTextSize);
    advance(static_cast<size_t>(std::to_chars(begin, begin + kMaxTextSize, number).ptr - begin));
  }

 protected:
  explicit ByteOutput(size_t capacity)
      : buffer_(std::make_unique_for_overwrite<char[]>(capacity)), capacity_(capacity) {}
  ~ByteOutput() = default;

  /// The bytes in the buffer.
  [[nodiscard]] std::string_view written() const { return {buffer_.get(), used_}; }
  void clear() { used_ = 0; }
  /// Keeps the bytes in the buffer.
  void enlarge(size_t capacity) {
    std::unique_ptr<char[]> larger = std::make_unique_for_overwrite<char[]>(capacity);
    std::memcpy(larger.get(), buffer_.get(), used_);
    buffer_ = std::move(larger);
    capacity_ = capacity;
  }

 private:
  virtual void makeRoom(size_t size) = 0;
  /// Appends more than kMaxReserve bytes.
  virtual void writeLong(std::string_view bytes) = 0;

  std::unique_ptr<char[]> buffer_;
  size_t capacity_, used_ = 0;
};

/// All bytes stay in memory. reserve() allows any size.
class ByteBuffer final : public ByteOutput {
 public:
  ByteBuffer() : ByteOutput(kMaxReserve) {}
  using ByteOutput::clear, ByteOutput::written;

 private:
  void makeRoom(size_t size) override { enlarge(2 * (written().size() + size)); }
  void writeLong(std::string_view bytes) override {
    std::memcpy(reserve(bytes.size()), bytes.data(), bytes.size());
    advance(bytes.size());
  }
};

}  // namespace asdfvk
