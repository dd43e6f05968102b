#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "generate/analytic_shapes.h"
#include "generate/creatures.h"
#include "generate/generated_shape.h"

namespace asdfvk {

[[nodiscard]] std::vector<std::string_view> shapeNames();

/// A shape with its default parameters and about `faceCount` faces. Its bits do not depend on the number of threads.
/// Throws Error{Usage} for an unknown name and for a count outside kMinFaceCount .. kMaxFaceCount.
[[nodiscard]] GeneratedShape generateShape(std::string_view name, uint64_t faceCount);

}  // namespace asdfvk
