#include "asdf_vk/error.h"

#include <array>
#include <cstddef>

namespace asdfvk {
namespace {

struct ErrorRow {
  ErrorCode code;
  ErrorKind kind;
  const char* name;
};

constexpr std::array kErrors{
    ErrorRow{ErrorCode::OptionOutOfRange, ErrorKind::Usage, "optionOutOfRange"},
    ErrorRow{ErrorCode::OptionConflict, ErrorKind::Usage, "optionConflict"},
    ErrorRow{ErrorCode::UnknownName, ErrorKind::Usage, "unknownName"},
    ErrorRow{ErrorCode::UnknownFormat, ErrorKind::Usage, "unknownFormat"},
    ErrorRow{ErrorCode::UnknownField, ErrorKind::Usage, "unknownField"},
    ErrorRow{ErrorCode::InvalidArgument, ErrorKind::Usage, "invalidArgument"},
    ErrorRow{ErrorCode::UnreadableInput, ErrorKind::Input, "unreadableInput"},
    ErrorRow{ErrorCode::EmptyMesh, ErrorKind::Input, "emptyMesh"},
    ErrorRow{ErrorCode::ArraySize, ErrorKind::Input, "arraySize"},
    ErrorRow{ErrorCode::ArrayType, ErrorKind::Input, "arrayType"},
    ErrorRow{ErrorCode::NonFiniteNumber, ErrorKind::Input, "nonFiniteNumber"},
    ErrorRow{ErrorCode::IndexOutOfRange, ErrorKind::Input, "indexOutOfRange"},
    ErrorRow{ErrorCode::MeshTooLarge, ErrorKind::Input, "meshTooLarge"},
    ErrorRow{ErrorCode::FarFromOrigin, ErrorKind::Input, "farFromOrigin"},
    ErrorRow{ErrorCode::InputTooLarge, ErrorKind::Input, "inputTooLarge"},
    ErrorRow{ErrorCode::TooManyFaces, ErrorKind::Input, "tooManyFaces"},
    ErrorRow{ErrorCode::NoValues, ErrorKind::Input, "noValues"},
    ErrorRow{ErrorCode::TooFewValues, ErrorKind::Input, "tooFewValues"},
    ErrorRow{ErrorCode::ValueOutOfRange, ErrorKind::Input, "valueOutOfRange"},
    ErrorRow{ErrorCode::UnitsDiffer, ErrorKind::Input, "unitsDiffer"},
    ErrorRow{ErrorCode::NoVulkanLoader, ErrorKind::Device, "noVulkanLoader"},
    ErrorRow{ErrorCode::NoVulkanDriver, ErrorKind::Device, "noVulkanDriver"},
    ErrorRow{ErrorCode::NoUsableDevice, ErrorKind::Device, "noUsableDevice"},
    ErrorRow{ErrorCode::GpuRequired, ErrorKind::Device, "gpuRequired"},
    ErrorRow{ErrorCode::NoDeviceForKernel, ErrorKind::Device, "noDeviceForKernel"},
    ErrorRow{ErrorCode::KernelUnsupported, ErrorKind::Device, "kernelUnsupported"},
    ErrorRow{ErrorCode::DeviceLimit, ErrorKind::Device, "deviceLimit"},
    ErrorRow{ErrorCode::EquationLimit, ErrorKind::Device, "equationLimit"},
    ErrorRow{ErrorCode::OutOfDeviceMemory, ErrorKind::Device, "outOfDeviceMemory"},
    ErrorRow{ErrorCode::DeviceLost, ErrorKind::Device, "deviceLost"},
    ErrorRow{ErrorCode::ValidationFailed, ErrorKind::Device, "validationFailed"},
    ErrorRow{ErrorCode::VulkanFailed, ErrorKind::Device, "vulkanFailed"},
    ErrorRow{ErrorCode::ForkedProcess, ErrorKind::Device, "forkedProcess"},
    ErrorRow{ErrorCode::OutputNotWritable, ErrorKind::Output, "outputNotWritable"},
    ErrorRow{ErrorCode::Cancelled, ErrorKind::Cancelled, "cancelled"},
};

constexpr bool rowsFollowTheEnum() {
  for (size_t i = 0; i < kErrors.size(); ++i)
    if (static_cast<size_t>(kErrors[i].code) != i) return false;
  return static_cast<size_t>(ErrorCode::Cancelled) + 1 == kErrors.size();
}
static_assert(rowsFollowTheEnum());

}  // namespace

ErrorKind kindOf(ErrorCode code) { return kErrors[static_cast<size_t>(code)].kind; }
const char* nameOf(ErrorCode code) { return kErrors[static_cast<size_t>(code)].name; }

}  // namespace asdfvk
