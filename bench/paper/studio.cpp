#include "paper/studio.h"

#include "cli/terminal.h"
#include "paper/triangle_values.h"
#include "render/picture.h"

namespace asdfvk::bench {
namespace {

constexpr double kTextScale = 1.6;  // Pictures stand three in a row.

}  // namespace

PageImage Studio::field(const std::string& file, const Subject& subject, const std::vector<double>& values,
                        const FieldStyle& style, const std::string& caption) const {
  const std::string name = file + ".png";
  writeStandardError("drawing " + name + "\n");
  const std::vector<double> ofTriangles = onTriangles(subject.mesh, values);
  folder_.write(name, render({.mesh = subject.mesh,
                              .values = ofTriangles,
                              .highlighted = {},
                              .title = style.title,
                              .range = style.range,
                              .width = kWithBar.width,
                              .height = kWithBar.height,
                              .view = subject.view,
                              .textScale = kTextScale},
                             control_));
  return {name, caption};
}

PageImage Studio::seeds(const std::string& file, const Subject& subject, const std::vector<uint8_t>& isSeed,
                        const std::string& caption, const PictureSize& size) const {
  const std::string name = file + ".png";
  writeStandardError("drawing " + name + "\n");
  const std::vector<uint8_t> ofTriangles = onTriangles(subject.mesh, isSeed);
  folder_.write(name, render({.mesh = subject.mesh,
                              .values = {},
                              .highlighted = ofTriangles,
                              .title = {},
                              .range = {},
                              .width = size.width,
                              .height = size.height,
                              .view = subject.view,
                              .textScale = kTextScale},
                             control_));
  return {name, caption};
}

}  // namespace asdfvk::bench
