#include "page/result_page.h"
#include "render/png.h"
#include "render/result_picture.h"

namespace asdfvk {

std::vector<char> fallbackPicture(const Result& result, FieldSpan fields, const View& view, const RunControl& control) {
  const Field* const pictured = comparesThickness(result) ? nullptr : &fields.front().get();
  return encodePng(pictureOf(result, pictured, view, kSmallPicture, control));
}

}  // namespace asdfvk
