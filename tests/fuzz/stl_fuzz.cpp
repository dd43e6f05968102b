#include "fuzz_reader.h"
#include "io/formats.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return asdfvk::fuzz::readOnce(asdfvk::parseStl, data, size);
}
