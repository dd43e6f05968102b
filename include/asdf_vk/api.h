#pragma once

// Visibility of the public functions in a shared library; the library hides everything else.
#if defined(_WIN32)
#define ASDFVK_API
#else
#define ASDFVK_API __attribute__((visibility("default")))
#endif
