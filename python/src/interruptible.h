#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "asdf_vk/run_control.h"

namespace asdfvk::python {

/// Runs `work` on a worker thread, without the GIL, and waits for it. The calling thread polls for signals and calls
/// `progress` (None, or a callable of a fraction from 0 to 1 and the name of a stage) every 20 ms. An exception of a
/// signal handler or of `progress` requests a stop and is thrown once `work` has ended. If `progress` returns False
/// (bool or numpy.bool_), Error{Cancelled} is thrown in the same way. Throws what `work` throws.
void runInterruptibly(const std::function<void(const RunControl&)>& work, const pybind11::object& progress);

/// Stops each `work` that a daemon thread left running, and waits for its end. Called at the end of the process, when
/// no thread can return to Python, because destructors of libraries then release what `work` uses.
void stopAtExit();

/// Throws Error{ForkedProcess} in a process without threads and devices, because it was forked after the first call.
void requireSameProcess();

[[nodiscard]] bool isForkedProcess();

}  // namespace asdfvk::python
