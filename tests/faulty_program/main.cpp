// asdf-vk with faults, which the names of meshes choose: *crash* ends by a signal, *hang* never ends, *grow* takes 10
// GB, *swell* does so in its first attempt, *kill* ends by SIGKILL, *once-kill* does so in its first attempt,
// *terminate* receives SIGTERM, *lose* loses the device, *slow* takes 0.3 s.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "asdf_vk/error.h"
#include "cli/one_mesh.h"
#include "cli/program.h"

namespace {

/// Makes the file INPUT.tried.
bool isFirstAttempt(const std::string& input) {
  std::FILE* const file = std::fopen((input + ".tried").c_str(), "wx");
  if (file != nullptr) std::fclose(file);
  return file != nullptr;
}

bool has(const std::string& input, const char* fault) { return input.find(fault) != std::string::npos; }

}  // namespace

void asdfvk::beforeMesh(const std::string& input) {
  if (input.find("crash") != std::string::npos) std::raise(SIGSEGV);
  while (input.find("hang") != std::string::npos) std::this_thread::sleep_for(std::chrono::seconds(1));
  if (input.find("terminate") != std::string::npos) {
    std::raise(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // Another thread requests the stop.
  }
  if (input.find("lose") != std::string::npos) throw Error(ErrorCode::DeviceLost, "the device was lost");
  if (input.find("slow") != std::string::npos) std::this_thread::sleep_for(std::chrono::milliseconds(300));
  if (has(input, "kill") && (!has(input, "once-kill") || isFirstAttempt(input))) std::raise(SIGKILL);
  if (!has(input, "grow") && !(has(input, "swell") && isFirstAttempt(input))) return;
  constexpr size_t kPiece = size_t{64} << 20, kPieceCount = 160;
  std::vector<std::vector<char>> pieces;
  for (size_t i = 0; i < kPieceCount; ++i) pieces.emplace_back(kPiece, static_cast<char>(i + 1));
}

int main(int argc, char** argv) { return static_cast<int>(asdfvk::runProgram({argv + 1, argv + argc})); }
