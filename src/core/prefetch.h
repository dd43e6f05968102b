#pragma once

namespace asdfvk {

/// Fetches memory into the cache. GCC would remove the calls of a function that only prefetches, because such a
/// function has no effect; the assembly statement is an effect.
inline void prefetchMemory(const void* place) {
  __builtin_prefetch(place);
  __asm__ volatile("");
}

}  // namespace asdfvk
