#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "asdf_vk/run_control.h"

namespace asdfvk {

/// Calls body(x, y) for every pixel: in bands of rows, with a checkpoint of `control` before each band, in parallel
/// over the tiles of a band.
template <typename Body>
void forEachPixel(int width, int height, const RunControl& control, const Body& body) {
  constexpr int kTileSide = 16;
  for (int top = 0; top < height; top += kTileSide) {
    control.checkpoint(static_cast<double>(top) / height);
    const int bottom = std::min(top + kTileSide, height);
    tbb::parallel_for(tbb::blocked_range<int>(0, width, kTileSide), [&](const tbb::blocked_range<int>& columns) {
      for (int y = top; y < bottom; ++y)
        for (int x = columns.begin(); x < columns.end(); ++x) body(x, y);
    });
  }
}

}  // namespace asdfvk
