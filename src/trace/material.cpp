#include "trace/material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "trace/adaptive_chunks.h"
#include "trace/winding_number.h"

namespace asdfvk {
namespace {

// Distance of the samples from a face: less than the distance of contact, so that a sample is not behind a wall that is
// not in contact.
constexpr double kSampleDistance = 0.75 * kContactDistance;
// Pieces of a smaller mean width have no samples of their own.
constexpr double kLeastPieceWidth = 2 * kContactDistance;
constexpr size_t kFirstSampleCount = 1024;

/// The part of a segment inside of a convex polygon, as parameters; empty if begin > end.
std::pair<double, double> clip(const FaceCut& cut, std::span<const Vec3d> polygon, const Vec3d& normal) {
  double begin = 0, end = 1;
  const Vec3d way = cut.to - cut.from;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const Vec3d& from = polygon[k];
    const Vec3d inwards = cross(normal, polygon[(k + 1) % polygon.size()] - from);
    const double height = dot(inwards, cut.from - from), slope = dot(inwards, way);
    if (slope > 0) begin = std::max(begin, -height / slope);
    if (slope < 0) end = std::min(end, -height / slope);
    if (slope == 0 && height < 0) return {1, 0};
  }
  return {begin, end};
}

/// Divides a convex polygon along the line of the cut, if the cut has a part inside of the polygon. Returns the part on
/// the other side of the line, or nothing.
std::vector<Vec3d> split(std::vector<Vec3d>& polygon, const FaceCut& cut, const Vec3d& normal) {
  const double size = length(cut.to - cut.from);
  const auto [begin, end] = clip(cut, polygon, normal);
  if ((end - begin) * size <= kContactDistance) return {};
  const Vec3d across = cross(normal, cut.to - cut.from) / size;
  std::vector<double> heights;
  double least = 0, greatest = 0;
  for (const Vec3d& corner : polygon) {
    const double height = dot(across, corner - cut.from);
    heights.push_back(std::abs(height) <= 0.25 * kContactDistance ? 0 : height);
    least = std::min(least, heights.back());
    greatest = std::max(greatest, heights.back());
  }
  if (least == 0 || greatest == 0) return {};
  std::vector<Vec3d> above, below;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const size_t next = (k + 1) % polygon.size();
    if (heights[k] >= 0) above.push_back(polygon[k]);
    if (heights[k] <= 0) below.push_back(polygon[k]);
    if (heights[k] * heights[next] >= 0) continue;
    const Vec3d p = polygon[k] + heights[k] / (heights[k] - heights[next]) * (polygon[next] - polygon[k]);
    above.push_back(p);
    below.push_back(p);
  }
  polygon = std::move(above);
  return below;
}

/// Area divided by half of the circumference.
double meanWidth(std::span<const Vec3d> polygon, const Vec3d& normal) {
  double area = 0, circumference = 0;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const Vec3d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    area += 0.5 * dot(normal, cross(p - polygon[0], q - polygon[0]));
    circumference += length(q - p);
  }
  return circumference > 0 ? 2 * area / circumference : 0;
}

}  // namespace

Material::Material(const TraceScene& scene, const DualGraph& graph, const Components& components, bool isFlipped,
                   const RunControl& control)
    : scene_(scene), weights_(scene.mesh.faceCount(), 0) {
  const auto boundsSolid = [&](uint32_t component) {
    const Component& each = components.components[component];
    return each.isClosed && each.isConsistentlyWound;
  };
  std::vector<uint8_t> isOfSolid(weights_.size()), isWanted(weights_.size(), 0);
  uint32_t solidCount = 0;
  double volume = 0;
  for (uint32_t c = 0; c < components.components.size(); ++c)
    if (boundsSolid(c)) {
      ++solidCount;
      volume += components.components[c].signedVolume;
    }
  isOutside_ = isFlipped && volume < 0;
  std::vector<std::pair<uint32_t, uint32_t>> ofCopies;
  for (uint32_t face = 0; face < isOfSolid.size(); ++face) {
    isOfSolid[face] = !scene.geometry.isDegenerate(face) && boundsSolid(components.componentOf[face]) ? 1 : 0;
    if (isOfSolid[face] == 0) continue;
    const uint32_t first = scene.representatives[face];
    ++weights_[first];
    isWanted[first] = 1;
    const std::pair<uint32_t, uint32_t> pair = std::minmax(components.componentOf[first], components.componentOf[face]);
    if (pair.first != pair.second && (ofCopies.empty() || ofCopies.back() != pair)) ofCopies.push_back(pair);
  }
  if (solidCount == 0) return;
  meetings_ = findFaceMeetings(scene, graph, components.componentOf, isWanted, control);
  meetings_.components.insert(meetings_.components.end(), ofCopies.begin(), ofCopies.end());
  const bool isFree = std::find_if(meetings_.bits.begin(), meetings_.bits.end(),
                                   [](uint8_t bits) { return bits != 0; }) == meetings_.bits.end();
  // One surface that meets no face: the sign of its volume decides.
  if (isFree && solidCount == 1 && volume != 0 && components.components.size() == 1) {
    if (volume < 0 && !isFlipped) commonKind_ = FaceKind::Inverted;
    return;
  }
  findKinds(graph, isOfSolid, control);
}

