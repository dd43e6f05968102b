#include "cli/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "cli/option_values.h"
#include "core/error.h"

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
      throw Error(ErrorKind::Usage,
                  fmt::format("--check takes its number with an equals sign: --check={}", arguments[i + 1]));
    arguments[i] = fmt::format("--check={}", kDefaultCheckCount);
  }
}

template <typename T>
CLI::Option* addChoice(CLI::App& app, const std::string& name, T& target,
                       const std::vector<std::pair<std::string, T>>& choices, const std::string& text) {
  std::string names;
  for (const auto& [choice, value] : choices) names += (names.empty() ? "" : "|") + choice;
  return app
      .add_option_function<std::string>(
          name,
          [name, names, &target, choices](const std::string& choice) {
            const auto found = std::find_if(choices.begin(), choices.end(),
                                            [&](const auto& candidate) { return candidate.first == choice; });
            if (found == choices.end())
              throw Error(ErrorKind::Usage, fmt::format("{}: '{}' is not one of {}", name, choice, names));
            target = found->second;
          },
          text)
      ->option_text(names);
}

/// `read` turns the text into a value and throws Error{Usage}; the option's name is put before its message.
template <typename Read>
CLI::Option* addValue(CLI::App& app, const std::string& name, const std::string& placeholder, const std::string& text,
                      Read read) {
  return app
      .add_option_function<std::string>(
          name,
          [name, read](const std::string& value) {
            try {
              read(value);
            } catch (const Error& error) {
              throw Error(error.kind(), name.substr(name.find("--")) + ": " + error.what());
            }
          },
          text)
      ->option_text(placeholder);
}

/// "10%", as --seeds takes it.
std::string defaultSeeds() { return fmt::format("{}%", Options{}.seeds.share * 100); }

void addComputation(CLI::App& app, Options& options) {
  const Options defaults;
  const std::string rays = "Seeds and rays";
  addValue(app, "--seeds", "N%|N|all", "Faces that cast rays: a share, a count or all; default " + defaultSeeds(),
           [&](const std::string& text) { options.seeds = parseSeedCount(text); })
      ->group(rays);
  addValue(app, "--rng-seed", "N",
           fmt::format("Seed of the random choice of seed faces; default {}", defaults.randomSeed),
           [&](const std::string& text) {
             options.randomSeed = parseWholeNumber(text, 0, std::numeric_limits<uint64_t>::max());
           })
      ->group(rays);
  addValue(app, "--rays", "N", fmt::format("Rays per cone, 1 to {}; default {}", kMaxRayCount, defaults.cone.rayCount),
           [&](const std::string& text) {
             options.cone.rayCount = static_cast<uint32_t>(parseWholeNumber(text, 1, kMaxRayCount));
           })
      ->group(rays);
  addValue(app, "--angle", "DEGREES",
           fmt::format("Full opening angle of the cone, above 0 and below 180; default {}",
                       defaults.cone.openingAngleDegrees),
           [&](const std::string& text) {
             options.cone.openingAngleDegrees = parseNumber(text);
             if (!(options.cone.openingAngleDegrees > 0 && options.cone.openingAngleDegrees < 180))
               throw Error(ErrorKind::Usage, fmt::format("'{}' is not above 0 and below 180", text));
           })
      ->group(rays);
  addValue(app, "--false-hit-angle", "DEGREES",
           fmt::format("A hit on a face whose normal is within this angle of the seed's is\n"
                       "false, 0 to 180; default {}",
                       defaults.cone.falseHitAngleDegrees),
           [&](const std::string& text) {
             options.cone.falseHitAngleDegrees = parseNumber(text);
             if (!(options.cone.falseHitAngleDegrees >= 0 && options.cone.falseHitAngleDegrees <= 180))
               throw Error(ErrorKind::Usage, fmt::format("'{}' is not from 0 to 180", text));
           })
      ->group(rays);
  addValue(app, "--outlier-deviations", "S",
           fmt::format("Lengths farther from the median than S standard deviations are left\n"
                       "out, above 0; default {}",
                       defaults.cone.outlierDeviations),
           [&](const std::string& text) {
             options.cone.outlierDeviations = parseNumber(text);
             if (!(options.cone.outlierDeviations > 0))
               throw Error(ErrorKind::Usage, fmt::format("'{}' is not above 0", text));
           })
      ->group(rays);
  addChoice<Orientation>(app, "--orient", options.orientation,
                         {{"keep", Orientation::Keep}, {"auto", Orientation::Auto}, {"flip", Orientation::Flip}},
                         "Closed components that look the wrong way: name them, turn them, or\n"
                         "turn every face; default keep")
      ->group(rays);

  const std::string interpolation = "Interpolation";
  addChoice<SolverChoice>(app, "--solver", options.solver,
                          {{"auto", SolverChoice::Auto},
                           {"cg", SolverChoice::Cg},
                           {"jacobi", SolverChoice::Jacobi},
                           {"eigen", SolverChoice::Eigen}},
                          "Conjugate gradient or Jacobi on the device, or Eigen on the CPU; default auto")
      ->group(interpolation);
  addValue(app, "--guidance", "K",
           fmt::format("Factor of the curvature term; default {} (harmonic interpolation)", defaults.guidance),
           [&](const std::string& text) { options.guidance = parseNumber(text); })
      ->group(interpolation);
  addValue(app, "--tolerance", "R",
           fmt::format("Relative residual at which the solver stops, above 0 and below 1;\n"
                       "default {}",
                       defaults.solverOptions.tolerance),
           [&](const std::string& text) {
             options.solverOptions.tolerance = parseNumber(text);
             if (!(options.solverOptions.tolerance > 0 && options.solverOptions.tolerance < 1))
               throw Error(ErrorKind::Usage, fmt::format("'{}' is not above 0 and below 1", text));
           })
      ->group(interpolation);
  addValue(app, "--max-iterations", "N",
           fmt::format("Iterations after which the solver gives up; default {}", defaults.solverOptions.maxIterations),
           [&](const std::string& text) {
             options.solverOptions.maxIterations =
                 static_cast<uint32_t>(parseWholeNumber(text, 1, std::numeric_limits<uint32_t>::max()));
           })
      ->group(interpolation);
}

