#pragma once

#include <string>

#include "asdf_vk/run_control.h"
#include "cli/report.h"
#include "page/page.h"

namespace asdfvk {

/// A page without results.
[[nodiscard]] Page emptyPage();

/// The name of a mesh in a page, if no other mesh of the page has it.
[[nodiscard]] std::string nameInPage(const std::string& mesh);

/// How a page shows a mesh.
struct PageMesh {
  std::string name;
  bool showsTimes = true;
};

/// Adds a result with the texts of its report and a small picture. Precondition: result.scene is set. Throws
/// Error{UnknownField} for a field of --fields that the result does not have, and Error{Cancelled}.
void addToPage(Page& page, const MeshOutcome& outcome, const PageMesh& mesh, const RunControl& control);

/// Writes the page atomically. Throws Error{OutputNotWritable}.
void writePage(const std::string& path, const Page& page);

}  // namespace asdfvk
