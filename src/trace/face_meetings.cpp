#include "trace/face_meetings.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <tuple>

#include "bvh/leaf_faces.h"
#include "core/box3.h"
#include "core/parallel.h"
#include "trace/adaptive_chunks.h"

namespace asdfvk {
namespace {

constexpr size_t kFirstChunkSize = 16384, kGrain = 256;
// Number of neighbouring faces for which the hierarchy is traversed together.
constexpr size_t kWalkFaceCount = 16;
// Shorter segments are points.
constexpr double kLeastLength = 2 * kContactDistance;
// Faces with a smaller cosine of their normals may lie on each other.
constexpr double kOppositeCosine = -1 + 1e-6;

// By half of the distance of contact on both sides, and by the rounding of coordinates.
constexpr float kHalfContact = static_cast<float>(0.625 * kContactDistance);
constexpr Vec3f kReach{kHalfContact, kHalfContact, kHalfContact};

struct BoxedFace {
  uint32_t face = 0;
  Box3f box;
};

bool overlap(const Box3f& a, const Box3f& b) {
  // Branch-free, because it is unpredictable which axis separates two boxes.
  return ((a.min.x <= b.max.x) & (a.min.y <= b.max.y) & (a.min.z <= b.max.z) & (b.min.x <= a.max.x) &
          (b.min.y <= a.max.y) & (b.min.z <= a.max.z)) != 0;
}

using Heights = std::array<double, 3>;

/// The heights of the corners of a triangle above the plane of another one; 0 within kContactDistance of the plane.
Heights heightsOf(const PlaneTriangle& triangle, const PlaneTriangle& plane) {
  Heights heights;
  for (size_t k = 0; k < 3; ++k) {
    heights[k] = dot(triangle.corners[k] - plane.corners[0], plane.normal);
    if (std::abs(heights[k]) <= kContactDistance) heights[k] = 0;
  }
  return heights;
}

bool isOnOneSide(const Heights& h) { return (h[0] > 0 && h[1] > 0 && h[2] > 0) || (h[0] < 0 && h[1] < 0 && h[2] < 0); }
bool isInPlane(const Heights& h) { return h[0] == 0 && h[1] == 0 && h[2] == 0; }

/// The part of a triangle in a plane.
struct Chord {
  Vec3d from, to;
  bool isEdge = false;
};

std::optional<Chord> chordOf(const PlaneTriangle& triangle, const Heights& heights) {
  std::array<Vec3d, 3> points;
  size_t count = 0, zeroCount = 0;
  for (size_t k = 0; k < 3; ++k) {
    if (heights[k] == 0) {
      ++zeroCount;
      points[count++] = triangle.corners[k];
    }
    const size_t next = (k + 1) % 3;
    if (heights[k] * heights[next] < 0 && count < 3)
      points[count++] = triangle.corners[k] +
                        heights[k] / (heights[k] - heights[next]) * (triangle.corners[next] - triangle.corners[k]);
  }
  if (count != 2) return {};
  return Chord{points[0], points[1], zeroCount == 2};
}

/// Whether two triangles in one plane overlap in an area, by the separating axes.
bool overlapInPlane(const PlaneTriangle& a, const PlaneTriangle& b) {
  const auto isSeparated = [&](const PlaneTriangle& edges, const PlaneTriangle& other) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec3d &from = edges.corners[k], edge = edges.corners[(k + 1) % 3] - from;
      const Vec3d inwards = cross(edges.normal, edge);
      double farthest = -1;
      for (const Vec3d& corner : other.corners) farthest = std::max(farthest, dot(inwards, corner - from));
      if (farthest <= kLeastLength * length(edge)) return true;
    }
    return false;
  };
  return !isSeparated(a, b) && !isSeparated(b, a);
}

/// Whether one of the triangles lies within kContactDistance of the other one, with the opposite normal.
bool touches(const PlaneTriangle& a, const PlaneTriangle& b) {
  return dot(a.normal, b.normal) < kOppositeCosine && (isInPlane(heightsOf(a, b)) || isInPlane(heightsOf(b, a))) &&
         overlapInPlane(a, b);
}

struct Meeting {
  uint8_t bit = 0;
  std::optional<FaceCut> ofFirst, ofSecond;
};

Meeting meetingOf(const PlaneTriangle& a, const PlaneTriangle& b) {
  const Heights ofA = heightsOf(a, b);
  if (isOnOneSide(ofA)) return {};
  const Heights ofB = heightsOf(b, a);
  if (isOnOneSide(ofB)) return {};
  if (dot(a.normal, b.normal) < kOppositeCosine && (isInPlane(ofA) || isInPlane(ofB)))
    return {overlapInPlane(a, b) ? kTouched : uint8_t{0}, {}, {}};
  const std::optional<Chord> first = chordOf(a, ofA), second = chordOf(b, ofB);
  if (!first || !second) return {};
  const double size = length(first->to - first->from);
  if (size <= kLeastLength) return {};
  const Vec3d direction = (first->to - first->from) / size;
  const double from = dot(second->from - first->from, direction), to = dot(second->to - first->from, direction);
  const double begin = std::max(0.0, std::min(from, to)), end = std::min(size, std::max(from, to));
  if (end - begin <= kLeastLength) return {};
  Meeting meeting{first->isEdge && second->isEdge ? kTouched : kCrossed, {}, {}};
  if (!first->isEdge) meeting.ofFirst = {0, first->from + begin * direction, first->from + end * direction};
  if (!second->isEdge) {
    const auto at = [&](double t) { return second->from + (t - from) / (to - from) * (second->to - second->from); };
    meeting.ofSecond = {0, at(begin), at(end)};
  }
  return meeting;
}

}  // namespace

