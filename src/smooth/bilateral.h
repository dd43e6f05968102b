#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/run_control.h"
#include "mesh/dual_graph.h"

/// Bilateral filter (Tomasi and Manduchi 1998) of a field on faces: the last step of the shape diameter function of
/// Shapira, Shamir and Cohen-Or 2008 and of the ASDF paper (section 3). In these papers the filter reduces differences
/// between poses. Here the filter reduces the noise of few rays per face. The filter keeps steps of the values between
/// parts. The value of a face f becomes the mean of the values v_g of the faces g within R rings of the dual graph,
/// with the weights
///   exp(-ring(g)^2 / (2 (R / 2)^2)) exp(-(v_g - v_f)^2 / (2 sigma_f^2)),
/// where sigma_f is the root mean square of the differences v_g - v_f in the window, f included. The default filter of
/// CGAL's sdf_values() (Bilateral_filtering in Surface_mesh_segmentation/internal/Filters.h) has four differences: the
/// width of the range Gaussian is 1.5 sigma_f; the window has 1 + floor(sqrt(faceCount / 2000)) rings (3 for 10,000
/// faces, 8 for 100,000); missing values are filled before the filter; faces are neighbours only across edges of two
/// faces with consistent winding. filterLikeCgal() (segment/cgal_postprocess.h) has these differences, because its
/// values must agree with those of CGAL to 1e-12. The windows of smoothBilaterally() are those with the least error
/// (docs/accuracy.md).
namespace asdfvk {

inline constexpr uint32_t kMaxBilateralWindow = 4;  ///< Greatest number of rings.

/// The window for which values from 30 rays have the least error on meshes with this number of faces. Finer meshes have
/// larger windows, because their true values differ less within a window. The window is for values that are traced at
/// every face with ConeRotation::Hashed. With fixed cones, the errors of neighbours are correlated. Interpolated values
/// are already smooth.
[[nodiscard]] SmoothingOptions::Window smoothingWindowFor(uint64_t faceCount);

/// values: #F, finite, or NaN for no value. A face without a value keeps no value and does not influence other faces.
/// The result has the same bits on any number of threads. Throws Error{OptionOutOfRange} for a number of rings out of
/// range, and Error{Cancelled}.
[[nodiscard]] std::vector<double> smoothBilaterally(const DualGraph& graph, std::span<const double> values,
                                                    const SmoothingOptions::Window& window,
                                                    const RunControl& stopOnly = {});

/// If every edge joins at most two faces, four rings around a face have at most 1 + 3 + 6 + 12 + 24 = 46 faces and 66
/// arcs. If more faces share an edge, these limits bound the time of a window.
inline constexpr uint32_t kMaxWindowFaceCount = 64;
inline constexpr uint32_t kMaxWindowArcCount = 96;

/// The faces within some rings of the dual graph around a face, each once. Ring 0 is the face.
class RingWindow {
 public:
  /// ringCount: 1 to kMaxBilateralWindow. Finds the rings around a face. Stops at kMaxWindowFaceCount faces or
  /// kMaxWindowArcCount arcs; further faces are left out.
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
