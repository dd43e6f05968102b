#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "generate/analytic_shapes.h"
#include "generate/creatures.h"
#include "generate/generated_shape.h"

namespace asdfvk {

/// Names of the shapes.
[[nodiscard]] std::vector<std::string_view> shapeNames();

/// The shape of that name with its default parameters and about `faceCount` faces. It has the same bits on any number
/// of threads. Throws Error{Usage} for an unknown name and for a count outside kMinFaceCount .. kMaxFaceCount.
[[nodiscard]] GeneratedShape generateShape(std::string_view name, uint64_t faceCount);

}  // namespace asdfvk
