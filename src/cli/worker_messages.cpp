#include "cli/worker_messages.h"

namespace asdfvk {

std::string lineOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string textOfBytes(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xc0 | byte >> 6);
      text += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return text;
}

std::string bytesOfText(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x80 || i + 1 == text.size()) {
      bytes += text[i];
    } else {
      ++i;
      bytes += static_cast<char>((byte & 0x03) << 6 | (static_cast<unsigned char>(text[i]) & 0x3f));
    }
  }
  return bytes;
}

Json requestOf(const MeshTask& task) {
  return {{"input", textOfBytes(task.input)}, {"output", textOfBytes(task.output)}};
}

MeshTask taskOf(const Json& request) {
  return {bytesOfText(request.at("input").get<std::string>()), bytesOfText(request.at("output").get<std::string>())};
}

Json answerOf(const MeshRun& run) {
  return {{"code", static_cast<int>(run.code)},
          {"json", textOfBytes(run.json)},
          {"text", textOfBytes(run.text)},
          {"record", toJsonLine(run.record)}};
}

MeshRun runOf(const Json& answer) {
  MeshRun run;
  run.code = static_cast<ExitCode>(answer.at("code").get<int>());
  run.json = bytesOfText(answer.at("json").get<std::string>());
  run.text = bytesOfText(answer.at("text").get<std::string>());
  run.record = parseRecord(answer.at("record").get<std::string>()).value();
  return run;
}

}  // namespace asdfvk
