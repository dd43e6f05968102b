#include "mesh/orientation.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "mesh/cavities.h"

namespace asdfvk {
namespace {

constexpr size_t kNamedComponents = 5;

void flipPolygons(Polygons& polygons, std::span<const uint8_t> isFlipped) {
  constexpr uint64_t kNone = ~uint64_t{0};
  uint64_t last = kNone;
  for (size_t f = 0; f < polygons.inputFaceOf.size(); ++f) {
    const uint64_t input = polygons.inputFaceOf[f];
    if (!isFlipped[f] || input == last) continue;
    last = input;
    const auto corner = [&](size_t i) {
      return polygons.corners.begin() + static_cast<std::ptrdiff_t>(polygons.firstCorner[i]);
    };
    std::reverse(corner(input) + 1, corner(input + 1));
  }
}

struct ComponentFaces {
  uint32_t first = 0;
  uint64_t count = 0;
};

// A polygon whose triangles belong to several components is counted in each of these components.
ComponentFaces componentFacesOf(const TriangleMesh& mesh, const Components& components, uint32_t index) {
  const Component& component = components.components[index];
  const std::span<const uint32_t> inputFaceOf = mesh.polygons.inputFaceOf;
  if (mesh.polygons.isEmpty()) return {component.firstFace, component.faceCount};
  ComponentFaces faces{inputFaceOf[component.firstFace], 1};
  uint32_t last = faces.first;
  for (uint32_t f = component.firstFace; f < mesh.faceCount(); ++f) {
    if (components.componentOf[f] != index || inputFaceOf[f] == last) continue;
    last = inputFaceOf[f];
    ++faces.count;
  }
  return faces;
}

}  // namespace

std::string OrientationReport::sentence(const TriangleMesh& mesh, const Components& components) const {
  if (invertedComponents.empty()) return {};
  std::string names;
  for (size_t i = 0; i < std::min(invertedComponents.size(), kNamedComponents); ++i) {
    const ComponentFaces faces = componentFacesOf(mesh, components, invertedComponents[i]);
    names += fmt::format("{}face {} and the {} connected to it", i == 0 ? "" : ", ", faces.first, faces.count - 1);
  }
  if (invertedComponents.size() > kNamedComponents)
    names += fmt::format(", and {} more", invertedComponents.size() - kNamedComponents);
  const char* form = invertedComponents.size() == 1
                         ? "{} of {} components is inverted ({}): its rays leave the solid"
                         : "{} of {} components are inverted ({}): their rays leave the solid";
  return fmt::format(fmt::runtime(form), invertedComponents.size(), components.components.size(), names);
}

OrientationReport analyseOrientation(const TriangleMesh& mesh, const Components& components) {
  OrientationReport report;
  report.isCavity = findCavities(mesh, components).isCavity;
  for (uint32_t i = 0; i < components.components.size(); ++i) {
    const Component& component = components.components[i];
    if (!component.isClosed || !component.isConsistentlyWound) continue;
    if (report.isCavity[i] ? component.signedVolume > 0 : component.signedVolume < 0)
      report.invertedComponents.push_back(i);
  }
  return report;
}

void flipFaces(Mesh& mesh, std::span<const uint8_t> isFlipped) {
  ASDFVK_CHECK_OP(isFlipped.size(), ==, mesh.faces.size());
  for (uint32_t f = 0; f < mesh.faceCount(); ++f)
    if (isFlipped[f]) std::swap(mesh.faces[f][1], mesh.faces[f][2]);
  flipPolygons(mesh.polygons, isFlipped);
}

void flipFaces(Mesh& mesh, FaceGeometry& geometry, std::span<const uint8_t> isFlipped) {
  flipFaces(mesh, isFlipped);
  for (uint32_t f = 0; f < mesh.faceCount(); ++f)
    if (isFlipped[f] && !geometry.isDegenerate(f)) geometry.normals[f] = -geometry.normals[f];
}

void flipInputFaces(Mesh& mesh, std::span<const uint64_t> inputFaces) {
  std::vector<uint8_t> isFlipped(mesh.faces.size(), 0);
  size_t next = 0;
  for (uint32_t f = 0; f < mesh.faceCount() && next < inputFaces.size(); ++f) {
    const uint64_t input = mesh.polygons.isEmpty() ? f : mesh.polygons.inputFaceOf[f];
    while (next < inputFaces.size() && inputFaces[next] < input) ++next;
    isFlipped[f] = next < inputFaces.size() && inputFaces[next] == input;
  }
  flipFaces(mesh, isFlipped);
}

void flipAllFaces(Mesh& mesh, FaceGeometry& geometry, Components& components) {
  flipFaces(mesh, geometry, std::vector<uint8_t>(mesh.faces.size(), 1));
  for (Component& component : components.components) component.signedVolume = -component.signedVolume;
}

void orientOutward(Mesh& mesh, FaceGeometry& geometry, Components& components, OrientationReport& report) {
  if (report.invertedComponents.empty()) return;
  std::vector<uint8_t> isInverted(components.components.size(), 0), isFlipped(mesh.faces.size());
  for (uint32_t index : report.invertedComponents) {
    isInverted[index] = 1;
    components.components[index].signedVolume = -components.components[index].signedVolume;
  }
  for (size_t f = 0; f < isFlipped.size(); ++f) isFlipped[f] = isInverted[components.componentOf[f]];
  flipFaces(mesh, geometry, isFlipped);
  report.invertedComponents.clear();
}

}  // namespace asdfvk
