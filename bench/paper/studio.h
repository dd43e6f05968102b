#pragma once

#include <string>
#include <vector>

#include "asdf_vk/run_control.h"
#include "io/colour_map.h"
#include "paper/output_folder.h"
#include "paper/page.h"
#include "paper/subject.h"

namespace asdfvk::bench {

/// In pixels. Plain pictures have no colour bar; in the other size they show the mesh as large as pictures with one.
struct PictureSize {
  int width = 0, height = 0;
};
inline constexpr PictureSize kWithBar{960, 600}, kPlain{780, 600};

/// How a field is drawn.
struct FieldStyle {
  std::string title;  ///< Above the colour bar.
  ColourRange range;
};

/// Draws meshes of the report, all of them in one size and manner, into its folder.
class Studio {
 public:
  Studio(const OutputFolder& folder, const RunControl& control) : folder_(folder), control_(control) {}

  /// values: #I, NaN is grey. `file` is without its ending.
  [[nodiscard]] PageImage field(const std::string& file, const Subject& subject, const std::vector<double>& values,
                                const FieldStyle& style, const std::string& caption) const;
  /// isSeed: #I; seeds are red, all else is light.
  [[nodiscard]] PageImage seeds(const std::string& file, const Subject& subject, const std::vector<uint8_t>& isSeed,
                                const std::string& caption, const PictureSize& size) const;

 private:
  const OutputFolder& folder_;
  RunControl control_;
};

}  // namespace asdfvk::bench
