// A program that uses the public headers alone: its own arrays, errors, progress and cancellation.
#include <asdf_vk/asdf_vk.h>

#include <array>
#include <cstdio>
#include <stop_token>

namespace {

constexpr std::array<float, 12> kPositions{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
constexpr std::array<std::uint32_t, 12> kTriangles{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

bool fail(const char* reason) {
  std::fprintf(stderr, "failed: %s\n", reason);
  return false;
}

bool computesOnArrays(asdfvk::Session& session) {
  asdfvk::Options options;
  options.seeds = asdfvk::SeedCount::all();
  double last = 0;
  asdfvk::RunControl control;
  control.progress = [&last](double fraction) { last = fraction; };
  const asdfvk::MeshView mesh(kPositions, kTriangles);
  const asdfvk::Result result = session.compute(mesh, options, control);
  if (result.sdf().size() != 4 || !(result.sdf()[0] > 0)) return fail("a tetrahedron has four values");
  if (result.field("seed") == nullptr || result.field("error") != nullptr) return fail("fields sdf and seed");
  return last == 1.0 || fail("progress ends at 1");
}

bool reportsErrors(asdfvk::Session& session) {
  constexpr std::array<std::uint32_t, 3> kOutOfRange{0, 1, 4};
  try {
    (void)session.compute(asdfvk::MeshView(kPositions, kOutOfRange));
    return fail("an index out of range is an error");
  } catch (const asdfvk::Error& error) {
    if (error.code() != asdfvk::ErrorCode::IndexOutOfRange) return fail(error.what());
  }
  std::stop_source stop;
  stop.request_stop();
  asdfvk::RunControl control;
  control.stop = stop.get_token();
  try {
    (void)session.compute(asdfvk::MeshView(kPositions, kTriangles), {}, control);
    return fail("a requested stop is an error");
  } catch (const asdfvk::Error& error) {
    return error.kind() == asdfvk::ErrorKind::Cancelled || fail(error.what());
  }
}

}  // namespace

int main() {
  asdfvk::Session session(
      {.backend = asdfvk::BackendChoice::Reference, .device = {}, .requireGpu = false, .variant = {}});
  return computesOnArrays(session) && reportsErrors(session) ? 0 : 1;
}
