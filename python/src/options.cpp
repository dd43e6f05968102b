#include "options.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "arrays.h"
#include "asdf_vk/choices.h"
#include "asdf_vk/error.h"

namespace py = pybind11;

namespace asdfvk::python {
namespace {

/// A value of an option with its name, for the messages.
struct Value {
  const char* name;
  py::handle object;

  [[noreturn]] void fail(const std::string& wanted) const {
    throw Error(ErrorCode::OptionOutOfRange,
                std::string(name) + "=" + std::string(py::repr(object)) + " is not " + wanted, {{"option", name}});
  }
};

/// An integer of Python or NumPy.
bool isWhole(const py::handle& object) {
  if (PyIndex_Check(object.ptr()) == 0 || isFlag(object)) return false;
  if (py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()))) return true;
  PyErr_Clear();
  return false;
}

double numberOf(const Value& value) {
  if (isFlag(value.object)) value.fail("a number");
  const double number = PyFloat_AsDouble(value.object.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    value.fail("a number");
  }
  if (!std::isfinite(number)) value.fail("a finite number");
  return number;
}

template <typename T>
T wholeOf(const Value& value, uint64_t minimum = 0, uint64_t maximum = std::numeric_limits<T>::max()) {
  const auto fail = [&] {
    value.fail("a whole number from " + std::to_string(minimum) + " to " + std::to_string(maximum));
  };
  if (!isWhole(value.object)) fail();
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.object.ptr()));
  const unsigned long long number = PyLong_AsUnsignedLongLong(index.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    fail();
  }
  if (number < minimum || number > maximum) fail();
  return static_cast<T>(number);
}

std::string textOf(const Value& value) {
  Py_ssize_t size = 0;
  const char* text = PyUnicode_Check(value.object.ptr()) ? PyUnicode_AsUTF8AndSize(value.object.ptr(), &size) : nullptr;
  if (text == nullptr) {  // Also for half of a surrogate pair.
    PyErr_Clear();
    value.fail("a string");
  }
  return {text, static_cast<size_t>(size)};
}

bool flagOf(const Value& value) {
  if (!isFlag(value.object)) value.fail("True or False");
  return PyObject_IsTrue(value.object.ptr()) == 1;
}

template <typename T, size_t N>
T choiceOf(const Value& value, const ChoiceNames<T, N>& names) {
  const std::string name = textOf(value);
  if (const T* found = findChoice(names, name)) return *found;
  throw Error(ErrorCode::UnknownName,
              std::string(value.name) + "='" + name + "' is unknown; the names are " + joined(names),
              {{"option", value.name}});
}

/// A share as a float, a count as an int, "auto", "all", or "10%".
SeedCount seedCountOf(const Value& value) {
  if (py::isinstance<py::str>(value.object)) {
    const std::string text = textOf(value);
    if (text == "all") return SeedCount::all();
    if (text == "auto") return SeedCount::automatic();
    if (!text.ends_with('%')) value.fail("'auto', 'all', a share such as 0.1 or '10%', or a count");
    const py::object percent =
        py::module_::import("builtins").attr("str")(text.substr(0, text.size() - 1)).attr("strip")();
    const auto number = py::reinterpret_steal<py::object>(PyFloat_FromString(percent.ptr()));
    if (!number) {
      PyErr_Clear();
      value.fail("'auto', 'all', a share such as 0.1 or '10%', or a count");
    }
    return SeedCount::ofShare(number.cast<double>() / 100);
  }
  if (isWhole(value.object)) return SeedCount::ofCount(wholeOf<uint64_t>(value, 1));
  return SeedCount::ofShare(numberOf(value));
}

/// "off", "auto", or (rings, passes).
SmoothingOptions smoothingOf(const Value& value) {
  if (py::isinstance<py::str>(value.object)) {
    const std::string text = textOf(value);
    if (text == "off") return {};
    if (text == "auto") return {.isOn = true, .window = {}};
  }
  if (!py::isinstance<py::tuple>(value.object) || py::len(value.object) != 2)
    value.fail("'off', 'auto' or a tuple of rings (1 to 4) and passes (1 to 100)");
  const auto pair = value.object.cast<py::tuple>();
  return {.isOn = true,
          .window = SmoothingOptions::Window{wholeOf<uint32_t>({value.name, pair[0]}, 1, 4),
                                             wholeOf<uint32_t>({value.name, pair[1]}, 1, 100)}};
}

uint64_t checkCountOf(const Value& value) {
  if (py::isinstance<py::str>(value.object)) {
    if (textOf(value) != "all") value.fail("'all' or a count of at least 1");
    return std::numeric_limits<uint64_t>::max();
  }
  return wholeOf<uint64_t>(value, 1);
}

struct OptionRow {
  const char* name;
  void (*set)(Options& options, const Value& value);
};

