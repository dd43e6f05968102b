#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/mesh.h"
#include "asdf_vk/options.h"
#include "asdf_vk/report.h"
#include "asdf_vk/run_control.h"
#include "asdf_vk/session.h"

namespace asdfvk {

/// Scene::valuesAt() moves points inwards by this share of the diagonal of the bounding box. Rays in float32 then start
/// below the surface by at least 80 times the rounding error of coordinates, which is 2^-23 of the box. Points that
/// were rounded to float32 or to six digits are inside, unless the mesh is far from the origin.
inline constexpr double kPointOffset = 1e-5;

/// A mesh prepared once for any number of computations on one session: geometry, dual graph, hierarchy, and the tracers
/// of the last kPreparedConeCount sets of cone options (for Vulkan the hierarchy on the device). Not thread-safe, like
/// its session, with which any number of scenes may exist at a time.
///
/// Beside the arrays of the caller it takes about 150 bytes per face of a closed mesh, and 110 per face for each
/// tracer; these are on the device with Vulkan. A Vulkan tracer also has up to 55 MB of buffers for its rays, whatever
/// the mesh.
class ASDFVK_API Scene {
 public:
  /// The session and the arrays of the mesh must outlive the scene. Does not change the mesh. Throws Error of kind
  /// Input (no face, index out of range) or Cancelled.
  Scene(Session& session, const MeshView& mesh, Orientation orientation = Orientation::Keep,
        const RunControl& control = {});
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Session::compute() with the same bits, but without preparing the mesh: Report::stageSeconds has 0 for the
  /// stages Geometry, Graph and Bvh, and the creation of a new tracer only for Encode and Upload. Options::orientation
  /// must be Keep or that of the scene; else it throws Error{OptionConflict}.
  ///
  /// region: #I, nonzero = inside; empty: the whole mesh. Seeds are chosen inside, and a share of seeds is a share of
  /// these faces; rays hit the whole mesh; the Poisson equation has the faces inside and the edges between them. Real
  /// fields are NaN outside, flags 0. The report counts the faces inside (seeds, missing values, ranges, thin regions
  /// and their areas), except that faceCount, triangleCount, vertexCount, componentCount, defects, reversedFaceCount
  /// and the warnings about defects and orientation are of the whole mesh. A region of all faces gives the same bits as
  /// none. Throws Error{ArraySize} for another size than #I, Error{EmptyMesh} for a region without a face,
  /// Error{OptionConflict} with post-processing or segmentation, which need the whole mesh.
  [[nodiscard]] Result compute(const Options& options = {}, std::span<const uint8_t> region = {},
                               const RunControl& control = {});

  /// Shape diameter at points: a cone of rays around minus the normal, from the point moved inwards by kPointOffset.
  /// points: 3 #P numbers, x y z in the unit of the mesh. normals: 3 #P numbers, outwards, of any length above 0.
  /// Returns #P values in the unit of the mesh; NaN where no ray hits the opposite side, which is the usual case
  /// outside of the shape.
  ///
  /// The definition is that of faces (docs/method.md), with the given normal in place of that of the face; no face is
  /// ignored. At the barycentre of a face, with its normal, the value is that of the face less about kPointOffset times
  /// the diagonal; walls thinner than that are not resolved. ConeRotation::Hashed turns each cone by a hash of its
  /// point, so that its values differ from those of faces by the noise of the rays. Points farther from the bounding
  /// box than 1/128 of its longest side are traced in double precision, more slowly; at 2^31 times that side there is
  /// no value.
  ///
  /// The tracer is kept: further calls with the same cone options cost only their rays. Throws Error{ArraySize} where a
  /// size is not a multiple of 3 or the sizes differ, Error{NonFiniteNumber} with the index for a number that is not
  /// finite, Error{OptionOutOfRange} for a normal of length 0, and Error of kind Usage, Device or Cancelled.
  [[nodiscard]] std::vector<double> valuesAt(std::span<const double> points, std::span<const double> normals,
                                             const ConeOptions& cone = {}, const RunControl& control = {});

  /// Wall thickness at points of the surface: the diameter of the largest ball that touches the surface at the point
  /// from inside and contains no point of an opposing wall, by the normals of ThicknessOptions
  /// (docs/thickness.md). points, normals: as for valuesAt(). Returns #P values in the unit of the mesh; NaN where no
  /// wall opposes the point in an open component. Ignores a limit in the options. Throws as valuesAt().
  [[nodiscard]] std::vector<double> thicknessAt(std::span<const double> points, std::span<const double> normals,
                                                const ThicknessOptions& thickness = {}, const RunControl& control = {});

  /// The input face nearest to each point; of equally near faces the first one. Faces without an area or with a corner
  /// that is not finite do not count. points: 3 #P numbers, x y z in the unit of the mesh. Returns #P input faces.
  /// Throws Error{ArraySize}, Error{NonFiniteNumber} with the index, and Error{NoValues} where no face counts.
  [[nodiscard]] std::vector<uint32_t> nearestFaces(std::span<const double> points, const RunControl& control = {});

  /// Distance of each point to the nearest point of the surface, in the unit of the mesh; never negative, and the same
  /// inside and outside. Exact for the facets but for rounding in double. Faces without an area do not count; a
  /// distance beyond the range of double is the largest double. points and errors: as for nearestFaces().
  [[nodiscard]] std::vector<double> distance(std::span<const double> points, const RunControl& control = {});

  /// Radius of the largest ball around each point inside of the shape: distance() where the point is behind its nearest
  /// face. NaN where it is in front of that face or outside of the bounding box: outside of a closed shape that is
  /// oriented outwards. On the surface it is about 0, or NaN. Surfaces inside of the shape, such as those of parts that
  /// overlap, stop the ball too.
  /// points and errors: as for nearestFaces().
  [[nodiscard]] std::vector<double> radii(std::span<const double> points, const RunControl& control = {});

  /// First hit of each ray on either side of a face.
  struct RayHits {
    std::vector<double> distances;  ///< #R, in the unit of the mesh; infinite without a hit.
    std::vector<uint32_t> faces;    ///< #R input faces; kNoSegment without a hit.
  };
  /// Traces rays in double precision on the CPU, whatever the backend. origins, directions: 3 #R numbers each;
  /// directions of any length above 0. Of coincident faces the first one is hit. From 2^31 times the longest side of
  /// the box there are no hits. Throws as valuesAt() does for points and normals.
  [[nodiscard]] RayHits firstHits(std::span<const double> origins, std::span<const double> directions,
                                  const RunControl& control = {});

  /// Seconds of the constructor: the stages Geometry, Graph and Bvh.
  [[nodiscard]] const StageSeconds& preparationSeconds() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Number of sets of cone options whose tracers a Scene keeps.
inline constexpr size_t kPreparedConeCount = 2;

}  // namespace asdfvk
