// Compiled once, before the files of every layer that includes core: the standard headers that most of them include,
// and fmt. It replaces no #include; CMAKE_DISABLE_PRECOMPILE_HEADERS builds without it.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
