#include "brute_force.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shared/cone_rules.h"

namespace asdfvk {
namespace {

struct Corners {
  uint32_t face;
  Vec3d a, b, c;
  [[nodiscard]] Vec3d normal() const { return cross(b - a, c - a); }
};

Corners cornersOf(const Mesh& mesh, uint32_t face) {
  const Face& f = mesh.faces[face];
  return {face, mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]};
}

// The faces that a cone of `seedFace` can hit: all but those with the very same vertices.
std::vector<Corners> facesToHit(const Mesh& mesh, uint32_t seedFace) {
  const Face& seed = mesh.faces[seedFace];
  std::vector<Corners> others;
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
    const Face& face = mesh.faces[f];
    if (!std::is_permutation(face.begin(), face.end(), seed.begin())) others.push_back(cornersOf(mesh, f));
  }
  return others;
}

// Infinity for a miss. The ray passes inside when it runs the same way round all three edges.
double hitDistance(const Corners& t, const Vec3d& origin, const Vec3d& direction) {
  const Vec3d a = t.a - origin, b = t.b - origin, c = t.c - origin;
  const double ab = dot(direction, cross(a, b)), bc = dot(direction, cross(b, c)), ca = dot(direction, cross(c, a));
  const bool isInside = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  const double slope = dot(t.normal(), direction);
  if (!isInside || !(std::abs(slope) > 0)) return std::numeric_limits<double>::infinity();
  const double distance = dot(t.normal(), a) / slope;
  return distance >= 0 ? distance : std::numeric_limits<double>::infinity();
}

}  // namespace

BruteForceCone traceByBruteForce(const Mesh& mesh, const Cone& cone, uint32_t seedFace) {
  const Corners seed = cornersOf(mesh, seedFace);
  const Vec3d origin = (seed.a + seed.b + seed.c) / 3.0;
  const Vec3d normal = seed.normal() / length(seed.normal());
  const bool isPaper = cone.definition == Definition::Paper;
  const ConeFrame frame = isPaper ? paperConeFrame(cone, normal, seedFace) : cgalConeFrame(-seed.normal());
  const std::vector<Corners> others = facesToHit(mesh, seedFace);
  BruteForceCone result;
  for (const Vec3d& d : cone.directions) {
    const Vec3d direction = d.x * frame.tangent + d.y * frame.bitangent + d.z * frame.axis;
    double nearest = std::numeric_limits<double>::infinity();
    Vec3d nearestNormal;
    uint32_t nearestFace = kNoFace;
    for (const Corners& corners : others) {
      const double distance = hitDistance(corners, origin, direction);
      if (!(distance < nearest)) continue;
      nearest = distance;
      nearestFace = corners.face;
      nearestNormal = corners.normal() / length(corners.normal());
    }
    const bool isFalse =
        isPaper ? dot(normal, nearestNormal) > cone.falseHitCosine : dot(direction, nearestNormal) <= 0;
    const bool isValid = std::isfinite(nearest) && !isFalse;
    result.rayLengths.push_back(isValid ? nearest : kNoValue);
    result.hitDistances.push_back(nearest);
    result.hitFaces.push_back(nearestFace);
  }
  result.value = isPaper ? valueBySorting(result.rayLengths, cone.weights) : cgalValueBySorting(result.rayLengths);
  return result;
}

namespace {

double medianOf(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  return 0.5 * (numbers[(numbers.size() - 1) / 2] + numbers[numbers.size() / 2]);
}

}  // namespace

double cgalValueBySorting(const std::vector<double>& rayLengths) {
  std::vector<double> lengths, differences;
  for (const double l : rayLengths)
    if (!std::isnan(l)) lengths.push_back(l);
  if (lengths.empty()) return kNoValue;
  const double median = medianOf(lengths);
  for (const double l : lengths) differences.push_back(std::abs(l - median));
  const double bound = 1.5 * medianOf(differences);
  double sum = 0, count = 0;
  for (const double l : lengths)
    if (std::abs(l - median) <= bound) {
      sum += l;
      ++count;
    }
  return sum / count;
}

double valueBySorting(const std::vector<double>& rayLengths, const std::vector<double>& weights) {
  std::vector<double> sorted;
  for (const double l : rayLengths)
    if (!std::isnan(l)) sorted.push_back(l);
  if (sorted.empty()) return kNoValue;
  std::sort(sorted.begin(), sorted.end());
  const size_t n = sorted.size();
  const double median = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
  double sum = 0, squares = 0;
  for (const double l : sorted) sum += l;
  for (const double l : sorted) squares += std::pow(l - sum / static_cast<double>(n), 2);
  const double bound = std::sqrt(squares / static_cast<double>(n)) + 1e-5 * median;
  double weighted = 0, weightSum = 0;
  for (size_t i = 0; i < rayLengths.size(); ++i) {
    if (!(std::abs(rayLengths[i] - median) <= bound)) continue;
    weighted += weights[i] * rayLengths[i];
    weightSum += weights[i];
  }
  return weighted / weightSum;
}

}  // namespace asdfvk
