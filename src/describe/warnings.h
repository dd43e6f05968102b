#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asdf_vk/report.h"

namespace asdfvk {

// Functions that make a warning: a sentence, and the values in the sentence as details. src/pipeline/prepared_mesh.cpp
// has one more such function.

/// One warning per kind of defect. isOfPolygons: sentences say "triangles" instead of "faces".
[[nodiscard]] std::vector<Warning> warningsOf(const MeshDefects& defects, bool isOfPolygons);

[[nodiscard]] Warning componentsReversed(uint64_t count);
[[nodiscard]] Warning facesReversed(uint64_t count);

struct MissingValues {
  uint64_t count = 0, faceCount = 0;
  bool isInverted = false;    ///< A face without a value belongs to an inverted component.
  bool isOpen = false;        ///< A face without a value belongs to an open component.
  bool keepsMissing = false;  ///< Faces without a value are not interpolated from connected faces.
};
[[nodiscard]] Warning missingValues(const MissingValues& missing);

/// robustShare: the robust range (1st to 99th percentile of the values), divided by the range of all values.
[[nodiscard]] Warning rangeDominated(double robustShare);
/// The warning for a relative error that is large compared with the error over the range.
[[nodiscard]] Warning rangeDominated(double robustShare, const ErrorEstimate& estimate);

[[nodiscard]] Warning finishedOnCpu(const SolverReport& solver);
[[nodiscard]] Warning notConverged(const SolverReport& solver);

[[nodiscard]] Warning backendReplaced(const std::string& failed, const std::string& next, const Error& failure);
[[nodiscard]] Warning predictedOnCpu(const Error& failure);
[[nodiscard]] Warning solvedOnCpu(const Error& failure);

/// clearShare: share of the pairs of patches that have a clear line of sight.
[[nodiscard]] Warning thinShell(double clearShare);
[[nodiscard]] Warning partCountDiffers(uint32_t requested, uint32_t found);
[[nodiscard]] Warning skippedContent(const std::vector<std::string>& skipped);
[[nodiscard]] Warning negativeVolumes(uint32_t count);
/// step: the distance of neighbouring coordinates. share: the step divided by the diagonal of the bounding box.
[[nodiscard]] Warning coarseCoordinates(double step, double share);

[[nodiscard]] Warning uncertainParts(double agreement);

/// areaShare: share of the area in faces that are larger than half of their shape diameter.
[[nodiscard]] Warning coarseParts(double areaShare);

/// minShare: every component has a smaller share of the area than this.
[[nodiscard]] Warning onlySmallComponents(double minShare, uint64_t partCount);

}  // namespace asdfvk
