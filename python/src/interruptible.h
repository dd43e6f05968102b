#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "asdf_vk/run_control.h"

namespace asdfvk::python {

/// Runs `work` on a worker thread, without the GIL, and waits for it. The calling thread polls for signals and
/// calls `progress` (None, or a callable of a fraction from 0 to 1 and the name of a stage) every 20 ms. An exception
/// of either requests a stop and is thrown once `work` has ended; so is Error{Cancelled} when `progress` returns False
/// (bool or numpy.bool_). Throws what `work` throws.
void runInterruptibly(const std::function<void(const RunControl&)>& work, const pybind11::object& progress);

/// At the end of the process, when no thread can return to Python: stops all `work`, which daemon threads have left
/// behind, and waits for its end. Destructors of libraries at the exit would take away what it uses.
void stopAtExit();

/// Throws Error{ForkedProcess} in a process that was forked after the first call: it has no threads
/// or devices of its parent.
void requireSameProcess();

/// Whether requireSameProcess() would throw.
[[nodiscard]] bool isForkedProcess();

}  // namespace asdfvk::python
