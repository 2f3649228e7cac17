// What honest clients feel of hostile ones: 30 players at 10 Hz beside floods of talk, of valid
// commands, of nonsense, of subscriptions, and of all at once; on loopback, in one process. The
// attackers' threads have the lowest priority.
//
//   hostile_bench WORLD ROBOT [SECONDS [NAME]]
#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/MessageBoard.hpp"

namespace {

using namespace ortung;
using Clock = std::chrono::steady_clock;

constexpr int kPlayers = 30;
constexpr double kHertz = 10.0;

class Connection {
 public:
  explicit Connection(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("can't connect");
    const int on = 1;
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    const timeval soon{0, 100'000};
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &soon, sizeof soon);
  }
  ~Connection() { ::close(socket_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Sends all or as much as goes. @returns whether the connection is still there
  bool send(std::string_view text) {
    const ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
    return sent >= 0 || errno == EAGAIN;
  }
  /// Throws away what has come. @returns whether the connection is still there
  bool drain() {
    char piece[65536];
    ssize_t got = 0;
    while ((got = ::recv(socket_, piece, sizeof piece, MSG_DONTWAIT)) > 0) {
    }
    return got < 0;
  }
  /// Reads on until a line that begins with @p beginning, and what it announces.
  std::string reply(const std::string& beginning) {
    while (true) {
      const std::string head = line();
      const std::size_t lines = head.find(" lines=");
      for (long n = lines == head.npos ? 0 : std::atol(head.c_str() + lines + 7); n > 0; --n)
        line();
      if (head.starts_with(beginning)) return head;
      if (head.starts_with("* ERR") || head.starts_with("* BYE")) throw std::runtime_error(head);
    }
  }

 private:
  std::string line() {
    std::size_t end;
    while ((end = input_.find('\n')) == input_.npos) {
      char piece[65536];
      const ssize_t got = ::recv(socket_, piece, sizeof piece, 0);
      if (got <= 0) throw std::runtime_error("closed");
      input_.append(piece, static_cast<std::size_t>(got));
    }
    std::string text = input_.substr(0, end);
    input_.erase(0, end + 1);
    return text;
  }
  int socket_;
  std::string input_;
};

struct Measured {
  std::vector<double> taken;  // [ms]
  int lost = 0;               ///< players that were dropped
};

void play(Connection& player, int number, const std::atomic<bool>& goesOn, Measured& measured) {
  const auto gap =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / kHertz));
  auto due = Clock::now() + gap * number / kPlayers;
  try {
    for (int i = 0; goesOn; ++i) {
      std::this_thread::sleep_until(due += gap);
      const std::string tag = "#" + std::to_string(i);
      const auto begin = Clock::now();
      player.send(tag + " UPDATE\n");
      player.reply(tag + " OK");
      measured.taken.push_back(
          std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    }
  } catch (const std::exception& error) {
    std::printf("  player %d: %s\n", number, error.what());
    measured.lost = 1;
  }
}

struct Attack {
  const char* name;
  std::string once;   ///< after HELLO
  std::string again;  ///< over and over
};

/// Attacks until told to stop; whoever is thrown out comes back.
void attack(std::uint16_t port, const Attack& how, const std::string& robot,
            const std::atomic<bool>& goesOn) {
  // Elsewhere it would have a processor of its own; here it must not take the server's.
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 19);
  while (goesOn) {
    try {
      Connection connection(port);
      connection.send("HELLO ortung/1 name=attacker\nCREATE a\n" + robot + ".\n" + how.once);
      while (goesOn && how.again.empty())  // it does not read either
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      while (goesOn && connection.send(how.again) && connection.drain()) {
      }
    } catch (const std::exception&) {
    }
  }
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

std::vector<Attack> attacks() {
  std::string absurd = "SUBSCRIBE";
  for (int i = 0; i < 60; ++i) absurd += " a" + std::to_string(i) + "/*/*";
  std::vector<Attack> all = {
      {"SAY", "", repeated("SAY hi\n", 500)},
      {"SAY, 60 kB", "", "SAY " + std::string(60'000, 'x') + "\n"},
      {"VELOCITY", "", repeated("VELOCITY v_m_s=0.1\n", 500)},
      {"TIME", "", repeated("TIME\n", 1000)},
      {"READ", "", repeated("READ\n", 200)},
      {"HELP", "", repeated("HELP\n", 200)},
      {"LIST robots", "", repeated("LIST robots\nDESCRIBE robot\n", 100)},
      {"SUBSCRIBE", absurd + "\n", absurd + " */*/*\n"},
      {"half lines", "", "VELOCITY v_m_"},
      {"long lines", "", std::string(60'000, 'x') + "\n"},
      {"junk", "", repeated(std::string("\x01\xff\0{]\n", 7), 500)},
      {"CREATE", "", "REMOVE\nCREATE a\n[[sensor]]\nplugin = \"odometry\"\n.\n"},
      {"nothing read", "SUBSCRIBE\n", ""}};
  return all;
}

void measure(const char* world, const std::string& robot, const char* name,
             const std::vector<Attack>& hostile, double seconds) {
  ServedSimulation simulation(world, {});
  BoardConfig config;
  config.log = [](const std::string& text) { std::printf("  %s\n", text.c_str()); };
  MessageBoard board(simulation, config);
  std::thread server([&] { board.run(); });
  std::vector<std::unique_ptr<Connection>> players;
  for (int i = 0; i < kPlayers; ++i) {
    players.push_back(std::make_unique<Connection>(board.port()));
    players.back()->send("HELLO ortung/1\nCREATE r drive=wander\n" + robot + ".\n");
    players.back()->reply("OK CREATE");
  }
  std::atomic<bool> goesOn{true};
  std::vector<Measured> measured(kPlayers);
  std::vector<std::thread> threads;
  std::vector<std::thread> attackers;
  for (const Attack& how : hostile)
    attackers.emplace_back([&] { attack(board.port(), how, robot, goesOn); });
  for (int i = 0; i < kPlayers; ++i)
    threads.emplace_back([&, i] {
      const auto place = static_cast<std::size_t>(i);
      play(*players[place], i, goesOn, measured[place]);
    });
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  goesOn = false;
  for (std::thread& thread : threads) thread.join();
  const BoardStatistics statistics = board.statistics();
  for (std::thread& thread : attackers) thread.join();
  board.stop();
  server.join();
  std::vector<double> all;
  int lost = 0;
  for (Measured& one : measured) {
    all.insert(all.end(), one.taken.begin(), one.taken.end());
    lost += one.lost;
  }
  std::sort(all.begin(), all.end());
  const auto quantile = [&](double share) {
    return all.empty() ? 0.0 : all[static_cast<std::size_t>(share * double(all.size() - 1))];
  };
  std::printf(
      "%-14s %5zu replies, p50 %6.2f ms, p99 %7.2f ms, greatest %7.2f ms; %d of %d dropped; "
      "%llu of %llu cycles missed\n",
      name, all.size(), quantile(0.5), quantile(0.99), quantile(1.0), lost, kPlayers,
      static_cast<unsigned long long>(statistics.missedCycles),
      static_cast<unsigned long long>(statistics.cycles));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "hostile_bench WORLD ROBOT [SECONDS [NAME]]\n");
    return 2;
  }
  const double seconds = argc > 3 ? std::atof(argv[3]) : 5.0;
  std::ifstream in(argv[2], std::ios::binary);
  const std::string robot{std::istreambuf_iterator<char>(in), {}};
  try {
    const auto run = [&](const std::string& name, const std::vector<Attack>& hostile) {
      if (argc < 5 || name == argv[4]) measure(argv[1], robot, name.c_str(), hostile, seconds);
    };
    const std::vector<Attack> all = attacks();
    run("nobody", {});
    for (const Attack& one : all) run(one.name, {one});
    run("all but SAY", {all.begin() + 2, all.end()});
    run("all", all);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hostile_bench: %s\n", error.what());
    return 1;
  }
}
