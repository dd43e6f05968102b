#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace asdfvk::test {

/// The ids of the specialization constants of a shader, in the order of their decorations.
inline std::vector<uint32_t> specializationIds(std::span<const uint32_t> spirv) {
  constexpr uint32_t kHeaderWordCount = 5, kOpDecorate = 71, kSpecId = 1;
  std::vector<uint32_t> ids;
  for (size_t i = kHeaderWordCount; i < spirv.size(); i += spirv[i] >> 16)
    if ((spirv[i] & 0xffff) == kOpDecorate && spirv[i + 2] == kSpecId) ids.push_back(spirv[i + 3]);
  return ids;
}

/// Whether a shader has specialization constants, each with an id of its own: Metal refuses others.
inline bool hasDistinctSpecializationIds(std::span<const uint32_t> spirv) {
  std::vector<uint32_t> ids = specializationIds(spirv);
  std::sort(ids.begin(), ids.end());
  return !ids.empty() && std::adjacent_find(ids.begin(), ids.end()) == ids.end();
}

}  // namespace asdfvk::test
