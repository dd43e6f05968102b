#pragma once

#include <span>

#include "asdf_vk/run_control.h"
#include "render/camera.h"
#include "render/image.h"
#include "render/scene.h"

namespace asdfvk {

/// Draws the mesh onto the image, shaded and antialiased: pixels that differ from a neighbour get more samples.
/// faceColours: #F. The same bits for any number of threads.
void renderMesh(Image& image, const PictureScene& scene, const Camera& camera, std::span<const Rgb> faceColours,
                const RunControl& control);

}  // namespace asdfvk
