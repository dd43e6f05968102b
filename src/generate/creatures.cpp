#include "generate/creatures.h"

#include <array>
#include <cmath>
#include <utility>

#include "generate/surface_nets.h"

namespace asdfvk {
namespace {

/// Adds capsules of the left side (y > 0) and their mirror images. The part number of a mirror image is greater by 1.
void addBothSides(std::vector<Capsule>& capsules, const std::vector<Capsule>& left) {
  for (Capsule capsule : left) {
    capsules.push_back(capsule);
    capsule.a.y = -capsule.a.y;
    capsule.b.y = -capsule.b.y;
    ++capsule.part;
    capsules.push_back(capsule);
  }
}

/// Adds a branch of `levelCount` levels. A branch forks into two branches of 0.8 times its length and 2^(-1/3) times
/// its radius (Murray's law). `forward` and `side` are orthogonal unit vectors. The two branches lie in the plane of
/// these vectors, and the branches of the next level in a perpendicular plane.
void addBranches(const Vec3d& foot, const Vec3d& forward, const Vec3d& side, double length, double radius,
                 uint32_t levelCount, std::vector<Capsule>& capsules) {
  if (levelCount == 0) return;
  const Vec3d fork = foot + forward * length;
  const double taper = std::cbrt(0.5);
  capsules.push_back({foot, fork, radius, radius * taper, static_cast<uint32_t>(capsules.size()), 0.6 * radius});
  for (const double angle : {0.6, -0.75}) {
    const Vec3d turned = forward * std::cos(angle) + side * std::sin(angle);
    addBranches(fork, turned, cross(forward, side), 0.8 * length, radius * taper, levelCount - 1, capsules);
  }
}

}  // namespace

CapsuleUnion animalField() {
  std::vector<Capsule> capsules{
      {{-0.55, 0, 0.95}, {0.50, 0, 1.00}, 0.30, 0.28, 0, 0},
      {{0.60, 0, 1.08}, {0.95, 0, 1.52}, 0.18, 0.13, 1, 0.15},
      {{0.97, 0, 1.58}, {1.35, 0, 1.45}, 0.15, 0.09, 2, 0.08},
      {{-0.82, 0, 1.05}, {-1.25, 0, 0.60}, 0.06, 0.04, 3, 0.08},
  };
  addBothSides(capsules, {{{0.46, 0.19, 0.85}, {0.50, 0.20, 0.45}, 0.12, 0.085, 4, 0.10},
                          {{0.50, 0.20, 0.45}, {0.46, 0.20, 0.06}, 0.085, 0.06, 4, 0.03},
                          {{-0.52, 0.19, 0.85}, {-0.58, 0.20, 0.45}, 0.14, 0.09, 6, 0.10},
                          {{-0.58, 0.20, 0.45}, {-0.50, 0.20, 0.06}, 0.09, 0.06, 6, 0.03},
                          {{0.92, 0.08, 1.69}, {0.87, 0.15, 1.87}, 0.045, 0.025, 8, 0.04}});
  return CapsuleUnion(std::move(capsules));
}

CapsuleUnion handField() {
  std::vector<Capsule> capsules{{{0, 0, -0.75}, {0, 0, 0}, 0.17, 0.16, 6, 0}};
  struct Finger {
    double knuckle, angle, length, radius;
    uint32_t part;
  };
  constexpr std::array<Finger, 4> kFingers{{{0.33, 0.36, 0.70, 0.095, 2},
                                            {0.11, 0.12, 0.80, 0.100, 3},
                                            {-0.11, -0.12, 0.74, 0.095, 4},
                                            {-0.33, -0.36, 0.58, 0.080, 5}}};
  for (const Finger& finger : kFingers)
    capsules.push_back({{0, finger.knuckle * 0.3, 0.05}, {0, finger.knuckle, 0.85}, 0.14, 0.12, 0, 0.06});
  for (const Finger& finger : kFingers) {
    // Three phalanges, each bent a little further towards x.
    Vec3d joint{0, finger.knuckle, 0.88};
    double radius = finger.radius, bend = 0.05;
    for (const double share : {0.45, 0.32, 0.23}) {
      const Vec3d direction{std::sin(bend), std::cos(bend) * std::sin(finger.angle),
                            std::cos(bend) * std::cos(finger.angle)};
      const Vec3d next = joint + direction * (share * finger.length);
      capsules.push_back({joint, next, radius, radius * 0.88, finger.part, 0.04});
      joint = next;
      radius *= 0.88;
      bend += 0.2;
    }
  }
  capsules.push_back({{0.02, 0.20, 0.22}, {0.10, 0.55, 0.50}, 0.13, 0.11, 1, 0.06});
  capsules.push_back({{0.10, 0.55, 0.50}, {0.14, 0.72, 0.72}, 0.11, 0.09, 1, 0.02});
  capsules.push_back({{0.14, 0.72, 0.72}, {0.15, 0.80, 0.90}, 0.09, 0.07, 1, 0.02});
  return CapsuleUnion(std::move(capsules));
}

CapsuleUnion figureField() {
  std::vector<Capsule> capsules{
      {{0, 0, 1.05}, {0, 0, 1.40}, 0.14, 0.16, 0, 0},
      {{0, -0.14, 1.47}, {0, 0.14, 1.47}, 0.085, 0.085, 0, 0.08},
      {{0, -0.08, 0.98}, {0, 0.08, 0.98}, 0.12, 0.12, 0, 0.08},
      {{0, 0, 1.52}, {0.01, 0, 1.68}, 0.06, 0.055, 1, 0.05},
      {{0.01, 0, 1.76}, {0.02, 0, 1.84}, 0.10, 0.115, 2, 0.03},
  };
  addBothSides(capsules, {{{0, 0.20, 1.47}, {-0.02, 0.40, 1.20}, 0.065, 0.050, 3, 0.05},
                          {{-0.02, 0.40, 1.20}, {0.06, 0.55, 0.98}, 0.050, 0.036, 5, 0.02},
                          {{0.07, 0.565, 0.955}, {0.11, 0.60, 0.84}, 0.042, 0.028, 7, 0.02},
                          {{0, 0.11, 0.93}, {0.03, 0.16, 0.52}, 0.090, 0.062, 9, 0.05},
                          {{0.03, 0.16, 0.52}, {-0.01, 0.18, 0.10}, 0.062, 0.042, 11, 0.02},
                          {{-0.02, 0.18, 0.06}, {0.16, 0.20, 0.04}, 0.050, 0.038, 13, 0.02}});
  return CapsuleUnion(std::move(capsules));
}

CapsuleUnion treeField() {
  std::vector<Capsule> capsules;
  addBranches({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 0.6, 0.12, 5, capsules);
  return CapsuleUnion(std::move(capsules));
}

GeneratedShape makeAnimal(uint64_t faceCount) { return polygonise(animalField(), faceCount); }
GeneratedShape makeHand(uint64_t faceCount) { return polygonise(handField(), faceCount); }
GeneratedShape makeFigure(uint64_t faceCount) { return polygonise(figureField(), faceCount); }
GeneratedShape makeTree(uint64_t faceCount) { return polygonise(treeField(), faceCount); }

}  // namespace asdfvk
