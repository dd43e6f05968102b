#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "asdf_vk/options.h"
#include "pipeline/prepared_scene.h"
#include "pipeline/space_parts.h"
#include "trace/material.h"
#include "trace/solids.h"

namespace asdfvk {

/// The surface of the material (material.h): the faces on which a thickness is defined. If no face meets another one
/// or has vertices of others on its edges, it is the surface of the mesh. Otherwise faces inside of the material are
/// left out, and faces that others cross and their neighbours are divided into triangles. These triangles belong to the
/// same input face. Or the surface of the space around the material: the same faces, reversed. A gap is a wall of it.
class JudgedSurface {
 public:
  /// scene: with a hierarchy. Must outlive this object. Throws Error{Cancelled}.
  JudgedSurface(const PreparedScene& scene, bool isFlipped, const RunControl& control);
  struct Space {};
  /// The surface of the space around a material.
  JudgedSurface(const JudgedSurface& material, Space);
  JudgedSurface(const JudgedSurface&) = delete;
  JudgedSurface& operator=(const JudgedSurface&) = delete;

  /// Mesh, geometry, components (without first faces and counts) and hierarchy of the surface. The graph may be empty.
  [[nodiscard]] const PreparedScene& scene() const { return own_ ? *own_ : original_; }
  [[nodiscard]] const PreparedScene& original() const { return original_; }
  /// The bodies; of the space: its parts, of which the sealed voids are closed.
  [[nodiscard]] const Solids& solids() const { return solids_; }
  [[nodiscard]] bool isSpace() const { return isSpace_; }
  /// The limit for this surface, in the unit of the mesh.
  [[nodiscard]] std::optional<double> limitIn(const ThicknessOptions& options) const {
    const std::optional<LengthLimit>& limit = isSpace_ ? options.closerThan : options.thinnerThan;
    return limit ? std::optional(limit->value) : std::nullopt;
  }
  [[nodiscard]] const std::vector<EnclosedSpace>& voids() const { return voids_; }  ///< Empty for a material.
  /// The index of the outer component of the body that a triangle of the mesh bounds. Bodies that touch or overlap are
  /// several.
  [[nodiscard]] uint32_t bodyOf(uint32_t triangle) const {
    return bodyOfComponent_[original_.prepared.components.componentOf[triangle]];
  }
  /// Pairs of bodies that touch, cross or overlap, or of which one lies in the material of the other, ascending.
  [[nodiscard]] const std::vector<std::pair<uint32_t, uint32_t>>& meetingBodies() const { return meetingBodies_; }
  /// The kind of a face of the surface: never Inside.
  [[nodiscard]] FaceKind kindOf(uint32_t face) const { return kinds_.empty() ? commonKind_ : kinds_[face]; }
  /// The triangle of the mesh that a face of the surface is a part of.
  [[nodiscard]] uint32_t triangleOf(uint32_t face) const { return triangles_.empty() ? face : triangles_[face]; }
  [[nodiscard]] uint64_t crossedCount() const { return crossedCount_; }  ///< Input faces that others cross.
  [[nodiscard]] uint64_t insideCount() const {
    return insideCount_;
  }  ///< Input faces with a part inside of the material.

 private:
  void keepBodies(const Material& material);
  void divide(const Material& material);
  void adopt(const Material& material);

  const PreparedScene& original_;
  std::unique_ptr<PreparedScene> own_;
  Solids solids_;
  FaceKind commonKind_ = FaceKind::Boundary;
  std::vector<FaceKind> kinds_;
  std::vector<uint32_t> triangles_;
  uint64_t crossedCount_ = 0, insideCount_ = 0;
  bool isSpace_ = false;
  std::vector<uint32_t> bodyOfComponent_;
  std::vector<std::pair<uint32_t, uint32_t>> meetingBodies_;
  std::vector<EnclosedSpace> voids_;
};

}  // namespace asdfvk
