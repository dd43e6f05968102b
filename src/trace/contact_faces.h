#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "trace/trace_scene.h"

namespace asdfvk {

/// The faces that touch the outer side of another face, as where two parts touch. Found at the first question: most
/// rays never ask.
class ContactFaces {
 public:
  /// contactDistance: see Cone. The scene must outlive it.
  ContactFaces(const TraceScene& scene, double contactDistance);

  /// Whether another face with about the opposite normal lies in the plane of the primitive, near its box. Any thread
  /// may call it.
  [[nodiscard]] bool contain(uint32_t primitive);

 private:
  [[nodiscard]] bool isInContact(uint32_t primitive) const;

  TraceScene scene_;
  double contactDistance_;
  enum State : uint8_t { Unknown, Apart, InContact };
  std::vector<State> states_;  // Per primitive.
};

}  // namespace asdfvk
