#include "cli/program.h"
#include "cli/terminal.h"

int main(int argc, char** argv) {
  asdfvk::secureStandardStreams();
  return static_cast<int>(asdfvk::runProgram({argv + (argc > 0 ? 1 : 0), argv + argc}));
}
