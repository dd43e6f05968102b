#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/field.h"
#include "asdf_vk/mesh.h"

namespace asdfvk {

using FieldReferences = std::span<const std::reference_wrapper<const Field>>;

struct ResultStyle {
  bool isAscii = false;
  std::string colourOf = {};
  bool coloursVertices = false;
};

/// The arguments of a writer: a mesh of input faces and the fields on it.
class ResultView {
 public:
  /// names: the fields to write, in this order and at both locations; if empty, all fields. Throws Error{UnknownField}
  /// for a name that no field has; Error{OptionConflict} for a field with an invalid or repeated name, with other than
  /// 1 or 3 components, or with a size that does not fit the mesh; the errors of requireValidArrays() for an invalid
  /// mesh. The arrays must outlive the view.
  ResultView(const MeshView& mesh, std::span<const Field> fields, std::span<const std::string> names,
             const ResultStyle& style);

  [[nodiscard]] FieldReferences fields() const { return fields_; }
  [[nodiscard]] bool isAscii() const { return style_.isAscii; }
  [[nodiscard]] bool coloursVertices() const { return style_.coloursVertices; }
  /// The field whose colours a viewer shows first; null if no field has colours. Throws Error{UnknownField} or
  /// Error{OptionConflict} for a colourOf that cannot be shown.
  [[nodiscard]] const Field* shownField() const;
  /// The labels of the face field "segment"; null if this field is not written.
  [[nodiscard]] const std::vector<uint32_t>* parts() const;
  /// Name of the second file; empty if there is none.
  [[nodiscard]] const std::string& besideName() const { return besideName_; }
  void setBesideName(std::string name) { besideName_ = std::move(name); }
  [[nodiscard]] const MeshView& mesh() const { return mesh_; }

  [[nodiscard]] uint64_t vertexCount() const { return mesh_.vertexCount(); }
  [[nodiscard]] uint64_t faceCount() const { return mesh_.inputFaceCount(); }
  [[nodiscard]] uint64_t cornerCount() const { return mesh_.corners().size(); }  ///< Sum over all faces.
  [[nodiscard]] std::span<const uint32_t> cornersOf(uint64_t face) const {
    if (mesh_.firstCorner().empty()) return mesh_.corners().subspan(3 * face, 3);
    const uint64_t first = mesh_.firstCorner()[face];
    return mesh_.corners().subspan(first, mesh_.firstCorner()[face + 1] - first);
  }

  /// Whether float represents every finite coordinate exactly.
  [[nodiscard]] bool hasFloatVertices() const;
  template <typename T>
  [[nodiscard]] std::array<T, 3> pointAt(uint64_t vertex) const {
    const auto at = [first = 3 * vertex](auto numbers) {
      return std::array{static_cast<T>(numbers[first]), static_cast<T>(numbers[first + 1]),
                        static_cast<T>(numbers[first + 2])};
    };
    return mesh_.floats().empty() ? at(mesh_.doubles()) : at(mesh_.floats());
  }

  /// The field that viewers show by default: the first field at `location` with real values and one component.
  [[nodiscard]] const Field* mainField(FieldLocation location) const;

 private:
  MeshView mesh_;
  std::vector<std::reference_wrapper<const Field>> fields_;
  ResultStyle style_;
  std::string besideName_;
};

}  // namespace asdfvk
