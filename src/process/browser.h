#pragma once

#include <string>

namespace asdfvk {

/// Opens a file with xdg-open, and does not wait. Throws Error{OutputNotWritable} if xdg-open cannot be started.
void openInBrowser(const std::string& path);

}  // namespace asdfvk