// The recipe and the definition come first: they set others.
constexpr std::array kOptions{
    OptionRow{"recipe", [](Options& o, const Value& v) { applyRecipe(choiceOf(v, kRecipes), o); }},
    OptionRow{"definition", [](Options& o, const Value& v) { applyDefinition(choiceOf(v, kDefinitions), o); }},
    OptionRow{"seeds", [](Options& o, const Value& v) { o.seeds = seedCountOf(v); }},
    OptionRow{"sampler", [](Options& o, const Value& v) { o.sampler = textOf(v); }},
    OptionRow{"random_seed", [](Options& o, const Value& v) { o.randomSeed = wholeOf<uint64_t>(v); }},
    OptionRow{"max_error", [](Options& o, const Value& v) { o.rounds.maxError = numberOf(v); }},
    OptionRow{"max_relative_error", [](Options& o, const Value& v) { o.rounds.maxRelativeError = numberOf(v); }},
    OptionRow{"time_budget", [](Options& o, const Value& v) { o.rounds.timeBudgetSeconds = numberOf(v); }},
    OptionRow{"estimate", [](Options& o, const Value& v) { o.estimatesError = flagOf(v); }},
    OptionRow{"rays", [](Options& o, const Value& v) { o.cone.rayCount = wholeOf<uint32_t>(v, 1, kMaxRayCount); }},
    OptionRow{"cone_angle", [](Options& o, const Value& v) { o.cone.openingAngleDegrees = numberOf(v); }},
    OptionRow{"false_hit_angle", [](Options& o, const Value& v) { o.cone.falseHitAngleDegrees = numberOf(v); }},
    OptionRow{"outlier_deviations", [](Options& o, const Value& v) { o.cone.outlierDeviations = numberOf(v); }},
    OptionRow{"cone_rotation", [](Options& o, const Value& v) { o.cone.rotation = choiceOf(v, kConeRotations); }},
    OptionRow{"orient", [](Options& o, const Value& v) { o.orientation = choiceOf(v, kOrientations); }},
    OptionRow{"smooth", [](Options& o, const Value& v) { o.smoothing = smoothingOf(v); }},
    OptionRow{"postprocess", [](Options& o, const Value& v) { o.postprocess = choiceOf(v, kPostprocesses); }},
    OptionRow{"segment", [](Options& o, const Value& v) { o.segmentation = choiceOf(v, kSegmentations); }},
    OptionRow{"parts", [](Options& o, const Value& v) { o.parts.partCount = wholeOf<uint32_t>(v, 1, kMaxPartCount); }},
    OptionRow{"detail", [](Options& o, const Value& v) { o.parts.detail = numberOf(v); }},
    OptionRow{"clusters",
              [](Options& o, const Value& v) {
                o.cgalSegmentation.clusterCount = wholeOf<uint32_t>(v, 2, kMaxClusterCount);
              }},
    OptionRow{"smoothness", [](Options& o, const Value& v) { o.cgalSegmentation.smoothness = numberOf(v); }},
    OptionRow{"expansion",
              [](Options& o, const Value& v) { o.cgalSegmentation.expansion = choiceOf(v, kCgalExpansions); }},
    OptionRow{"measure", [](Options& o, const Value& v) { o.measure = choiceOf(v, kMeasures); }},
    OptionRow{"wall_angle", [](Options& o, const Value& v) { o.thickness.wallAngleDegrees = numberOf(v); }},
    OptionRow{"thinner_than", [](Options& o, const Value& v) { o.thickness.thinnerThan = numberOf(v); }},
    OptionRow{"allow_sharp_edges", [](Options& o, const Value& v) { o.thickness.allowsSharpEdges = flagOf(v); }},
    OptionRow{"centres", [](Options& o, const Value& v) { o.computesCentres = flagOf(v); }},
    OptionRow{"per", [](Options& o, const Value& v) { o.per = choiceOf(v, kPerElements); }},
    OptionRow{"weights", [](Options& o, const Value& v) { o.interpolation.weights = choiceOf(v, kWeights); }},
    OptionRow{"guidance", [](Options& o, const Value& v) { o.interpolation.guidance = choiceOf(v, kGuidances); }},
    OptionRow{"pooling", [](Options& o, const Value& v) { o.interpolation.pooling = numberOf(v); }},
    OptionRow{"solver", [](Options& o, const Value& v) { o.solver = textOf(v); }},
    OptionRow{"tolerance", [](Options& o, const Value& v) { o.solverOptions.tolerance = numberOf(v); }},
    OptionRow{"max_iterations",
              [](Options& o, const Value& v) { o.solverOptions.maxIterations = wholeOf<uint32_t>(v, 1); }},
    OptionRow{"check", [](Options& o, const Value& v) { o.checkCount = checkCountOf(v); }},
};

}  // namespace

std::vector<std::string> optionNames() {
  std::vector<std::string> names;
  for (const OptionRow& row : kOptions) names.emplace_back(row.name);
  return names;
}

Options optionsOf(const py::dict& values) {
  Options options;
  size_t usedCount = 0;
  for (const OptionRow& row : kOptions) {
    if (!values.contains(row.name)) continue;
    const py::object value = values[row.name];
    ++usedCount;
    if (!value.is_none()) row.set(options, {row.name, value});
  }
  const bool hasSeeds = values.contains("seeds") && !py::object(values["seeds"]).is_none();
  if (options.rounds.areSet() && !hasSeeds) options.seeds = SeedCount::ofShare(kFirstRoundShare);
  if (usedCount == values.size()) return options;
  for (const auto& [key, value] : values) {
    const auto name = py::str(key).cast<std::string>();
    bool isKnown = false;
    for (const OptionRow& row : kOptions) isKnown = isKnown || name == row.name;
    if (!isKnown) throw Error(ErrorCode::UnknownName, "there is no option '" + name + "'", {{"option", name}});
  }
  return options;
}

}  // namespace asdfvk::python
