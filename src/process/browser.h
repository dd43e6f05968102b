#pragma once

#include <string>

namespace asdfvk {

/// Opens a file in the browser of the desktop (xdg-open). Does not wait for the browser. Throws
/// Error{OutputNotWritable} if xdg-open cannot be started.
void openInBrowser(const std::string& path);

}  // namespace asdfvk
