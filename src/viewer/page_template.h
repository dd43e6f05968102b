#pragma once

#include <string_view>

namespace asdfvk {

/// The page without data, bundled by the build from src/viewer/page (bundle.cmake), with the places @TITLE@, @DATA@ and
/// @FALLBACK@.
extern const std::string_view kPageTemplate;

}  // namespace asdfvk
