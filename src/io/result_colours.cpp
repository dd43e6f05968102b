#include "io/result_colours.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/parallel.h"

namespace asdfvk {
namespace {

constexpr uint32_t kNoPart = std::numeric_limits<uint32_t>::max();

/// The colours of parts. The page has the same colours (src/page/browser/colour_maps.js).
constexpr std::array<Rgba, 12> kPartColours{{{78, 121, 167, 255},
                                             {242, 142, 43, 255},
                                             {89, 161, 79, 255},
                                             {225, 87, 89, 255},
                                             {118, 183, 178, 255},
                                             {237, 201, 72, 255},
                                             {176, 122, 161, 255},
                                             {156, 117, 95, 255},
                                             {255, 157, 167, 255},
                                             {140, 209, 125, 255},
                                             {160, 203, 232, 255},
                                             {121, 112, 110, 255}}};
constexpr Rgba kUnsetColour{210, 209, 204, 255}, kSetColour{31, 85, 160, 255};

Field onVertices(const ResultView& result, const Field& field) {
  Field moved{.name = field.name, .location = FieldLocation::PerVertex};
  std::visit(
      [&]<typename Entries>(const Entries& entries) {
        using T = typename Entries::value_type;
        if constexpr (std::is_same_v<T, double>) {
          std::vector<double> sums(result.vertexCount(), 0), counts(result.vertexCount(), 0);
          for (uint64_t face = 0; face < result.faceCount(); ++face)
            for (const uint32_t corner : result.cornersOf(face)) {
              if (std::isnan(entries[face])) continue;
              sums[corner] += entries[face];
              counts[corner] += 1;
            }
          for (size_t v = 0; v < sums.size(); ++v) sums[v] /= counts[v];  // NaN for a vertex whose faces have no value.
          moved.values = std::move(sums);
        } else {
          constexpr bool kIsFlag = std::is_same_v<T, uint8_t>;
          Entries labels(result.vertexCount(), kIsFlag ? T{0} : std::numeric_limits<T>::max());
          for (uint64_t face = 0; face < result.faceCount(); ++face)
            for (const uint32_t corner : result.cornersOf(face))
              labels[corner] =
                  kIsFlag ? std::max(labels[corner], entries[face]) : std::min(labels[corner], entries[face]);
          moved.values = std::move(labels);
        }
      },
      field.values);
  return moved;
}

}  // namespace

Rgba colourOfPart(uint32_t part) {
  if (part == kNoPart) return kNoValueColour;
  Rgba colour = kPartColours[part % kPartColours.size()];
  const double light = std::pow(0.75, part / kPartColours.size() % 4);
  for (size_t channel = 0; channel < 3; ++channel)
    colour[channel] = static_cast<uint8_t>(std::lround(light * colour[channel]));
  return colour;
}

std::string nameOfPart(uint32_t part) { return part == kNoPart ? "no part" : fmt::format("part {}", part); }

std::vector<Rgba> coloursOf(const Field& field) {
  std::vector<Rgba> colours(field.size());
  const ColourRange range = field.reals() != nullptr ? percentileRange(*field.reals()) : ColourRange{};
  std::visit(
      [&]<typename Entries>(const Entries& entries) {
        using T = typename Entries::value_type;
        forEachInParallel(colours.size(), [&](uint32_t i) {
          if constexpr (std::is_same_v<T, double>)
            colours[i] = colourOf(entries[i], range);
          else if constexpr (std::is_same_v<T, uint8_t>)
            colours[i] = entries[i] != 0 ? kSetColour : kUnsetColour;
          else
            colours[i] = colourOfPart(entries[i]);
        });
      },
      field.values);
  return colours;
}

std::vector<Rgba> vertexColoursOf(const ResultView& result, const Field& field) {
  return field.location == FieldLocation::PerVertex ? coloursOf(field) : coloursOf(onVertices(result, field));
}

std::array<double, 3> linearColour(const Rgba& colour) {
  static const std::array<double, 256> kLinear = [] {
    std::array<double, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
      const double share = static_cast<double>(i) / 255;
      table[i] = share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    }
    return table;
  }();
  return {kLinear[colour[0]], kLinear[colour[1]], kLinear[colour[2]]};
}

}  // namespace asdfvk
