#include "render/png.h"

#include <doctest/doctest.h>
#include <png.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

namespace fs = std::filesystem;

Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = {static_cast<uint8_t>(x), static_cast<uint8_t>(y), static_cast<uint8_t>(x * y)};
  return image;
}

/// Reads a picture with libpng.
Image decode(const std::vector<char>& bytes) {
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  REQUIRE_NE(png_image_begin_read_from_memory(&description, bytes.data(), bytes.size()), 0);
  CHECK_EQ(description.format, uint32_t{PNG_FORMAT_RGB});
  description.format = PNG_FORMAT_RGB;
  Image image(static_cast<int>(description.width), static_cast<int>(description.height));
  std::vector<uint8_t> pixels(PNG_IMAGE_SIZE(description));
  REQUIRE_NE(png_image_finish_read(&description, nullptr, pixels.data(), 0, nullptr), 0);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (size_t channel = 0; channel < 3; ++channel)
        image.at(x, y)[channel] = pixels[3 * static_cast<size_t>(y * image.width() + x) + channel];
  return image;
}

TEST_CASE("libpng reads back every pixel") {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {200, 151}}) {
    const Image image = gradient(width, height);
    CHECK(decode(encodePng(image)) == image);
  }
}

TEST_CASE("a file is written whole") {
  const fs::path path = fs::temp_directory_path() / ("asdf-vk-png-test-" + std::to_string(getpid()) + ".png");
  const Image image = gradient(40, 30);
  writePng(path, image);
  std::ifstream in(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  fs::remove(path);
  CHECK(decode(bytes) == image);
}

TEST_CASE("a place that cannot be written is an output error") {
  for (const char* path : {"/no/such/folder/a.png", "/proc/a.png", "/dev/full"}) {
    INFO(path);
    try {
      writePng(path, gradient(64, 64));
      FAIL_CHECK("no error");
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::Output);
    }
  }
}

}  // namespace
}  // namespace asdfvk
