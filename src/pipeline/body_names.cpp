#include "pipeline/body_names.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "shared/cone_hit.h"

namespace asdfvk {

BodyNames::BodyNames(const JudgedSurface& surface) : surface_(surface) {
  const PreparedMesh& prepared = surface.original().prepared;
  const std::vector<Component>& components = prepared.components.components;
  const auto isFirstBody = [&](const Component& component) {
    return surface.bodyOf(component.firstFace) == surface.bodyOf(components.front().firstFace);
  };
  isPlain_ = prepared.objects.empty() && std::all_of(components.begin(), components.end(), isFirstBody);
}

std::string BodyNames::nameOf(uint32_t triangle) const {
  const PreparedMesh& prepared = surface_.original().prepared;
  const std::string_view name = objectNameOf(prepared.objects, prepared.mesh.inputFaceOf(triangle));
  return name.empty() ? fmt::format("component {}", surface_.bodyOf(triangle)) : std::string(name);
}

std::vector<std::string> BodyNames::of(uint32_t triangle, uint32_t other) const {
  if (isPlain_) return {};
  std::vector<std::string> names{nameOf(triangle)};
  const bool isSameBody = surface_.bodyOf(triangle) == surface_.bodyOf(other);
  if (std::string second = nameOf(other); !isSameBody || second != names.front()) names.push_back(std::move(second));
  if (!isSameBody && names[0] == names[1]) {
    names[0] += fmt::format(" (component {})", surface_.bodyOf(triangle));
    names[1] += fmt::format(" (component {})", surface_.bodyOf(other));
  }
  return names;
}

std::vector<std::string> BodyNames::ofInputFace(uint64_t face) const {
  const TriangleMesh& mesh = surface_.original().prepared.mesh;
  uint32_t triangle = 0;
  while (triangle < mesh.faceCount() && mesh.inputFaceOf(triangle) < face) ++triangle;
  return triangle < mesh.faceCount() ? of(triangle, triangle) : std::vector<std::string>();
}

std::vector<std::vector<std::string>> BodyNames::ofGroups(const JudgedSurface& faces, std::span<const uint32_t> groupOf,
                                                          size_t groupCount) const {
  std::vector<std::vector<std::string>> names(groupCount);
  if (isPlain_) return names;
  std::vector<std::map<uint32_t, uint32_t>> firstTriangles(groupCount);  // By body.
  for (uint32_t face = 0; face < groupOf.size(); ++face) {
    if (groupOf[face] == kNoFace) continue;
    const uint32_t triangle = faces.triangleOf(face);
    firstTriangles[groupOf[face]].try_emplace(surface_.bodyOf(triangle), triangle);
  }
  for (size_t group = 0; group < groupCount; ++group)
    for (const auto& [body, triangle] : firstTriangles[group]) names[group].push_back(nameOf(triangle));
  return names;
}

std::vector<BodyContact> BodyNames::contacts(const InputFaceSet& region) const {
  const PreparedMesh& prepared = surface_.original().prepared;
  const std::vector<Component>& components = prepared.components.components;
  std::vector<uint8_t> isOfRegion(components.size());
  for (uint32_t face = 0; face < prepared.mesh.faceCount(); ++face)
    if (region.contains(prepared.mesh.inputFaceOf(face))) isOfRegion[surface_.bodyOf(face)] = 1;
  std::vector<BodyContact> contacts;
  for (const auto& [first, second] : surface_.meetingBodies())
    if (isOfRegion[first] != 0 || isOfRegion[second] != 0)
      contacts.push_back({of(components[first].firstFace, components[second].firstFace)});
  return contacts;
}

}  // namespace asdfvk
