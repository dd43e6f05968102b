#pragma once

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asdfvk::test {

/// An environment variable with another value, or without one, while this exists.
class ScopedVariable {
 public:
  ScopedVariable(std::string name, const std::optional<std::string>& value)
      : name_(std::move(name)), before_(valueOf(name_)) {
    set(value);
  }
  ~ScopedVariable() { set(before_); }
  ScopedVariable(const ScopedVariable&) = delete;
  ScopedVariable& operator=(const ScopedVariable&) = delete;

  [[nodiscard]] static std::optional<std::string> valueOf(const std::string& name) {
    const char* value = std::getenv(name.c_str());
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  }

 private:
  void set(const std::optional<std::string>& value) {
    if (value)
      ::setenv(name_.c_str(), value->c_str(), 1);
    else
      ::unsetenv(name_.c_str());
  }

  std::string name_;
  std::optional<std::string> before_;
};

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
