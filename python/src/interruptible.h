#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "asdf_vk/run_control.h"

namespace asdfvk::python {

/// Runs `work` on a worker thread, without the GIL, and waits for its end. Every 20 ms, the calling thread checks for
/// signals and calls `progress`. `progress` is None, or a callable with two arguments: the finished fraction of `work`
/// (0 to 1), and the name of the current stage, or "" before the first stage. If a signal handler or `progress` raises
/// an exception, a stop of `work` is requested; the exception is thrown when `work` has ended. If `progress` returns
/// False (bool or numpy.bool_), Error{Cancelled} is thrown in the same way. Exceptions of `work` are thrown too.
void runInterruptibly(const std::function<void(const RunControl&)>& work, const pybind11::object& progress);

/// Stops each `work` that still runs for a daemon thread, and waits for its end. Called at the end of the process, when
/// no thread can return to Python. After this call, destructors of libraries release objects that `work` uses.
void stopAtExit();

/// Throws Error{ForkedProcess} if this process was forked after the first call. Such a process lacks the threads and
/// devices of its parent.
void requireSameProcess();

[[nodiscard]] bool isForkedProcess();

}  // namespace asdfvk::python
