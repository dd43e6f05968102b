#pragma once

namespace asdfvk {

/// Fetches memory into the cache. The assembly statement counts as a side effect. Without a side effect, GCC removes
/// calls of a function that only prefetches.
inline void prefetchMemory(const void* place) {
  __builtin_prefetch(place);
  __asm__ volatile("");
}

}  // namespace asdfvk
