#pragma once

#include <string>
#include <vector>

#include "asdf_vk/options.h"
#include "render/camera.h"

namespace asdfvk {

/// What is written and printed, and where.
struct Outputs {
  std::string path;                 ///< Of the result: a file, a directory, "-"; empty: beside each input.
  std::string format;               ///< A name of outputFormats(); empty: by `path`, else ply.
  std::vector<std::string> fields;  ///< Those of --fields, in this order; empty: those of fieldNames().
  bool ascii = false;
  std::string picture;            ///< A .png, "-" for standard output; empty: none.
  std::string pictureOf = "sdf";  ///< Name of the field to show; empty: the thin places.
  View pictureView;
  bool choosesView = false;  ///< --picture-view is given.
  std::string points;        ///< A .ply for the skeleton points, "-" for standard output; empty: none.
  bool opensPage = false;    ///< Start the browser with the page.
  bool json = false;
  bool quiet = false;
};

/// The fields to write: those of `outputs`, or by default those that the options compute.
[[nodiscard]] std::vector<std::string> fieldNames(const Outputs& outputs, const Options& options);

}  // namespace asdfvk
