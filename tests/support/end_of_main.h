#pragma once

#include <memory>

namespace asdfvk::test {

/// Destroys the object at the end of main, after those that were kept later. A Vulkan instance in a static object would
/// be destroyed after the static data of the validation layers.
void keepUntilEndOfMain(std::shared_ptr<void> object);

}  // namespace asdfvk::test
