#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/mesh.h"
#include "core/vec3.h"
#include "io/formats.h"
#include "io/object_names.h"

namespace asdfvk {

/// An affine map: the point p becomes columns[0] p.x + columns[1] p.y + columns[2] p.z + translation.
struct Placement {
  std::array<Vec3d, 3> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec3d translation;

  [[nodiscard]] Vec3d direction(const Vec3d& p) const { return columns[0] * p.x + columns[1] * p.y + columns[2] * p.z; }
  [[nodiscard]] Vec3d point(const Vec3d& p) const { return direction(p) + translation; }
  /// Whether the map turns the outside of a surface inside.
  [[nodiscard]] bool mirrors() const { return dot(cross(columns[0], columns[1]), columns[2]) < 0; }
  [[nodiscard]] bool isFinite() const;
  /// The map that applies `inner` first and then this map.
  [[nodiscard]] Placement after(const Placement& inner) const;
};

/// The triangles of a part of a file, in the coordinates of the part.
struct PartMesh {
  std::vector<Vec3d> vertices;
  std::vector<Face> faces;
  std::vector<NamedFaces> objects = {};  ///< Names within the part, like Mesh::objects.
};

/// The memory limit of all instances is the greater of this number of bytes and 64 times the size of the file.
inline constexpr uint64_t kMaxInstanceBytes = uint64_t{1} << 30;

/// Joins the placed parts of a file into one mesh. Parts share no vertices, so that each part is a separate component.
class AssembledMesh {
 public:
  /// vertexCount, faceCount: at least the numbers that add() will receive. Throws Error{TooManyFaces} as
  /// requireFaceCount(), Error{MeshTooLarge} if 32-bit indices do not suffice, Error{InputTooLarge} if instances exceed
  /// the memory limit.
  AssembledMesh(uint64_t vertexCount, uint64_t faceCount, const MeshSource& source);

  /// Reverses the faces of a mirrored part, so that its outside stays outside. name: name of the faces that have no
  /// name within the part. Throws Error{InputTooLarge} if names exceed the memory limit.
  void add(const PartMesh& part, const Placement& placement, std::string_view name);
  /// Throws Error{UnreadableInput} if the mesh has no face.
  [[nodiscard]] Mesh finish();

 private:
  void addNames(const PartMesh& part, std::string_view name);

  uint64_t limit_;  ///< Greatest memory of all instances in bytes.
  uint64_t meshBytes_ = 0;
  std::vector<Vec3d> vertices_;
  std::vector<Face> faces_;
  ObjectNames names_;
  uint32_t partCount_ = 0;
  double float32Step_ = 0;
};

}  // namespace asdfvk
