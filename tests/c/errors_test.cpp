// Errors, handles and the progress function of the interface in C.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <thread>

#include "c/c_objects.h"
#include "generate/analytic_shapes.h"
#include "support/shapes.h"

using namespace asdfvk;
using namespace asdfvk::test;

namespace {

/// Whether the call failed so, with a message of one line that contains `part`.
bool failsWith(asdf_vk_status status, asdf_vk_status expected, const std::string& name, const std::string& part) {
  const std::string message = asdf_vk_last_error();
  const bool is = status == expected && asdf_vk_last_error_name() == name && message.find(part) != std::string::npos &&
                  message.find('\n') == std::string::npos;
  CHECK_MESSAGE(is, status, " ", std::string(asdf_vk_last_error_name()), ": ", message);
  return is;
}
#define CHECK_FAILS(call, status, name, part) CHECK(failsWith(call, status, name, part))

/// The arguments of the last call of a progress function, and what it does.
struct ProgressRecord {
  int callCount = 0;
  double last = 0;
  std::string stages;
  int stopAt = std::numeric_limits<int>::max();
  asdf_vk_scene* used = nullptr;       ///< Computed in the call.
  asdf_vk_scene* destroyed = nullptr;  ///< Destroyed in the call.
  asdf_vk_status status = ASDF_VK_OK;
};

int recordProgress(double fraction, const char* stage, void* user) {
  auto& record = *static_cast<ProgressRecord*>(user);
  record.last = fraction;
  if (record.stages.find(stage) == std::string::npos) record.stages += std::string(stage) + " ";
  asdf_vk_result* result = nullptr;
  if (record.used != nullptr) record.status = asdf_vk_compute(record.used, nullptr, nullptr, nullptr, &result);
  asdf_vk_result_destroy(result);
  asdf_vk_scene_destroy(record.destroyed);
  return ++record.callCount >= record.stopAt ? 1 : 0;
}

int throwInProgress(double, const char*, void*) { throw std::runtime_error("of the caller"); }

}  // namespace

TEST_CASE("arrays of a wrong size or type are errors") {
  const Owned<asdf_vk_session> session = sessionOfC("reference");
  const Mesh mesh = shapes::tetrahedron();
  asdf_vk_scene* scene = nullptr;
  const auto create = [&](const void* vertices, int vertexType, size_t vertexCount, const void* corners, int cornerType,
                          size_t faceCount, const char* unit = nullptr) {
    return asdf_vk_scene_create(session.get(), vertices, static_cast<asdf_vk_type>(vertexType), vertexCount, corners,
                                static_cast<asdf_vk_type>(cornerType), faceCount, unit, &scene);
  };
  const void* const v = mesh.vertices.data();
  const void* const f = mesh.faces.data();
  CHECK_FAILS(create(v, ASDF_VK_FLOAT64, 3, f, ASDF_VK_UINT32, 4), ASDF_VK_INPUT, "indexOutOfRange", "does not exist");
  CHECK_FAILS(create(v, ASDF_VK_FLOAT64, 4, f, ASDF_VK_UINT32, 0), ASDF_VK_INPUT, "emptyMesh", "no faces");
  CHECK_FAILS(create(nullptr, ASDF_VK_FLOAT64, 4, f, ASDF_VK_UINT32, 4), ASDF_VK_USAGE, "invalidArgument",
              "a null pointer was passed for the vertices");
  CHECK_FAILS(create(v, ASDF_VK_FLOAT64, 4, nullptr, ASDF_VK_UINT32, 4), ASDF_VK_USAGE, "invalidArgument", "null");
  CHECK_FAILS(create(v, ASDF_VK_UINT8, 4, f, ASDF_VK_UINT32, 4), ASDF_VK_INPUT, "arrayType", "neither");
  CHECK_FAILS(create(v, ASDF_VK_FLOAT64, 4, f, ASDF_VK_FLOAT64, 4), ASDF_VK_INPUT, "arrayType", "neither");
  constexpr size_t kHuge = std::numeric_limits<size_t>::max() / 3 + 2;
  CHECK_FAILS(create(v, ASDF_VK_FLOAT64, kHuge, f, ASDF_VK_UINT32, 4), ASDF_VK_INPUT, "meshTooLarge", "vertices");
  CHECK_FAILS(create(v, ASDF_VK_FLOAT64, 4, f, ASDF_VK_UINT32, kHuge), ASDF_VK_INPUT, "meshTooLarge", "faces");
  CHECK_FAILS(create(v, ASDF_VK_FLOAT64, 4, f, ASDF_VK_UINT32, 4, "ell"), ASDF_VK_USAGE, "unknownName", "'ell'");
  const std::array<int32_t, 3> negative{0, 1, -1};
  CHECK_FAILS(create(v, ASDF_VK_FLOAT64, 4, negative.data(), ASDF_VK_INT32, 1), ASDF_VK_INPUT, "indexOutOfRange", "");
  const std::array<uint64_t, 3> first{0, 4, 3};
  CHECK_FAILS(asdf_vk_scene_create_polygons(session.get(), v, ASDF_VK_FLOAT64, 4, f, ASDF_VK_UINT32, first.data(), 2,
                                            nullptr, &scene),
              ASDF_VK_INPUT, "arraySize", "ascend");
  const std::array<uint64_t, 2> huge{0, std::numeric_limits<uint64_t>::max()};
  CHECK_FAILS(asdf_vk_scene_create_polygons(session.get(), v, ASDF_VK_FLOAT64, 4, f, ASDF_VK_UINT32, huge.data(), 1,
                                            nullptr, &scene),
              ASDF_VK_INPUT, "meshTooLarge", "corners");
  CHECK_FAILS(asdf_vk_scene_create(session.get(), v, ASDF_VK_FLOAT64, 4, f, ASDF_VK_UINT32, 4, nullptr, nullptr),
              ASDF_VK_USAGE, "invalidArgument", "for the output");
  CHECK_FAILS(asdf_vk_scene_read(session.get(), "/nowhere/a.ply", &scene), ASDF_VK_INPUT, "unreadableInput",
              "/nowhere/a.ply: cannot be opened");
  CHECK(scene == nullptr);
}

