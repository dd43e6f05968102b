#include "segment/part_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asdf_vk/error.h"
#include "core/check.h"
#include "core/ordered_sum.h"
#include "core/parallel.h"
#include "segment/normal_filter.h"

namespace asdfvk {
namespace {

constexpr double kMinShareOfMaximum = 1e-4;
constexpr double kConcaveFactor = 3;
/// A face that is folded back on its neighbour by more than this is no concave crease: decimation makes such faces.
constexpr double kMaxConcaveRadians = 2.4;

/// The logarithms of the values. A missing value is replaced by the value of the nearest face with a value.
std::vector<float> fillLogValues(const DualGraph& graph, std::span<const double> values, double logUnit) {
  double largest = -1;
  for (const double value : values)
    if (!std::isnan(value)) largest = std::max(largest, value);
  if (largest < 0) throw Error(ErrorCode::NoValues, "no face has a value, so there is nothing to segment");
  std::vector<float> logs(values.size(), 0);
  if (!(largest > 0)) return logs;
  const double least = std::max(kMinShareOfMaximum * largest, std::numeric_limits<double>::min());
  std::vector<uint32_t> queue;
  std::vector<uint8_t> isSet(values.size(), 0);
  double sum = 0;
  for (uint32_t face = 0; face < values.size(); ++face) {
    if (std::isnan(values[face])) continue;
    logs[face] = static_cast<float>(std::log(std::max(values[face], least)) + logUnit);
    sum += double{logs[face]};
    isSet[face] = 1;
    queue.push_back(face);
  }
  if (queue.size() == values.size()) return logs;
  const auto mean = static_cast<float>(sum / static_cast<double>(queue.size()));
  for (size_t i = 0; i < queue.size(); ++i)
    for (const uint32_t neighbour : graph.neighboursOf(queue[i])) {
      if (isSet[neighbour]) continue;
      isSet[neighbour] = 1;
      logs[neighbour] = logs[queue[i]];
      queue.push_back(neighbour);
    }
  for (uint32_t face = 0; face < values.size(); ++face)
    if (!isSet[face]) logs[face] = mean;
  return logs;
}

/// Returns the corner of f where a common edge of f and g begins. number: which of several common edges, numbered from
/// 0.
uint32_t commonEdge(const Face& f, const Face& g, uint32_t number) {
  const auto isOfG = [&](uint32_t vertex) { return vertex == g[0] || vertex == g[1] || vertex == g[2]; };
  uint32_t last = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t from = f[i], to = f[(i + 1) % 3];
    if (from == to || !isOfG(from) || !isOfG(to)) continue;
    last = i;
    if (number-- == 0) break;
  }
  return last;
}

/// Angle between two unit normals in radians; positive on a concave edge. edge: along the common edge, in the direction
/// of the face with normal p.
double dihedralAngle(const Vec3d& p, const Vec3d& q, const Vec3d& edge) {
  const Vec3d normal = cross(p, q);
  const double angle = std::atan2(length(normal), dot(p, q) + 0.0);  // + 0.0: the angle of zero normals is 0, not pi.
  return dot(normal, edge) > 0 || angle > kMaxConcaveRadians ? -angle : angle;
}

}  // namespace

PartSurface makePartSurface(const TriangleMesh& mesh, const FaceGeometry& geometry, const DualGraph& graph,
                            std::span<const double> values) {
  ASDFVK_CHECK_OP(values.size(), ==, mesh.faces.size());
  const uint32_t faceCount = mesh.faceCount();
  const Normalization box = normalizationOf(geometry.bounds);
  PartSurface surface;
  surface.offsets = graph.offsets;
  surface.areas.resize(faceCount);
  surface.centres.resize(faceCount);
  // In normalised coordinates no area overflows or underflows.
  const auto areaOf = [&](uint32_t face) {
    return geometry.isDegenerate(face) ? 0 : triangleArea(box.normalizedCorners(mesh, face));
  };
  const double area = orderedSum(faceCount, [&](size_t face) { return areaOf(static_cast<uint32_t>(face)); });
  const double unit = area > 0 ? 1 / std::sqrt(area) : 1;
  surface.meshLength = box.toMeshLength(1 / unit);
  surface.logValues = fillLogValues(graph, values, std::log(unit) + std::log(box.scale));
  forEachInParallel(faceCount, [&](uint32_t face) {
    const Vec3d centre = box.toNormalized(geometry.barycentres[face]) * unit;
    surface.centres[face] = isFinite(centre) ? centre : Vec3d{};
    surface.areas[face] = static_cast<float>(areaOf(face) * unit * unit);
  });

  const std::vector<Vec3d> normals = filterNormals(geometry.normals, surface.areas, graph);
  const size_t arcCount = graph.neighbours.size();
  surface.arcs.resize(arcCount);
  surface.creasedArcs.resize(arcCount);
  surface.edgeLengths.resize(arcCount);
  surface.angles.resize(arcCount);
  forEachInParallel(faceCount, [&](uint32_t face) {
    uint32_t number = 0;  // Counts the arcs to the same neighbour.
    for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
      const uint32_t other = graph.neighbours[arc];
      number = arc > graph.offsets[face] && graph.neighbours[arc - 1] == other ? number + 1 : 0;
      const uint32_t corner = commonEdge(mesh.faces[face], mesh.faces[other], number);
      const Vec3d from = box.toNormalized(mesh.vertices[mesh.faces[face][corner]]) * unit,
                  to = box.toNormalized(mesh.vertices[mesh.faces[face][(corner + 1) % 3]]) * unit;
      const Vec3d middle = (from + to) * 0.5;
      const double path = length(surface.centres[face] - middle) + length(surface.centres[other] - middle);
      const double angle = dihedralAngle(normals[face], normals[other], to - from);
      const double crease = kConcaveFactor * std::max(0.0, angle) +
                            std::abs(double{surface.logValues[face]} - double{surface.logValues[other]});
      surface.arcs[arc] = {other, static_cast<float>(path)};
      surface.creasedArcs[arc] = {other, static_cast<float>(path + kCreaseLength * crease)};
      surface.edgeLengths[arc] = static_cast<float>(length(to - from));
      surface.angles[arc] = static_cast<float>(angle);
    }
  });
  return surface;
}

}  // namespace asdfvk
