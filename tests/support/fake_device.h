#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/scoped_variable.h"

namespace asdfvk::test {

/// While this exists, new instances have the layer of tests/fake_device, whose variables (settings.h there) have the
/// given values; variables that are not given keep theirs. The validation layer, where it is on, sees the device of the
/// driver, or on request the fake one.
class FakeDevice {
 public:
  using Variables = std::vector<std::pair<std::string, std::string>>;
  enum class ValidationSees { Driver, Fake };

  explicit FakeDevice(const Variables& variables, ValidationSees seen = ValidationSees::Driver) {
    // The first layer is the nearest to the program: the first in the list for new loaders, and that of the first
    // folder for the loader of Debian 12.
    const std::string fake = "VK_LAYER_ASDFVK_fake_device", validation = "VK_LAYER_KHRONOS_validation:";
    set("VK_INSTANCE_LAYERS", seen == ValidationSees::Fake ? validation + fake : fake);
    const std::string folder = std::string(":") + ASDFVK_FAKE_DEVICE_DIR;
    if (const std::optional<std::string> folders = ScopedVariable::valueOf("VK_LAYER_PATH"))
      set("VK_LAYER_PATH", *folders + folder);
    else
      set("VK_ADD_LAYER_PATH", "/usr/share/vulkan/explicit_layer.d" + folder);
    for (const auto& [name, value] : variables) set(name, value);
  }

 private:
  void set(const std::string& name, const std::string& value) {
    changes_.push_back(std::make_unique<ScopedVariable>(name, value));
  }

  std::vector<std::unique_ptr<ScopedVariable>> changes_;
};

}  // namespace asdfvk::test
