#pragma once

#include <memory>

#include "trace/trace_scene.h"

namespace asdfvk {

/// A mesh with its geometry and hierarchy. Result::scene of the public interface.
struct SceneData {
  std::shared_ptr<const void> owner;  ///< Owns everything that `scene` views, except the arrays of the caller.
  TraceScene scene;
};

}  // namespace asdfvk
