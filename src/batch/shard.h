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

/// The indices of the inputs of the shard, ascending. Every input is in exactly one shard. The inputs are assigned from
/// the largest file to the smallest, each to the shard with the fewest bytes so far, so that the shards have about the
/// same size; kBytesPerMesh is added to each file. The result depends on the paths and sizes only.
[[nodiscard]] std::vector<size_t> selectShard(const std::vector<InputFile>& inputs, const Shard& shard);

}  // namespace asdfvk
