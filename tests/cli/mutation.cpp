#include "cli/mutation.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace asdfvk::test {
namespace {

constexpr std::array<std::string_view, 18> kTextNumbers{
    "0",      "-1",   "1e300", "-1e300", "nan",  "inf", "99999999999",          "4294967295", "4294967296",
    "1e-320", "0x10", "2.5",   "3.",     "1e39", "--1", "18446744073709551616", "2147483647", ""};
constexpr std::array<uint32_t, 10> kRawNumbers{0,          1,          0xffffffff, 0x7fffffff, 0x80000000,
                                               0x7fc00000, 0x7f800000, 0x7f7fffff, 1000000,    0x00000100};

uint32_t position(const std::string& bytes, Random& random) {
  return bytes.empty() ? 0 : random.index(static_cast<uint32_t>(bytes.size()));
}

bool isNumberByte(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '.' || c == 'e'; }

void replaceTextNumber(std::string& bytes, Random& random) {
  size_t begin = position(bytes, random);
  while (begin < bytes.size() && !isNumberByte(bytes[begin])) ++begin;
  while (begin > 0 && begin < bytes.size() && isNumberByte(bytes[begin - 1])) --begin;
  size_t end = begin;
  while (end < bytes.size() && isNumberByte(bytes[end])) ++end;
  bytes.replace(begin, end - begin, kTextNumbers[random.index(kTextNumbers.size())]);
}

void replaceRawNumber(std::string& bytes, Random& random) {
  const uint32_t value = kRawNumbers[random.index(kRawNumbers.size())];
  const size_t begin = position(bytes, random);
  for (size_t i = 0; i < 4 && begin + i < bytes.size(); ++i) bytes[begin + i] = static_cast<char>(value >> (8 * i));
}

void mutateOnce(std::string& bytes, Random& random) {
  const size_t begin = position(bytes, random);
  const size_t length = 1 + random.index(64);
  // Changed values, which may well be read, are twice as frequent as changed lengths, which are mostly refused.
  switch (random.index(9)) {
    case 0:
    case 1:
      for (uint32_t i = 1 + random.index(4); i > 0 && !bytes.empty(); --i)
        bytes[position(bytes, random)] ^= static_cast<char>(1u << random.index(8));
      return;
    case 2:
    case 3:
      replaceTextNumber(bytes, random);
      return;
    case 4:
    case 5:
      replaceRawNumber(bytes, random);
      return;
    case 6:
      bytes.resize(begin);
      return;
    case 7:
      bytes.insert(begin, bytes.substr(begin, length));
      return;
    default:
      bytes.erase(begin, length);
  }
}

}  // namespace

std::string mutate(std::string bytes, Random& random) {
  for (uint32_t faults = 1 + random.index(8) / 6; faults > 0; --faults) mutateOnce(bytes, random);
  return bytes;
}

}  // namespace asdfvk::test
