#include "session.h"

#include <algorithm>
#include <chrono>

#include "interruptible.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

constexpr auto kLockInterval = std::chrono::milliseconds(20);

std::vector<py::ssize_t> shapeOf(const Field& field) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(field.itemCount())};
  if (field.componentCount != 1) shape.push_back(field.componentCount);
  return shape;
}

}  // namespace

py::array arrayOf(const Field& field, bool single) {
  const auto convert = [&]<typename T>(const auto& entries, T) -> py::array {
    py::array_t<T> array(shapeOf(field));
    std::transform(entries.begin(), entries.end(), array.mutable_data(),
                   [](auto entry) { return static_cast<T>(entry); });
    return array;
  };
  if (const std::vector<double>* reals = field.reals()) return single ? convert(*reals, 0.0f) : convert(*reals, 0.0);
  if (const auto* flags = std::get_if<std::vector<uint8_t>>(&field.values)) return convert(*flags, uint8_t{});
  return convert(std::get<std::vector<uint32_t>>(field.values), int32_t{});
}

SharedSession::SharedSession(const SessionOptions& options, uint32_t threadCount) : threadCount_(threadCount) {
  requireSameProcess();
  const py::gil_scoped_release released;
  const ThreadLimit limit(threadCount);
  session_ = std::make_unique<Session>(options);
}

SharedSession::~SharedSession() {
  if (isForkedProcess()) (void)session_.release();
}

void SharedSession::run(const std::function<void(Session&, const RunControl&)>& work, const py::object& progress) {
  requireSameProcess();
  runInterruptibly(
      [&](const RunControl& control) {
        std::unique_lock<std::timed_mutex> lock(mutex_, std::defer_lock);
        while (!lock.try_lock_for(kLockInterval)) control.checkpoint(0);
        const ThreadLimit limit(threadCount_);
        work(*session_, control);
      },
      progress);
}

void SharedSession::releaseWhenIdle(std::unique_ptr<Scene>& scene) {
  const py::gil_scoped_release released;
  const std::scoped_lock lock(mutex_);
  scene.reset();
}

}  // namespace asdfvk::python