TEST_CASE("handles that are null, destroyed or of another type are errors, in any order of destruction") {
  const Mesh mesh = shapes::icosphere(1);
  Owned<asdf_vk_session> session = sessionOfC("reference");
  Owned<asdf_vk_scene> scene = sceneOfC(session.get(), mesh);
  asdf_vk_session* const gone = session.get();
  session.reset();
  Owned<asdf_vk_result> result = resultOfC(scene.get());  // The scene keeps its session.
  asdf_vk_scene* const goneScene = scene.get();
  scene.reset();
  CHECK(numbersOf(result.get(), "sdf").size() == 80);
  asdf_vk_session_destroy(gone);
  asdf_vk_scene_destroy(nullptr);

  asdf_vk_result* none = nullptr;
  asdf_vk_scene* other = nullptr;
  CHECK_FAILS(asdf_vk_compute(nullptr, nullptr, nullptr, nullptr, &none), ASDF_VK_USAGE, "invalidArgument",
              "the scene is null");
  CHECK_FAILS(asdf_vk_compute(goneScene, nullptr, nullptr, nullptr, &none), ASDF_VK_USAGE, "invalidArgument",
              "was destroyed");
  CHECK_FAILS(asdf_vk_scene_read(gone, "a.ply", &other), ASDF_VK_USAGE, "invalidArgument", "handle of a session");
  CHECK_FAILS(asdf_vk_compute(reinterpret_cast<asdf_vk_scene*>(result.get()), nullptr, nullptr, nullptr, &none),
              ASDF_VK_USAGE, "invalidArgument", "handle of a scene");
  asdf_vk_field field{};
  CHECK_FAILS(asdf_vk_result_find(result.get(), "width", ASDF_VK_PER_FACE, &field), ASDF_VK_USAGE, "unknownField",
              "no field width");
  CHECK_FAILS(asdf_vk_result_find(result.get(), "sdf", ASDF_VK_PER_VERTEX, &field), ASDF_VK_USAGE, "unknownField",
              "sdf");
  CHECK_FAILS(asdf_vk_result_find(result.get(), "sdf", static_cast<asdf_vk_location>(2), &field), ASDF_VK_USAGE,
              "invalidArgument", "neither PER_FACE nor PER_VERTEX");
  CHECK_FAILS(asdf_vk_result_find(result.get(), nullptr, ASDF_VK_PER_FACE, &field), ASDF_VK_USAGE, "invalidArgument",
              "null");
  CHECK_FAILS(asdf_vk_result_field(result.get(), 99, &field), ASDF_VK_USAGE, "unknownField", "99");
  std::array<double, 79> small{};
  CHECK_FAILS(asdf_vk_result_copy(result.get(), "sdf", ASDF_VK_PER_FACE, ASDF_VK_FLOAT64, small.data(), 79),
              ASDF_VK_INPUT, "arraySize", "79");
  std::array<uint8_t, 80> flags{};
  CHECK_FAILS(asdf_vk_result_copy(result.get(), "sdf", ASDF_VK_PER_FACE, ASDF_VK_UINT8, flags.data(), 80),
              ASDF_VK_INPUT, "arrayType", "sdf");
  const char* json = nullptr;
  for (const char* pointer : {"/width", "width", "/sdf/~"})
    CHECK_FAILS(asdf_vk_result_json(result.get(), pointer, &json), ASDF_VK_USAGE, "unknownField", pointer);
  CHECK_FAILS(asdf_vk_result_write(result.get(), "/nowhere/a.ply"), ASDF_VK_OUTPUT, "outputNotWritable", "/nowhere");
  CHECK_FAILS(asdf_vk_result_write(result.get(), "a.xyz"), ASDF_VK_USAGE, "unknownFormat", "a.xyz");
  CHECK(none == nullptr);
  std::thread([] { CHECK(std::string(asdf_vk_last_error()).empty()); }).join();
}

