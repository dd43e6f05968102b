#pragma once

#include <string>

namespace asdfvk {

/// Starts the browser of the desktop (xdg-open) with a file and does not wait for it. Throws Error{OutputNotWritable}
/// where it cannot be started.
void openInBrowser(const std::string& path);

}  // namespace asdfvk
