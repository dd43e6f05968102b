#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "documents/program.h"

namespace asdfvk {
namespace {

std::string contentOf(const std::string& path) {
  std::ifstream in(std::string(ASDFVK_SOURCE_DIR) + "/" + path);
  REQUIRE_MESSAGE(in.good(), path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_CASE("docs/options.md has the rows of the options; asdfvk-write-documents FOLDER SOURCES writes them") {
  const std::string page = contentOf("docs/options.md");
  CHECK(optionPage(page) == page);
  CHECK(page.find("| `--wall-angle DEGREES` | 120 | above 90 and at most 180 |") != std::string::npos);
}

TEST_CASE("the keywords of Python are those of the rows") {
  CHECK(keywordModule() == contentOf("python/asdf_vk/_keywords.py"));
}

}  // namespace
}  // namespace asdfvk
