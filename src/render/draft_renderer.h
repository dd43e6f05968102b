#pragma once

#include <span>
#include <vector>

#include "render/camera.h"
#include "render/image.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// The vertices of the faces that rays can hit, once each, in normalised coordinates.
[[nodiscard]] std::vector<Vec3d> verticesOfHitFaces(const TraceScene& scene);

/// Draws the mesh onto the image with a depth buffer of 2 x 2 samples per pixel: flat faces in one light, without
/// shadows. faceColours: #F. The same bits for any number of threads.
void renderDraft(Image& image, const TraceScene& scene, const Camera& camera, std::span<const Rgb> faceColours);

}  // namespace asdfvk
