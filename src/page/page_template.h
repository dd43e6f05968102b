#pragma once

#include <string_view>

namespace asdfvk {

/// The page without data, and the script of the page. The build bundles both from src/page/browser (bundle.cmake). The
/// page has the places @TITLE@, @DATA@, @FALLBACK@ and @SCRIPT@ (base64 of the deflated kPageScript).
extern const std::string_view kPageTemplate;
extern const std::string_view kPageScript;

}  // namespace asdfvk
