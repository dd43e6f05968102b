#include "pipeline/surface_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.h"
#include "trace/adaptive_chunks.h"
#include "trace/greatest_section.h"
#include "trace/reference_tracer.h"
#include "trace/seed_order.h"
#include "trace/solids.h"
#include "trace/wall_tree.h"

namespace asdfvk {
namespace {

constexpr size_t kFirstChunkSize = 4096, kBlockSize = 256;
// Points with a greater normalised coordinate are not on the surface.
constexpr double kMaxCoordinate = 2;
// Normalised: the nearest point is a vertex, up to rounding.
constexpr double kVertexReach = 1e-12;
// Progress after the nearest triangles, and, at known faces, after the first greatest sections and after the balls.
constexpr double kNearestDone = 0.3, kFirstSectionsDone = 0.2, kBallsDone = 0.8;

ChunkSize chunkSizeOf(size_t count) { return {kFirstChunkSize, std::max<size_t>(count, 1)}; }

/// Calls work(i) for each i below `count`, in parallel, with checkpoints in between.
template <typename Work>
void forEachPoint(size_t count, const RunControl& control, const Work& work) {
  forEachChunk(count, chunkSizeOf(count), control,
               [&](size_t begin, size_t end) { forEachInParallel(end - begin, [&](uint32_t i) { work(begin + i); }); });
}

}  // namespace

void findNearestPoints(const PreparedScene& scene, std::span<const Vec3d> points, const RunControl& control,
                       FunctionRef<void(size_t, const SurfacePoint&)> take) {
  const TraceScene view = scene.view();
  forEachPoint(points.size(), control, [&](size_t i) {
    const Vec3d p = scene.bvh.normalization.toNormalized(points[i]);
    take(i, nearestSurfacePoint(view, p, 0, [](uint32_t face) { return face; }));
  });
}

void findNearestPoints(const PreparedScene& scene, std::span<const Vec3d> points, std::span<const Vec3d> normals,
                       const RunControl& control, FunctionRef<void(size_t, const SurfacePoint&)> take) {
  const TraceScene view = scene.view();
  forEachPoint(points.size(), control, [&](size_t i) {
    const Vec3d p = scene.bvh.normalization.toNormalized(points[i]);
    take(i, nearestSurfacePoint(view, p, 0, [&](uint32_t face) {
           return dot(normals[i], scene.prepared.geometry.normals[face]) > 0 ? face : kNoFace;
         }));
  });
}

bool isBehindSurface(const PreparedScene& scene, const Vec3d& point, const SurfacePoint& nearest) {
  const TraceScene view = scene.view();
  const PlaneTriangle triangle = triangleOf(view, nearest.face);
  const auto& [a, b, c] = triangle.corners;
  if (std::min({length(nearest.point - a), length(nearest.point - b), length(nearest.point - c)}) <= kVertexReach) {
    const Vec3d p = scene.bvh.normalization.toNormalized(point), way = (a + b + c) / 3.0 - p;
    const RayHit hit = nearestHitFromAnywhere(view, p, way / length(way), kNoFace, 0);
    if (hit.face != kNoFace) return dot(way, view.geometry.normals[hit.face]) > 0;
  }
  return nearest.side < 0;
}

std::vector<RayHit> findFirstHits(const PreparedScene& scene, std::span<const Vec3d> origins,
                                  std::span<const Vec3d> directions, const RunControl& control) {
  const TraceScene view = scene.view();
  std::vector<RayHit> hits(origins.size());
  forEachPoint(hits.size(), control, [&](size_t i) {
    const Vec3d origin = scene.bvh.normalization.toNormalized(origins[i]);
    hits[i] = nearestHitFromAnywhere(view, origin, directions[i], kNoFace, 0);
  });
  return hits;
}

std::vector<double> thicknessAtPoints(const JudgedSurface& surface, std::span<const Vec3d> points,
                                      std::span<const Vec3d> normals, const ThicknessOptions& options,
                                      const RunControl& control) {
  std::vector<uint32_t> nearest(points.size());
  findNearestPoints(surface.scene(), points, control.part(0, kNearestDone),
                    [&](size_t i, const SurfacePoint& found) { nearest[i] = found.face; });
  const std::vector<ThicknessRange> ranges =
      thicknessRangesAt(surface, points, normals, nearest, options, control.part(kNearestDone, 1));
  std::vector<double> values(ranges.size());
  std::ranges::transform(ranges, values.begin(), &ThicknessRange::low);
  return values;
}

std::vector<ThicknessRange> thicknessRangesAt(const JudgedSurface& surface, std::span<const Vec3d> points,
                                              std::span<const Vec3d> normals, std::span<const uint32_t> faces,
                                              const ThicknessOptions& options, const RunControl& control) {
  if (points.empty()) return {};
  const TraceScene view = surface.scene().view();
  const Normalization& unit = view.bvh.normalization;
  const Solids& solids = surface.solids();
  std::vector<uint8_t> isWanted(solids.isClosed.size());
  for (const uint32_t face : faces)
    if (face != kNoFace) isWanted[solids.solidOf[face]] = solids.isClosed[solids.solidOf[face]];
  std::vector<GreatestSection> sections =
      findGreatestSections(view, solids.solidOf, isWanted, kFirstSection, control.part(0, kFirstSectionsDone));
  const WallTree tree(view, makeOpposingWalls(options), &solids);
  // Normalised diameters, infinite without a wall.
  std::vector<double> values(points.size(), std::numeric_limits<double>::quiet_NaN());
  // In the order of the hierarchy, consecutive points are near the same walls.
  const SeedOrder seedOrder(view);
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < points.size(); ++i) {
    const Vec3d p = unit.toNormalized(points[i]);
    if (faces[i] != kNoFace && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kMaxCoordinate)
      order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return seedOrder.primitiveOf(faces[a]) < seedOrder.primitiveOf(faces[b]);
  });
  const auto measure = [&](std::span<const uint32_t> block) {
    std::vector<BallQuery> queries(block.size());
    for (size_t i = 0; i < block.size(); ++i) {
      const Vec3d p = unit.toNormalized(points[block[i]]);
      queries[i] = {{{p, p, p}, normals[block[i]]}, p, {}, {}, solids.bodyOf(faces[block[i]])};
      queries[i].atPoint.ball.diameter = sections[solids.solidOf[faces[block[i]]]].bound;
      queries[i].least.ball.diameter = 0;  // Not needed.
    }
    tree.shrink(queries);
    for (size_t i = 0; i < block.size(); ++i)
      values[block[i]] = queries[i].atPoint.wall == kNoFace ? std::numeric_limits<double>::infinity()
                                                            : queries[i].atPoint.ball.diameter;
  };
  const RunControl ofBalls = control.part(kFirstSectionsDone, kBallsDone);
  forEachChunk(order.size(), chunkSizeOf(order.size()), ofBalls, [&](size_t begin, size_t end) {
    const std::span<const uint32_t> chunk = std::span(order).subspan(begin, end - begin);
    forEachTask((chunk.size() + kBlockSize - 1) / kBlockSize, [&](size_t block) {
      const size_t first = block * kBlockSize;
      measure(chunk.subspan(first, std::min(kBlockSize, chunk.size() - first)));
    });
  });
  std::fill(isWanted.begin(), isWanted.end(), uint8_t{0});
  for (const uint32_t i : order)
    if (const uint32_t solid = solids.solidOf[faces[i]]; sections[solid].caps(values[i])) isWanted[solid] = 1;
  searchInexactSections(view, solids.solidOf, isWanted, kQuickSection, control.part(kBallsDone, 1), sections);
  const auto inMesh = [&](double diameter) { return std::isfinite(diameter) ? unit.toMeshLength(diameter) : kNoValue; };
  std::vector<ThicknessRange> ranges(points.size(), {kNoValue, kNoValue});
  for (const uint32_t i : order) {
    const GreatestSection& cap = sections[solids.solidOf[faces[i]]];
    const bool isCapped = cap.caps(values[i]);
    ranges[i] = {inMesh(cap.capped(values[i])), inMesh(isCapped ? std::min(values[i], cap.bound) : values[i]),
                 isCapped};
  }
  return ranges;
}

}  // namespace asdfvk
