#pragma once

// Marks the public functions of a shared library as visible. The library hides all other symbols.
#if defined(_WIN32)
#define ASDFVK_API
#else
#define ASDFVK_API __attribute__((visibility("default")))
#endif
