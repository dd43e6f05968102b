#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asdf_vk/field.h"
#include "asdf_vk/session.h"
#include "describe/report_text.h"
#include "describe/shown_places.h"
#include "mesh/mesh.h"
#include "page/page_arrays.h"
#include "page/segment_list.h"

namespace asdfvk {

class AtomicFile;

using FieldSpan = std::span<const std::reference_wrapper<const Field>>;

/// Thin places and gaps.
struct PageThinPlaces {
  ShownPlaces shown;
  ThinSurface surface;
};

/// Texts and lists that a page shows of a result. Texts are UTF-8; all characters are allowed.
struct PageTexts {
  std::string name;   ///< Name of the mesh.
  std::string label;  ///< Text that distinguishes this result from other results in the page.
  ReportTexts report;
  std::string up = "y";                               ///< Upright axis of the first view: x, y, z, -x, -y or -z.
  double azimuthDegrees = 30, elevationDegrees = 18;  ///< Direction of the first view.
  std::optional<PageThinPlaces> thin;                 ///< Unset without a limit.
  std::optional<LeastPlace> least;                    ///< Unset if no wall or gap was found.
  std::vector<PageSegment> segments;
  std::vector<char> picture;  ///< PNG file for browsers without WebGL 2; may be empty.
};

/// A self-contained HTML file that shows results in a browser.
class Page {
 public:
  /// generator: name and version of the program.
  explicit Page(std::string generator) : generator_(std::move(generator)) {}

  /// Adds a result. Keeps no references to the arguments. Preconditions: as for encodeMesh().
  void add(const TriangleMesh& mesh, FieldSpan fields, PageTexts texts);

  [[nodiscard]] bool isEmpty() const { return texts_.empty(); }
  void write(AtomicFile& file) const;

  /// The JSON of the page (docs/page-format.md), and the arrays to which it refers.
  [[nodiscard]] nlohmann::ordered_json data() const;
  [[nodiscard]] const PageArrays& arrays() const { return arrays_; }

 private:
  void writeTitle(AtomicFile& file) const;
  void writeData(AtomicFile& file) const;
  void writeFallback(AtomicFile& file) const;
  void writeScript(AtomicFile& file) const;

  std::string generator_;
  /// The descriptions of encodeMesh(), with the texts.
  std::vector<std::shared_ptr<const nlohmann::ordered_json>> meshes_;
  std::vector<PageTexts> texts_;
  PageArrays arrays_;
};

}  // namespace asdfvk
