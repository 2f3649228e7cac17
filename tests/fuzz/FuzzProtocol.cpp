// Bytes of a client against the server's side of the protocol, without sockets and threads. A byte
// 0xFF in the input lets the world go on by a cycle, 0xFE begins anew with what the second client
// says.
#include <cstdint>
#include <cstdlib>
#include <deque>

#include "../server/CountingWorld.hpp"
#include "Conversation.hpp"
#include "Http.hpp"

namespace {

using namespace ortung;
using namespace ortung::server;

/// Runs everything on one thread, in order.
class InlineHost final : public Host {
 public:
  using Host::Host;
  ~InlineHost() override = default;
  void post(std::function<void()> task) override { tasks_.push_back(std::move(task)); }
  void work(std::function<void()> task) override { post(std::move(task)); }
  void broadcast(ClientId from, std::string_view text) override {
    for (const auto& conversation : conversations)
      if (conversation->id() != from) conversation->tell(text);
  }
  void queue(std::weak_ptr<Conversation> client) override {
    post([client] {
      if (const auto conversation = client.lock()) conversation->nextTurn();
    });
  }
  void spread(ClientId from, std::string_view text) override {
    for (const auto& conversation : conversations)
      if (conversation->id() != from) conversation->hear(text);
  }
  void listen(Conversation&) override {}
  std::size_t listeners(ClientId) const override { return conversations.size() - 1; }
  void forget(ClientId) override {}
  void countSubscribers(int change) override { subscribers += change; }
  void settle() {
    for (int round = 0; round < 3; ++round) {
      keeper.runOnce();
      while (!tasks_.empty()) {
        const auto task = std::move(tasks_.front());
        tasks_.pop_front();
        task();
      }
    }
  }
  std::vector<std::shared_ptr<Conversation>> conversations;
  int subscribers = 0;

 private:
  std::deque<std::function<void()>> tasks_;
};

/// A client that reads nothing of a long time, then everything.
class SlowOutlet final : public Outlet {
 public:
  ~SlowOutlet() override = default;
  void send(std::string_view text) override {
    if (isFinished || text.empty()) std::abort();
    outstanding_ += text.size();
    if (text.back() != '\n' && text.find("bytes=") == text.npos) std::abort();
  }
  void append(std::string_view text) override { send(text); }
  void flush() override {}
  std::size_t outstanding() const override { return outstanding_; }
  void finish() override { isFinished = true; }
  void resume() override {}
  const std::string& peer() const override { return peer_; }

 private:
  std::string peer_ = "127.0.0.1";
  bool isFinished = false;
  std::size_t outstanding_ = 0;
};

void require(bool holds) {
  if (!holds) std::abort();
}

/// Says the same again, and whatever the words are, as they are.
BoardCommand echo() {
  return {"ECHO", "", BoardCommand::Role::kViewer, [](const BoardCommand::Call& call) {
            BoardCommand::Reply reply{"", call.words};
            for (const auto& [key, value] : call.keys) reply.lines.push_back(key + "=" + value);
            return reply;
          }};
}

/// The same as bytes, beside the world.
BoardCommand slowEcho() {
  return {.name = "MULL",
          .help = "",
          .handle =
              [](const BoardCommand::Call& call) {
                BoardCommand::Reply reply;
                if (!call.isAwaited()) std::abort();
                for (const std::string& word : call.words) reply.bytes += word;
                return reply;
              },
          .isSlow = true};
}

void judge(std::string_view bytes) {
  const std::size_t head = httpHeadLength(bytes);
  require(head == bytes.npos || head <= bytes.size());
  if (speechOf(bytes) == Speech::kHttp) require(!httpAnswer(bytes, "400", "no").empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  judge(rest);
  test::CountingWorld world(3);
  BoardConfig config;
  config.commands = {echo(), slowEcho()};
  config.pace = Pace::kLockstep;
  config.control = {"*"};
  config.limits.output = 20'000;
  config.limits.line = 4096;
  config.limits.configuration = 2048;
  config.limits.orders = 8;
  config.limits.errors = 10;  // exceptions are slow here
  InlineHost* host = nullptr;
  WorldKeeper keeper(world, config, [&host] {
    for (const auto& conversation : host->conversations)
      host->post([conversation] { conversation->onCycle(); });
  });
  InlineHost inlineHost(world, config, keeper);
  host = &inlineHost;
  for (ClientId id = 1; id <= 2; ++id)
    inlineHost.conversations.push_back(
        std::make_shared<Conversation>(inlineHost, id, std::make_unique<SlowOutlet>()));

  std::size_t speaker = 0;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of("\xFE\xFF"), rest.size());
    inlineHost.conversations[speaker]->receive(rest.substr(0, end));
    if (end < rest.size() && rest[end] == '\xFE') speaker = 1 - speaker;
    inlineHost.settle();
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  // Whatever was said, nothing of a client outlives it.
  for (const auto& conversation : inlineHost.conversations) conversation->hangUp();
  inlineHost.settle();
  require(keeper.clients().empty());
  require(keeper.robots().empty());
  require(inlineHost.subscribers == 0);
  return 0;
}
