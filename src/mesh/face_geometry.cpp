#include "mesh/face_geometry.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asdfvk {
namespace {

struct NormalAndArea {
  Vec3d normal;
  double area = 0;
};

// Edges are scaled by the longest one before they are multiplied, so that tiny and huge units neither underflow nor
// overflow.
NormalAndArea normalAndArea(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a, ac = c - a, bc = c - b;
  double longest = 0;
  for (const Vec3d& edge : {ab, ac, bc})
    for (size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, std::abs(edge[axis]));
  if (!(longest > 0) || !std::isfinite(longest)) return {};
  const Vec3d scaledAb = ab / longest, scaledAc = ac / longest, scaledBc = bc / longest;
  const double longestSquared = std::max({dot(scaledAb, scaledAb), dot(scaledAc, scaledAc), dot(scaledBc, scaledBc)});
  const Vec3d scaledCross = cross(scaledAb, scaledAc);
  const double doubledArea = length(scaledCross);
  if (!(doubledArea > kDegenerateHeightRatio * longestSquared)) return {};
  // An area beyond a double's range must neither read as degenerate nor as infinite.
  using Limits = std::numeric_limits<double>;
  return {scaledCross / doubledArea, std::clamp(0.5 * doubledArea * longest * longest, Limits::min(), Limits::max())};
}

}  // namespace

FaceGeometry computeFaceGeometry(const Mesh& mesh) {
  FaceGeometry geometry;
  const size_t faceCount = mesh.faces.size();
  geometry.barycentres.resize(faceCount);
  geometry.normals.resize(faceCount);
  geometry.areas.resize(faceCount);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, faceCount, 4096), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t f = range.begin(); f < range.end(); ++f) {
      const auto [i, j, k] = mesh.faces[f];
      const Vec3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
      geometry.barycentres[f] = a + ((b - a) + (c - a)) / 3.0;
      const NormalAndArea face =
          mesh.hasFiniteCorners(static_cast<uint32_t>(f)) ? normalAndArea(a, b, c) : NormalAndArea{};
      geometry.normals[f] = face.normal;
      geometry.areas[f] = face.area;
    }
  });
  for (const Face& face : mesh.faces)
    for (uint32_t vertex : face)
      if (isFinite(mesh.vertices[vertex])) geometry.bounds.add(mesh.vertices[vertex]);
  return geometry;
}

}  // namespace asdfvk
