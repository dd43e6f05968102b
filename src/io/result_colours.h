#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/colour_map.h"
#include "io/result_view.h"

namespace asdfvk {

/// The colour of a part. The first twelve parts have different colours; later parts have darker shades of these
/// colours. No part (4294967295) is grey.
[[nodiscard]] Rgba colourOfPart(uint32_t part);
/// The name of a part, for example "part 3"; "no part" for 4294967295.
[[nodiscard]] std::string nameOfPart(uint32_t part);

/// The colour of each entry of a field of one component. The colour of a real number is that of the colour map over
/// percentileRange(); the colour of a label is colourOfPart(); a set flag is blue.
[[nodiscard]] std::vector<Rgba> coloursOf(const Field& field);

/// coloursOf() per vertex. If the field is per face, a vertex gets the mean value or the least label of its faces.
[[nodiscard]] std::vector<Rgba> vertexColoursOf(const ResultView& result, const Field& field);

/// The linear light of a screen colour (sRGB, IEC 61966-2-1); 0 to 1 for each channel.
[[nodiscard]] std::array<double, 3> linearColour(const Rgba& colour);

}  // namespace asdfvk
