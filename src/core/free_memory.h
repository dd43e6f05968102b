#pragma once

namespace asdfvk {

/// Empties a container and frees its memory. The assignment `container = {}` keeps the memory of a vector, because it
/// assigns an empty list of elements.
template <typename Container>
void freeMemory(Container& container) {
  container = Container();
}

}  // namespace asdfvk
