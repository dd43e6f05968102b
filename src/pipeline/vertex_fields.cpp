#include "pipeline/vertex_fields.h"

#include <cmath>
#include <utility>

#include "asdf_vk/session.h"
#include "core/bucket_sort.h"
#include "core/check.h"
#include "core/parallel.h"
#include "pipeline/input_face_values.h"

namespace asdfvk {
namespace {

struct VertexFaces {
  const TriangleMesh& mesh;
  std::span<const uint32_t> vertexOf;
  std::span<const double> areas;
  Buckets<uint32_t> faces;

  [[nodiscard]] std::span<const uint32_t> facesAt(uint32_t vertex) const {
    return faces[vertexOf.empty() ? vertex : vertexOf[vertex]];
  }

  VertexFaces(const TriangleMesh& triangles, std::span<const uint32_t> vertices, std::span<const double> faceAreas)
      : mesh(triangles),
        vertexOf(vertices),
        areas(faceAreas),
        faces(sortIntoBuckets<uint32_t>(mesh.vertices.size(), mesh.faceCount(), [&](uint32_t face, auto put) {
          for (const uint32_t vertex : mesh.faces[face]) put(vertex, face);
        })) {}
};

std::vector<double> meansOf(const VertexFaces& at, const std::vector<double>& entries, uint32_t componentCount) {
  std::vector<double> means(at.mesh.vertices.size() * componentCount, kNoValue);
  const auto meanAt = [&](uint32_t vertex, size_t component) {
    double weight = 0, mean = kNoValue, last = kNoValue;
    for (const uint32_t face : at.facesAt(vertex)) {
      const double value = entries[at.mesh.inputFaceOf(face) * size_t{componentCount} + component];
      if (std::isnan(value)) continue;
      last = value;
      const double area = at.areas[face];
      if (!(area > 0)) continue;
      mean = weight > 0 ? mean + (value - mean) * (area / (weight + area)) : value;
      weight += area;
    }
    return weight > 0 ? mean : last;
  };
  forEachInParallel(at.mesh.vertices.size(), [&](uint32_t vertex) {
    for (size_t c = 0; c < componentCount; ++c) means[vertex * size_t{componentCount} + c] = meanAt(vertex, c);
  });
  return means;
}

std::vector<uint32_t> labelsOf(const VertexFaces& at, const std::vector<uint32_t>& entries) {
  std::vector<uint32_t> labels(at.mesh.vertices.size(), kNoSegment);
  forEachInParallel(labels.size(), [&](uint32_t vertex) {
    std::vector<std::pair<uint32_t, double>> areaOf;
    for (const uint32_t face : at.facesAt(vertex))
      if (const uint32_t label = entries[at.mesh.inputFaceOf(face)]; label != kNoSegment)
        areaOf.emplace_back(label, at.areas[face]);
    labels[vertex] = labelOfLargestArea(areaOf);
  });
  return labels;
}

std::vector<uint8_t> flagsOf(const VertexFaces& at, const std::vector<uint8_t>& entries) {
  std::vector<uint8_t> flags(at.mesh.vertices.size(), 0);
  forEachInParallel(flags.size(), [&](uint32_t vertex) {
    for (const uint32_t face : at.facesAt(vertex)) flags[vertex] |= entries[at.mesh.inputFaceOf(face)];
  });
  return flags;
}

}  // namespace

std::vector<Field> vertexFieldsOf(const TriangleMesh& mesh, std::span<const uint32_t> vertexOf,
                                  std::span<const double> areas, std::span<const Field> faceFields) {
  const VertexFaces at(mesh, vertexOf, areas);
  std::vector<Field> fields;
  for (const Field& field : faceFields) {
    ASDFVK_CHECK_OP(field.itemCount(), ==, mesh.inputFaceCount());
    Field& result = fields.emplace_back(Field{.name = field.name,
                                              .label = field.label,
                                              .unit = field.unit,
                                              .location = FieldLocation::PerVertex,
                                              .componentCount = field.componentCount});
    if (const auto* reals = field.reals()) {
      result.values = meansOf(at, *reals, field.componentCount);
    } else {
      ASDFVK_CHECK_OP(field.componentCount, ==, 1u);
      if (const auto* labels = std::get_if<std::vector<uint32_t>>(&field.values)) result.values = labelsOf(at, *labels);
      if (const auto* flags = std::get_if<std::vector<uint8_t>>(&field.values)) result.values = flagsOf(at, *flags);
    }
  }
  return fields;
}

}  // namespace asdfvk
