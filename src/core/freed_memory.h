#pragma once

#include <cstdlib>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace asdfvk {

/// Gives back to the system what was freed and is still held for the next allocation. To be called where much has been
/// freed in small pieces, which libraries do, and what comes needs large ones. Without glibc it does nothing.
inline void returnFreedMemory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace asdfvk
