#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "batch/input_list.h"

namespace asdfvk {

/// One of `count` parts of a batch.
struct Shard {
  uint32_t index = 1;  ///< 1 to count.
  uint32_t count = 1;
};

inline constexpr uint32_t kMaxShardCount = 1'000'000;

/// "2/7". Throws Error{OptionOutOfRange}.
[[nodiscard]] Shard parseShard(const std::string& text);

/// The inputs of the shard, in the same order. Every input is in exactly one shard, and the sizes of the shards are
/// balanced: from the largest file to the smallest, each goes to the shard with the least bytes so far. Depends on the
/// paths and sizes only.
[[nodiscard]] std::vector<InputFile> selectShard(const std::vector<InputFile>& inputs, const Shard& shard);

}  // namespace asdfvk
