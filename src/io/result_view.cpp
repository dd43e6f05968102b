#include "io/result_view.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "io/input_failure.h"
#include "mesh/validation.h"

namespace asdfvk {
namespace {

[[noreturn]] void failConflict(const std::string& reason) { throw Error(ErrorCode::OptionConflict, reason); }

/// Whether the name has at least one character, and only ASCII letters, digits and '_'.
bool isFieldName(std::string_view name) {
  const auto isAllowed = [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), isAllowed);
}

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
                       const ResultStyle& style)
    : mesh_(mesh), style_(style) {
  requireValidArrays(mesh);
  if (names.empty()) fields_.assign(fields.begin(), fields.end());
  for (const std::string& name : names) {
    if (findField(fields, name) == nullptr)
      throw Error(ErrorCode::UnknownField, fmt::format("the result has no field {}", printable(name)));
    std::copy_if(fields.begin(), fields.end(), std::back_inserter(fields_),
                 [&](const Field& field) { return field.name == name; });
  }
  std::set<std::pair<FieldLocation, std::string_view>> used;
  for (const Field& field : fields_) {
    requireValidField(field, mesh);
    if (!used.emplace(field.location, field.name).second)
      failConflict(fmt::format("two fields have the name {}", field.name));
  }
}

bool ResultView::hasFloatVertices() const {
  const std::span<const double> numbers = mesh_.doubles();
  const auto isFloat = [](double c) { return !std::isfinite(c) || static_cast<double>(static_cast<float>(c)) == c; };
  const auto hasDouble = [&](size_t begin, size_t end) -> uint64_t {
    return !std::all_of(numbers.begin() + static_cast<std::ptrdiff_t>(begin),
                        numbers.begin() + static_cast<std::ptrdiff_t>(end), isFloat);
  };
  return foldInParallel<uint64_t>(numbers.size(), hasDouble, std::plus<>()) == 0;
}

const std::vector<uint32_t>* ResultView::parts() const {
  for (const Field& field : fields_)
    if (field.name == "segment" && field.location == FieldLocation::PerFace)
      return std::get_if<std::vector<uint32_t>>(&field.values);
  return nullptr;
}

const Field* ResultView::shownField() const {
  const std::string& wanted = style_.colourOf;
  for (const Field& field : fields_) {
    if (field.name != (wanted.empty() ? "segment" : wanted)) continue;
    if (field.componentCount == 1) return &field;
    if (!wanted.empty())
      failConflict(fmt::format("field {} has {} components; colours show a field of one component", wanted,
                               field.componentCount));
  }
  if (!wanted.empty())
    throw Error(ErrorCode::UnknownField,
                fmt::format("the colours cannot show the field {}, because it is not written", printable(wanted)));
  const Field* const ofFaces = mainField(FieldLocation::PerFace);
  return ofFaces != nullptr ? ofFaces : mainField(FieldLocation::PerVertex);
}

const Field* ResultView::mainField(FieldLocation location) const {
  for (const Field& field : fields_)
    if (field.location == location && field.componentCount == 1 && field.reals() != nullptr) return &field;
  return nullptr;
}

}  // namespace asdfvk
