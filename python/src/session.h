#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "asdf_vk/scene.h"
#include "asdf_vk/session.h"

namespace asdfvk::python {

/// The fields and the report of a computation. Arrays are made when they are read.
class ComputedFields {
 public:
  explicit ComputedFields(Result&& result) : result_(std::move(result)) {}

  [[nodiscard]] const std::vector<Field>& fields() const { return result_.fields; }
  [[nodiscard]] const Report& report() const { return result_.report; }

 private:
  Result result_;
};

/// The array of a field, (items,) or (items, components), with memory of its own. Real numbers become float32 where
/// `single` is set, and double otherwise; uint32 becomes int32, in which 0xffffffff is -1.
[[nodiscard]] pybind11::array arrayOf(const Field& field, bool single);

/// Session for Python: any number of threads may call it, one computation at a time.
class SharedSession {
 public:
  /// threadCount: see ThreadLimit. Throws Error{ForkedProcess} and as Session().
  SharedSession(const SessionOptions& options, uint32_t threadCount);
  /// In a forked process nothing is released: the threads of the device do not exist there.
  ~SharedSession();
  SharedSession(const SharedSession&) = delete;
  SharedSession& operator=(const SharedSession&) = delete;

  [[nodiscard]] const Session& session() const { return *session_; }

  /// Runs `work` when no other thread uses the session, see runInterruptibly().
  void run(const std::function<void(Session&, const RunControl&)>& work, const pybind11::object& progress);
  /// Destroys a scene of this session when no other thread uses the session.
  void releaseWhenIdle(std::unique_ptr<Scene>& scene);

 private:
  std::unique_ptr<Session> session_;
  uint32_t threadCount_;
  std::timed_mutex mutex_;
};

}  // namespace asdfvk::python
