#include "io/result_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "io/input_failure.h"
#include "io/stored_fields.h"
#include "mesh/validation.h"

namespace asdfvk {
namespace {

[[noreturn]] void failConflict(const std::string& reason) { throw Error(ErrorCode::OptionConflict, reason); }

void requireValidField(const Field& field, const MeshView& mesh) {
  if (!isFieldName(field.name))
    failConflict(fmt::format("'{}' is not a name of a field; letters, digits and '_' are allowed", field.name));
  if (field.componentCount != 1 && field.componentCount != 3)
    failConflict(fmt::format("field {} has {} components; 1 or 3 are allowed", field.name, field.componentCount));
  const bool isFace = field.location == FieldLocation::PerFace;
  const uint64_t itemCount = isFace ? mesh.inputFaceCount() : mesh.vertexCount();
  if (field.size() != itemCount * field.componentCount)
    failConflict(fmt::format("field {} has {} of {}; the mesh has {}", field.name,
                             counted(field.size(), "entry", "entries"), counted(field.componentCount, "component"),
                             isFace ? counted(itemCount, "face") : counted(itemCount, "vertex", "vertices")));
}

}  // namespace

ResultView::ResultView(const MeshView& mesh, std::span<const Field> fields, std::span<const std::string> names,
                       bool ascii)
    : mesh_(mesh), isAscii_(ascii) {
  requireValidArrays(mesh);
  if (names.empty()) fields_.assign(fields.begin(), fields.end());
  for (const std::string& name : names) {
    const Field* const field = findField(fields, name);
    if (field == nullptr)
      throw Error(ErrorCode::UnknownField, fmt::format("the result has no field {}", printable(name)));
    fields_.emplace_back(*field);
  }
  std::set<std::string_view> used;
  for (const Field& field : fields_) {
    requireValidField(field, mesh);
    if (!used.insert(field.name).second) failConflict(fmt::format("two fields have the name {}", field.name));
  }
}

bool ResultView::hasFloatVertices() const {
  return std::all_of(mesh_.doubles().begin(), mesh_.doubles().end(),
                     [](double c) { return !std::isfinite(c) || static_cast<double>(static_cast<float>(c)) == c; });
}

const Field* ResultView::mainField(FieldLocation location) const {
  for (const Field& field : fields_)
    if (field.location == location && field.componentCount == 1 && field.reals() != nullptr) return &field;
  return nullptr;
}

}  // namespace asdfvk
