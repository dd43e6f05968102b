#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/asdf.h"
#include "render/view.h"

namespace asdfvk {

enum class PictureOf {
  Sdf,
  Seeds,
  Error,  ///< Result::expectedError.
};

/// What was asked for, after every option was checked on its own and against the others.
struct CommandLine {
  std::vector<std::string> meshes;  ///< Paths, "-" for standard input (once at most).
  SessionOptions session;
  Recipe recipe = Recipe::Balanced;  ///< Applied to `options` before the options of their own.
  Options options;
  std::string output;   ///< A file, a directory, "-" for standard output; empty: beside each input.
  std::string format;   ///< "ply", "vtu", "npy" or "csv"; empty: told by `output`, else ply.
  std::string picture;  ///< A .png, "-" for standard output; empty: none.
  PictureOf pictureOf = PictureOf::Sdf;
  View pictureView;
  bool ascii = false;
  bool json = false;
  bool quiet = false;
  bool listDevices = false;
  uint32_t threadCount = 0;           ///< 0: as many as there are cores.
  std::optional<std::string> answer;  ///< The text of --help or --version; nothing else is to be done then.
};

}  // namespace asdfvk
