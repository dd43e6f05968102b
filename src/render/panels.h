#pragma once

#include <span>
#include <string>

#include "render/image.h"

namespace asdfvk {

struct Panel {
  Image image;
  std::string caption;  ///< Below it; may be empty.
};

/// The panels side by side on white, centred to each other's height, each with its caption below it. Precondition: at
/// least one panel.
[[nodiscard]] Image composeRow(std::span<const Panel> panels);

}  // namespace asdfvk
