#include "interruptible.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <utility>

#include "arrays.h"
#include "asdf_vk/error.h"
#include "asdf_vk/report.h"
#include "gil.h"
#include "worker_threads.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(20);

std::atomic<pid_t> firstProcess{0};

/// The state that the working thread writes and the calling thread reports.
struct Progress {
  std::atomic<double> fraction{0};
  std::atomic<const char*> stage{""};
};

/// Calls `callback` where the progress has changed. Returns whether the work may go on.
class ProgressCall {
 public:
  ProgressCall(const Progress& progress, const py::object& callback) : progress_(progress), callback_(callback) {}

  bool operator()() {
    const double fraction = progress_.fraction;
    const char* stage = progress_.stage;
    if (callback_.is_none() || (fraction == lastFraction_ && stage == lastStage_)) return true;
    lastFraction_ = fraction;
    lastStage_ = stage;
    const py::object answer = callPython(callback_, py::make_tuple(fraction, stage));
    return !isFlag(answer) || PyObject_IsTrue(answer.ptr()) == 1;
  }

 private:
  const Progress& progress_;
  const py::object& callback_;
  double lastFraction_ = -1;
  const char* lastStage_ = nullptr;
};

/// Its stop is requested at the end of the process.
std::stop_source& endOfProcess() {
  static auto* source = new std::stop_source;
  return *source;
}

}  // namespace

void runInterruptibly(const std::function<void(const RunControl&)>& work, const py::object& progress) {
  Progress state;
  ProgressCall call(state, progress);
  std::stop_source source;
  const std::stop_callback stopAtEnd(endOfProcess().get_token(), [&] { source.request_stop(); });
  const RunControl control{source.get_token(), [&](double fraction) { state.fraction = fraction; },
                           [&](Stage stage) { state.stage = nameOf(stage); }};
  std::packaged_task<void()> task([&] { work(control); });
  std::future<void> done = task.get_future();
  std::exception_ptr raised;
  runOnWorker(std::move(task));
  const auto isDone = [&] {
    const GilRelease released;
    return done.wait_for(kPollInterval) == std::future_status::ready;
  };
  while (!isDone()) {
    if (source.stop_requested()) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!call()) source.request_stop();
    } catch (...) {
      raised = std::current_exception();
      source.request_stop();
    }
  }
  if (raised) std::rethrow_exception(raised);
  done.get();
  state.fraction = 1;
  call();
}

void stopAtExit() {
  if (isForkedProcess()) return;
  endOfProcess().request_stop();
  waitForWorkers();
}

bool isForkedProcess() {
  const pid_t first = firstProcess;
  return first != 0 && first != getpid();
}

void requireSameProcess() {
  pid_t unset = 0;
  firstProcess.compare_exchange_strong(unset, getpid());
  if (isForkedProcess())
    throw Error(ErrorCode::ForkedProcess,
                "this process was forked after the first use of asdf_vk and has no threads or devices of its parent; "
                "start processes with the method 'spawn' or 'forkserver', or first use asdf_vk in the child");
}

}  // namespace asdfvk::python
