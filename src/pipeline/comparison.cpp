#include "pipeline/comparison.h"

#include <algorithm>
#include <cmath>

#include "core/free_memory.h"
#include "pipeline/wall_changes.h"

namespace asdfvk {
namespace {

// Progress after the former thickness of all faces.
constexpr double kFacesProgress = 0.8;

/// The former thickness at a place. Two thicknesses that the greatest sections limit are the same if their ranges do
/// not tell them apart.
double formerThicknessOf(const ThicknessRange& now, const ThicknessRange& former) {
  return now.low <= former.high && former.low <= now.high ? now.low : former.low;
}

}  // namespace

std::vector<double> compareVersions(const MeasuredVersion& now, const MeasuredVersion& former,
                                    const RunControl& control) {
  const PreparedMesh& prepared = now.computation.prepared;
  PlacedPoints placed;
  for (const uint32_t face : prepared.traceableFaces) {
    if (std::isnan(now.thickness.atBarycentre[face])) continue;
    if (!now.computation.region.contains(prepared.mesh.inputFaceOf(face))) continue;
    placed.add(now, face, prepared.geometry.barycentres[face]);
    placed.thickness.push_back(rangeAtBarycentre(now, face));
  }
  std::vector<Counterpart> found = counterpartsOf(placed, former, control.part(0, kFacesProgress));
  std::vector<Counterpart> counterparts(prepared.mesh.faceCount());
  std::vector<double> thickness(prepared.mesh.faceCount(), kNoValue);
  for (size_t i = 0; i < found.size(); ++i) {
    counterparts[placed.faces[i]] = found[i];
    if (found[i].face != kNoFace)
      thickness[placed.faces[i]] = formerThicknessOf(placed.thickness[i], found[i].thickness);
  }
  freeMemory(found);
  freeMemory(placed);
  setWallChanges(now, former, counterparts, control.withoutProgress());
  control.checkpoint(1);
  return thickness;
}

}  // namespace asdfvk
