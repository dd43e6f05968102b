#include "random_solids/assembly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/random.h"
#include "generate/block_solid.h"

namespace asdfvk {
namespace {

/// Radii over heights, of a solid with `sideCount` planar sides around the z axis.
struct Profile {
  uint32_t sideCount;
  double phase;
  std::vector<double> heights, radii;

  [[nodiscard]] Vec3d at(uint32_t side, uint32_t k) const {
    const double angle = phase + 2 * std::numbers::pi * (side % sideCount) / sideCount;
    return {radii[k] * std::cos(angle), radii[k] * std::sin(angle), heights[k]};
  }
};

/// Between the two profiles, which have as many heights.
BlockSolid solidBetween(const Profile& inner, const Profile& outer) {
  BlockSolid solid;
  solid.addLattice({1, outer.sideCount, static_cast<uint32_t>(outer.heights.size()) - 1},
                   [&](uint32_t i, uint32_t j, uint32_t k) { return (i == 0 ? inner : outer).at(j, k); });
  return solid;
}

BlockSolid solidWithin(const Profile& outer) {
  Profile axis = outer;
  axis.radii.assign(outer.radii.size(), 0);
  return solidBetween(axis, outer);
}

BlockSolid solidBox(const std::array<double, 2>& xs, const std::array<double, 2>& ys, const std::array<double, 2>& zs) {
  BlockSolid solid;
  solid.addLattice({1, 1, 1}, [&](uint32_t i, uint32_t j, uint32_t k) { return Vec3d{xs[i], ys[j], zs[k]}; });
  return solid;
}

/// Stacks units of one to three parts along z. The bottom and the top of a unit contain the z axis, so that each unit
/// touches the next one.
class AssemblyStack {
 public:
  AssemblyStack(uint64_t seed, bool interpenetrates) : random_(seed), interpenetrates_(interpenetrates) {}

  std::vector<Mesh> parts(uint32_t count) {
    while (parts_.size() < count) {
      const auto left = count - static_cast<uint32_t>(parts_.size());
      const double height = random_.index(3) == 0 ? between(0.05, 0.15) : between(0.5, 1.5);
      const double bottom = interpenetrates_ && !parts_.empty() ? top_ - 0.3 * std::min(height, height_) : top_;
      top_ = bottom + height;
      height_ = height;
      switch (random_.index(left >= 2 ? 5 : 2)) {
        case 0:
          addBoxes(bottom, 1 + random_.index(std::min(left, 3u)));
          break;
        case 1:
          addRound(bottom);
          break;
        case 2:
          addPinInSleeve(bottom);
          break;
        case 3:
          addFilledBox(bottom);
          break;
        default:
          addBallInCylinder(bottom);
      }
    }
    return std::move(parts_);
  }

  Mesh doubled() {
    top_ = between(0.1, 1.5);
    const BlockSolid solid = random_.index(2) == 0 ? oneBox(0) : solidWithin(randomProfile({0, top_}));
    SurfaceDivision division = randomDivision();
    Mesh mesh = solid.surface(division);
    division.otherDiagonals = true;
    const Mesh other = solid.surface(division);
    mesh.faces.insert(mesh.faces.end(), other.faces.begin(), other.faces.end());
    return mesh;
  }

  Random& random() { return random_; }

 private:
  double between(double least, double greatest) { return least + (greatest - least) * random_.real(); }

  SurfaceDivision randomDivision() {
    SurfaceDivision division{.diagonalSeed = random_.next()};
    if (random_.index(3) != 0) division.longestEdge = between(0.4, 1.2);
    return division;
  }

  void add(const BlockSolid& solid) { parts_.push_back(solid.surface(randomDivision())); }

  BlockSolid oneBox(double bottom) {
    const double x = between(0.5, 1.5), y = between(0.5, 1.5);
    return solidBox({-x, x}, {-y, y}, {bottom, top_});
  }

  /// Side by side, between common planes along y and z.
  void addBoxes(double bottom, uint32_t count) {
    const double y = between(0.5, 1.5);
    double x = -between(0.5, 1.5);
    for (uint32_t i = 0; i < count; ++i) {
      const double next = i + 1 == count ? std::max(x, 0.0) + between(0.5, 1) : x + between(0.1, 1);
      add(solidBox({x, next}, {-y, y}, {bottom, top_}));
      x = next;
    }
  }

  Profile randomProfile(std::vector<double> heights) {
    constexpr std::array<uint32_t, 7> kSideCounts{3, 4, 5, 6, 8, 12, 24};
    const uint32_t sideCount = kSideCounts[random_.index(kSideCounts.size())];
    const double radius = between(0.6, 1.5);
    std::vector<double> radii(heights.size(), radius);
    return {sideCount, between(0, 1), std::move(heights), std::move(radii)};
  }

  /// Profile of the part of a sphere between two parallel planes, or of a prism.
  Profile roundProfile(double bottom) {
    if (random_.index(2) == 0) return randomProfile({bottom, top_});
    constexpr uint32_t kRingCount = 5;
    Profile profile = randomProfile(std::vector<double>(kRingCount + 1));
    const double reach = between(0.4, 0.9);  // The height of the planes over the centre, in radii.
    for (uint32_t k = 0; k <= kRingCount; ++k) {
      const double share = 2.0 * k / kRingCount - 1;
      profile.heights[k] = k == kRingCount ? top_ : bottom + (top_ - bottom) * (share + 1) / 2;
      profile.radii[k] *= std::sqrt(1 - reach * reach * share * share);
    }
    return profile;
  }

