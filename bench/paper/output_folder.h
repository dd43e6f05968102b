#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "render/image.h"

namespace asdfvk::bench {

/// Where the evaluation's files go. Each appears whole or not at all.
class OutputFolder {
 public:
  /// Makes the folder where there is none. Throws Error{Output} with the reason.
  explicit OutputFolder(std::filesystem::path path);

  void write(const std::string& name, std::string_view text) const;
  void write(const std::string& name, const Image& image) const;

 private:
  std::filesystem::path path_;
};

}  // namespace asdfvk::bench
