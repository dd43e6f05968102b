#include "segment/assembly_parts.h"

#include <algorithm>
#include <cmath>

#include "asdf_vk/error.h"
#include "core/check.h"

namespace asdfvk {
namespace {

Parts partsOfComponent(const PartsInput& input, std::span<const uint32_t> faces, const PartsOptions& options,
                       const LineOfSight& sight, const RunControl& control) {
  std::vector<Face> triangles;
  std::vector<double> values;
  for (const uint32_t face : faces) {
    triangles.push_back(input.mesh.faces[face]);
    values.push_back(input.values[face]);
  }
  TriangleMesh mesh;
  mesh.vertices = input.mesh.vertices;
  mesh.faces = triangles;
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  const EdgeSurvey edges = surveyEdges(mesh);
  const Components components = findComponents(mesh, edges);
  return segmentIntoParts({mesh, geometry, edges.graph, components, values}, options, sight, control);
}

Parts onePart(size_t faceCount) {
  Parts parts;
  parts.partOf.assign(faceCount, 0);
  parts.partCount = parts.fewest = parts.most = 1;
  return parts;
}

}  // namespace

Parts segmentAssembly(const PartsInput& input, const PartsOptions& options, const LineOfSight& sight,
                      const RunControl& control) {
  ASDFVK_CHECK(!options.partCount);
  const size_t componentCount = input.components.components.size();
  const uint32_t faceCount = input.mesh.faceCount();
  if (std::all_of(input.values.begin(), input.values.end(), [](double v) { return std::isnan(v); }))
    throw Error(ErrorCode::NoValues, "no face has a value");
  std::vector<std::vector<uint32_t>> facesOf(componentCount);
  std::vector<double> areaOf(componentCount, 0);
  Parts all;
  all.areas.resize(faceCount);
  double area = 0;
  for (uint32_t face = 0; face < faceCount; ++face) area += input.geometry.areas[face];
  for (uint32_t face = 0; face < faceCount; ++face) {
    const uint32_t component = input.components.componentOf[face];
    all.areas[face] = input.geometry.areas[face] / area;
    facesOf[component].push_back(face);
    areaOf[component] += all.areas[face];
  }

  all.partOf.resize(faceCount);
  double comparedArea = 0, agreement = 0, meanSight = 0;
  for (size_t component = 0; component < componentCount; ++component) {
    control.checkpoint(static_cast<double>(component) / static_cast<double>(componentCount));
    const std::vector<uint32_t>& faces = facesOf[component];
    const bool isDivided =
        areaOf[component] >= kMinPartArea &&
        std::any_of(faces.begin(), faces.end(), [&](uint32_t f) { return !std::isnan(input.values[f]); });
    const Parts parts =
        isDivided ? partsOfComponent(input, faces, options, sight, control.withoutProgress()) : onePart(faces.size());
    for (size_t i = 0; i < faces.size(); ++i) all.partOf[faces[i]] = all.partCount + parts.partOf[i];
    for (const auto& [a, b, stability] : parts.boundaries)
      all.boundaries.push_back({all.partCount + a, all.partCount + b, stability});
    all.partCount += parts.partCount;
    all.fewest += parts.fewest;
    all.most += parts.most;
    all.isThinShell = all.isThinShell || parts.isThinShell;
    if (!parts.agreement) continue;
    agreement += areaOf[component] * *parts.agreement;
    meanSight += areaOf[component] * parts.meanSight;
    comparedArea += areaOf[component];
  }
  if (comparedArea > 0) {
    all.agreement = agreement / comparedArea;
    all.meanSight = meanSight / comparedArea;
  }
  numberByValue(input.values, all);
  return all;
}

}  // namespace asdfvk
