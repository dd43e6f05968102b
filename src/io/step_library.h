#pragma once

#include "io/step_module.h"

namespace asdfvk {

/// Loads the module that reads STEP at the first call, from the first of these places: the file that the environment
/// variable ASDF_VK_STEP_MODULE names, the folder of the program or library that has this function, its neighbour
/// ../LIBDIR/asdf-vk, and the folder for which the library was configured. Throws Error{UnreadableInput} if there is no
/// module, or if it cannot be loaded.
[[nodiscard]] StepModuleFunction stepModule();

}  // namespace asdfvk
