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
/// below the surface by at least 80 rounding errors of a coordinate (each 2^-23 of the box). If the mesh is not far
/// from the origin, points of the surface that were rounded to float32 or to six digits are then also inside.
inline constexpr double kPointOffset = 1e-5;

/// A mesh that is prepared once for any number of computations on one session. Keeps geometry, dual graph, hierarchy,
/// and the tracers of the last kPreparedConeCount sets of cone options. A session may have any number of scenes. The
/// session and its scenes are not thread-safe.
///
/// In addition to the arrays of the caller, a scene takes about 150 bytes per face of a closed mesh, and about 110
/// bytes per face for each tracer. The memory of a Vulkan tracer is on the device. Such a tracer also has buffers of up
/// to 55 MB for rays.
class ASDFVK_API Scene {
 public:
  /// Prepares the mesh without changing it. The session and the arrays of the mesh must outlive the scene. Throws Error
  /// of kind Input (no face, index out of range) or Cancelled.
  Scene(Session& session, const MeshView& mesh, Orientation orientation = Orientation::Keep,
        const RunControl& control = {});
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Returns the result of Session::compute(), bit for bit, without preparing the mesh again. Report::stageSeconds is 0
  /// for the stages Geometry, Graph and Bvh. Encode and Upload take time only if a new tracer is created. Throws
  /// Error{OptionConflict} if Options::orientation is neither Keep nor the orientation of the scene.
  ///
  /// region: #I, nonzero for faces inside of the region; empty: the whole mesh. Seeds are chosen among the faces
  /// inside, and SeedCount::share refers to these faces. Rays hit the whole mesh. The Poisson equation has the faces
  /// inside and the edges between these faces. Faces outside have NaN in real fields and 0 in flags. The report
  /// describes the faces inside: seeds, missing values, ranges, thin regions and their areas. faceCount, triangleCount,
  /// vertexCount, componentCount, defects, reversedFaceCount and the warnings about defects and orientation describe
  /// the whole mesh. A region of all faces gives the same bits as an empty `region`. Throws Error{ArraySize} for a size
  /// other than #I, Error{EmptyMesh} for a region without a face, and Error{OptionConflict} with post-processing or
  /// segmentation, which need the whole mesh.
  [[nodiscard]] Result compute(const Options& options = {}, std::span<const uint8_t> region = {},
                               const RunControl& control = {});
  [[nodiscard]] Result compute(const CheckedOptions& options, std::span<const uint8_t> region = {},
                               const RunControl& control = {});

  /// Like compute(), and compares the wall thickness with a former version of the mesh (ComparisonReport); adds the
  /// field "thickness_change", and Measure::Thickness. The meshes may be triangulated differently, but must be in the
  /// same place. `former` may belong to another session. Throws Error{UnitsDiffer} if both meshes state a unit, and not
  /// the same one.
  [[nodiscard]] Result compare(const Scene& former, const Options& options = {}, std::span<const uint8_t> region = {},
                               const RunControl& control = {});
  /// Throws Error{OptionConflict} if the options do not measure the thickness.
  [[nodiscard]] Result compare(const Scene& former, const CheckedOptions& options, std::span<const uint8_t> region = {},
                               const RunControl& control = {});

  /// Shape diameter at points. The cone of rays starts at the point, moved inwards by kPointOffset. The axis of the
  /// cone is the reversed normal. points: 3 #P numbers, x y z in the unit of the mesh. normals: 3 #P numbers;
  /// directions outwards, of any length above 0. Returns #P values in the unit of the mesh; NaN where no ray hits the
  /// opposite side. Points outside of the shape usually have NaN.
  ///
  /// Values are defined as for faces (docs/method.md), with the given normal instead of the normal of the face. Rays
  /// can hit every face. At the barycentre of a face, with the normal of the face, the value is slightly less than the
  /// value of the face. The difference is about kPointOffset times the diagonal of the bounding box. Walls thinner than
  /// this offset are not resolved. ConeRotation::Hashed rotates each cone by a hash of its point. With this rotation,
  /// values also differ from the values of faces by the noise of the rays. Points farther from the bounding box than
  /// 1/128 of its longest side are traced in double precision, more slowly. Points farther away than 2^31 times the
  /// longest side have no value.
  ///
  /// The scene keeps the tracer: further calls with the same cone options only trace rays. Throws Error{ArraySize} if a
  /// size is not a multiple of 3 or the sizes differ, Error{NonFiniteNumber} with the index of a number that is not
  /// finite, Error{OptionOutOfRange} for a normal of length 0, and Error of kind Usage, Device or Cancelled.
  [[nodiscard]] std::vector<double> valuesAt(std::span<const double> points, std::span<const double> normals,
                                             const ConeOptions& cone = {}, const RunControl& control = {});

  /// Wall thickness at points of the surface (ThicknessOptions, docs/thickness.md): the diameter of the largest ball
  /// that touches the point from inside and contains no point of an opposing wall. points, normals: as for valuesAt().
  /// Returns #P values in the unit of the mesh; NaN in an open component where no wall is opposite. Ignores
  /// ThicknessOptions::thinnerThan. Throws as valuesAt().
  [[nodiscard]] std::vector<double> thicknessAt(std::span<const double> points, std::span<const double> normals,
                                                const ThicknessOptions& thickness = {}, const RunControl& control = {});

  /// The input face nearest to each point. If several faces are equally near, returns the first of them. Faces of zero
  /// area or with a non-finite corner are ignored. points: 3 #P numbers, x y z in the unit of the mesh. Returns #P
  /// input faces. Throws Error{ArraySize}, Error{NonFiniteNumber} with the index, and Error{NoValues} if all faces are
  /// ignored.
  [[nodiscard]] std::vector<uint32_t> nearestFaces(std::span<const double> points, const RunControl& control = {});

  /// Unsigned distance of each point to the triangles, in the unit of the mesh. Exact except for rounding in double. A
  /// distance that exceeds the range of double is returned as the largest double. Points, ignored faces and errors: as
  /// for nearestFaces().
  [[nodiscard]] std::vector<double> distance(std::span<const double> points, const RunControl& control = {});

  /// Radius of the largest ball inside of the shape around each point: distance() if the point is behind its nearest
  /// face, else NaN. Points outside of the bounding box also have NaN. On the surface the radius is about 0 or NaN.
  /// Closed parts that overlap or touch are one shape: their surfaces inside of the shape do not limit the ball. Points
  /// and errors: as for distance().
  [[nodiscard]] std::vector<double> radii(std::span<const double> points, const RunControl& control = {});

  /// First hit of each ray. Rays hit faces from both sides.
  struct RayHits {
    std::vector<double> distances;  ///< #R, in the unit of the mesh; infinite without a hit.
    std::vector<uint32_t> faces;    ///< #R input faces; kNoSegment without a hit.
  };
  /// Traces rays in double precision on the CPU, whatever the backend. origins, directions: 3 #R numbers each;
  /// directions have any length above 0. If several faces coincide, a ray hits the first of them. A ray hits nothing if
  /// its origin is farther from the bounding box than 2^31 times the longest side of the box. Throws as valuesAt() does
  /// for points and normals.
  [[nodiscard]] RayHits firstHits(std::span<const double> origins, std::span<const double> directions,
                                  const RunControl& control = {});

  /// Seconds of the constructor, in the stages Geometry, Graph and Bvh.
  [[nodiscard]] const StageSeconds& preparationSeconds() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Number of tracers that a Scene keeps, each for one set of cone options.
inline constexpr size_t kPreparedConeCount = 2;

}  // namespace asdfvk
