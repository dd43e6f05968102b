#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

struct XXH3_state_s;

namespace asdfvk {

/// Returns the 128-bit XXH3 hash of the bytes as 32 hexadecimal digits. The hash detects accidental changes only.
[[nodiscard]] std::string contentHash(std::span<const char> bytes);

/// contentHash() of bytes in several pieces.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(const ContentHash&) = delete;
  ContentHash& operator=(const ContentHash&) = delete;

  void add(std::span<const char> bytes);
  [[nodiscard]] std::string text() const;

 private:
  XXH3_state_s* state_;
};

/// Returns contentHash() of the bytes of a file. Unset if the file is not a regular file or cannot be read.
[[nodiscard]] std::optional<std::string> contentHashOf(const std::filesystem::path& path);

}  // namespace asdfvk
