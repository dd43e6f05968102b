#include "random_solids/random_boxes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/random.h"

namespace asdfvk {
namespace {

/// The walls of a box along x or y, on both sides of the middle: outside and inside.
struct Walls {
  DraftedPlane outer, inner;

  [[nodiscard]] std::vector<DraftedPlane> planes() const {
    return {{-outer.offset, -outer.slope}, {-inner.offset, -inner.slope}, inner, outer};
  }
};

class RandomBox {
 public:
  RandomBox(uint64_t seed, double limit) : random_(seed), limit_(limit) {
    height_ = limit * between(8, 10);
    floor_ = limit * between(1, 2);
    const double first = draft(), second = draft();
    // The inside has more draft, so that a wall is thinnest at its rim, between the inner edge and the outer plane.
    outerSlope_ = std::min(first, second);
    innerSlope_ = std::max(first, second);
    for (Walls& walls : walls_) {
      const double wall = limit * between(1, 2), halfWidth = limit * between(5, 8);
      walls.outer = {halfWidth - outerSlope_ * height_, outerSlope_};
      walls.inner = {halfWidth - wall * std::hypot(1, outerSlope_) - innerSlope_ * height_, innerSlope_};
      least_ = std::min({least_, wall, floor_});
    }
  }

  ThicknessPart sound() { return make(walls_[0].planes(), walls_[1].planes(), {0, floor_, height_}, {}); }

  ThicknessPart withThinPlace() {
    least_ = limit_ * between(0.2, 0.98);
    std::vector<DraftedPlane> xs = walls_[0].planes(), ys = walls_[1].planes();
    const double from = ys[1].at(0) * between(0.1, 0.9), to = from + limit_ * between(0.3, 2);
    if (random_.index(3) == 0) {  // From below, into the floor.
      const double side = xs[1].at(0) * between(0.1, 0.9);
      xs.insert(xs.begin() + 2, {{side, 0}, {side + limit_ * between(0.3, 2), 0}});
      ys.insert(ys.begin() + 2, {{from, 0}, {to, 0}});
      return make(xs, ys, {0, floor_ - least_, floor_, height_}, Cell{2, 2, 0});
    }
    // From outside, into a wall; a part of them is open at the rim.
    const DraftedPlane inner = walls_[0].inner;
    xs.insert(xs.begin() + 3, {inner.offset + least_ * std::hypot(1, inner.slope), inner.slope});
    ys.insert(ys.begin() + 2, {{from, 0}, {to, 0}});
    const double bottom = floor_ + (height_ - floor_) * between(0.1, 0.5);
    if (random_.index(3) == 0) return make(xs, ys, {0, floor_, bottom, height_}, Cell{3, 2, 2});
    return make(xs, ys, {0, floor_, bottom, bottom + limit_ * between(0.3, 2), height_}, Cell{3, 2, 2});
  }

 private:
  using Cell = std::array<uint32_t, 3>;

  double between(double least, double greatest) { return least + (greatest - least) * random_.real(); }
  double draft() { return std::tan(between(1, 3) * std::numbers::pi / 180); }

  /// thinPlace: the cell that is left out, besides the inside of the box.
  [[nodiscard]] ThicknessPart make(const std::vector<DraftedPlane>& xs, const std::vector<DraftedPlane>& ys,
                                   const std::vector<double>& zs, const std::optional<Cell>& thinPlace) const {
    const auto isInside = [&](const std::vector<DraftedPlane>& planes, uint32_t cell, const Walls& walls) {
      const double middle = (planes[cell].at(height_) + planes[cell + 1].at(height_)) / 2;
      return std::abs(middle) < walls.inner.at(height_);
    };
    ThicknessPart part{.solid = {}, .leastThickness = least_, .leastWall = least_};
    addDraftedLattice(part.solid, xs, ys, zs, [&](uint32_t i, uint32_t j, uint32_t k) {
      return Cell{i, j, k} != thinPlace &&
             !(zs[k] >= floor_ && isInside(xs, i, walls_[0]) && isInside(ys, j, walls_[1]));
    });
    return part;
  }

  Random random_;
  double limit_, height_ = 0, floor_ = 0, outerSlope_ = 0, innerSlope_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
  std::array<Walls, 2> walls_;  // Along x and y.
};

}  // namespace

ThicknessPart makeSoundBox(uint64_t seed, double limit) { return RandomBox(seed, limit).sound(); }

ThicknessPart makeBoxWithThinPlace(uint64_t seed, double limit) { return RandomBox(seed, limit).withThinPlace(); }

}  // namespace asdfvk