void addOutput(CLI::App& app, CommandLine& line) {
  const std::string output = "Output";
  addValue(app, "-o,--output", "FILE|DIR|-",
           "Result: a file (.ply .vtu .npy .csv), a directory, or - for standard\n"
           "output; default NAME.asdf.ply beside the input",
           [&](const std::string& text) {
             if (text.empty()) throw Error(ErrorKind::Usage, "the name is empty");
             line.output = text;
           })
      ->group(output);
  addChoice<std::string>(app, "--format", line.format, {{"ply", "ply"}, {"vtu", "vtu"}, {"npy", "npy"}, {"csv", "csv"}},
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

void addDevice(CLI::App& app, CommandLine& line) {
  const std::string device = "Device";
  addChoice<Backend>(
      app, "--backend", line.session.backend,
      {{"auto", Backend::Auto}, {"vulkan", Backend::Vulkan}, {"cpu", Backend::Cpu}, {"reference", Backend::Reference}},
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
  addValue(app, "--threads", "N", "CPU threads, 1 to 1024; default as many as there are cores",
           [&](const std::string& text) { line.threadCount = static_cast<uint32_t>(parseWholeNumber(text, 1, 1024)); })
      ->group(device);
}

void requireAgreement(const CommandLine& line) {
  const auto refuse = [](const char* message) { throw Error(ErrorKind::Usage, message); };
  if (line.meshes.empty() && !line.listDevices) refuse("no mesh was given; asdf-vk --help lists the options");
  if (std::count(line.meshes.begin(), line.meshes.end(), "-") > 1)
    refuse("standard input ('-') can be read only once; name it once");
  if (std::count(line.meshes.begin(), line.meshes.end(), "") > 0) refuse("the name of a mesh is empty");
  if (line.output == "-" && line.json)
    refuse("-o - and --json both want standard output; give -o a file or drop --json");
  const bool isCpu = line.session.backend == Backend::Cpu || line.session.backend == Backend::Reference;
  if (isCpu && line.session.requireGpu)
    refuse("--require-gpu contradicts --backend cpu and reference, which run on the CPU; drop one");
  if (isCpu && !line.session.device.empty())
    refuse("--device chooses a Vulkan device, which --backend cpu and reference do without; drop one");
  const SolverChoice solver = line.options.solver;
  if (isCpu && (solver == SolverChoice::Cg || solver == SolverChoice::Jacobi))
    refuse(
        "--solver cg and jacobi run on a Vulkan device, which --backend cpu and reference do without; use --solver "
        "eigen");
}

}  // namespace

CommandLine parseCommandLine(std::vector<std::string> arguments) {
  CommandLine line;
  CLI::App app(kDescription, "asdf-vk");
  app.footer(kFooter);
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("--version", std::string("asdf-vk ") + ASDFVK_VERSION, "Print the version");
  app.add_option("meshes", line.meshes, "Meshes: PLY, OFF, OBJ or STL; '-' is standard input")->option_text("MESH...");
  addComputation(app, line.options);
  addOutput(app, line);
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
    throw Error(ErrorKind::Usage, message.substr(0, message.find(':')) + " takes exactly one value, once");
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::Usage, std::string(error.what()) + "; asdf-vk --help lists the options");
  }
  requireAgreement(line);
  return line;
}

std::string shortUsage() {
  return "Usage: asdf-vk MESH... [OPTIONS]\n"
         "Computes the shape diameter function of triangle meshes; writes NAME.asdf.ply beside each.\n"
         "asdf-vk --help lists the options.\n";
}

}  // namespace asdfvk
