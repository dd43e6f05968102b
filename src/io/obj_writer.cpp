// Wavefront OBJ: vertices with colours, and the faces in file order. Each part has a material (usemtl), which a second
// file defines. OBJ cannot store the values of fields.
#include "io/obj_writer.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/atomic_file.h"
#include "io/formats.h"
#include "io/result_colours.h"
#include "io/row_blocks.h"

namespace asdfvk {
namespace {

/// The name of a material, for example "part_3". The name has no blank, because some readers end a name at a blank.
std::string materialOf(uint32_t part) {
  std::string name = nameOfPart(part);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

void putColour(ByteOutput& file, const Rgba& colour) {
  for (size_t channel = 0; channel < 3; ++channel) file.write(fmt::format(" {:.4f}", colour[channel] / 255.0));
}

template <typename T>
void writeVertices(AtomicFile& file, const ResultView& result, const std::vector<Rgba>& colours) {
  writeRows(file, result.vertexCount(), [&](ByteBuffer& to, uint64_t vertex) {
    to.put('v');
    for (const T coordinate : result.pointAt<T>(vertex)) {
      to.put(' ');
      to.putNumber(coordinate);
    }
    if (!colours.empty()) putColour(to, colours[vertex]);
    to.put('\n');
  });
}

}  // namespace

void writeObj(AtomicFile& file, const ResultView& result) {
  const Field* const shown = result.shownField();
  file.write(fmt::format("# asdf-vk: {}{}\n", shown == nullptr ? "no colours" : "colours show ",
                         shown == nullptr ? "" : shown->name));
  if (!result.besideName().empty()) file.write(fmt::format("mtllib {}\n", result.besideName()));
  file.write("o asdf-vk\n");
  const std::vector<Rgba> colours = shown == nullptr ? std::vector<Rgba>() : vertexColoursOf(result, *shown);
  result.hasFloatVertices() ? writeVertices<float>(file, result, colours)
                            : writeVertices<double>(file, result, colours);
  const std::vector<uint32_t>* const parts = result.parts();
  writeRows(file, result.faceCount(), [&](ByteBuffer& to, uint64_t face) {
    if (parts != nullptr && (face == 0 || (*parts)[face] != (*parts)[face - 1]))
      to.write(fmt::format("usemtl {}\n", materialOf((*parts)[face])));
    to.put('f');
    for (const uint32_t corner : result.cornersOf(face)) {
      to.put(' ');
      to.putNumber(uint64_t{corner} + 1);
    }
    to.put('\n');
  });
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