TEST_CASE("a forked process gets errors, and does not wait for threads of its parent") {
  const Owned<asdf_vk_session> session = sessionOfC("reference");
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    alarm(20);
    asdf_vk_session* own = nullptr;
    const bool isError = asdf_vk_session_create(nullptr, &own) == ASDF_VK_DEVICE && own == nullptr &&
                         std::string(asdf_vk_last_error_name()) == "forkedProcess";
    asdf_vk_session_destroy(session.get());
    _exit(isError ? 7 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 7);
}

TEST_CASE("options have names, values and the objects that they belong to") {
  const Owned<asdf_vk_options> options = optionsOfC({{"estimate", "off"}, {"rays", "20"}});
  const auto set = [&](const char* name, const char* value) { return asdf_vk_options_set(options.get(), name, value); };
  CHECK_FAILS(set("seed", "1"), ASDF_VK_USAGE, "unknownName", "did you mean seeds or rng-seed?");
  CHECK_FAILS(set("allow-sharp-edges", "on"), ASDF_VK_USAGE, "unknownName",
              "allow-sharp-edges was removed: thin edges do not count any more; count-edges counts them");
  CHECK_FAILS(set("fail-if-thinner", "1"), ASDF_VK_USAGE, "unknownName", "no option 'fail-if-thinner'");
  CHECK_FAILS(set("rays", "0"), ASDF_VK_USAGE, "optionOutOfRange", "rays: '0' is not a whole number from 1 to 1024");
  CHECK_FAILS(set("estimate", "maybe"), ASDF_VK_USAGE, "optionOutOfRange", "estimate: 'maybe' is not on or off");
  asdf_vk_session* session = nullptr;
  CHECK_FAILS(asdf_vk_session_create(options.get(), &session), ASDF_VK_USAGE, "optionConflict",
              "is an option of a computation");
  const Owned<asdf_vk_session> own = sessionOfC("reference");
  const Owned<asdf_vk_scene> scene = sceneOfC(own.get(), shapes::icosphere(1));
  asdf_vk_result* none = nullptr;
  requireDone(set("threads", "1"));
  CHECK_FAILS(asdf_vk_compute(scene.get(), options.get(), nullptr, nullptr, &none), ASDF_VK_USAGE, "optionConflict",
              "threads is an option of a session");
  requireDone(set("threads", nullptr));
  requireDone(asdf_vk_compute(scene.get(), options.get(), nullptr, nullptr, &none));
  const Owned<asdf_vk_result> result(none);
  CHECK(jsonAt(result.get(), "/options/rays") == "20");
  CHECK(jsonAt(result.get(), "/options/estimate") == "false");
  const Owned<asdf_vk_options> contradicting = optionsOfC({{"backend", "cpu"}, {"require-gpu", "true"}});
  CHECK_FAILS(asdf_vk_session_create(contradicting.get(), &session), ASDF_VK_USAGE, "optionConflict",
              "require-gpu contradicts backend=cpu");
}

