#pragma once

#include <filesystem>
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
#include "asdf_vk/run_control.h"
#include "asdf_vk/session.h"
#include "describe/report_text.h"
#include "describe/shown_places.h"
#include "mesh/mesh.h"
#include "page/page_arrays.h"

namespace asdfvk {

class AtomicFile;
class AtomicFiles;
struct View;

using FieldSpan = std::span<const std::reference_wrapper<const Field>>;

/// Thin places and gaps.
struct PageThinPlaces {
  ShownPlaces shown;
  ThinSurface surface;
};

struct PageSegment {
  uint32_t label = 0;
  uint64_t faceCount = 0;  ///< Number of triangles.
  double area = 0;
  double median = kNoValue;  ///< Median of the values of the triangles; NaN without values.
  Vec3d centre;              ///< Area-weighted mean of the barycentres.
};

/// Texts and lists that a page shows of a result. Texts are UTF-8; all characters are allowed.
struct PageTexts {
  std::string name;   ///< Name of the mesh.
  std::string label;  ///< Text that distinguishes this result from other results in the page.
  ReportTexts report;
  std::string up = "y";                               ///< Upright axis of the first view: x, y, z, -x, -y or -z.
  double azimuthDegrees = 30, elevationDegrees = 18;  ///< Direction of the first view.
  std::optional<PageThinPlaces> thin;                 ///< Unset without a limit.
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

/// Adds a result with its thin places, segments, view and a small picture. texts: name, label and report. fields: the
/// fields to show, beginning with the field of the picture. Preconditions: the result has a scene; there is a field.
/// Throws Error{Cancelled}.
void addResult(Page& page, PageTexts texts, const Result& result, FieldSpan fields, const View& view,
               const RunControl& control);

/// A page without results, with the name and version of this program as generator.
[[nodiscard]] Page emptyPage();

/// Writes the page atomically. Throws Error{OutputNotWritable}.
void writePage(const std::filesystem::path& path, const Page& page);
/// The file appears when the caller commits the group.
void writePage(AtomicFiles& files, const std::filesystem::path& path, const Page& page);

/// Returns the segments, ascending by label. areas, barycentres: #F. labels, values: #I. Leaves out kNoSegment.
[[nodiscard]] std::vector<PageSegment> listSegments(const TriangleMesh& mesh, std::span<const double> areas,
                                                    std::span<const Vec3d> barycentres,
                                                    std::span<const uint32_t> labels, std::span<const double> values);

}  // namespace asdfvk
