#pragma once

#include <array>
#include <span>
#include <string>

#include "core/vec3.h"
#include "render/camera.h"
#include "render/image.h"
#include "trace/trace_scene.h"

namespace asdfvk {

/// A place to mark with a ring and a text, in the unit of the mesh.
struct Callout {
  Vec3d place, opposite;  ///< Two points of the surface. The ring is around the visible one.
  std::string text;
};

/// Width of the columns for the texts of the callouts at either side of a picture, in pixels; 0 without callouts.
[[nodiscard]] double calloutWidth(std::span<const Callout> callouts, double capHeight);

/// Draws a ring at each place, its text in the nearer one of the two columns (left, right), and a line between both.
void drawCallouts(Image& image, const TraceScene& scene, const Camera& camera, std::span<const Callout> callouts,
                  const std::array<PixelArea, 2>& columns, double capHeight);

}  // namespace asdfvk
