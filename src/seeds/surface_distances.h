#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/prefetch.h"
#include "core/unset_vector.h"
#include "mesh/dual_graph.h"

/// Distances between faces along the arcs of the dual graph.
namespace asdfvk {

/// Dihedral angle at which an arc is sqrt(2) long. Concave edges separate the parts of a shape. The shape diameter
/// function changes more across concave edges than across convex edges.
inline constexpr double kConcaveAngleDegrees = 10;
inline constexpr double kConvexAngleDegrees = 20;

/// Limits of the length of an arc on any mesh.
inline constexpr float kMinArcLength = 0x1p-20f;
inline constexpr float kMaxArcLength = 0x1p+20f;

/// The length of each arc, in the order of graph.neighbours and equal in both directions. It is sqrt(1 + (a / s)^2),
/// where a is the dihedral angle of the edge and s one of the constants above. Lengths have no unit; the length is 1
/// between coplanar faces. arcAngles: see arcAngles(). A degenerate face counts as coplanar with its neighbours.
[[nodiscard]] UnsetVector<float> arcLengths(std::span<const float> arcAngles);

/// The distance of each face to the nearest of a growing set of seeds. The search for shortest paths from a new seed
/// does not enter faces that are at least as near to an older seed. The time of a new seed is proportional to the
/// number of faces to which it is the nearest seed. The graph and the lengths must outlive this object.
class SurfaceDistances {
 public:
  static constexpr float kUnreached = std::numeric_limits<float>::infinity();

  /// arcLengths: aligned with graph.neighbours, positive, the same in both directions. Starts without seeds.
  SurfaceDistances(const DualGraph& graph, std::span<const float> arcLengths);

  /// Adds seeds. After the call, each distance below `limit` is exact; larger distances may be overestimated.
  /// Precondition: limits do not grow from call to call until clear().
  void add(std::span<const uint32_t> seeds, float limit);

  /// The distance of a face; 0 for a seed.
  [[nodiscard]] float at(uint32_t face) const { return distances_[face]; }

  /// Recommended number of faces between the prefetch and the use of a face, for faces in random order in memory.
  static constexpr size_t kPrefetchDistance = 16;
  /// Prefetches the memory that at(face) and the addition of the face access first.
  void prefetch(uint32_t face) const {
    prefetchMemory(&distances_[face]);
    prefetchMemory(&graph_.offsets[face]);
  }
  /// Prefetches the memory that the addition of the face accesses next. Call this function some time after prefetch().
  void prefetchArcs(uint32_t face) const {
    prefetchMemory(graph_.neighbours.data() + graph_.offsets[face]);
    prefetchMemory(arcLengths_.data() + graph_.offsets[face]);
  }

  void clear();

 private:
  struct Pending {
    float distance = 0;
    uint32_t face = 0;
    uint32_t parent = 0;  ///< The face before `face` on the path, or `face` itself.
  };

  /// Calls put(Pending) for each neighbour to which the path over this face is shorter than its distance and than
  /// `limit`.
  template <typename Put>
  void visit(const Pending& from, float limit, const Put& put);

  const DualGraph& graph_;
  std::span<const float> arcLengths_;
  std::vector<float> distances_;  ///< #F
  std::vector<Pending> pending_;  ///< Empty between calls. A member, so that its memory is reused.
};

/// The faces around a face by ascending distance (Dijkstra's algorithm), for one centre after another; the memory is
/// reused. The graph and the lengths must outlive this object.
class SurfaceBall {
 public:
  /// arcLengths: aligned with graph.neighbours, positive.
  SurfaceBall(const DualGraph& graph, std::span<const float> arcLengths);

  struct Member {
    float distance = 0;  ///< Distance from the centre.
    uint32_t face = 0;
  };

  /// Starts again around `centre`, which is the first member.
  void startAt(uint32_t centre);
  /// Sets `member` to the next nearest face. Returns false after the last face of the centre's component. The order of
  /// equal distances is unspecified but deterministic.
  [[nodiscard]] bool next(Member& member);

 private:
  const DualGraph& graph_;
  std::span<const float> arcLengths_;
  std::vector<float> distances_;   ///< #F; infinite except for the faces in touched_.
  std::vector<uint32_t> touched_;  ///< Faces that have a distance since startAt().
  std::vector<Member> heap_;
};

}  // namespace asdfvk
