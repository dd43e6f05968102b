#include "io/base64_text.h"

#include <doctest/doctest.h>

#include <string>

namespace asdfvk::test {

TEST_CASE("base64 has the texts of RFC 4648, and decoding returns the bytes") {
  const std::string bytes = "foobar";
  const char* const texts[]{"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (size_t size = 0; size <= bytes.size(); ++size) {
    const std::string text = base64Text({bytes.data(), size});
    CHECK_EQ(text, texts[size]);
    const auto decoded = base64Bytes(text);
    REQUIRE(decoded);
    CHECK_EQ(std::string(decoded->begin(), decoded->end()), bytes.substr(0, size));
  }
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  const auto decoded = base64Bytes(base64Text(all));
  REQUIRE(decoded);
  CHECK_EQ(std::string(decoded->begin(), decoded->end()), all);
}

}  // namespace asdfvk::test
