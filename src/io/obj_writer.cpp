// Wavefront OBJ: vertices with colours, and the faces in file order. Each part has a material (usemtl), which a second
// file defines. OBJ cannot store the values of fields.
#include "io/obj_writer.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/atomic_file.h"
#include "io/formats.h"
#include "io/result_colours.h"

namespace asdfvk {
namespace {

/// The name of a material, for example "part_3". The name has no blank, because some readers end a name at a blank.
std::string materialOf(uint32_t part) {
  std::string name = nameOfPart(part);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

void putColour(AtomicFile& file, const Rgba& colour) {
  for (size_t channel = 0; channel < 3; ++channel) file.write(fmt::format(" {:.4f}", colour[channel] / 255.0));
}

void writeVertices(AtomicFile& file, const ResultView& result, const std::vector<Rgba>& colours) {
  const auto put = [&](uint64_t vertex, const auto& point) {
    file.put('v');
    for (const auto coordinate : point) {
      file.put(' ');
      file.putNumber(coordinate);
    }
    if (!colours.empty()) putColour(file, colours[vertex]);
    file.put('\n');
  };
  result.hasFloatVertices() ? result.putPoints<float>(put) : result.putPoints<double>(put);
}

}  // namespace

void writeObj(AtomicFile& file, const ResultView& result) {
  const Field* const shown = result.shownField();
  file.write(fmt::format("# asdf-vk: {}{}\n", shown == nullptr ? "no colours" : "colours show ",
                         shown == nullptr ? "" : shown->name));
  if (!result.besideName().empty()) file.write(fmt::format("mtllib {}\n", result.besideName()));
  file.write("o asdf-vk\n");
  writeVertices(file, result, shown == nullptr ? std::vector<Rgba>() : vertexColoursOf(result, *shown));
  const std::vector<uint32_t>* const parts = result.parts();
  for (uint64_t face = 0; face < result.faceCount(); ++face) {
    if (parts != nullptr && (face == 0 || (*parts)[face] != (*parts)[face - 1]))
      file.write(fmt::format("usemtl {}\n", materialOf((*parts)[face])));
    file.put('f');
    for (const uint32_t corner : result.cornersOf(face)) {
      file.put(' ');
      file.putNumber(uint64_t{corner} + 1);
    }
    file.put('\n');
  }
}

void writeObjMaterials(AtomicFile& file, const ResultView& result) {
  std::vector<uint32_t> parts = *result.parts();
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  for (const uint32_t part : parts) {
    file.write(fmt::format("newmtl {}\nKd", materialOf(part)));
    putColour(file, colourOfPart(part));
    file.write("\nKa 0 0 0\nKs 0 0 0\nillum 1\n\n");
  }
}

bool hasObjMaterials(const ResultView& result) { return result.parts() != nullptr; }

}  // namespace asdfvk
