// The precompiled header of every layer that includes core: the most frequent headers. Files still include the headers
// that they use, so that the build also works with CMAKE_DISABLE_PRECOMPILE_HEADERS.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/mesh.h"
#include "asdf_vk/run_control.h"
#include "core/check.h"
#include "core/vec3.h"
