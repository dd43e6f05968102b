#pragma once

#include <string>

#include "asdf_vk/run_control.h"
#include "asdf_vk/session.h"
#include "render/camera.h"
#include "render/image.h"

namespace asdfvk {

struct PictureStyle {
  int width = 1200, height = 900;  ///< In pixels.
  double textScale = 1;            ///< See Picture::textScale.
};

/// Style of the picture in pages, for browsers without WebGL 2, and of pictures of many meshes. A picture takes a sixth
/// of the CPU time of a picture in the default style.
inline constexpr PictureStyle kSmallPicture{.width = 480, .height = 360, .textScale = 1.4};

/// Whether the thickness was compared with a limit.
[[nodiscard]] bool comparesThickness(const Result& result);

/// What a picture shows if no field is named: null for the thin places if comparesThickness(), else the field
/// "thickness", else "segment", else the first field. Precondition: there is a field.
[[nodiscard]] const Field* shownField(const Result& result);

/// The requested view with an up direction. If the requested view has no up direction, the direction is z for an
/// `input` in STL or 3MF, and that of guessUp() for other formats: usually y for GLB, OBJ and OFF, else z. If
/// findsThin, bestViewOf() chooses the angles for the thin places. Precondition: result.scene is set.
[[nodiscard]] View viewOf(const View& requested, const std::string& input, const Result& result, bool findsThin);

/// Renders the mesh of a result, coloured by a field per input face with one component, or with its thin places if
/// `field` is null. Throws Error{Cancelled}. Preconditions: result.scene is set; without a field, comparesThickness().
[[nodiscard]] Image pictureOf(const Result& result, const Field* field, const View& view, const PictureStyle& style,
                              const RunControl& control);

}  // namespace asdfvk
