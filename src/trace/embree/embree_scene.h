#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

#include "trace/cone_tracer.h"

namespace asdfvk {

struct EmbreeRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeRelease>;

enum class EmbreeMode {
  Fastest,  ///< A ray may fall between two triangles: one in 600,000 on a scanned model, 26 on a cylinder.
  Robust,   ///< None does; a fifth slower.
};

/// Embree's own hierarchy over the triangle slots of a scene's: primitive i is the triangle of slot i, in normalised
/// coordinates and float32. Built on all threads, to the same bits on any number of them.
class EmbreeScene {
 public:
  /// Throws Error{Device}.
  EmbreeScene(const TraceScene& scene, EmbreeMode mode);

  [[nodiscard]] RTCScene get() const { return scene_.get(); }
  [[nodiscard]] EmbreeMode mode() const { return mode_; }

 private:
  EmbreeMode mode_;
  // In this order: the scene goes first.
  EmbreeDevice device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeRelease> scene_;
};

}  // namespace asdfvk
