#pragma once

#include <string_view>

namespace asdfvk {

/// The page without data, bundled by the build from src/page/browser (bundle.cmake), with the places @TITLE@, @DATA@,
/// @FALLBACK@ and @SCRIPT@ (base64 of the deflated kPageScript).
extern const std::string_view kPageTemplate;
extern const std::string_view kPageScript;

}  // namespace asdfvk
