#include "batch/content_hash.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <fstream>
#include <memory>
#include <vector>

namespace asdfvk {
namespace {

std::string textOf(const XXH128_hash_t& hash) { return fmt::format("{:016x}{:016x}", hash.high64, hash.low64); }

}  // namespace

std::string contentHash(std::span<const char> bytes) { return textOf(XXH3_128bits(bytes.data(), bytes.size())); }

std::optional<std::string> contentHashOf(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;  // Opening a FIFO would wait for a writer.
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> piece(size_t{1} << 18);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())), in.gcount() > 0)
    XXH3_128bits_update(state.get(), piece.data(), static_cast<size_t>(in.gcount()));
  if (in.bad()) return std::nullopt;
  return textOf(XXH3_128bits_digest(state.get()));
}

}  // namespace asdfvk
