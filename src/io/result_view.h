#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/field.h"
#include "asdf_vk/mesh.h"
#include "io/stored_fields.h"

namespace asdfvk {

/// The arguments of a writer: a mesh of input faces and the fields on it.
class ResultView {
 public:
  /// names: the fields to write, in this order; empty: all. Throws Error{UnknownField} for a name that no field has;
  /// Error{OptionConflict} for a field with an invalid or repeated name, with other than 1 or 3 components, or whose
  /// size does not fit the mesh; the errors of requireValidArrays() for an invalid mesh. The arrays must outlive the
  /// view.
  ResultView(const MeshView& mesh, std::span<const Field> fields, std::span<const std::string> names, bool ascii);

  [[nodiscard]] FieldReferences fields() const { return fields_; }
  [[nodiscard]] bool isAscii() const { return isAscii_; }

  [[nodiscard]] uint64_t vertexCount() const { return mesh_.vertexCount(); }
  [[nodiscard]] uint64_t faceCount() const { return mesh_.inputFaceCount(); }
  [[nodiscard]] uint64_t cornerCount() const { return mesh_.corners().size(); }  ///< Of all faces.
  [[nodiscard]] std::span<const uint32_t> cornersOf(uint64_t face) const {
    if (mesh_.firstCorner().empty()) return mesh_.corners().subspan(3 * face, 3);
    const uint64_t first = mesh_.firstCorner()[face];
    return mesh_.corners().subspan(first, mesh_.firstCorner()[face + 1] - first);
  }

  /// Whether float holds every coordinate exactly; non-finite ones are held.
  [[nodiscard]] bool hasFloatVertices() const;
  /// Calls put(T) for x, y, z of each vertex.
  template <typename T, typename Put>
  void putCoordinates(Put put) const {
    for (const double coordinate : mesh_.doubles()) put(static_cast<T>(coordinate));
    for (const float coordinate : mesh_.floats()) put(static_cast<T>(coordinate));
  }

  /// The field that a viewer should show first: the first one of that location with one component and real values.
  [[nodiscard]] const Field* mainField(FieldLocation location) const;

 private:
  MeshView mesh_;
  std::vector<std::reference_wrapper<const Field>> fields_;
  bool isAscii_;
};

}  // namespace asdfvk
