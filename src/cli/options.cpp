#include "cli/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "asdf_vk/error.h"
#include "cli/choice_names.h"
#include "cli/computation_options.h"
#include "cli/option_adding.h"
#include "cli/option_values.h"
#include "core/text.h"

namespace asdfvk {
namespace {

constexpr const char* kDescription =
    "Computes the shape diameter function of triangle meshes (the local thickness of the body at each face): rays on\n"
    "the device from seed faces, interpolation over the others. Reads PLY, OFF, OBJ and STL; '-' is standard input.";

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 usage, 2 input unreadable, 3 no device or device lost, 4 output not writable,\n"
    "5 a requested check failed, 70 internal error, 130 cancelled. With several meshes the others are done and the\n"
    "first failure's code is returned.";

bool isCheckCount(const std::string& text) {
  return text == "all" || (!text.empty() && text.find_first_not_of("0123456789") == std::string::npos);
}

/// A flag with a value that only an equals sign can attach, so that `--check mesh.ply` does not take the mesh for it.
/// A number behind a space would be taken for a mesh; that is told unless there is such a file.
void spellOutBareCheck(std::vector<std::string>& arguments) {
  for (size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    if (arguments[i] != "--check") continue;
    std::error_code ignored;
    if (i + 1 < arguments.size() && isCheckCount(arguments[i + 1]) &&
        !std::filesystem::exists(arguments[i + 1], ignored))
      throw Error(ErrorCode::OptionOutOfRange,
                  fmt::format("--check takes its number with an equals sign: --check={}", arguments[i + 1]));
    arguments[i] = fmt::format("--check={}", kDefaultCheckCount);
  }
}

void addOutput(CLI::App& app, CommandLine& line) {
  const std::string output = "Output";
  addValue(app, "-o,--output", "FILE|DIR|-",
           "Result: a file (.ply .vtu .npy .csv), a directory, or - for standard\n"
           "output; default NAME.asdf.ply beside the input",
           [&](const std::string& text) {
             if (text.empty()) throw Error(ErrorCode::OptionOutOfRange, "the name is empty");
             line.output = text;
           })
      ->group(output);
  addChoice(app, "--format", line.format,
            ChoiceNames<const char*, 4>{{{"ply", "ply"}, {"vtu", "vtu"}, {"npy", "npy"}, {"csv", "csv"}}},
            "Format where -o does not tell it; default ply")
      ->group(output);
  app.add_flag("--ascii", line.ascii, "Write PLY as text")->group(output);
  addValue(app, "--check", "[=N|all]",
           fmt::format("Recompute N random traced faces, and N among all, with the reference\n"
                       "(default {}); exit code 5 when traced faces disagree",
                       kDefaultCheckCount),
           [&](const std::string& text) { line.options.checkCount = parseCheckCount(text); })
      ->group(output);
  app.add_flag("--json", line.json, "Report as JSON on standard output, one line per mesh")->group(output);
  app.add_flag("--quiet", line.quiet, "Say nothing but errors on standard error")->group(output);
}

/// "30,18"
void readViewAngles(const std::string& text, View& view) {
  const size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' is not two numbers with a comma between them", text));
  view.azimuthDegrees = parseNumber(text.substr(0, comma));
  view.elevationDegrees = parseNumber(text.substr(comma + 1));
  if (std::abs(view.azimuthDegrees) > 360)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("the azimuth in '{}' is not from -360 to 360", text));
  if (std::abs(view.elevationDegrees) > 90)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("the elevation in '{}' is not from -90 to 90", text));
}

void addPicture(CLI::App& app, CommandLine& line) {
  const std::string picture = "Picture";
  addValue(app, "--picture", "FILE.png", "Also render the coloured mesh, for one mesh; - is standard output",
           [&](const std::string& text) {
             if (text != "-" && lowerCase(std::filesystem::path(text).extension().string()) != ".png")
               throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' does not end in .png", text));
             line.picture = text;
           })
      ->group(picture);
  CLI::Option* needsPicture = app.get_option("--picture");
  addChoice(app, "--picture-of", line.pictureOf, kPictures,
            "The diameter in colours, the faces that cast rays, or the errors expected\nby the estimate; default sdf")
      ->group(picture)
      ->needs(needsPicture);
  const View view;
  addValue(app, "--picture-view", "AZIMUTH,ELEVATION",
           fmt::format("Degrees from the mesh's broad side to the right and up;\ndefault {},{}", view.azimuthDegrees,
                       view.elevationDegrees),
           [&](const std::string& text) { readViewAngles(text, line.pictureView); })
      ->group(picture)
      ->needs(needsPicture);
  addChoice(app, "--picture-up", line.pictureView.up,
            ChoiceNames<std::optional<Up>, 7>{{{"auto", std::nullopt},
                                               {"x", Up::X},
                                               {"y", Up::Y},
                                               {"z", Up::Z},
                                               {"-x", Up::MinusX},
                                               {"-y", Up::MinusY},
                                               {"-z", Up::MinusZ}}},
            "What points up in the picture; auto is y unless the mesh would fall over;\ndefault auto")
      ->group(picture)
      ->needs(needsPicture);
}

