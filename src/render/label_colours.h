#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "render/image.h"

namespace asdfvk {

inline constexpr std::array<Rgb, 12> kLabelColours{{{78, 121, 167},
                                                    {242, 142, 43},
                                                    {89, 161, 79},
                                                    {225, 87, 89},
                                                    {118, 183, 178},
                                                    {237, 201, 72},
                                                    {176, 122, 161},
                                                    {156, 117, 95},
                                                    {255, 157, 167},
                                                    {140, 209, 125},
                                                    {160, 203, 232},
                                                    {121, 112, 110}}};

/// Colours of faces by label (both #F): labels that share an edge have different colours unless one of them has 12
/// neighbours of 12 colours. Greedy, labels of the largest area first; each gets the colour that its neighbours have
/// least, of those the one that is used least, of those the first. areas: #F.
[[nodiscard]] std::vector<Rgb> labelColours(const TriangleMesh& mesh, std::span<const double> areas,
                                            std::span<const uint32_t> labels);

}  // namespace asdfvk
