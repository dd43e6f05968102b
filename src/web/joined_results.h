#pragma once

#include "asdf_vk/session.h"

namespace asdfvk {

/// The result of one computation that measures all that two computations on one scene have measured: thickness and
/// gaps of `checked`, shape diameters and segments of `computed`. The times are summed.
[[nodiscard]] Result joined(const Result& checked, const Result& computed);

}  // namespace asdfvk
