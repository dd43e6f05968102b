#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "asdf_vk/scene.h"
#include "describe/session_options.h"
#include "page/page.h"

namespace asdfvk {

/// A mesh in a page that computes (src/web/browser/engine.js), with its last results. Computes on the CPU. All
/// functions throw Error.
class PageSession {
 public:
  using Json = nlohmann::ordered_json;

  PageSession();
  ~PageSession();

  /// Reads and prepares a mesh, and forgets the mesh before. unit: replaces the unit that the file states; empty: the
  /// mesh has no unit. Returns the facts of the mesh.
  Json open(const std::filesystem::path& file, const std::optional<std::string>& unit, const RunControl& control);

  /// Measures the thickness, and the gaps if options need them. options: names and values of the JSON report.
  void check(const Json& options, const RunControl& control);
  /// Computes the shape diameters, and segments if options need them.
  void compute(const Json& options, const RunControl& control);

  /// The JSON report of the last check and the last computation, in one.
  [[nodiscard]] Json report() const;
  /// A page with the result of the last check and the last computation.
  [[nodiscard]] Page page() const;
  /// Writes the last results. The extension of the file determines the format: json, html, or one of resultFormats().
  void save(const std::filesystem::path& file) const;

 private:
  struct Opened;

  [[nodiscard]] Opened& opened() const;
  [[nodiscard]] Result measure(const Json& options, const RunControl& control);

  SessionSettings settings_;
  Session session_;
  std::unique_ptr<Opened> opened_;  ///< Null before the first mesh.
};

}  // namespace asdfvk
