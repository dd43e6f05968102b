#pragma once

#include <array>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "trace/contact_faces.h"
#include "trace/embree/embree_api.h"
#include "trace/embree/lane_cones.h"

// The Embree scene, and tracing in groups of eight cones. Lengths are in normalised units.
namespace asdfvk {

struct EmbreeRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeRelease>;

enum class EmbreeMode {
  Fastest,  ///< Rays may pass between adjacent triangles: 1 of 600,000 on a scanned model, 1 of 26 on a cylinder.
  Robust,   ///< No ray passes between adjacent triangles; a fifth slower.
};

/// Embree's hierarchy over the primitives of the Bvh: primitive i has index i in both. Normalised coordinates, float32.
/// Built on all threads, with the same bits for any number of them.
class EmbreeScene {
 public:
  /// Throws Error{Device}.
  EmbreeScene(const TraceScene& scene, EmbreeMode mode);

  [[nodiscard]] RTCScene get() const { return scene_.get(); }
  [[nodiscard]] EmbreeMode mode() const { return mode_; }

 private:
  EmbreeMode mode_;
  // In this order: the scene is destroyed before its device.
  EmbreeDevice device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeRelease> scene_;
};

/// Data shared by all cones of a trace. Views only.
struct EmbreeCones {
  const TraceScene& scene;
  const Cone& cone;
  std::span<const TrianglePlane> planes;
  const EmbreeScene& embree;
  ContactFaces& contacts;
};

/// A cone to trace, and the output array of its hits.
struct EmbreeSeed {
  ConeStart start;
  uint32_t primitive = kNoFace;  ///< The face that the origin lies on; kNoFace: none.
  bool fitsFloat = true;         ///< Otherwise the cone is not cast, and isDoubtful().
  std::span<ConeHit> hits;       ///< One per ray, or empty.
};

/// Traces up to eight neighbouring cones together: each packet holds the same ray of all of them. Embree traverses for
/// each ray alone (intersect8()), so that hits do not depend on the other cones. Keeps its memory from call to call.
class EmbreeConeGroup {
 public:
  static constexpr size_t kWidth = LaneHits::kWidth;

  explicit EmbreeConeGroup(const EmbreeCones& cones);

  /// Adds a cone for the next trace(). Precondition: fewer than kWidth cones.
  void add(const EmbreeSeed& seed);
  [[nodiscard]] size_t size() const { return size_; }
  [[nodiscard]] const EmbreeSeed& seed(size_t lane) const { return seeds_[lane]; }

  /// Computes the values of all cones that were added.
  void trace();
  void clear();

  /// The value in normalised units, or kNoValue. Meaningless when isDoubtful().
  [[nodiscard]] double value(size_t lane) const { return values_[lane]; }
  /// Whether float32 may be too coarse for the cone, so that the reference must trace it. True without
  /// EmbreeSeed::fitsFloat, if the value is too small, if a ray hit its own face or the outer side of
  /// a face in contact, or if leavesSurface().
  [[nodiscard]] bool isDoubtful(size_t lane) const { return isDoubtful_[lane]; }
  /// Whether a ray had no hit or hit the outer side of a face. In a closed surface this means that the ray passed
  /// between two triangles. False in robust mode and for cones that were not cast. Not detected: such a ray inside a
  /// second shell, or one that passed between triangles twice.
  [[nodiscard]] bool leavesSurface(size_t lane) const;

 private:
  EmbreeCones cones_;
  LaneFrames frames_;
  LaneCones lanes_;
  RTCRayHit8 packet_{};
  alignas(32) std::array<int, kWidth> isActive_{};  // -1 or 0, as Embree expects.
  size_t size_ = 0;
  std::array<EmbreeSeed, kWidth> seeds_;
  std::array<double, kWidth> values_{};
  std::array<bool, kWidth> isDoubtful_{};
  std::vector<LaneHits> hits_;  // Per ray.

  [[nodiscard]] LaneHits cast(const Vec3d& coneDirection);
  [[nodiscard]] bool hitsItself(size_t lane) const;
  [[nodiscard]] bool hitsContact(size_t lane) const;
  void writeHits(size_t lane) const;
};

}  // namespace asdfvk
