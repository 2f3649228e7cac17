#include "ortung/web/WebSpeech.hpp"

namespace ortung {
namespace {

class BoardSpeech final : public WebSpeech {
 public:
  ~BoardSpeech() override = default;
  void fromClient(std::string_view message, bool) override { toBoard.append(message); }
  void fromBoard(std::string_view bytes) override {
    toClient.push_back({std::string(bytes), true});
  }
};

}  // namespace

WebSpeech::~WebSpeech() = default;

WebProtocol boardProtocol() {
  return {{"ortung.board.1"}, "/board", [](std::string_view) {
            return std::make_unique<BoardSpeech>();
          }};
}

}  // namespace ortung
