#pragma once

#include <memory>

#include "trace/trace_scene.h"

namespace asdfvk {

/// Mesh and hierarchy of a result, for pictures and pages (Result::scene).
struct SceneData {
  std::shared_ptr<const void> owner;  ///< Owns everything that `scene` views, except the arrays of the caller.
  TraceScene scene;
};

}  // namespace asdfvk
