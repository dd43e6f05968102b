#pragma once

#include <span>

#include "asdf_vk/run_control.h"
#include "render/camera.h"
#include "render/image.h"
#include "render/sample_rows.h"

namespace asdfvk {

inline constexpr Rgb kAlarm{206, 38, 30};

/// Draws the mesh onto the image with a depth buffer of 4 x 4 samples per pixel, smooth normals, and the soft shadows
/// of SkyLight. faceColours: #F. alarming: triangles on the surface or within the body, in the unit of the mesh. Where
/// these triangles are visible, they have the colour kAlarm. Where they are hidden, they tint the faces in front of
/// them. The result has the same bits for any number of threads. Throws Error{Cancelled}.
void renderMesh(Image& image, const TraceScene& scene, const Camera& camera, std::span<const Rgb> faceColours,
                Surface alarming, const RunControl& control);

}  // namespace asdfvk
