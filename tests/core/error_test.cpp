#include "asdf_vk/error.h"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

using namespace asdfvk;

namespace {

struct Row {
  ErrorCode code;
  ErrorKind kind;
  const char* name;
};

const std::vector<Row> kRows{
    {ErrorCode::OptionOutOfRange, ErrorKind::Usage, "optionOutOfRange"},
    {ErrorCode::OptionConflict, ErrorKind::Usage, "optionConflict"},
    {ErrorCode::UnknownName, ErrorKind::Usage, "unknownName"},
    {ErrorCode::UnknownFormat, ErrorKind::Usage, "unknownFormat"},
    {ErrorCode::UnknownField, ErrorKind::Usage, "unknownField"},
    {ErrorCode::InvalidArgument, ErrorKind::Usage, "invalidArgument"},
    {ErrorCode::UnreadableInput, ErrorKind::Input, "unreadableInput"},
    {ErrorCode::EmptyMesh, ErrorKind::Input, "emptyMesh"},
    {ErrorCode::ArraySize, ErrorKind::Input, "arraySize"},
    {ErrorCode::ArrayType, ErrorKind::Input, "arrayType"},
    {ErrorCode::NonFiniteNumber, ErrorKind::Input, "nonFiniteNumber"},
    {ErrorCode::IndexOutOfRange, ErrorKind::Input, "indexOutOfRange"},
    {ErrorCode::MeshTooLarge, ErrorKind::Input, "meshTooLarge"},
    {ErrorCode::FarFromOrigin, ErrorKind::Input, "farFromOrigin"},
    {ErrorCode::InputTooLarge, ErrorKind::Input, "inputTooLarge"},
    {ErrorCode::TooManyFaces, ErrorKind::Input, "tooManyFaces"},
    {ErrorCode::NoValues, ErrorKind::Input, "noValues"},
    {ErrorCode::TooFewValues, ErrorKind::Input, "tooFewValues"},
    {ErrorCode::ValueOutOfRange, ErrorKind::Input, "valueOutOfRange"},
    {ErrorCode::UnitsDiffer, ErrorKind::Input, "unitsDiffer"},
    {ErrorCode::NoVulkanLoader, ErrorKind::Device, "noVulkanLoader"},
    {ErrorCode::NoVulkanDriver, ErrorKind::Device, "noVulkanDriver"},
    {ErrorCode::NoUsableDevice, ErrorKind::Device, "noUsableDevice"},
    {ErrorCode::GpuRequired, ErrorKind::Device, "gpuRequired"},
    {ErrorCode::NoDeviceForKernel, ErrorKind::Device, "noDeviceForKernel"},
    {ErrorCode::KernelUnsupported, ErrorKind::Device, "kernelUnsupported"},
    {ErrorCode::DeviceLimit, ErrorKind::Device, "deviceLimit"},
    {ErrorCode::EquationLimit, ErrorKind::Device, "equationLimit"},
    {ErrorCode::OutOfDeviceMemory, ErrorKind::Device, "outOfDeviceMemory"},
    {ErrorCode::DeviceLost, ErrorKind::Device, "deviceLost"},
    {ErrorCode::ValidationFailed, ErrorKind::Device, "validationFailed"},
    {ErrorCode::VulkanFailed, ErrorKind::Device, "vulkanFailed"},
    {ErrorCode::ForkedProcess, ErrorKind::Device, "forkedProcess"},
    {ErrorCode::OutputNotWritable, ErrorKind::Output, "outputNotWritable"},
    {ErrorCode::Cancelled, ErrorKind::Cancelled, "cancelled"},
};

}  // namespace

TEST_CASE("each code has its kind and a name of its own") {
  std::set<std::string> names;
  for (const Row& row : kRows) {
    CAPTURE(row.name);
    CHECK(kindOf(row.code) == row.kind);
    CHECK(std::string(nameOf(row.code)) == row.name);
    names.insert(nameOf(row.code));
  }
  CHECK(names.size() == kRows.size());
  // Every enumerator is in the table: they are consecutive, and Cancelled is the last.
  CHECK(kRows.size() == static_cast<size_t>(ErrorCode::Cancelled) + 1);
}

TEST_CASE("an error carries its code, kind, message and details") {
  const Error error(ErrorCode::DeviceLimit, "the device allows less", {{"limit", "134217728"}});
  CHECK(error.code() == ErrorCode::DeviceLimit);
  CHECK(error.kind() == ErrorKind::Device);
  CHECK(std::string(error.what()) == "the device allows less");
  REQUIRE(error.details().size() == 1);
  CHECK(error.details()[0].name == "limit");
  CHECK(error.details()[0].value == "134217728");
  CHECK(Error(ErrorCode::Cancelled, "").details().empty());
}
