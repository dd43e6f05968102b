#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "core/vec3.h"
#include "mesh/components.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"

/// Segmentation into parts; the number of parts need not be given. Steps: division into patches, lines of sight between
/// patches, merging of pairs in the order of costs, and a graph cut. The merging is done for several numbers of
/// patches, and a consensus of the results is found. docs/segmentation.md has the definition and its sources.
namespace asdfvk {

/// Returns 1 for each segment (in the unit of the mesh) that no face intersects between the end points, else 0.
using LineOfSight = std::function<std::vector<uint8_t>(std::span<const LineSegment>)>;

struct PartsInput {
  const TriangleMesh& mesh;
  const FaceGeometry& geometry;
  const DualGraph& graph;
  const Components& components;
  std::span<const double> values;  ///< #F, not negative; NaN for no value.
};

struct Parts {
  std::vector<uint32_t> partOf;  ///< #F, numbered by ascending mean value.
  uint32_t partCount = 0;
  std::vector<double> areas;  ///< #F, shares of the area of the mesh.
  /// Numbers of parts with the threshold multiplied, and divided, by kPartStabilityFactor.
  uint32_t fewest = 0, most = 0;
  std::vector<PartBoundary> boundaries;  ///< Ascending by the numbers of the parts.
  /// Mean Rand index, weighted by area, of the consensus with the divisions from each number of patches. The index is
  /// computed before small parts are merged and boundaries are cut. Unset if no component has kMinPartArea, because no
  /// divisions are compared.
  std::optional<double> agreement;
  bool isThinShell = false;  ///< A closed thin wall around a cavity, divided without lines of sight.
  /// Mean visibility over pairs of patches of the same component, weighted by the product of their areas.
  double meanSight = 1;
};

/// Numbers the parts, also in `boundaries`, by the mean of their values, weighted by area; parts without a value are
/// the last. values: #F.
void numberByValue(std::span<const double> values, Parts& parts);

/// A share of the area of the mesh. Smaller components are not divided. Smaller parts are merged with a neighbour.
inline constexpr double kMinPartArea = 0.01;

/// Divides a mesh into parts. Components below kMinPartArea are small. If all components are small, each component is a
/// part. If the small components have at most 5 % of the area together, they take the part that is nearest in space. If
/// the small components have more, each of them is a part; but components below kMinPartArea times the largest
/// component take the nearest part. In all other cases a part belongs to one component. With options.partCount there
/// are this many parts, more if there are more components, and fewer if there are fewer faces; small parts are then not
/// merged. The result does not depend on the number of threads. Throws Error{NoValues} if no face has a value, the
/// errors of `sight`, and Error{Cancelled} between steps.
[[nodiscard]] Parts segmentIntoParts(const PartsInput& input, const PartsOptions& options, const LineOfSight& sight,
                                     const RunControl& control = {});

}  // namespace asdfvk
