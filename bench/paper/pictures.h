#pragma once

#include <string>
#include <vector>

#include "asdf_vk/run_control.h"
#include "io/colour_map.h"
#include "paper/evaluation.h"
#include "paper/output.h"

namespace asdfvk::bench {

/// Converts entries per input face (#I) to entries per triangle (#F).
template <typename T>
[[nodiscard]] std::vector<T> toTriangles(const Mesh& mesh, const std::vector<T>& inputFaceValues) {
  if (mesh.polygons.isEmpty()) return inputFaceValues;
  std::vector<T> values;
  values.reserve(mesh.faces.size());
  for (const uint32_t inputFace : mesh.polygons.inputFaceOf) values.push_back(inputFaceValues[inputFace]);
  return values;
}

struct FieldStyle {
  std::string title;  ///< Text above the colour bar.
  ColourRange range;
};

/// Renders meshes to PNG files with the same style, and keeps a list of the files. Reports progress on standard error.
class PictureWriter {
 public:
  PictureWriter(const OutputFolder& folder, RunControl control) : folder_(folder), control_(std::move(control)) {}

  // figure: number in the paper. name: the file without ".png".
  /// values: #I; faces with NaN are grey.
  void drawField(int figure, const std::string& name, const NamedMesh& mesh, const std::vector<double>& values,
                 const FieldStyle& style, const std::string& caption);
  /// values: #F.
  void drawTriangleField(int figure, const std::string& name, const NamedMesh& mesh, const std::vector<double>& values,
                         const FieldStyle& style, const std::string& caption);
  /// isSeed: #I; seeds are red.
  void drawSeeds(int figure, const std::string& name, const NamedMesh& mesh, const std::vector<uint8_t>& isSeed,
                 const std::string& caption);

  /// The list of pictures in the order of drawing, with the columns figure, file and caption.
  [[nodiscard]] const CsvTable& list() const { return list_; }

 private:
  void write(int figure, const std::string& name, const Image& image, const std::string& caption);

  const OutputFolder& folder_;
  RunControl control_;
  CsvTable list_{{"figure", "file", "caption"}, {}};
};

}  // namespace asdfvk::bench
