#include "paper/pictures.h"

#include "render/picture.h"
#include "support/program.h"

namespace asdfvk::bench {
namespace {

constexpr int kWidth = 960, kHeight = 600;
constexpr double kTextScale = 1.6;  // The page shows three pictures in a row.

}  // namespace

void PictureWriter::drawField(int figure, const std::string& name, const NamedMesh& mesh,
                              const std::vector<double>& values, const FieldStyle& style, const std::string& caption) {
  drawTriangleField(figure, name, mesh, toTriangles(mesh.mesh, values), style, caption);
}

void PictureWriter::drawTriangleField(int figure, const std::string& name, const NamedMesh& mesh,
                                      const std::vector<double>& values, const FieldStyle& style,
                                      const std::string& caption) {
  const Image image = render({.scene = mesh.scene->scene,
                              .values = values,
                              .title = style.title,
                              .range = style.range,
                              .width = kWidth,
                              .height = kHeight,
                              .view = mesh.view,
                              .textScale = kTextScale},
                             control_);
  write(figure, name, image, caption);
}

void PictureWriter::drawSeeds(int figure, const std::string& name, const NamedMesh& mesh,
                              const std::vector<uint8_t>& isSeed, const std::string& caption) {
  const std::vector<uint8_t> highlighted = toTriangles(mesh.mesh, isSeed);
  const Image image = render({.scene = mesh.scene->scene,
                              .highlighted = highlighted,
                              .width = kWidth,
                              .height = kHeight,
                              .view = mesh.view,
                              .textScale = kTextScale},
                             control_);
  write(figure, name, image, caption);
}

void PictureWriter::write(int figure, const std::string& name, const Image& image, const std::string& caption) {
  const std::string file = name + ".png";
  folder_.write(file, image);
  list_.rows.push_back({std::to_string(figure), file, caption});
  writeProgress("wrote " + file);
}

}  // namespace asdfvk::bench
