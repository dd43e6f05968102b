// Reads a binary PLY with our reader and with OpenMesh's into plain arrays, turn by turn in one run, and prints the
// median and the spread of each. Without a file it writes a float PLY of 3 million vertices and 6 million faces to
// read.
#include <fmt/format.h>
#include <unistd.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "array_importer.h"
#include "core/stopwatch.h"
#include "io/mesh_reader.h"

namespace {

using asdfvk::Face;
using asdfvk::Mesh;
using asdfvk::Stopwatch;

/// A wavy sheet of about `faceCount` triangles in float32.
void writeSheet(const std::filesystem::path& path, uint32_t faceCount) {
  uint32_t side = 1;
  while (2 * uint64_t{side} * side < faceCount) ++side;
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      (side + 1) * (side + 1), 2 * side * side);
  const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (uint32_t y = 0; y <= side; ++y)
    for (uint32_t x = 0; x <= side; ++x)
      append(std::array{static_cast<float>(x), static_cast<float>(y), static_cast<float>((x * y) % 17)});
  const auto appendFace = [&](const Face& face) {
    append(uint8_t{3});
    append(face);
  };
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t a = y * (side + 1) + x, b = a + 1, c = a + side + 1, d = c + 1;
      appendFace({a, b, d});
      appendFace({a, d, c});
    }
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void printRow(const char* name, std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  fmt::print("{:<10} median {:.3f} s, {:.3f} to {:.3f} s over {} runs\n", name, seconds[seconds.size() / 2],
             seconds.front(), seconds.back(), seconds.size());
}

}  // namespace

int main(int argumentCount, char** arguments) {
  const bool hasFile = argumentCount > 1;
  const std::filesystem::path path =
      hasFile ? std::filesystem::path(arguments[1])
              : std::filesystem::temp_directory_path() / fmt::format("asdfvk-read-ply-{}.ply", ::getpid());
  if (!hasFile) writeSheet(path, 6'000'000);
  constexpr int kRunCount = 7;
  std::vector<double> ourSeconds, openMeshSeconds;
  bool areEqual = true;
  Mesh mesh;
  for (int run = -1; run < kRunCount; ++run) {  // Run -1 warms up.
    mesh = {};
    const Stopwatch ourWatch;
    mesh = asdfvk::readMesh(path);
    const double ours = ourWatch.seconds();
    asdfvk::bench::ArrayImporter importer;
    OpenMesh::IO::Options options;
    const Stopwatch openMeshWatch;
    const bool isRead = OpenMesh::IO::PLYReader().read(path.string(), importer, options);
    const double theirs = openMeshWatch.seconds();
    areEqual = areEqual && isRead && importer.vertices == mesh.vertices && importer.faces == mesh.faces;
    if (run < 0) continue;
    ourSeconds.push_back(ours);
    openMeshSeconds.push_back(theirs);
  }
  if (!hasFile) std::filesystem::remove(path);
  fmt::print("{} vertices, {} faces, binary PLY\n", mesh.vertices.size(), mesh.faces.size());
  printRow("asdf-vk", ourSeconds);
  printRow("OpenMesh", openMeshSeconds);
  if (!areEqual) fmt::print("the two readers differ\n");
  return areEqual ? 0 : 1;
}
