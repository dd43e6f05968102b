#pragma once

#include <future>

namespace asdfvk::python {

/// Starts `task` on an idle worker thread, or on a new one where none is idle. Workers are kept to the end of the
/// process, as many as were ever busy at once: TBB 2021.8 loses some 10 KB with each thread that used it while the
/// processors were busy, and then ended. `task` may be destroyed later than its future is ready.
void runOnWorker(std::packaged_task<void()> task);

/// Waits until no task is running or waits for a worker.
void waitForWorkers();

}  // namespace asdfvk::python
