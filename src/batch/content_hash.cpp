#include "batch/content_hash.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <fstream>
#include <new>
#include <vector>

namespace asdfvk {
namespace {

std::string textOf(const XXH128_hash_t& hash) { return fmt::format("{:016x}{:016x}", hash.high64, hash.low64); }

}  // namespace

std::string contentHash(std::span<const char> bytes) { return textOf(XXH3_128bits(bytes.data(), bytes.size())); }

ContentHash::ContentHash() : state_(XXH3_createState()) {
  if (state_ == nullptr) throw std::bad_alloc();
  XXH3_128bits_reset(state_);
}
ContentHash::~ContentHash() { XXH3_freeState(state_); }
void ContentHash::add(std::span<const char> bytes) { XXH3_128bits_update(state_, bytes.data(), bytes.size()); }
std::string ContentHash::text() const { return textOf(XXH3_128bits_digest(state_)); }

std::optional<std::string> contentHashOf(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;  // Opening a FIFO would wait for a writer.
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  ContentHash hash;
  std::vector<char> piece(size_t{1} << 18);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())), in.gcount() > 0)
    hash.add({piece.data(), static_cast<size_t>(in.gcount())});
  if (in.bad()) return std::nullopt;
  return hash.text();
}

}  // namespace asdfvk
