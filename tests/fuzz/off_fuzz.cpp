#include "fuzz_reader.h"
#include "io/mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return asdfvk::fuzz::readOnce(asdfvk::parseOff, data, size);
}
