#include "generate/capsule_union.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/check.h"

namespace asdfvk {
namespace {

// Calls use(i) for the bits of a selection in ascending order.
template <typename Use>
void forEachBit(uint64_t bits, Use use) {
  for (; bits != 0; bits &= bits - 1) use(static_cast<size_t>(std::countr_zero(bits)));
}

// Cubic smooth minimum of a and b, with two continuous derivatives. If |a - b| < blend, the smooth minimum is less than
// min(a, b) by at most blend / 6; else it equals min(a, b). `share` is the derivative with respect to b. 1 - share is
// the derivative with respect to a.
struct SmoothMinimum {
  double value, share;
};
SmoothMinimum smoothMinimum(double a, double b, double blend) {
  const double near = blend - std::abs(a - b);
  if (near <= 0) return {std::min(a, b), b < a ? 1.0 : 0.0};
  const double h = near / blend;
  const double other = 0.5 * h * h;
  return {std::min(a, b) - h * h * near / 6, b < a ? 1 - other : other};
}

}  // namespace

CapsuleUnion::CapsuleUnion(std::vector<Capsule> capsules) : capsules_(std::move(capsules)) {
  ASDFVK_CHECK_OP(capsules_.size(), >, 0u);
  ASDFVK_CHECK_OP(capsules_.size(), <=, kMaxCapsules);
  all_ = kAll >> (kMaxCapsules - capsules_.size());
  for (const Capsule& capsule : capsules_) {
    Axis axis;
    axis.origin = capsule.a;
    axis.length = length(capsule.b - capsule.a);
    ASDFVK_CHECK_OP(axis.length, >, std::abs(capsule.radiusB - capsule.radiusA));
    axis.direction = (capsule.b - capsule.a) / axis.length;
    axis.radius = capsule.radiusA;
    axis.radiusSlope = (capsule.radiusB - capsule.radiusA) / axis.length;
    axis.lean = axis.radiusSlope / std::sqrt(1 - axis.radiusSlope * axis.radiusSlope);
    axis.blend = capsule.blend;
    axis.part = capsule.part;
    axes_.push_back(axis);
    largestBlend_ = std::max(largestBlend_, capsule.blend);
    for (const auto& [centre, radius] : {std::pair{capsule.a, capsule.radiusA}, {capsule.b, capsule.radiusB}}) {
      bounds_.add(centre - Vec3d{radius, radius, radius});
      bounds_.add(centre + Vec3d{radius, radius, radius});
    }
  }
  const Vec3d margin{largestBlend_, largestBlend_, largestBlend_};
  bounds_ = {bounds_.min - margin, bounds_.max + margin};
}

// The distance to the ball at s along the axis, |p - c(s)| - r(s), is convex in s. From the foot of the perpendicular,
// the minimum is in the direction of growing radius.
CapsuleUnion::Nearest CapsuleUnion::nearest(const Axis& axis, const Vec3d& p) {
  const Vec3d fromOrigin = p - axis.origin;
  const double along = dot(fromOrigin, axis.direction);
  double s = along;
  if (axis.lean != 0) s += axis.lean * std::sqrt(std::max(0.0, dot(fromOrigin, fromOrigin) - along * along));
  s = std::clamp(s, 0.0, axis.length);
  Nearest result;
  result.radius = axis.radius + axis.radiusSlope * s;
  result.fromCentre = fromOrigin - axis.direction * s;
  result.fromCentreLength = asdfvk::length(result.fromCentre);
  result.distance = result.fromCentreLength - result.radius;
  return result;
}

double CapsuleUnion::value(const Vec3d& p, Selection selection) const {
  double value = 0;
  bool isFirst = true;
  forEachBit(selection & all_, [&](size_t i) {
    const double distance = nearest(axes_[i], p).distance;
    value = isFirst ? distance : smoothMinimum(value, distance, axes_[i].blend).value;
    isFirst = false;
  });
  return value;
}

CapsuleUnion::Sample CapsuleUnion::sample(const Vec3d& p, Selection selection) const {
  Sample sample;
  bool isFirst = true;
  forEachBit(selection & all_, [&](size_t i) {
    const Nearest ball = nearest(axes_[i], p);
    const Vec3d gradient = ball.fromCentreLength > 0 ? ball.fromCentre / ball.fromCentreLength : Vec3d{};
    if (isFirst) {
      sample = {ball.distance, gradient};
    } else {
      const auto [value, share] = smoothMinimum(sample.value, ball.distance, axes_[i].blend);
      sample = {value, sample.gradient * (1 - share) + gradient * share};
    }
    isFirst = false;
  });
  return sample;
}

// A capsule has no effect on the smooth minimum if its distance exceeds the least distance by more than a few blend
// widths. Within `radius` of p, each distance differs by at most `radius` from the distance at p, so two distances move
// apart by at most 2 * radius.
CapsuleUnion::Selection CapsuleUnion::near(const Vec3d& p, double radius) const {
  std::vector<double> distances;
  for (const Axis& axis : axes_) distances.push_back(nearest(axis, p).distance);
  const double least = *std::min_element(distances.begin(), distances.end());
  Selection selection = 0;
  for (size_t i = 0; i < distances.size(); ++i)
    if (distances[i] <= least + 2 * radius + 4 * largestBlend_) selection |= Selection{1} << i;
  return selection;
}

CapsuleUnion::Dominating CapsuleUnion::dominating(const Vec3d& p, Selection selection) const {
  Dominating result;
  double least = std::numeric_limits<double>::infinity();
  forEachBit(selection & all_, [&](size_t i) {
    const Nearest ball = nearest(axes_[i], p);
    if (ball.distance >= least) return;
    least = ball.distance;
    result = {axes_[i].part, 2 * ball.radius};
  });
  return result;
}

CapsuleUnion CapsuleUnion::withRadiiAtLeast(double radius) const {
  std::vector<Capsule> capsules = capsules_;
  for (Capsule& capsule : capsules) {
    capsule.radiusA = std::max(capsule.radiusA, radius);
    capsule.radiusB = std::max(capsule.radiusB, radius);
  }
  return CapsuleUnion(std::move(capsules));
}

}  // namespace asdfvk
