#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/face_geometry.h"
#include "segment/cgal_postprocess.h"
#include "segment/cgal_segmentation.h"
#include "stored_case.h"
#include "support/cgal_oracle.h"

namespace asdfvk::test {

/// Checks that CGAL and asdf-vk post-process and segment alike, from the same values.
inline void checkAgainstCgal(const Mesh& source) {
  CgalOracle oracle(source);
  const Mesh& mesh = oracle.mesh();
  const std::vector<double> raw = oracle.rawValues();
  const CgalOracle::Values expected = oracle.postprocess(raw);
  const FaceNeighbours neighbours = findFaceNeighbours(mesh);
  CHECK(findFaceNeighbours(source) == neighbours);
  const CgalValues values = postprocessLikeCgal(neighbours, raw);
  CHECK(values.min == doctest::Approx(expected.min).epsilon(1e-12));
  CHECK(values.max == doctest::Approx(expected.max).epsilon(1e-12));
  double difference = 0;
  for (size_t face = 0; face < raw.size(); ++face)
    difference = std::max(difference, std::abs(values.normalized[face] - expected.normalized[face]));
  CHECK(difference < 1e-12);
  for (const Setting& setting : kSettings) {
    CAPTURE(setting.clusterCount);
    CAPTURE(setting.smoothness);
    const std::vector<uint32_t> segments =
        oracle.segment(expected.normalized, setting.clusterCount, setting.smoothness);
    const CgalSegmentation ours = segmentLikeCgal(computeFaceGeometry(mesh), mesh, neighbours, expected.normalized,
                                                  {setting.clusterCount, setting.smoothness, CgalExpansion::First});
    CHECK(ours.segments == segments);
    CHECK(ours.clusters == oracle.segment(expected.normalized, setting.clusterCount, setting.smoothness, true));
  }
}

}  // namespace asdfvk::test
