#pragma once

#include <algorithm>
#include <cstddef>

#include "asdf_vk/run_control.h"
#include "core/parallel.h"

namespace asdfvk {

/// Calls body(x, y) for every pixel: in bands of rows, with a checkpoint of `control` before each band, in parallel
/// over the tiles of a band.
template <typename Body>
void forEachPixel(int width, int height, const RunControl& control, const Body& body) {
  constexpr int kTileSide = 16;
  for (int top = 0; top < height; top += kTileSide) {
    control.checkpoint(static_cast<double>(top) / height);
    const int bottom = std::min(top + kTileSide, height);
    forEachRange(static_cast<size_t>(width), kTileSide, [&](size_t left, size_t right) {
      for (int y = top; y < bottom; ++y)
        for (auto x = static_cast<int>(left); x < static_cast<int>(right); ++x) body(x, y);
    });
  }
}

}  // namespace asdfvk
