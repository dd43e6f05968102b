#include "cli/program.h"

int main(int argc, char** argv) {
  return static_cast<int>(asdfvk::runProgram({argv + (argc > 0 ? 1 : 0), argv + argc}));
}
