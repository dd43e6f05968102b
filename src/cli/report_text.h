#pragma once

#include <string>

#include "cli/mesh_outcome.h"

namespace asdfvk {

/// The report as aligned lines. The first line has the name of the mesh, and the verdict on the thickness or the size
/// of the mesh. Lines with further results and with the output files follow. With --verbose the report has all of
/// reportRows(). Without --verbose the report has at most six lines of at most 100 columns; long file names take more
/// columns.
[[nodiscard]] std::string textReport(const MeshOutcome& outcome);

}  // namespace asdfvk
