#include "trace/cpu/lane_cones.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "cone/cone_value.h"
#include "core/random.h"
#include "support/shapes.h"
#include "trace_results.h"

using namespace asdfvk;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<InstructionSet> instructionSets() {
  if (widestInstructionSet() == InstructionSet::Baseline) return {InstructionSet::Baseline};
  return {InstructionSet::Baseline, widestInstructionSet()};
}

/// The value of one lane by coneValue().
double valueOfLane(const Cone& cone, std::span<const std::array<double, LaneCones::kWidth>> lengths, size_t lane) {
  std::vector<double> valid, weights;
  for (size_t ray = 0; ray < lengths.size(); ++ray) {
    if (lengths[ray][lane] == kInfinity) continue;
    valid.push_back(lengths[ray][lane]);
    weights.push_back(cone.weights[ray]);
  }
  return coneValue(valid, weights, cone.outliers);
}

struct ConeLanes {
  LaneFrames frames;
  std::vector<std::array<Vec3d, LaneCones::kWidth>> directions;  // Per ray.
  std::array<Vec3d, LaneCones::kWidth> origins, normals;
};

/// The cones of faces of a mesh, with rays that hit random faces.
ConeLanes randomCones(const TracedMesh& traced, const Cone& cone, Random& random) {
  ConeLanes cones;
  cones.directions.resize(cone.directions.size());
  for (size_t lane = 0; lane < LaneCones::kWidth; ++lane) {
    const auto face = static_cast<uint32_t>(random.real() * static_cast<double>(traced.mesh.faceCount()));
    cones.normals[lane] = traced.geometry.normals[face];
    cones.origins[lane] = traced.bvh.normalization.toNormalized(traced.geometry.barycentres[face]);
    const ConeFrame frame = paperConeFrame(cone, cones.normals[lane], face);
    cones.frames.set(lane, frame, cones.origins[lane], cones.normals[lane]);
    for (size_t ray = 0; ray < cone.directions.size(); ++ray) {
      const Vec3d& d = cone.directions[ray];
      cones.directions[ray][lane] = d.x * frame.tangent + d.y * frame.bitangent + d.z * frame.axis;
    }
  }
  return cones;
}

}  // namespace

TEST_CASE("cones side by side have the bits of coneValue, for any number of rays") {
  Random random(3);
  const TracedMesh anyMesh(shapes::box({1, 1, 1}));
  const TraceScene scene = anyMesh.scene();
  for (const uint32_t rayCount : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 16u, 30u, 31u, 33u, 100u, 1024u})
    for (const ConeOptions& options : {ConeOptions{rayCount},
                                       {.rayCount = rayCount, .outlierDeviations = 0.3},
                                       {.rayCount = rayCount, .outlierDeviations = 2.5},
                                       {.rayCount = rayCount, .definition = Definition::Cgal}}) {
      const Cone cone = makeCone(options);
      for (const InstructionSet instructionSet : instructionSets()) {
        LaneCones lanes(cone, scene, instructionSet);
        for (int turn = 0; turn < 20; ++turn) {
          for (auto& row : lanes.lengths())
            for (size_t lane = 0; lane < LaneCones::kWidth; ++lane) {
              // Lane 0 has no valid ray, lane 1 has every one, lane 2 many ties.
              const bool isValid = lane > 0 && (lane == 1 || random.real() < 0.7);
              const double length = lane == 2 ? std::floor(4 * random.real()) : random.real() * random.real();
              row[lane] = isValid ? length : kInfinity;
            }
          const auto values = lanes.values();
          CHECK(std::isnan(values[0]));
          for (size_t lane = 1; lane < LaneCones::kWidth; ++lane) {
            const double expected = valueOfLane(cone, lanes.lengths(), lane);
            CHECK((values[lane] == expected || (std::isnan(values[lane]) && std::isnan(expected))));
          }
        }
      }
    }
}

namespace {

double distanceToPlane(const TraceScene& scene, uint32_t face, const Vec3d& origin, const Vec3d& direction) {
  const Vec3d& normal = scene.geometry.normals[face];
  return (dot(normal, scene.originOf(face)) - dot(normal, origin)) / dot(normal, direction);
}

void checkLengths(const ConeOptions& options) {
  Random random(8);
  const TracedMesh traced(shapes::jittered(shapes::icosphere(2), 0.1, 4));
  const TraceScene scene = traced.scene();
  const Cone cone = makeCone(options);
  const ConeLanes cones = randomCones(traced, cone, random);
  std::vector<LaneHits> hits(cone.directions.size());
  for (size_t ray = 0; ray < hits.size(); ++ray)
    for (size_t lane = 0; lane < LaneCones::kWidth; ++lane) {
      const auto face = static_cast<uint32_t>(random.real() * static_cast<double>(traced.mesh.faceCount()));
      const double length = distanceToPlane(scene, face, cones.origins[lane], cones.directions[ray][lane]);
      const double off = std::array{0.0, 5e-5, -5e-5, 8e-5, -8e-5}[(ray + lane) % 5];  // 2^-14 is 6.1e-5.
      hits[ray].faces[lane] = (ray + lane) % 7 == 0 ? kNoFace : face;
      hits[ray].distances[lane] = static_cast<float>(length + off);
    }
  for (const InstructionSet instructionSet : instructionSets()) {
    LaneCones lanes(cone, scene, instructionSet);
    lanes.measure(cones.frames, hits);
    size_t validCount = 0, keptDistanceCount = 0;
    for (size_t lane = 0; lane < LaneCones::kWidth; ++lane) {
      for (size_t ray = 0; ray < hits.size(); ++ray) {
        const double length = lanes.lengths()[ray][lane];
        const uint32_t face = hits[ray].faces[lane];
        if (face == kNoFace) {
          CHECK(length == kInfinity);
          continue;
        }
        const double onPlane = distanceToPlane(scene, face, cones.origins[lane], cones.directions[ray][lane]);
        const double distance = hits[ray].distances[lane];
        if (isFalseHit(cone, cones.normals[lane], cones.directions[ray][lane], scene.geometry.normals[face])) {
          CHECK(length == kInfinity);
          continue;
        }
        const bool isNear = std::abs(onPlane - distance) <= 0x1p-14;
        CHECK(length == (isNear ? onPlane : distance));
        ++validCount;
        keptDistanceCount += !isNear;
      }
    }
    CHECK(validCount > 50);
    CHECK(keptDistanceCount > 10);
  }
}

}  // namespace

TEST_CASE("lengths are those to the planes of hits in double, but for slivers, misses and false hits") {
  checkLengths({});
  checkLengths({.definition = Definition::Cgal});
}