std::span<const FaceCut> FaceMeetings::cutsOf(uint32_t face) const {
  const auto range = std::equal_range(cuts.begin(), cuts.end(), FaceCut{.face = face},
                                      [](const FaceCut& a, const FaceCut& b) { return a.face < b.face; });
  return {range.first, range.second};
}

FaceMeetings findFaceMeetings(const TraceScene& scene, const DualGraph& graph, std::span<const uint32_t> componentOf,
                              std::span<const uint8_t> isWanted, const RunControl& control) {
  FaceMeetings meetings{std::vector<uint8_t>(scene.mesh.faceCount()), {}, {}};
  std::mutex mutex;
  const auto record = [&](uint32_t face, uint32_t other, Meeting& meeting) {
    for (const uint32_t each : {face, other})
      std::atomic_ref(meetings.bits[each]).fetch_or(meeting.bit, std::memory_order_relaxed);
    const std::pair<uint32_t, uint32_t> components = std::minmax(componentOf[face], componentOf[other]);
    const std::lock_guard lock(mutex);
    if (meeting.ofFirst) meetings.cuts.push_back({face, meeting.ofFirst->from, meeting.ofFirst->to});
    if (meeting.ofSecond) meetings.cuts.push_back({other, meeting.ofSecond->from, meeting.ofSecond->to});
    if (components.first != components.second &&
        (meetings.components.empty() || meetings.components.back() != components))
      meetings.components.push_back(components);
  };
  const auto meet = [&](uint32_t face, uint32_t other) {
    const std::span<const uint32_t> neighbours = graph.neighboursOf(face);
    if (std::find(neighbours.begin(), neighbours.end(), other) != neighbours.end()) {
      if (dot(scene.geometry.normals[face], scene.geometry.normals[other]) >= kOppositeCosine) return;
      if (!touches(triangleOf(scene, face), triangleOf(scene, other))) return;
      Meeting folded{.bit = kTouched};
      record(face, other, folded);
      return;
    }
    Meeting meeting = meetingOf(triangleOf(scene, face), triangleOf(scene, other));
    if (meeting.bit != 0) record(face, other, meeting);
  };
  const auto boxed = [&](uint32_t face) {
    BoxedFace result{.face = face};
    for (const Vec3d& corner : scene.bvh.normalization.normalizedCorners(scene.mesh, face))
      result.box.add(Vec3f(corner));
    result.box.min = result.box.min - kReach;
    result.box.max = result.box.max + kReach;
    return result;
  };
  const std::span<const uint32_t> faces = scene.bvh.primitiveFaces;
  forEachChunk(faces.size(), ChunkSize(kFirstChunkSize, faces.size()), control, [&](size_t begin, size_t end) {
    forEachRange(end - begin, kGrain, [&](size_t first, size_t last) {
      std::vector<BoxedFace> block, near;
      for (size_t i = begin + first; i < begin + last; i += kWalkFaceCount) {
        block.clear();
        near.clear();
        Box3f box;
        for (const uint32_t face : faces.subspan(i, std::min(kWalkFaceCount, begin + last - i)))
          if (isWanted[face] != 0) box.add(block.emplace_back(boxed(face)).box);
        if (block.empty()) continue;
        const auto reaches = [&](const BvhNode& node) { return overlaps(node, box); };
        forEachLeafFace(scene.bvh, reaches, [&](uint32_t face) {
          if (isWanted[face] != 0) near.push_back(boxed(face));
          return true;
        });
        for (const BoxedFace& one : block)
          for (const BoxedFace& other : near)
            if (other.face > one.face && overlap(one.box, other.box)) meet(one.face, other.face);
      }
    });
  });
  for (uint32_t face = 0; face < meetings.bits.size(); ++face)
    meetings.bits[face] = meetings.bits[scene.representatives[face]];
  const auto order = [](const FaceCut& cut) {
    return std::tuple(cut.face, cut.from.x, cut.from.y, cut.from.z, cut.to.x, cut.to.y, cut.to.z);
  };
  std::sort(meetings.cuts.begin(), meetings.cuts.end(),
            [&](const FaceCut& a, const FaceCut& b) { return order(a) < order(b); });
  std::sort(meetings.components.begin(), meetings.components.end());
  meetings.components.erase(std::unique(meetings.components.begin(), meetings.components.end()),
                            meetings.components.end());
  return meetings;
}

}  // namespace asdfvk
