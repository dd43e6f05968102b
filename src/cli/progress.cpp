#include "cli/progress.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace asdfvk {
namespace {

constexpr double kQuietSeconds = 1;
constexpr double kRedrawSeconds = 0.1;
constexpr int kCells = 40;
constexpr std::string_view kWipeLine = "\r\x1b[K";

}  // namespace

ProgressBar::ProgressBar(std::function<void(std::string_view)> write, std::function<double()> now)
    : write_(std::move(write)), now_(std::move(now)), start_(now_()), lastDrawn_(start_) {}

void ProgressBar::update(double fraction) {
  const double time = now_();
  if (time - start_ < kQuietSeconds) return;
  if (isVisible_ && time - lastDrawn_ < kRedrawSeconds) return;
  write_(fmt::format("{}{}", kWipeLine, progressText(fraction)));
  lastDrawn_ = time;
  isVisible_ = true;
}

void ProgressBar::clear() {
  if (!isVisible_) return;
  write_(kWipeLine);
  isVisible_ = false;
}

std::string progressText(double fraction) {
  const double share = fraction >= 0 ? std::fmin(fraction, 1) : 0;
  const int filled = static_cast<int>(std::floor(share * kCells));
  return fmt::format("[{}{}] {:3.0f} %", std::string(static_cast<size_t>(filled), '#'),
                     std::string(static_cast<size_t>(kCells - filled), ' '), std::floor(share * 100));
}

}  // namespace asdfvk
