#pragma once

#include "asdf_vk/run_control.h"
#include "cli/command_line.h"
#include "mesh/mesh.h"
#include "pipeline/asdf.h"

namespace asdfvk {

/// Renders what --picture asks for and writes it, whole or not at all. Throws Error{Output} with the reason and
/// Error{Cancelled}.
void writePicture(const CommandLine& line, const TriangleMesh& mesh, const Result& result, const RunControl& control);

}  // namespace asdfvk
