#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "mesh/dual_graph.h"

/// Bilateral filter (Tomasi and Manduchi 1998) of a field on faces. It is the last step of the shape diameter function
/// of Shapira, Shamir and Cohen-Or 2008 and of the ASDF paper (section 3). There it reduces the differences between
/// poses; here it reduces the noise of few rays per face. Steps of the values between parts are kept. The value of a
/// face becomes the mean of the values v_g of the faces g within R rings of the dual graph with the weights
///   exp(-ring(g)^2 / (2 (R / 2)^2)) exp(-(v_g - v_f)^2 / (2 sigma_f^2)),
/// where sigma_f is the root mean square of the differences v_g - v_f in the window, f included.
/// CGAL's sdf_values() has a similar filter by default (Bilateral_filtering in
/// Surface_mesh_segmentation/internal/Filters.h) with three differences. Its range Gaussian has the width 1.5 sigma_f.
/// Its window has 1 + floor(sqrt(faceCount / 2000)) rings: 3 for 10,000 faces and 8 for 100,000. Faces without a value
/// receive a value before the filter.
namespace asdfvk {

inline constexpr uint32_t kMaxBilateralWindow = 4;  ///< Rings.

/// The window with the least error of the 30-ray function on meshes with this number of faces. The finer the mesh, the
/// less the true values differ within a window. The windows are for values that are traced at every face with
/// ConeRotation::Hashed. With fixed cones the errors of neighbours are correlated, and interpolated values are smooth
/// already.
[[nodiscard]] SmoothingOptions::Window smoothingWindowFor(uint64_t faceCount);

/// values: #F, finite, or NaN for no value. A face without a value remains without one and does not influence other
/// faces. The result has the same bits on any number of threads. Throws the error of requireValid().
[[nodiscard]] std::vector<double> smoothBilaterally(const DualGraph& graph, std::span<const double> values,
                                                    const SmoothingOptions::Window& window);

/// Throws Error{OptionOutOfRange} for a number of rings out of range.
void requireValid(const SmoothingOptions::Window& window);

/// If every edge joins at most two faces, four rings around a face have at most 1 + 3 + 6 + 12 + 24 = 46 faces, and 66
/// arcs are visited. Windows are truncated at these limits, which bounds their cost where more faces share an edge.
inline constexpr uint32_t kMaxWindowFaceCount = 64;
inline constexpr uint32_t kMaxWindowArcCount = 96;

/// The faces within some rings of the dual graph around a face, each once: ring 0 (the face itself), ring 1, ....
class RingWindow {
 public:
  /// ringCount: 1 to kMaxBilateralWindow. Faces beyond kMaxWindowFaceCount or beyond the first kMaxWindowArcCount arcs
  /// are left out.
  void gather(const DualGraph& graph, uint32_t face, uint32_t ringCount);

  /// The faces of all rings; valid until the next gather().
  [[nodiscard]] std::span<const uint32_t> faces() const { return {faces_.data(), ringEnds_[ringCount_]}; }
  [[nodiscard]] std::span<const uint32_t> ring(uint32_t ring) const {
    return faces().subspan(ringBegin(ring), ringEnds_[ring] - ringBegin(ring));
  }
  [[nodiscard]] uint32_t ringCount() const { return ringCount_; }

 private:
  [[nodiscard]] uint32_t ringBegin(uint32_t ring) const { return ring == 0 ? 0 : ringEnds_[ring - 1]; }

  std::array<uint32_t, kMaxWindowFaceCount> faces_;
  std::array<uint32_t, kMaxBilateralWindow + 1> ringEnds_{};
  uint32_t ringCount_ = 0;
};

}  // namespace asdfvk