TEST_CASE("threads compute on one session, whose scenes other threads destroy") {
  const Owned<asdf_vk_session> session = sessionOfC("cpu");
  const Mesh mesh = makeSphere(2000).mesh;
  const std::vector<double> expected = numbersOf(resultOfC(sceneOfC(session.get(), mesh).get()).get(), "sdf");
  const Owned<asdf_vk_scene> shared = sceneOfC(session.get(), mesh);
  std::array<std::vector<double>, 3> values;
  std::vector<std::thread> threads;
  for (std::vector<double>& own : values)
    threads.emplace_back([&] {
      const Owned<asdf_vk_scene> scene = sceneOfC(session.get(), mesh);
      own = numbersOf(resultOfC(shared.get()).get(), "sdf");
      if (own == expected) own = numbersOf(resultOfC(scene.get()).get(), "sdf");
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& own : values) CHECK(own == expected);
}

TEST_CASE("a scene is destroyed without waiting for a computation on its session") {
  struct Other {
    asdf_vk_scene* scene;
    std::atomic<bool> isComputing{false}, isDestroyed{false};
  };
  const Owned<asdf_vk_session> session = sessionOfC("cpu");
  const Mesh mesh = makeSphere(2000).mesh;
  const Owned<asdf_vk_scene> scene = sceneOfC(session.get(), mesh);
  for (const bool isPrepared : {true, false}) {
    Owned<asdf_vk_scene> owned = sceneOfC(session.get(), mesh);
    if (isPrepared) (void)resultOfC(owned.get());
    Other other{owned.release()};
    std::thread thread([&] {
      while (!other.isComputing) std::this_thread::yield();
      asdf_vk_scene_destroy(other.scene);
      other.isDestroyed = true;
    });
    const asdf_vk_progress waitForThread = [](double, const char*, void* user) {
      auto& waited = *static_cast<Other*>(user);
      waited.isComputing = true;
      for (int i = 0; i < 500 && !waited.isDestroyed; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      return waited.isDestroyed ? 0 : 1;
    };
    asdf_vk_result* result = nullptr;
    const asdf_vk_status status = asdf_vk_compute(scene.get(), nullptr, waitForThread, &other, &result);
    thread.join();
    CHECK(status == ASDF_VK_OK);
    asdf_vk_result_destroy(result);
  }
}

TEST_CASE("the progress function stops a computation, and may neither compute on its session nor throw") {
  const Owned<asdf_vk_session> session = sessionOfC("reference");
  const Owned<asdf_vk_scene> scene = sceneOfC(session.get(), makeSphere(2000).mesh);
  Owned<asdf_vk_scene> other = sceneOfC(session.get(), shapes::icosphere(1));
  (void)resultOfC(other.get());
  asdf_vk_result* none = nullptr;
  ProgressRecord record{.used = scene.get(), .destroyed = other.release()};
  requireDone(asdf_vk_compute(scene.get(), nullptr, recordProgress, &record, &none));
  const Owned<asdf_vk_result> result(std::exchange(none, nullptr));
  CHECK(record.callCount > 3);
  CHECK(record.last == 1);
  CHECK(record.stages.find("trace") != std::string::npos);
  CHECK(record.status == ASDF_VK_USAGE);
  ProgressRecord stopping{.stopAt = 3};
  CHECK_FAILS(asdf_vk_compute(scene.get(), nullptr, recordProgress, &stopping, &none), ASDF_VK_CANCELLED, "cancelled",
              "cancelled");
  CHECK(stopping.callCount == 3);
  CHECK_FAILS(asdf_vk_compute(scene.get(), nullptr, throwInProgress, nullptr, &none), ASDF_VK_INTERNAL, "internal",
              "of the caller");
  requireDone(asdf_vk_compute(scene.get(), nullptr, nullptr, nullptr, &none));
  asdf_vk_result_destroy(none);
}

TEST_CASE("progress functions that compute on each other's session fail, and do not wait for each other") {
  struct Side {
    asdf_vk_scene* other;
    std::atomic<int>& arrivedCount;
    int callCount = 0;
    std::string error;
  };
  const asdf_vk_progress computeOnOther = [](double, const char*, void* user) {
    auto& side = *static_cast<Side*>(user);
    if (++side.callCount > 1) return 0;
    const auto waitForBoth = [&](int count) {
      ++side.arrivedCount;
      for (int i = 0; i < 3000 && side.arrivedCount < count; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    };
    waitForBoth(2);
    asdf_vk_result* none = nullptr;
    if (asdf_vk_compute(side.other, nullptr, nullptr, nullptr, &none) != ASDF_VK_OK) side.error = asdf_vk_last_error();
    asdf_vk_result_destroy(none);
    waitForBoth(4);
    return 0;
  };
  const Owned<asdf_vk_session> a = sessionOfC("cpu"), b = sessionOfC("cpu");
  const Owned<asdf_vk_scene> ofA = sceneOfC(a.get(), shapes::icosphere(2)), ofB = sceneOfC(b.get(), shapes::cube());
  std::atomic<int> arrivedCount{0};
  Side sideA{ofB.get(), arrivedCount}, sideB{ofA.get(), arrivedCount};
  const auto compute = [&](asdf_vk_scene* scene, Side& side) {
    asdf_vk_result* result = nullptr;
    CHECK(asdf_vk_compute(scene, nullptr, computeOnOther, &side, &result) == ASDF_VK_OK);
    asdf_vk_result_destroy(result);
  };
  std::thread thread([&] { compute(ofB.get(), sideB); });
  compute(ofA.get(), sideA);
  thread.join();
  for (const Side* side : {&sideA, &sideB})
    CHECK(side->error == "a progress function must not compute on a session in use; give it a session of its own");
  // A session that is not in use serves a progress function.
  ProgressRecord record{.used = ofB.get()};
  asdf_vk_result* result = nullptr;
  requireDone(asdf_vk_compute(ofA.get(), nullptr, recordProgress, &record, &result));
  asdf_vk_result_destroy(result);
  CHECK(record.status == ASDF_VK_OK);
}
