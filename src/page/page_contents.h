#pragma once

#include <functional>
#include <string>
#include <vector>

#include "asdf_vk/session.h"
#include "describe/computation_options.h"

namespace asdfvk {

/// The fields that a page shows by default: segments, then the fields of defaultFieldNames(), then all others that a
/// page can show. Views the fields of the result.
[[nodiscard]] std::vector<std::reference_wrapper<const Field>> shownFields(const Result& result,
                                                                           const Options& options);

/// Label of a mesh in a page: "cow.ply, balanced, seeds 10 %".
[[nodiscard]] std::string labelInPage(const std::string& name, const ComputationSettings& computation,
                                      const Report& report);

}  // namespace asdfvk
