// What a referee box sends: cut into messages, read, and made into orders. However the bytes come,
// the messages are the same.
#include <vector>

#include "Fuzz.hpp"
#include "Messages.hpp"
#include "ortung/refbox/BoxCommand.hpp"

namespace {

using namespace ortung;

constexpr std::size_t kLongest = 128;

std::vector<std::string> messagesOf(std::string_view bytes, std::size_t piece) {
  refbox::Messages messages(kLongest);
  std::vector<std::string> all;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    messages.receive(
        bytes.substr(at, piece), [&](std::string_view message) { all.emplace_back(message); },
        [&] { all.emplace_back("too long"); });
    fuzz::require(messages.waiting() <= kLongest);
  }
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  const auto messages = messagesOf(text, size + 1);
  fuzz::require(messages == messagesOf(text, 1));
  for (const std::string& message : messages) {
    std::string why;
    const auto command = refbox::readBoxCommand(message, why);
    fuzz::require(command || !why.empty());
    if (!command) continue;
    fuzz::require(!command->robot || (*command->robot >= 0 && *command->robot <= 99));
    for (const char* address : {"", "224.16.32.10"}) {
      why.clear();
      const auto order = refbox::orderOf(*command, {"blue", "yellow", address}, why);
      fuzz::require(order || !why.empty());
    }
  }
  return 0;
}
