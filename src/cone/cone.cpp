#include "cone/cone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asdf_vk/error.h"
#include "core/random.h"
#include "shared/cone_rules.h"

namespace asdfvk {
namespace {

// Rays that a device traces side by side, so they should be neighbours.
constexpr size_t kRunLength = 8;

struct Ray {
  double azimuth = 0;  // Radians, 0 .. 2 pi.
  Vec3d direction;
  double weight = 0;
};

// Reorders whole rays so that each run of kRunLength is a compact patch of the cone: sectors of azimuth with `rows`
// runs each, by increasing angle to the axis. There is one row unless sectors would be slivers.
void sortIntoCompactRuns(std::vector<Ray>& rays, double halfAngle) {
  const double runCount = std::ceil(static_cast<double>(rays.size()) / kRunLength);
  const double squareSectorCount = 2 * std::numbers::pi * std::sin(halfAngle / 2) / halfAngle;
  const auto rows = std::max<size_t>(1, static_cast<size_t>(std::lround(std::sqrt(runCount / squareSectorCount))));
  std::sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) { return a.azimuth < b.azimuth; });
  if (rows == 1) return;
  const size_t sectorRayCount = rows * kRunLength;
  for (size_t begin = 0; begin < rays.size(); begin += sectorRayCount) {
    const auto first = rays.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = rays.begin() + static_cast<std::ptrdiff_t>(std::min(begin + sectorRayCount, rays.size()));
    std::sort(first, last, [](const Ray& a, const Ray& b) { return a.weight > b.weight; });
  }
}

}  // namespace

Cone makeCone(const ConeOptions& options) {
  if (options.rayCount < 1 || options.rayCount > kMaxRayCount)
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("a cone of {} rays is out of range; give 1 to {}", options.rayCount, kMaxRayCount));
  if (!(options.openingAngleDegrees > 0 && options.openingAngleDegrees < 180))
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("a cone angle of {} degrees is out of range; give more than 0 and less "
                            "than 180",
                            options.openingAngleDegrees));
  if (!(options.falseHitAngleDegrees >= 0 && options.falseHitAngleDegrees <= 180))
    throw Error(
        ErrorCode::OptionOutOfRange,
        fmt::format("a false-hit angle of {} degrees is out of range; give 0 to 180", options.falseHitAngleDegrees));
  if (!(options.outlierDeviations > 0))
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("an outlier limit of {} standard deviations is out of range; give more than 0",
                            options.outlierDeviations));
  // Vogel 1979. Stores the versine 1 - cos t instead of the cosine, so that narrow cones lose no digits.
  const double halfAngle = options.openingAngleDegrees * std::numbers::pi / 360;
  const double maxVersine = 2 * std::pow(std::sin(halfAngle / 2), 2);
  const double goldenAngle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Ray> rays(options.rayCount);
  for (size_t i = 0; i < rays.size(); ++i) {
    const double versine = (static_cast<double>(i) + 0.5) / options.rayCount * maxVersine;
    const double sine = std::sqrt(versine * (2 - versine));
    const double phi = static_cast<double>(i) * goldenAngle;
    rays[i].azimuth = std::fmod(phi, 2 * std::numbers::pi);
    rays[i].direction = {sine * std::cos(phi), sine * std::sin(phi), 1 - versine};
    rays[i].weight = 1 / (2 * std::asin(std::sqrt(versine / 2)));
  }
  sortIntoCompactRuns(rays, halfAngle);

  Cone cone;
  cone.falseHitCosine = std::cos(options.falseHitAngleDegrees * std::numbers::pi / 180) + kFalseHitSlack;
  cone.outlierDeviations = options.outlierDeviations;
  cone.halfAngleRadians = options.openingAngleDegrees * std::numbers::pi / 360;
  cone.rotation = options.rotation;
  for (const Ray& ray : rays) {
    cone.directions.push_back(ray.direction);
    cone.weights.push_back(ray.weight);
  }
  return cone;
}

ConeFrame coneFrame(const Vec3d& z) {
  const double s = z.z < -0.7 ? -1.0 : 1.0;
  const double a = -1 / (s + z.z);
  const double b = z.x * z.y * a;
  return {{1 + s * z.x * z.x * a, s * b, -s * z.x}, {b, s + z.y * z.y * a, -z.y}, z};
}

ConeFrame faceConeFrame(const Cone& cone, const Vec3d& normal, uint32_t face) {
  const ConeFrame frame = coneFrame(-normal);
  if (cone.rotation == ConeRotation::Fixed) return frame;
  const double angle =
      2 * std::numbers::pi * Random(face).real();  // The first random number of a seed is a hash of the seed.
  const double cosine = std::cos(angle), sine = std::sin(angle);
  return {cosine * frame.tangent + sine * frame.bitangent, cosine * frame.bitangent - sine * frame.tangent, frame.axis};
}

}  // namespace asdfvk
