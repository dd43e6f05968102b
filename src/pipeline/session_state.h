#pragma once

#include "pipeline/backend.h"
#include "pipeline/computation.h"

namespace asdfvk {

/// Session::state_.
struct SessionState {
  explicit SessionState(const SessionOptions& options) : named(openBackend(options)) {}

  NamedBackend named;
  Solvers solvers;  ///< Destroyed before the device that they use.
};

}  // namespace asdfvk
