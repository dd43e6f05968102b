#pragma once

#include <string>

#include "cli/options.h"

namespace asdfvk {

/// Hash of all options that decide the bytes of an output of a batch, or whether the mesh passes. Options that a batch
/// refuses are not in it.
[[nodiscard]] std::string optionsHash(const Computation& computation, const std::optional<Computation>& compared,
                                      const SessionOptions& session, const Outputs& outputs);

}  // namespace asdfvk
