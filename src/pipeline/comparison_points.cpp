#include "pipeline/comparison_points.h"

#include <algorithm>
#include <cmath>

namespace asdfvk {

void PlacedPoints::add(const MeasuredVersion& version, uint32_t face, const Vec3d& point) {
  points.push_back(point);
  normals.push_back(version.computation.prepared.geometry.normals[face]);
  faces.push_back(face);
}

ThicknessRange rangeAtBarycentre(const MeasuredVersion& version, uint32_t face) {
  const Normalization& unit = version.surface.scene().bvh.normalization;
  const GreatestSection& cap = version.thickness.caps[version.surface.solids().solidOf[face]];
  const double value = version.thickness.atBarycentre[face];
  const bool isCapped = std::isfinite(cap.diameter) && value == unit.toMeshLength(cap.diameter);
  return {value, isCapped ? unit.toMeshLength(cap.bound) : value, isCapped};
}

void measure(const MeasuredVersion& version, PlacedPoints& placed, const RunControl& control) {
  placed.thickness = thicknessRangesAt(version.surface, placed.points, placed.normals, placed.faces,
                                       version.computation.options.thickness, control);
  for (size_t i = 0; i < placed.size(); ++i)
    if (version.surface.kindOf(placed.faces[i]) == FaceKind::NoThickness) placed.thickness[i] = {0, 0};
}

std::vector<Counterpart> counterpartsOf(const PlacedPoints& placed, const MeasuredVersion& other,
                                        const RunControl& control) {
  std::vector<Counterpart> found(placed.size());
  std::vector<double> distances(placed.size());
  const Normalization& unit = other.surface.scene().bvh.normalization;
  findNearestPoints(other.surface.scene(), placed.points, placed.normals, control.part(0, 0.5),
                    [&](size_t i, const SurfacePoint& nearest) {
                      if (nearest.face == kNoFace) return;
                      found[i] = {nearest.face, nearest.point};
                      distances[i] = unit.toMeshLength(nearest.distance);
                    });
  PlacedPoints opposite;
  std::vector<size_t> indices;
  for (size_t i = 0; i < found.size(); ++i) {
    if (found[i].face == kNoFace) continue;
    indices.push_back(i);
    opposite.add(other, found[i].face, unit.toMesh(found[i].point));
  }
  measure(other, opposite, control.part(0.5, 1));
  for (size_t k = 0; k < indices.size(); ++k) {
    const size_t i = indices[k];
    found[i].thickness = opposite.thickness[k];
    const double reach = std::max(found[i].thickness.high, placed.thickness[i].high) / 2;
    if (!(distances[i] <= reach + unit.contactLength())) found[i] = {};
  }
  return found;
}

}  // namespace asdfvk
