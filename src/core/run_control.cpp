#include "asdf_vk/run_control.h"

#include "asdf_vk/error.h"

namespace asdfvk {

void RunControl::checkpoint(double fraction) const {
  if (stop.stop_requested()) throw Error(ErrorCode::Cancelled, "cancelled");
  if (progress) progress(fraction);
}

RunControl RunControl::part(double from, double to) const {
  RunControl control = withoutProgress();
  if (progress) control.progress = [this, from, to](double fraction) { progress(from + fraction * (to - from)); };
  return control;
}

}  // namespace asdfvk
