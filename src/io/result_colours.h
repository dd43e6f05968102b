#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/colour_map.h"
#include "io/stored_fields.h"

namespace asdfvk {

/// The colour of a part: one of twelve, for later parts darker ones of them. Grey without a part (4294967295).
[[nodiscard]] Rgba colourOfPart(uint32_t part);
/// "part 3", "no part".
[[nodiscard]] std::string nameOfPart(uint32_t part);

/// The colour of each entry of a field of one component: real numbers by the colour map over percentileRange(), labels
/// by colourOfPart(), flags blue where they are set.
[[nodiscard]] std::vector<Rgba> coloursOf(const Field& field);

/// A colour per vertex, as coloursOf(). Of a field per face, a vertex has the mean value of its faces, or the least
/// label of them.
[[nodiscard]] std::vector<Rgba> vertexColoursOf(const ResultView& result, const Field& field);

/// A colour of a screen (sRGB) as a share of light, 0 to 1 (IEC 61966-2-1).
[[nodiscard]] std::array<double, 3> linearColour(const Rgba& colour);

}  // namespace asdfvk