  void addRound(double bottom) { add(solidWithin(roundProfile(bottom))); }

  void addPinInSleeve(double bottom) {
    const Profile pin = roundProfile(bottom);
    Profile sleeve = pin;
    std::fill(sleeve.radii.begin(), sleeve.radii.end(),
              *std::max_element(pin.radii.begin(), pin.radii.end()) + between(0.05, 0.5));
    add(solidBetween(pin, sleeve));
    add(solidWithin(pin));
  }

  /// A box whose pocket or cavity is filled by another one.
  void addFilledBox(double bottom) {
    const double x = between(0.4, 1), y = between(0.4, 1), wall = between(0.05, 0.5), floor = (top_ - bottom) / 3;
    const std::array<double, 4> xs{-x - wall, -x, x, x + wall}, ys{-y - wall, -y, y, y + wall};
    const std::array<double, 4> zs{bottom, bottom + floor, top_ - floor, top_};
    const bool isCavity = random_.index(2) == 0;
    BlockSolid solid;
    solid.addLattice(
        {3, 3, 3},
        [&](uint32_t i, uint32_t j, uint32_t k) {
          return Vec3d{xs[i], ys[j], zs[k]};
        },
        [&](uint32_t i, uint32_t j, uint32_t k) { return i != 1 || j != 1 || k == 0 || (isCavity && k == 2); });
    add(solid);
    add(solidBox({-x, x}, {-y, y}, {zs[1], isCavity ? zs[2] : zs[3]}));
  }

  void addBallInCylinder(double bottom) {
    constexpr uint32_t kRingCount = 6;
    const double radius = (top_ - bottom) * between(0.3, 0.48), centre = (bottom + top_) / 2;
    Profile cylinder = randomProfile(std::vector<double>(kRingCount + 1));
    Profile ball = cylinder;
    for (uint32_t k = 0; k <= kRingCount; ++k) {
      const bool isPole = k == 0 || k == kRingCount;
      const double latitude = std::numbers::pi * (double(k) / kRingCount - 0.5);
      ball.radii[k] = isPole ? 0 : radius * std::cos(latitude);
      ball.heights[k] = centre + radius * std::sin(latitude);
      if (isPole) cylinder.radii[k] = 0;
      cylinder.heights[k] = k <= 1                ? bottom
                            : k + 1 >= kRingCount ? top_
                                                  : bottom + (top_ - bottom) * (k - 1) / (kRingCount - 2);
    }
    const double outerRadius = (radius + between(0.05, 0.5)) / std::cos(std::numbers::pi / cylinder.sideCount);
    for (double& r : cylinder.radii) r = r > 0 ? outerRadius : 0;
    add(solidBetween(ball, cylinder));
    Profile axis = ball;
    axis.radii.assign(ball.radii.size(), 0);
    add(solidBetween(axis, ball));
  }

  Random random_;
  bool interpenetrates_;
  double top_ = 0, height_ = 0;
  std::vector<Mesh> parts_;
};

/// A uniformly random rotation (K. Shoemake, Uniform Random Rotations, Graphics Gems III, 1992), as the images of the
/// axes.
std::array<Vec3d, 3> randomRotation(Random& random) {
  const double share = random.real(), first = 2 * std::numbers::pi * random.real(),
               second = 2 * std::numbers::pi * random.real();
  const double x = std::sqrt(1 - share) * std::sin(first), y = std::sqrt(1 - share) * std::cos(first);
  const double z = std::sqrt(share) * std::sin(second), w = std::sqrt(share) * std::cos(second);
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
           {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
           {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}}};
}

}  // namespace

GeneratedShape makeAssembly(const AssemblyParameters& parameters) {
  AssemblyStack stack(parameters.seed, parameters.interpenetrates);
  const uint32_t count = 2 + stack.random().index(7);
  const std::vector<Mesh> parts = stack.parts(count);
  std::array<Vec3d, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (stack.random().index(4) != 0) axes = randomRotation(stack.random());

  GeneratedShape shape;
  double end = 0;
  for (uint32_t part = 0; part < parts.size(); ++part) {
    const Mesh& mesh = parts[part];
    const auto [least, greatest] = std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                                       [](const Vec3d& a, const Vec3d& b) { return a.z < b.z; });
    const double shift = parameters.apart ? end - least->z : 0;
    if (parameters.apart) end += greatest->z - least->z + *parameters.apart;
    const auto first = static_cast<uint32_t>(shape.mesh.vertices.size());
    // The shift comes last, so that the turned part is the same wherever it is.
    for (const Vec3d& p : mesh.vertices)
      shape.mesh.vertices.push_back(p.x * axes[0] + p.y * axes[1] + p.z * axes[2] + shift * axes[2]);
    for (const auto& [a, b, c] : mesh.faces) shape.mesh.faces.push_back({first + a, first + b, first + c});
    shape.part.resize(shape.mesh.faces.size(), part);
  }
  shape.diameter.assign(shape.mesh.faces.size(), 0);
  return shape;
}

GeneratedShape makeDoubledSolid(uint64_t seed) { return withUniformDiameter(AssemblyStack(seed, false).doubled(), 0); }

}  // namespace asdfvk
