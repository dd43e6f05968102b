#include "batch/shard.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <numeric>
#include <queue>
#include <string_view>
#include <utility>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

bool parseCount(std::string_view text, uint32_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

Shard parseShard(const std::string& text) {
  Shard shard;
  const size_t slash = text.find('/');
  const std::string_view view = text;
  if (slash == std::string::npos || !parseCount(view.substr(0, slash), shard.index) ||
      !parseCount(view.substr(slash + 1), shard.count) || shard.index < 1 || shard.index > shard.count ||
      shard.count > kMaxShardCount)
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("'{}' is not I/N with I from 1 to N, such as 2/7, and N at most {}", text, kMaxShardCount));
  return shard;
}

std::vector<size_t> selectShard(const std::vector<InputFile>& inputs, const Shard& shard) {
  std::vector<size_t> bySize(inputs.size());
  std::iota(bySize.begin(), bySize.end(), size_t{0});
  std::sort(bySize.begin(), bySize.end(), [&](size_t a, size_t b) {
    if (inputs[a].byteCount != inputs[b].byteCount) return inputs[a].byteCount > inputs[b].byteCount;
    return inputs[a].path < inputs[b].path;
  });
  using Load = std::pair<uint64_t, uint32_t>;  // Bytes, shard: of equal loads the first shard is the next.
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (uint32_t index = 1; index <= shard.count; ++index) loads.emplace(0, index);
  std::vector<size_t> chosen;
  for (const size_t i : bySize) {
    const auto [bytes, index] = loads.top();
    loads.pop();
    loads.emplace(bytes + inputs[i].byteCount + kBytesPerMesh, index);
    if (index == shard.index) chosen.push_back(i);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace asdfvk
