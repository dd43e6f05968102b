#include "cone/cone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/check.h"
#include "core/elementary.h"
#include "core/random.h"
#include "mesh/face_geometry.h"
#include "shared/cone_rules.h"

namespace asdfvk {
namespace {

// Number of consecutive rays that a device traces side by side. These rays should be neighbours.
constexpr size_t kRunLength = 8;

const double kGoldenAngle = std::numbers::pi * (3 - std::sqrt(5.0));

struct Ray {
  double azimuth = 0;  // Angle about the axis, in radians, 0 .. 2 pi.
  double angle = 0;    // Angle to the axis, in radians.
  Vec3d direction;
  double weight = 0;
  double solidAngle = 1;
};

// Reorders the rays so that each run of kRunLength rays is a compact patch of the cone. Runs are grouped into sectors
// of azimuth. A sector has `rows` runs, ordered by increasing angle to the axis. `rows` is chosen so that patches are
// about square.
void sortIntoCompactRuns(std::vector<Ray>& rays, double halfAngle) {
  const double runCount = std::ceil(static_cast<double>(rays.size()) / kRunLength);
  const double squareSectorCount = 2 * std::numbers::pi * sine(halfAngle / 2) / halfAngle;
  const auto rows = std::max<size_t>(1, static_cast<size_t>(std::lround(std::sqrt(runCount / squareSectorCount))));
  std::sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) { return a.azimuth < b.azimuth; });
  if (rows == 1) return;
  const size_t sectorRayCount = rows * kRunLength;
  for (size_t begin = 0; begin < rays.size(); begin += sectorRayCount) {
    const auto first = rays.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = rays.begin() + static_cast<std::ptrdiff_t>(std::min(begin + sectorRayCount, rays.size()));
    std::sort(first, last, [](const Ray& a, const Ray& b) { return a.angle < b.angle; });
  }
}

// Vogel 1979. Stores the versine 1 - cos t instead of the cosine, so that narrow cones lose no digits.
std::vector<Ray> paperRays(uint32_t count, double halfAngle) {
  const double maxVersine = 2 * sine(halfAngle / 2) * sine(halfAngle / 2);
  std::vector<Ray> rays(count);
  for (size_t i = 0; i < rays.size(); ++i) {
    const double versine = (static_cast<double>(i) + 0.5) / count * maxVersine;
    const double radius = std::sqrt(versine * (2 - versine));
    const double phi = static_cast<double>(i) * kGoldenAngle;
    rays[i].azimuth = std::fmod(phi, 2 * std::numbers::pi);
    rays[i].direction = {radius * cosine(phi), radius * sine(phi), 1 - versine};
    rays[i].angle = angleOf(radius, 1 - versine);
    rays[i].weight = 1 / rays[i].angle;
  }
  return rays;
}

// Ray i passes through the disk that closes the cone, at the share i / count of the radius of the disk.
std::vector<Ray> cgalRays(uint32_t count, double halfAngle) {
  // The ray on the axis represents the radii from 0 to half a step. Their mean is a quarter of a step.
  constexpr double kAxisRadius = 0.25;
  std::vector<Ray> rays(count);
  for (size_t i = 0; i < rays.size(); ++i) {
    const auto step = static_cast<double>(i);
    const double radius = sine(halfAngle) * (step / count);
    const double phi = step * kGoldenAngle;
    const Vec3d direction{radius * cosine(phi), radius * sine(phi), cosine(halfAngle)};
    rays[i].azimuth = std::fmod(phi, 2 * std::numbers::pi);
    rays[i].direction = direction / length(direction);
    rays[i].angle = angleOf(radius, cosine(halfAngle));
    rays[i].weight = 1;
    // The density of rays per solid angle is proportional to 1 / (sin t cos^2 t).
    const double t = angleOf(sine(halfAngle) * (std::max(step, kAxisRadius) / count), cosine(halfAngle));
    rays[i].solidAngle = sine(t) * cosine(t) * cosine(t);
  }
  return rays;
}

}  // namespace

