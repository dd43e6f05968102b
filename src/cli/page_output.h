#pragma once

#include <string>

#include "asdf_vk/run_control.h"
#include "cli/mesh_outcome.h"
#include "page/page.h"

namespace asdfvk {

[[nodiscard]] std::string nameInPage(const std::string& mesh);

/// Name of a mesh in a page, and whether the page shows times.
struct PageMesh {
  std::string name;
  bool showsTimes = true;
};

/// Adds a result to a page, with its report and a small picture. Precondition: the result has a scene. Throws
/// Error{UnknownField} if the result lacks a field of --fields, and Error{Cancelled}.
void addToPage(Page& page, const MeshOutcome& outcome, const PageMesh& mesh, const RunControl& control);

}  // namespace asdfvk
