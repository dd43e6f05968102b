#pragma once

#include "asdf_vk/session.h"
#include "cli/command_line.h"

namespace asdfvk {

/// Renders the field of --picture-of and writes it, whole or not at all. result.scene must be set. Throws
/// Error{OutputNotWritable}, Error{UnknownField} and Error{Cancelled}.
void writePicture(const CommandLine& line, const Result& result, const RunControl& control);

}  // namespace asdfvk
