#pragma once

#include <stop_token>

#include "asdf_vk/run_control.h"

namespace asdfvk::test {

/// A control whose stop was requested.
inline RunControl stoppedControl() {
  std::stop_source stop;
  stop.request_stop();
  return {stop.get_token(), {}, {}};
}

}  // namespace asdfvk::test
