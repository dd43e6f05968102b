#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <memory>
#include <utility>
#include <vector>

#include "support/end_of_main.h"

namespace {

std::vector<std::shared_ptr<void>>& keptObjects() {
  static std::vector<std::shared_ptr<void>> objects;
  return objects;
}

}  // namespace

void asdfvk::test::keepUntilEndOfMain(std::shared_ptr<void> object) { keptObjects().push_back(std::move(object)); }

int main(int argc, char** argv) {
  const int result = doctest::Context(argc, argv).run();
  while (!keptObjects().empty()) keptObjects().pop_back();
  return result;
}
