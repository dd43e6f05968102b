#include "bench_program.h"

#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"

namespace asdfvk::bench {

int runBenchProgram(CLI::App& app, int argc, char** argv, const std::function<void(const RunControl&)>& body) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::Usage);
  }
  try {
    const Interrupt interrupt;
    const Interrupt::Listening listening;
    body({interrupt.token(), {}});
    return 0;
  } catch (...) {
    const Failure failure = currentFailure();
    printError(app.get_name(), failure.message);
    return static_cast<int>(failure.code);
  }
}

}  // namespace asdfvk::bench
