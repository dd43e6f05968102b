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
#include "mesh/mesh.h"
#include "page/page_arrays.h"

namespace asdfvk {

class AtomicFile;

/// The comparison of a result with a limit of the thickness.
struct PageThinPlaces {
  double limit = 0;
  std::string verdict;  ///< "passed", "failed" or "notJudged".
  std::vector<ThinRegion> regions;
  ThinSurface surface;
};

struct PageSegment {
  uint32_t label = 0;
  uint64_t faceCount = 0;  ///< Triangles.
  double area = 0;
  double median = kNoValue;  ///< Median of the values of its triangles; NaN where none has one.
  Vec3d centre;              ///< Mean of the barycentres, weighted by area.
};

/// The texts and lists of a result in a page, in UTF-8; any characters are allowed.
struct PageTexts {
  std::string name;                                          ///< Name of the mesh.
  std::string label;                                         ///< Distinguishes this result from the others of the page.
  std::vector<std::pair<std::string, std::string>> summary;  ///< Rows of a table: title, value.
  std::string errorSentence;
  std::string up = "y";                               ///< Upright axis of the first view: x, y, z, -x, -y or -z.
  double azimuthDegrees = 30, elevationDegrees = 18;  ///< Direction of the first view.
  std::vector<std::string> warnings, defects;
  std::optional<PageThinPlaces> thin;  ///< Unset without a limit.
  std::vector<PageSegment> segments;
  std::vector<char> picture;  ///< A PNG for browsers without WebGL2; may be empty.
};

/// One HTML file that shows results in a browser and needs no other file.
class Page {
 public:
  /// generator: name and version of the program.
  explicit Page(std::string generator) : generator_(std::move(generator)) {}

  /// Encodes a result; copies what it needs. Preconditions: as encodeMesh().
  void add(const TriangleMesh& mesh, std::span<const std::reference_wrapper<const Field>> fields, PageTexts texts);

  [[nodiscard]] bool isEmpty() const { return texts_.empty(); }
  void write(AtomicFile& file) const;

 private:
  void writeTitle(AtomicFile& file) const;
  void writeData(AtomicFile& file) const;
  void writeFallback(AtomicFile& file) const;
  void writeScript(AtomicFile& file) const;

  std::string generator_;
  std::vector<std::shared_ptr<const nlohmann::ordered_json>> meshes_;  ///< Descriptions.
  std::vector<PageTexts> texts_;
  PageArrays arrays_;
};

/// The segments in the order of their labels, with the labels and values per input face. Where an entry of `labels` is
/// kNoSegment, the face belongs to none. areas, barycentres: per triangle.
[[nodiscard]] std::vector<PageSegment> listSegments(const TriangleMesh& mesh, std::span<const double> areas,
                                                    std::span<const Vec3d> barycentres,
                                                    std::span<const uint32_t> labels, std::span<const double> values);

}  // namespace asdfvk
