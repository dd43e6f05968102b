#include "session.h"

#include <algorithm>
#include <chrono>

#include "arrays.h"
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

py::array arrayOf(const Field& field, bool single, const py::handle& owner) {
  if (const std::vector<double>* reals = field.reals()) {
    if (!single) return viewAsArray(reals->data(), shapeOf(field), owner);
    py::array_t<float> array(shapeOf(field));
    std::transform(reals->begin(), reals->end(), array.mutable_data(),
                   [](double real) { return static_cast<float>(real); });
    return array;
  }
  if (const auto* flags = std::get_if<std::vector<uint8_t>>(&field.values))
    return viewAsArray(flags->data(), shapeOf(field), owner);
  const auto& indices = std::get<std::vector<uint32_t>>(field.values);
  return viewAsArray(reinterpret_cast<const int32_t*>(indices.data()), shapeOf(field), owner);
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
