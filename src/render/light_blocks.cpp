#include "render/light_blocks.h"

#include <array>
#include <cmath>
#include <utility>

namespace asdfvk {
namespace {

constexpr int kBlockSide = 16;                ///< In pixels, a power of two.
constexpr double kSmoothCosine = 0.98;        ///< Least cosine between the normals of a block.
constexpr double kSmoothDistance = 1.5;       ///< From the bilinear surface through the corners of a block, in pixels.
constexpr double kMaxLightError = 1.0 / 400;  ///< At the pixels that test a block; a grey level is 1/255.

/// Bilinear weights of the four corners of a block.
std::array<double, 4> cornerWeights(int x, int y, int last) {
  const double right = double(x) / last, low = double(y) / last;
  return {(1 - right) * (1 - low), right * (1 - low), (1 - right) * low, right * low};
}

}  // namespace

LightBlocks::LightBlocks(const SkyLight& light, int width, int height, double pixelSize)
    : light_(light),
      width_(width),
      height_(height),
      pixelSize_(pixelSize),
      points_(static_cast<size_t>(width) * static_cast<size_t>(height)),
      states_(points_.size(), State::Empty) {}

void LightBlocks::set(int x, int y, const LitPoint& point) {
  points_[indexOf(x, y)] = point;
  states_[indexOf(x, y)] = State::Dark;
}

void LightBlocks::fill() {
  for (int top = 0; top < height_; top += kBlockSide)
    for (int left = 0; left < width_; left += kBlockSide) fillBlock(left, top, kBlockSide);
}

double LightBlocks::lightAt(int x, int y) {
  const size_t index = indexOf(x, y);
  LitPoint& point = points_[index];
  if (states_[index] == State::Dark) {
    point.light = light_.at(point.position, point.normal);
    states_[index] = State::Lit;
  }
  return point.light;
}

void LightBlocks::fillBlock(int left, int top, int side) {
  if (left >= width_ || top >= height_) return;
  if (side == 1) {
    if (at(left, top) != nullptr) lightAt(left, top);
    return;
  }
  if (side > 2 && isSmooth(left, top, side) && interpolate(left, top, side)) return;
  const int half = side / 2;
  for (const int dy : {0, half})
    for (const int dx : {0, half}) fillBlock(left + dx, top + dy, half);
}

bool LightBlocks::isSmooth(int left, int top, int side) const {
  const int last = side - 1;
  if (left + last >= width_ || top + last >= height_) return false;
  std::array<const LitPoint*, 4> corners{at(left, top), at(left + last, top), at(left, top + last),
                                         at(left + last, top + last)};
  for (const LitPoint* const corner : corners)
    if (corner == nullptr) return false;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const LitPoint* const point = at(left + x, top + y);
      if (point == nullptr || dot(point->normal, corners[0]->normal) < kSmoothCosine) return false;
      const std::array<double, 4> weights = cornerWeights(x, y, last);
      Vec3d expected;
      for (size_t i = 0; i < 4; ++i) expected += corners[i]->position * weights[i];
      if (length(point->position - expected) > kSmoothDistance * pixelSize_) return false;
    }
  return true;
}

bool LightBlocks::interpolate(int left, int top, int side) {
  const int last = side - 1, middle = side / 2;
  const std::array<double, 4> corners{lightAt(left, top), lightAt(left + last, top), lightAt(left, top + last),
                                      lightAt(left + last, top + last)};
  const auto mixed = [&](int x, int y) {
    const std::array<double, 4> weights = cornerWeights(x, y, last);
    double sum = 0;
    for (size_t i = 0; i < 4; ++i) sum += corners[i] * weights[i];
    return sum;
  };
  const std::array<std::pair<int, int>, 3> tested{{{middle, middle}, {middle, 0}, {0, middle}}};
  for (const auto& [x, y] : tested)
    if (std::abs(mixed(x, y) - lightAt(left + x, top + y)) > kMaxLightError) return false;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (const size_t index = indexOf(left + x, top + y); states_[index] == State::Dark) {
        points_[index].light = mixed(x, y);
        states_[index] = State::Lit;
      }
  return true;
}

}  // namespace asdfvk
