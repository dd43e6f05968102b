#pragma once

#include "asdf_vk/run_control.h"
#include "asdf_vk/session.h"
#include "render/camera.h"
#include "render/image.h"

namespace asdfvk {

struct PictureStyle {
  int width = 1200, height = 900;  ///< In pixels.
  double textScale = 1;            ///< See Picture::textScale.
  bool isDraft = false;            ///< See Picture::isDraft.
};

/// Renders the mesh of a result coloured by a field per input face of one component. Precondition: result.scene is
/// set. Throws Error{Cancelled}.
[[nodiscard]] Image pictureOf(const Result& result, const Field& field, const View& view, const PictureStyle& style,
                              const RunControl& control);

}  // namespace asdfvk
