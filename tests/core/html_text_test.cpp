#include "core/html_text.h"

#include <doctest/doctest.h>

namespace asdfvk {
namespace {

TEST_CASE("markup, control characters and invalid UTF-8 in HTML") {
  CHECK_EQ(escapedForHtml("a<b>&\"'c"), "a&lt;b&gt;&amp;&quot;&#39;c");
  CHECK_EQ(escapedForHtml("a\nb\tc\x7f"), "a\nb c ");
  CHECK_EQ(escapedForHtml("\xc3\xa4 \xe2\x82\xac \xf0\x9f\x90\x8e"), "\xc3\xa4 \xe2\x82\xac \xf0\x9f\x90\x8e");
  const std::string unknown = "\xef\xbf\xbd";
  CHECK_EQ(escapedForHtml("\xff"
                          "a"),
           unknown + "a");
  CHECK_EQ(escapedForHtml("\xc3"), unknown);
  CHECK_EQ(escapedForHtml("\xc0\xbc"), unknown + unknown);                // An overlong '<'.
  CHECK_EQ(escapedForHtml("\xed\xa0\x80"), unknown + unknown + unknown);  // A surrogate.
  CHECK_EQ(escapedForScript("{\"a\":\"</script>&\"}"), "{\"a\":\"\\u003c/script\\u003e\\u0026\"}");
}

}  // namespace
}  // namespace asdfvk
