#include "generate/icosahedron.h"

#include <cmath>

namespace asdfvk {

Icosahedron unitIcosahedron() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  const double norm = std::sqrt(1 + golden * golden);
  const double a = 1 / norm, b = golden / norm;
  return {{{{-a, b, 0},
            {a, b, 0},
            {-a, -b, 0},
            {a, -b, 0},
            {0, -a, b},
            {0, a, b},
            {0, -a, -b},
            {0, a, -b},
            {b, 0, -a},
            {b, 0, a},
            {-b, 0, -a},
            {-b, 0, a}}},
          {{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
            {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
            {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}}};
}

}  // namespace asdfvk
