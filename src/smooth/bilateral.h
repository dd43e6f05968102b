#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "mesh/dual_graph.h"

/// Bilateral smoothing (Tomasi and Manduchi 1998) of a field on faces: the last step of the shape diameter function of
/// Shapira, Shamir and Cohen-Or 2008, as the ASDF paper has it (section 3), against what varies with the pose; here for
/// what few rays per face leave to chance, while steps between parts are kept. A face becomes the mean of the faces g
/// within `window` rings of the dual graph, of weight
///   exp(-ring(g)^2 / (2 (window / 2)^2)) exp(-(v_g - v_f)^2 / (2 sigma_f^2)),
/// sigma_f being the root mean square of the differences v_g - v_f in the window, itself included.
/// CGAL's sdf_values() does the same by default (Bilateral_filtering in Surface_mesh_segmentation/internal/Filters.h)
/// but for three things: its range Gaussian is 1.5 sigma_f wide; its window is 1 + floor(sqrt(faceCount / 2000)) rings
/// without an end, 3 for 10,000 faces and 8 for 100,000; and a face without a value is given one first.
namespace asdfvk {

/// What lowers the error of the 30-ray function on a mesh of so many faces: the finer the mesh, the less the true
/// values differ within a window. Meant for values traced at every face with ConeRotation::Hashed: with fixed cones
/// neighbours err alike, which smoothing cannot undo, and interpolated values are smooth already.
[[nodiscard]] SmoothingOptions::Window smoothingWindowFor(uint64_t faceCount);

/// values: #F, finite, or NaN for no value. A face without a value neither gives nor gets one. The same bits on any
/// number of threads. Throws Error{Usage} for a window out of range.
[[nodiscard]] std::vector<double> smoothBilaterally(const DualGraph& graph, std::span<const double> values,
                                                    const SmoothingOptions::Window& options);

/// Throws Error{Usage} for a window out of range.
void requireValid(const SmoothingOptions::Window& options);

}  // namespace asdfvk
