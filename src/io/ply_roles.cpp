#include "io/ply_roles.h"

#include <fmt/format.h>

#include "core/text.h"
#include "io/input_faces.h"
#include "io/input_failure.h"

namespace asdfvk {
namespace {

void setOnce(size_t& property, size_t value, const PlyElement& element) {
  if (property != kNoProperty)
    failInput(fmt::format("element {} has two properties for {}", quoted(element.name),
                          quoted(element.properties[value].name)));
  property = value;
}

void findCoordinates(PlyElement& element) {
  constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
  for (size_t i = 0; i < element.properties.size(); ++i)
    for (size_t axis = 0; axis < 3; ++axis)
      if (element.properties[i].name == kNames[axis]) setOnce(element.coordinates[axis], i, element);
  for (size_t axis = 0; axis < 3; ++axis) {
    if (element.coordinates[axis] == kNoProperty)
      failInput(fmt::format("element 'vertex' has no property {}", kNames[axis]));
    if (element.properties[element.coordinates[axis]].list)
      failInput(fmt::format("property {} of element 'vertex' is a list; it must be a number", kNames[axis]));
  }
}

void findIndices(PlyElement& element) {
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const std::string_view name = element.properties[i].name;
    if (name == "vertex_indices" || name == "vertex_index") setOnce(element.indices, i, element);
  }
  if (element.indices == kNoProperty)
    failInput(fmt::format("element {} has no list vertex_indices", quoted(element.name)));
  const PlyProperty& property = element.properties[element.indices];
  if (!property.list || !isInteger(property.type))
    failInput(fmt::format("property {} of element {} must be a list of integers", quoted(property.name),
                          quoted(element.name)));
}

}  // namespace

uint64_t assignPlyRoles(std::span<PlyElement> elements) {
  const PlyElement* vertices = nullptr;
  const PlyElement* faces = nullptr;
  const PlyElement* strips = nullptr;
  const auto take = [](const PlyElement*& place, PlyElement& element, PlyRole role) {
    if (place != nullptr) failInput(fmt::format("element {} stands in the header twice", quoted(element.name)));
    place = &element;
    element.role = role;
    role == PlyRole::Vertices ? findCoordinates(element) : findIndices(element);
  };
  for (PlyElement& element : elements) {
    if (element.name == "vertex") take(vertices, element, PlyRole::Vertices);
    if (element.name == "face") take(faces, element, PlyRole::Faces);
    if (element.name == "tristrips") take(strips, element, PlyRole::Strips);
  }
  if (vertices == nullptr) failInput("it has no element 'vertex'");
  if (faces == nullptr && strips == nullptr)
    failInput(fmt::format("it holds {} and no element 'face'; a point cloud has to be meshed first",
                          counted(vertices->count, "point")));
  requireIndexableVertexCount(vertices->count);
  return vertices->count;
}

}  // namespace asdfvk
