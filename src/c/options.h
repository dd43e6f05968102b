#pragma once

#include "c/handle_types.h"
#include "describe/session_options.h"

namespace asdfvk::c {

/// The settings of a session or of a computation; null: the defaults. Throws Error{OptionConflict} for an option of a
/// computation in the options of a session, and vice versa. Throws the errors of complete() and requireValid().
[[nodiscard]] SessionSettings sessionSettings(const asdf_vk_options* options);
[[nodiscard]] ComputationSettings computationSettings(const asdf_vk_options* options, bool compares);
/// computationSettings() for values at points. Throws Error{OptionConflict} for options without an effect there.
[[nodiscard]] Options pointOptions(const asdf_vk_options* options);

}  // namespace asdfvk::c
