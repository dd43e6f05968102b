#pragma once

#include <string>

namespace asdfvk {

/// Throws Error{OptionConflict} where the program that opens files in a browser is not installed.
void requireBrowser();

/// Starts the browser of the desktop (xdg-open) with a file and does not wait for it.
void openInBrowser(const std::string& path);

}  // namespace asdfvk