/// Distance of a point on a face from the plane of the face after rounding to float32. Rays at the rim of the cone have
/// the smallest angle to the plane. Therefore rays at the rim have the longest path within this distance.
constexpr double kFloatPlaneError = 0x1p-22;
constexpr double kMaxContactDistance = 0x1p-16;

Cone makeCone(const ConeOptions& options) {
  const bool isCgal = options.definition == Definition::Cgal;
  ASDFVK_CHECK(options.rayCount >= 1 && options.rayCount <= kMaxRayCount);
  ASDFVK_CHECK(options.openingAngleDegrees > 0 && options.openingAngleDegrees < 180);
  Cone cone;
  cone.definition = options.definition;
  cone.falseHitCosine = cosine(options.falseHitAngleDegrees * std::numbers::pi / 180) + kFalseHitSlack;
  cone.outliers.deviations = options.outlierDeviations;
  cone.halfAngleRadians = options.openingAngleDegrees * std::numbers::pi / 360;
  cone.contactDistance =
      std::clamp(kFloatPlaneError / cosine(cone.halfAngleRadians), kContactDistance, kMaxContactDistance);
  cone.rotation = options.rotation;
  if (isCgal) {
    // The greatest negative normal number of float32. With this bound, an angle of 90 degrees is not acute.
    cone.falseHitCosine = -static_cast<double>(std::numeric_limits<float>::min());
    cone.outliers = {.spread = OutlierRule::Spread::MedianDeviation, .deviations = 1.5, .slack = 0};
  }
  std::vector<Ray> rays =
      isCgal ? cgalRays(options.rayCount, cone.halfAngleRadians) : paperRays(options.rayCount, cone.halfAngleRadians);
  sortIntoCompactRuns(rays, cone.halfAngleRadians);
  for (const Ray& ray : rays) {
    cone.directions.push_back(ray.direction);
    cone.weights.push_back(ray.weight);
    cone.solidAngles.push_back(ray.solidAngle);
  }
  return cone;
}

ConeFrame coneFrame(const Vec3d& z) {
  const double s = isConeFrameFlipped(z) ? -1.0 : 1.0;
  const double a = -1 / (s + z.z);
  const double b = z.x * z.y * a;
  return {{1 + s * z.x * z.x * a, s * b, -s * z.x}, {b, s + z.y * z.y * a, -z.y}, z};
}

ConeFrame cgalConeFrame(const Vec3d& inward) {
  const Vec3d n = inward / length(inward);
  const Vec3d magnitude{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
  Vec3d v;
  if (n.x == 0) {
    v = {1, 0, 0};
  } else if (n.y == 0) {
    v = {0, 1, 0};
  } else if (n.z == 0) {
    v = {0, 0, 1};
  } else if (magnitude.x <= magnitude.y && magnitude.x <= magnitude.z) {
    v = {0, -n.z, n.y};
  } else if (magnitude.y <= magnitude.z) {
    v = {-n.z, 0, n.x};
  } else {
    v = {-n.y, n.x, 0};
  }
  const Vec3d tangent = v / length(v), bitangent = cross(n, tangent);
  return {tangent, bitangent / length(bitangent), n};
}

double coneRotation(const Cone& cone, uint64_t key) {
  if (cone.rotation == ConeRotation::Fixed) return 0;
  // The first number of a generator seeded with `key` is a hash of `key`, so that the rotation depends on `key` only.
  return 2 * std::numbers::pi * Random(key).real();
}

ConeFrame paperConeFrame(const Cone& cone, const Vec3d& normal, uint64_t key) {
  const ConeFrame frame = coneFrame(-normal);
  if (cone.rotation == ConeRotation::Fixed) return frame;
  const double angle = coneRotation(cone, key);
  const double c = cosine(angle), s = sine(angle);
  return {c * frame.tangent + s * frame.bitangent, c * frame.bitangent - s * frame.tangent, frame.axis};
}

}  // namespace asdfvk
