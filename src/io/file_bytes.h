#pragma once

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>

namespace asdfvk {

/// A whole file in memory. Not mapped: a file that shrinks while it is mapped ends the process.
class FileBytes {
 public:
  /// "-" is standard input. Pipes are read to their end. Throws Error{UnreadableInput} with the reason of the system.
  [[nodiscard]] static FileBytes read(const std::filesystem::path& path);

  [[nodiscard]] std::span<const char> bytes() const { return {data_.get(), size_}; }

 private:
  struct Free {
    void operator()(char* data) const { std::free(data); }
  };

  void grow(size_t capacity);
  void readAll(int descriptor);

  std::unique_ptr<char, Free> data_;  ///< From malloc: realloc grows it in place where possible, and does not clear it.
  size_t size_ = 0;
  size_t capacity_ = 0;
};

}  // namespace asdfvk
