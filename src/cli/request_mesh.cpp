#include "cli/request_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "asdf_vk/error.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "describe/option_json.h"
#include "io/base64_text.h"
#include "mesh/input_faces.h"

namespace asdfvk {
namespace {

[[noreturn]] void refuseMesh(ErrorCode code, const std::string& message) { throw Error(code, message); }

Mesh decodedMesh(const MeshRequest& request, ReadOptions reading) {
  reading.format = lowerCase(request.format);
  const std::vector<std::string> formats = meshExtensions();
  if (std::find(formats.begin(), formats.end(), reading.format) == formats.end())
    refuseMesh(ErrorCode::UnknownFormat,
               fmt::format("format: '{}' is not one of {}{}", request.format, joined(formats, ", "),
                           similarNameQuestion(request.format, formats)));
  const auto bytes = base64Bytes(request.data);
  if (!bytes) refuseMesh(ErrorCode::UnreadableInput, "data is not base64");
  return parseMesh(*bytes, reading);
}

Vec3d pointOf(const Json& json, size_t index) {
  const bool isPoint = json.is_array() && json.size() == 3 &&
                       std::all_of(json.begin(), json.end(), [](const Json& number) { return number.is_number(); });
  if (!isPoint) refuseMesh(ErrorCode::ArraySize, fmt::format("vertices[{}] is not a list of three numbers", index));
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

/// Appends the corners of a face to `corners`.
void addCorners(const Json& json, size_t index, size_t vertexCount, std::vector<uint32_t>& corners) {
  if (!json.is_array() || json.size() < 3)
    refuseMesh(ErrorCode::ArraySize, fmt::format("faces[{}] is not a list of three or more vertices", index));
  for (const Json& corner : json) {
    if (!corner.is_number_unsigned() || corner.get<uint64_t>() >= vertexCount)
      refuseMesh(ErrorCode::IndexOutOfRange,
                 fmt::format("faces[{}] has a corner that is not the index of a vertex (0 to {})", index,
                             static_cast<int64_t>(vertexCount) - 1));
    corners.push_back(corner.get<uint32_t>());
  }
}

Mesh assembledMesh(const MeshRequest& request) {
  const Json &vertices = request.vertices, &faces = request.faces;
  if (!vertices.is_array() || !faces.is_array())
    refuseMesh(ErrorCode::ArraySize, "vertices and faces belong together, and both are lists of lists");
  if (faces.empty()) refuseMesh(ErrorCode::EmptyMesh, "the mesh has no faces");
  Mesh mesh;
  mesh.vertices.reserve(vertices.size());
  for (size_t i = 0; i < vertices.size(); ++i) mesh.vertices.push_back(pointOf(vertices[i], i));
  InputFaces input;
  input.reserve(faces.size());
  std::vector<uint32_t> corners;
  for (size_t i = 0; i < faces.size(); ++i) {
    corners.clear();
    addCorners(faces[i], i, mesh.vertices.size(), corners);
    input.add(corners);
  }
  input.moveTo(mesh);
  return mesh;
}

void requireSize(const std::string& path, uint64_t maxBytes) {
  std::error_code error;
  const uint64_t size = std::filesystem::file_size(path, error);
  if (error) return;  // loadMesh() throws the reason.
  if (maxBytes > 0 && size > maxBytes)
    refuseMesh(ErrorCode::InputTooLarge, fmt::format("{} has {} bytes; --max-memory allows {}", path, size, maxBytes));
}

}  // namespace

LoadedMesh requestedMesh(const MeshRequest& request, const std::string& path, const ReadOptions& reading,
                         uint64_t maxBytes) {
  LoadedMesh loaded;
  const Stopwatch watch;
  try {
    if (!path.empty()) {
      requireSize(path, maxBytes);
      return loadMesh(path, reading, false, {});
    }
    loaded.mesh = request.data.empty() ? assembledMesh(request) : decodedMesh(request, reading);
  } catch (...) {
    loaded.failure = std::current_exception();
  }
  loaded.seconds = watch.seconds();
  return loaded;
}

}  // namespace asdfvk