void Material::findKinds(const DualGraph& graph, std::span<const uint8_t> isOfSolid, const RunControl& control) {
  const uint32_t faceCount = scene_.mesh.faceCount();
  kinds_.assign(faceCount, FaceKind::Boundary);
  // On a connected part of the surface that meets no face, all faces have one kind. Its largest face is sampled.
  const auto isFree = [&](uint32_t face) { return isOfSolid[face] != 0 && meetings_.bits[face] == 0; };
  DisjointSets sets(faceCount);
  forEachInParallel(faceCount, [&](uint32_t face) {
    if (!isFree(face)) return;
    for (const uint32_t neighbour : graph.neighboursOf(face))
      if (neighbour < face && isFree(neighbour)) sets.join(face, neighbour);
  });
  constexpr uint32_t kNone = UINT32_MAX;
  std::vector<uint32_t> largest(faceCount, kNone), samples;
  for (uint32_t face = 0; face < faceCount; ++face) {
    if (isOfSolid[face] == 0) continue;
    uint32_t& sample = largest[sets.lowestOf(face)];
    if (sample == kNone || scene_.geometry.areas[face] > scene_.geometry.areas[sample]) sample = face;
  }
  for (const uint32_t sample : largest)
    if (sample != kNone) samples.push_back(sample);
  forEachChunk(samples.size(), ChunkSize(kFirstSampleCount, std::max<size_t>(samples.size(), 1)), control,
               [&](size_t begin, size_t end) {
                 forEachInParallel(end - begin, [&](uint32_t i) {
                   const uint32_t face = samples[begin + i];
                   kinds_[face] = kindAt(scene_.originOf(face), scene_.geometry.normals[face]);
                 });
               });
  for (uint32_t face = 0; face < faceCount; ++face)
    if (isOfSolid[face] != 0) kinds_[face] = kinds_[largest[sets.lowestOf(face)]];
}

FaceKind Material::kindAt(const Vec3d& point, const Vec3d& normal) const {
  int inside = windingNumberAt(scene_, weights_, point - kSampleDistance * normal);
  int outside = windingNumberAt(scene_, weights_, point + kSampleDistance * normal);
  if (isOutside_) std::tie(inside, outside) = std::pair(-outside, -inside);
  if (inside < 0 || outside < 0) return FaceKind::Inverted;
  if (outside > 0) return FaceKind::Inside;
  return inside == 0 ? FaceKind::NoThickness : FaceKind::Boundary;
}

bool Material::hasKind(FaceKind kind) const {
  return kinds_.empty() ? commonKind_ == kind : std::find(kinds_.begin(), kinds_.end(), kind) != kinds_.end();
}

std::vector<FacePiece> Material::piecesOf(uint32_t face) const {
  const PlaneTriangle triangle = triangleOf(scene_, face);
  std::vector<std::vector<Vec3d>> polygons{{triangle.corners.begin(), triangle.corners.end()}};
  for (const FaceCut& cut : meetings_.cutsOf(scene_.representatives[face]))
    for (size_t i = 0, count = polygons.size(); i < count; ++i)
      if (std::vector<Vec3d> other = split(polygons[i], cut, triangle.normal); !other.empty())
        polygons.push_back(std::move(other));
  std::vector<FacePiece> pieces;
  for (std::vector<Vec3d>& polygon : polygons) {
    if (meanWidth(polygon, triangle.normal) <= kLeastPieceWidth) continue;
    Vec3d middle{};
    for (const Vec3d& corner : polygon) middle += corner;
    middle = middle / static_cast<double>(polygon.size());
    pieces.push_back({std::move(polygon), kindAt(middle, triangle.normal)});
  }
  return pieces;
}

}  // namespace asdfvk
