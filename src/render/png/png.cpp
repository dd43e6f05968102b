#include "render/png.h"

#include <fmt/core.h>
#include <png.h>

#include <utility>

#include "asdf_vk/error.h"
#include "core/atomic_file.h"

namespace asdfvk {

std::vector<char> encodePng(const Image& image) {
  static_assert(sizeof(Rgb) == 3, "rows are passed to libpng as in memory");
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(image.width());
  description.height = static_cast<png_uint_32>(image.height());
  description.format = PNG_FORMAT_RGB;
  const void* pixels = image.pixels().data();
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::vector<char> bytes(size);
  if (png_image_write_to_memory(&description, bytes.data(), &size, 0, pixels, 0, nullptr) == 0)
    throw Error(ErrorCode::OutputNotWritable,
                fmt::format("the picture cannot be encoded: {}", std::as_const(description.message)));
  bytes.resize(size);
  return bytes;
}

void writePng(const std::filesystem::path& path, const Image& image) {
  AtomicFiles files;
  writePng(files, path, image);
  files.commit();
}

void writePng(AtomicFiles& files, const std::filesystem::path& path, const Image& image) {
  const std::vector<char> bytes = encodePng(image);
  files.write(path, [&](AtomicFile& file) { file.write(bytes.data(), bytes.size()); });
}

}  // namespace asdfvk
