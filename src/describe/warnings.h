#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asdf_vk/report.h"

namespace asdfvk {

// Every warning but that of inverted components: its sentence, and the values of the sentence as details.

/// One warning per defect found, each with its count; empty for a clean mesh. isOfPolygons: the triangles were cut from
/// polygons, and the sentences call them triangles instead of faces.
[[nodiscard]] std::vector<Warning> warningsOf(const MeshDefects& defects, bool isOfPolygons);

[[nodiscard]] Warning componentsReversed(uint64_t count);

struct MissingValues {
  uint64_t count = 0, faceCount = 0;
  bool isInverted = false;    ///< A face without a value belongs to an inverted component.
  bool isOpen = false;        ///< A face without a value belongs to an open component.
  bool keepsMissing = false;  ///< Faces do not get values from faces connected to them.
};
[[nodiscard]] Warning missingValues(const MissingValues& missing);

/// robustShare: length of the range that holds 98 % of the values, over the length of the range of all values.
[[nodiscard]] Warning rangeDominated(double robustShare);
/// The warning where the relative error is large against the error over the range.
[[nodiscard]] Warning rangeDominated(double robustShare, const ErrorEstimate& estimate);

[[nodiscard]] Warning finishedOnCpu(const SolverReport& solver);
[[nodiscard]] Warning notConverged(const SolverReport& solver);

[[nodiscard]] Warning backendReplaced(const std::string& failed, const std::string& next, const Error& failure);
[[nodiscard]] Warning predictedOnCpu(const Error& failure);
[[nodiscard]] Warning solvedOnCpu(const Error& failure);

/// clearShare: of the pairs of patches with a clear line of sight.
[[nodiscard]] Warning thinShell(double clearShare);
[[nodiscard]] Warning partCountDiffers(uint32_t requested, uint32_t found);
/// minShare: of the area, which no component has.
/// skipped: Mesh::skipped.
[[nodiscard]] Warning skippedContent(const std::vector<std::string>& skipped);

/// agreement: PartsReport::agreement.
[[nodiscard]] Warning uncertainParts(double agreement);

/// areaShare: of faces larger than half of their value.
[[nodiscard]] Warning coarseParts(double areaShare);

[[nodiscard]] Warning onlySmallComponents(double minShare, uint64_t partCount);

}  // namespace asdfvk