void addDevice(CLI::App& app, CommandLine& line) {
  const std::string device = "Device";
  addChoice(app, "--backend", line.session.backend, kBackends,
            "Vulkan, Embree on the CPU, the double-precision reference on the CPU,\n"
            "or the fastest of them here; default auto")
      ->group(device);
  addValue(app, "--device", "N|NAME", "Device by its number in --list-devices or by a part of its name",
           [&](const std::string& text) { line.session.device = text; })
      ->group(device);
  app.add_flag("--require-gpu", line.session.requireGpu, "Fail rather than run on a CPU device or the reference")
      ->group(device);
  app.add_flag("--list-devices", line.listDevices, "List the Vulkan devices and what speaks for or against each")
      ->group(device);
  VulkanTraceRequest& trace = line.session.trace;
  addChoice(app, "--kernel", trace.kernel, kTraceKernels,
            "Vulkan: lanes side by side walk one ray of neighbouring seeds, the rays of\n"
            "one seed, or these together as a packet; default auto, by the device")
      ->group(device);
  addChoice(app, "--bvh", trace.bvh, kBvhLayouts,
            "Vulkan: nodes of eight children with boxes in bytes, or of two in float32;\ndefault auto")
      ->group(device);
  addChoice(app, "--fetch", trace.fetch, kBvhFetches,
            "Vulkan: what the hierarchy is read from, texel or storage buffers; default auto")
      ->group(device);
  addValue(app, "--threads", "N", "CPU threads, 1 to 1024; default as many as there are cores",
           [&](const std::string& text) { line.threadCount = static_cast<uint32_t>(parseWholeNumber(text, 1, 1024)); })
      ->group(device);
}

void requireAgreement(const CommandLine& line) {
  const auto refuse = [](const char* message) { throw Error(ErrorCode::OptionOutOfRange, message); };
  if (line.meshes.empty() && !line.listDevices) refuse("no mesh was given; asdf-vk --help lists the options");
  if (std::count(line.meshes.begin(), line.meshes.end(), "-") > 1)
    refuse("standard input ('-') can be read only once; name it once");
  if (std::count(line.meshes.begin(), line.meshes.end(), "") > 0) refuse("the name of a mesh is empty");
  if (line.output == "-" && line.json)
    refuse("-o - and --json both want standard output; give -o a file or drop --json");
  if (!line.picture.empty() && line.meshes.size() > 1)
    refuse("--picture takes one mesh; name one mesh, or run them one by one");
  if (line.picture == "-" && (line.output == "-" || line.json))
    refuse("--picture - wants standard output for itself; give it a file, or drop --json and -o -");
  const bool isCpu = line.session.backend == Backend::Cpu || line.session.backend == Backend::Reference;
  if (isCpu && line.session.requireGpu)
    refuse("--require-gpu contradicts --backend cpu and reference, which run on the CPU; drop one");
  if (isCpu && !line.session.device.empty())
    refuse("--device chooses a Vulkan device, which --backend cpu and reference do without; drop one");
  if (isCpu && !line.session.trace.isEmpty())
    refuse(
        "--kernel, --bvh and --fetch choose between shaders, which --backend cpu and reference do without; drop one");
  const bool estimates = line.options.estimatesError || line.options.rounds.maxError;
  if (line.pictureOf == PictureOf::Error && (!estimates || line.options.seeds.kind == SeedCount::Kind::All))
    refuse(
        "--picture-of error shows what the estimate expects; drop --no-estimate, and --seeds all, which has no error");
  const SolverChoice solver = line.options.solver;
  if (isCpu && (solver == SolverChoice::Cg || solver == SolverChoice::Jacobi))
    refuse(
        "--solver cg and jacobi run on a Vulkan device, which --backend cpu and reference do without; use --solver "
        "cpu");
}

}  // namespace

CommandLine parseCommandLine(std::vector<std::string> arguments) {
  CommandLine line;
  CLI::App app(kDescription, "asdf-vk");
  app.footer(kFooter);
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("--version", std::string("asdf-vk ") + ASDFVK_VERSION, "Print the version");
  app.add_option("meshes", line.meshes, "Meshes: PLY, OFF, OBJ or STL; '-' is standard input")->option_text("MESH...");
  addComputation(app, line);
  addOutput(app, line);
  addPicture(app, line);
  addDevice(app, line);

  spellOutBareCheck(arguments);
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back.
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::CallForVersion& version) {
    line.answer = std::string(version.what()) + "\n";
    return line;
  } catch (const CLI::Success&) {
    line.answer = app.help();
    return line;
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string message = error.what();
    throw Error(ErrorCode::OptionOutOfRange, message.substr(0, message.find(':')) + " takes exactly one value, once");
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::OptionOutOfRange, std::string(error.what()) + "; asdf-vk --help lists the options");
  }
  if (line.options.rounds.areAsked() && app.count("--seeds") == 0) line.options.seeds.share = kFirstRoundShare;
  requireAgreement(line);
  return line;
}

std::string shortUsage() {
  return "Usage: asdf-vk MESH... [OPTIONS]\n"
         "Computes the shape diameter function of triangle meshes; writes NAME.asdf.ply beside each.\n"
         "asdf-vk --help lists the options.\n";
}

}  // namespace asdfvk
