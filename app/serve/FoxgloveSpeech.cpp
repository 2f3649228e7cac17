#include "FoxgloveSpeech.hpp"

#include <utility>

#include "ortung/foxglove/FoxgloveSession.hpp"

namespace ortung::app {
namespace {

class FoxgloveSpeech final : public WebSpeech {
 public:
  explicit FoxgloveSpeech(const std::string& token) : session_(token) { fetch(); }
  ~FoxgloveSpeech() override = default;
  void fromClient(std::string_view message, bool isBinary) override {
    session_.fromClient(message, isBinary);
    fetch();
  }
  void fromBoard(std::string_view bytes) override {
    session_.fromBoard(bytes);
    fetch();
  }

 private:
  void fetch() {
    toBoard += std::exchange(session_.toBoard, {});
    for (FoxgloveSession::Frame& frame : session_.toClient)
      toClient.push_back({std::move(frame.bytes), frame.isBinary});
    session_.toClient.clear();
    isOver = session_.isOver;
  }
  FoxgloveSession session_;
};

/// Returns the query's token, if a token file may contain it; else "".
std::string tokenIn(std::string_view target) {
  constexpr std::string_view kKey = "token=";
  constexpr std::size_t kLongest = 256;
  const std::size_t query = target.find('?');
  if (query == target.npos) return "";
  std::size_t at = target.find(kKey, query);
  if (at == target.npos || (target[at - 1] != '?' && target[at - 1] != '&')) return "";
  at += kKey.size();
  const std::string_view token = target.substr(at, target.find('&', at) - at);
  for (const char c : token)
    if (c <= ' ' || c > '~' || c == '=') return "";
  return token.size() <= kLongest ? std::string(token) : "";
}

}  // namespace

WebProtocol foxgloveProtocol() {
  return {{"foxglove.sdk.v1", "foxglove.websocket.v1"}, "", [](std::string_view target) {
            return std::make_unique<FoxgloveSpeech>(tokenIn(target));
          }};
}

}  // namespace ortung::app
