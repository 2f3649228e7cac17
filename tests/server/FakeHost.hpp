#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "Await.hpp"
#include "Conversation.hpp"
#include "CountingWorld.hpp"

namespace ortung::test {

/// What the server has said to whom, in its order.
using Told = std::vector<std::pair<server::ClientId, std::string>>;

/// Notes what is sent, line by line; how much of it the client has not read is what the test says.
class FakeOutlet : public server::Outlet {
 public:
  FakeOutlet(Told& told, server::ClientId client) : told_(told), client_(client) {}
  ~FakeOutlet() override = default;
  void send(std::string_view text) override {
    append(text);
    flush();
  }
  void append(std::string_view text) override {
    hasMore = true;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size() - 1);
      told_.emplace_back(client_, text.substr(0, end));
      text.remove_prefix(end + 1);
    }
  }
  void flush() override { pieces += std::exchange(hasMore, false) ? 1 : 0; }
  std::size_t outstanding() const override { return unread; }
  void finish() override { hasFinished = true; }
  void resume() override { ++resumed; }
  const std::string& peer() const override { return peer_; }

  std::size_t unread = 0;
  int pieces = 0;        ///< in which it was sent
  bool hasMore = false;  ///< that waits to be sent
  int resumed = 0;
  bool hasFinished = false;

 private:
  Told& told_;
  server::ClientId client_;
  std::string peer_ = "10.0.0.1";
};

/// A board without sockets and threads: nothing happens before the test says so.
class FakeHost : public server::Host {
 public:
  FakeHost(ServedWorld& world, const BoardConfig& boardConfig)
      : Host(world, boardConfig, keeper_), keeper_(world, boardConfig, {}) {}
  ~FakeHost() override = default;

  void post(std::function<void()> task) override { tasks.push_back(std::move(task)); }
  void work(std::function<void()> task) override { tasks.push_back(std::move(task)); }
  void queue(std::weak_ptr<server::Conversation> client) override { backlog.push_back(client); }
  void broadcast(server::ClientId, std::string_view) override {}
  void spread(server::ClientId from, std::string_view text) override {
    for (const auto& client : clients)
      if (client->id() != from) client->hear(text);
  }
  void listen(server::Conversation&) override {}
  std::size_t listeners(server::ClientId) const override { return clients.size() - 1; }
  void forget(server::ClientId) override {}
  void countSubscribers(int) override {}

  /// A client that has joined. @returns the client and its outlet, owned by it
  std::pair<server::Conversation&, FakeOutlet&> join(const std::string& role = "player") {
    const auto id = static_cast<server::ClientId>(clients.size() + 1);
    auto outlet = std::make_unique<FakeOutlet>(told, id);
    FakeOutlet& its = *outlet;
    clients.push_back(std::make_shared<server::Conversation>(*this, id, std::move(outlet)));
    clients.back()->receive("HELLO ortung/1 role=" + role + "\n");
    settle();
    return {*clients.back(), its};
  }
  void runTasks() {
    while (!tasks.empty()) {
      const std::function<void()> task = std::move(tasks.front());
      tasks.pop_front();
      task();
    }
  }
  /// Gives everybody in the backlog one turn.
  void giveTurns() {
    for (const auto& weak : std::exchange(backlog, {}))
      if (const auto client = weak.lock()) client->nextTurn();
  }
  /// Until the backlog is empty.
  void giveAllTurns() {
    EXPECT_TRUE(comesTrue("the backlog is empty", [this] {
      giveTurns();
      return backlog.empty();
    }));
  }
  /// Until nobody waits for anything.
  void settle() {
    constexpr int kStages = 4;  // a robot file is read, then ordered, then answered
    int quiet = 0;
    EXPECT_TRUE(comesTrue("nobody waits for anything", [&] {
      quiet = tasks.empty() && backlog.empty() ? quiet + 1 : 1;
      giveTurns();
      keeper.runOnce();
      runTasks();
      return quiet >= kStages;
    }));
  }
  /// How many lines a client was told that begin with @p text.
  std::size_t count(server::ClientId client, const std::string& text = "") const {
    return static_cast<std::size_t>(std::count_if(told.begin(), told.end(), [&](const auto& line) {
      return line.first == client && line.second.starts_with(text);
    }));
  }

  Told told;
  std::deque<std::function<void()>> tasks;
  std::vector<std::weak_ptr<server::Conversation>> backlog;
  std::vector<std::shared_ptr<server::Conversation>> clients;

 private:
  server::WorldKeeper keeper_;
};

}  // namespace ortung::test
