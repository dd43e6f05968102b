#include "pipeline/body_names.h"

#include <fmt/core.h>

#include <algorithm>

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

std::vector<std::string> BodyNames::ofAll(std::vector<uint32_t> triangles) const {
  if (isPlain_) return {};
  const auto rank = [&](uint32_t triangle) { return surface_.bodyOf(triangle); };
  std::stable_sort(triangles.begin(), triangles.end(), [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
  std::vector<std::string> names;
  for (size_t i = 0; i < triangles.size(); ++i)
    if (i == 0 || rank(triangles[i]) != rank(triangles[i - 1])) names.push_back(nameOf(triangles[i]));
  return names;
}

std::vector<BodyContact> BodyNames::contacts() const {
  const std::vector<Component>& components = surface_.original().prepared.components.components;
  std::vector<BodyContact> contacts;
  for (const auto& [first, second] : surface_.meetingBodies())
    contacts.push_back({of(components[first].firstFace, components[second].firstFace)});
  return contacts;
}

}  // namespace asdfvk
