#pragma once

#include <memory>

#include "trace/trace_scene.h"

namespace asdfvk {

struct SceneData {
  std::shared_ptr<const void> owner;  ///< Owns everything that `scene` views, except the arrays of the caller.
  TraceScene scene;
};

}  // namespace asdfvk
