#pragma once

#include <string>

#include "asdf_vk/error.h"

namespace asdfvk {

/// The message of an error, with a remedy such as an option or a package. requiresGpu: the remedy must not propose the
/// CPU. valueOptions: the given options that need shape diameters, such as --segment.
[[nodiscard]] std::string messageWithRemedy(const Error& error, bool requiresGpu = false,
                                            const std::string& valueOptions = "");

}  // namespace asdfvk
