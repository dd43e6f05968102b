#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace asdfvk::test {

/// CGAL's shape diameter function and segmentation, called through its public interface. Only in builds that found
/// CGAL; the package is under the GPL, and nothing but tests and benchmarks links it.
class CgalOracle {
 public:
  /// Soups of triangles are oriented and their non-manifold vertices split, as CGAL's readers do.
  explicit CgalOracle(const Mesh& mesh);
  ~CgalOracle();

  /// The mesh as CGAL has it: the same faces in the same order, perhaps with other windings and more vertices.
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }

  /// #F, by 25 rays, not post-processed; NaN for no value.
  [[nodiscard]] std::vector<double> rawValues();

  struct Values {
    std::vector<double> normalized;
    double min = 0, max = 0;
  };
  /// values: #F, NaN for no value; at least one has a value.
  [[nodiscard]] Values postprocess(std::span<const double> values);

  /// Segments, or the clusters of the faces. values: #F, normalised, with at least as many different ones as clusters.
  [[nodiscard]] std::vector<uint32_t> segment(std::span<const double> values, uint32_t clusterCount, double smoothness,
                                              bool returnsClusters = false);

 private:
  struct Surface;
  Mesh mesh_;
  std::unique_ptr<Surface> surface_;
};

}  // namespace asdfvk::test
