#include "pipeline/thickness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/solids.h"

namespace asdfvk {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
// Faces of one call of the shrinker: their balls need 9 MiB.
constexpr size_t kBlockFaceCount = size_t{1} << 16;
// Part of the progress in which the greatest sections are found.
constexpr double kSectionsProgress = 0.2;

GreatestSection toMesh(const Normalization& normalization, const GreatestSection& section) {
  return {section.centre / normalization.scale + normalization.centre, normalization.toMeshLength(section.diameter),
          normalization.toMeshLength(section.bound)};
}

}  // namespace

FaceThickness measureThickness(const Computation& computation, const RunControl& control) {
  const WallTree tree(computation.scene, makeOpposingWalls(computation.options.thickness.wallAngleDegrees));
  const TraceScene& scene = computation.scene;
  const Solids solids = findSolids(computation.prepared.mesh, computation.prepared.components);
  const std::vector<GreatestSection> sections = findGreatestSections(scene, solids.solidOf, solids.isClosed, control.part(0, kSectionsProgress));
  const size_t faceCount = computation.prepared.mesh.faceCount();
  FaceThickness thickness{std::vector<double>(faceCount, kNoValue), std::vector<double>(faceCount, kNoValue),
                          std::vector<uint32_t>(faceCount, kNoFace), {}};
  const std::span<const uint32_t> faces = computation.domain.traceableFaces;
  const auto lengthOf = [&](const FaceBalls& balls, const InscribedBall& ball) {
    const double greatest = sections[solids.solidOf[balls.face]].diameter;
    const double diameter = ball.wall == kNoFace ? greatest : ball.ball.diameter;
    return diameter < kUnlimited ? scene.bvh.normalization.toMeshLength(diameter) : kNoValue;
  };
  for (size_t begin = 0; begin < faces.size(); begin += kBlockFaceCount) {
    const size_t end = std::min(faces.size(), begin + kBlockFaceCount);
    std::vector<FaceBalls> balls(end - begin);
    for (size_t i = begin; i < end; ++i) {
      balls[i - begin].face = faces[i];
      balls[i - begin].atBarycentre.ball.diameter = sections[solids.solidOf[faces[i]]].bound;
      balls[i - begin].least.ball.diameter = sections[solids.solidOf[faces[i]]].bound;
    }
    const auto progressAt = [&](size_t count) {
      return kSectionsProgress + (1 - kSectionsProgress) * static_cast<double>(count) / static_cast<double>(faces.size());
    };
    shrinkFaceBalls(tree, balls, control.part(progressAt(begin), progressAt(end)));
    for (const FaceBalls& each : balls) {
      thickness.atBarycentre[each.face] = lengthOf(each, each.atBarycentre);
      thickness.least[each.face] = lengthOf(each, each.least);
      thickness.leastWalls[each.face] = each.least.wall;
    }
  }
  for (const GreatestSection& section : sections)
    if (section.diameter < kUnlimited &&
        !(thickness.greatestSection && section.diameter <= thickness.greatestSection->diameter))
      thickness.greatestSection = section;
  if (thickness.greatestSection)
    thickness.greatestSection = toMesh(scene.bvh.normalization, *thickness.greatestSection);
  return thickness;
}

std::vector<double> thicknessOfInputFaces(const TriangleMesh& mesh, std::span<const double> values) {
  if (mesh.polygons.isEmpty()) return {values.begin(), values.end()};
  std::vector<double> least(mesh.inputFaceCount(), kNoValue);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    double& value = least[mesh.inputFaceOf(face)];
    if (!(value <= values[face]) && !std::isnan(values[face])) value = values[face];
  }
  return least;
}

}  // namespace asdfvk
