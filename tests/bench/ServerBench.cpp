// What an update costs over the network (paper, section 2.2), on loopback, server and clients in
// one process: latency with 3 clients and with 200, and the server's CPU time against a bare echo.
//
//   server_bench WORLD ROBOT [SECONDS]
#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/MessageBoard.hpp"

namespace {

using namespace ortung;
using Clock = std::chrono::steady_clock;

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// A client that sends a request and waits for a reply of a known number of lines.
class Client {
 public:
  explicit Client(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address = loopback(port);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("can't connect");
    const int on = 1;
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(const std::string& text) {
    if (::send(socket_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
      throw std::runtime_error("can't send");
  }
  std::string lines(std::ptrdiff_t count) {
    std::string text;
    char piece[65536];
    while (std::count(text.begin(), text.end(), '\n') < count) {
      const ssize_t got = ::recv(socket_, piece, sizeof piece, 0);
      if (got <= 0) throw std::runtime_error("the server closed the connection");
      text.append(piece, static_cast<std::size_t>(got));
    }
    return text;
  }
  /// HELLO, CREATE, and waits until all features have a reading; returns their number.
  std::ptrdiff_t join(const std::string& robot) {
    send("HELLO ortung/1\n");
    lines(1);
    send("CREATE r drive=wander\n" + robot + ".\n");
    const std::string reply = lines(1);
    if (!reply.starts_with("OK CREATE")) throw std::runtime_error(reply);
    const std::string features = reply.substr(reply.find("features=") + 9);
    const std::ptrdiff_t wanted = std::atol(features.c_str());
    while (true) {
      send("READ\n");
      const std::string head = lines(1);
      const std::ptrdiff_t count = std::atol(head.c_str() + head.find("lines=") + 6);
      const std::ptrdiff_t here = std::count(head.begin(), head.end(), '\n') - 1;
      if (here < count) lines(count - here);
      if (count == wanted) return count + 1;
    }
  }

 private:
  int socket_;
};

double microseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::micro>(duration).count();
}

double quantile(std::vector<double>& values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

/// Clients, spread over some threads, each asking at a rate; how long each answer took [us].
/// @param connect called for each client on its thread; returns the lines of its answers
template <class Connect>
std::vector<double> ask(std::uint16_t port, Connect connect, int clients, double hertz,
                        double seconds) {
  constexpr int kThreads = 4;
  std::vector<std::vector<double>> taken(kThreads);
  std::vector<std::thread> threads;
  for (int t = 0; t < std::min(kThreads, clients); ++t) {
    threads.emplace_back([&, t] {
      std::vector<std::unique_ptr<Client>> own;
      std::ptrdiff_t lines = 0;
      for (int i = t; i < clients; i += kThreads) {
        own.push_back(std::make_unique<Client>(port));
        lines = connect(*own.back());
      }
      const auto gap = std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(1.0 / hertz / static_cast<double>(own.size())));
      const auto begin = Clock::now();
      auto due = begin;
      for (std::size_t i = 0; Clock::now() - begin < std::chrono::duration<double>(seconds); ++i) {
        std::this_thread::sleep_until(due += gap);
        const auto start = Clock::now();
        own[i % own.size()]->send("READ\n");
        own[i % own.size()]->lines(lines);
        taken[static_cast<std::size_t>(t)].push_back(microseconds(Clock::now() - start));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::vector<double> all;
  for (const auto& some : taken) all.insert(all.end(), some.begin(), some.end());
  return all;
}

struct Served {
  Served(const char* file, Pace pace) : world(file, {}), board(world, configFor(pace)) {
    thread = std::thread([this] { board.run(); });
  }
  ~Served() {
    board.stop();
    thread.join();
  }
  static BoardConfig configFor(Pace pace) {
    BoardConfig config;
    config.pace = pace;
    config.control = {"*"};
    config.limits.sessionsOfAddress = config.limits.sessions;
    return config;
  }
  ServedSimulation world;
  MessageBoard board;
  std::thread thread;
};

/// Answers every line with the same bytes, as simply as the kernel permits.
class Echo {
 public:
  explicit Echo(std::string reply, int clients = 1)
      : reply_(std::move(reply)), socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address = loopback(0);
    if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(socket_, clients) != 0)
      throw std::runtime_error("no socket to listen at");
    thread_ = std::thread([this, clients] { serve(clients); });
  }
  ~Echo() {
    thread_.join();
    ::close(socket_);
  }
  std::uint16_t port() const {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }

 private:
  /// Until all clients have gone. Waits in poll() as every server with more than one client must.
  void serve(int clients) {
    std::vector<pollfd> waits;
    for (int i = 0; i < clients; ++i) {
      waits.push_back({::accept(socket_, nullptr, nullptr), POLLIN, 0});
      const int on = 1;
      ::setsockopt(waits.back().fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    }
    char piece[4096];
    for (int left = clients; left > 0;) {
      ::poll(waits.data(), waits.size(), -1);
      for (pollfd& wait : waits) {
        if (wait.revents == 0) continue;
        if (::recv(wait.fd, piece, sizeof piece, 0) > 0) {
          ::send(wait.fd, reply_.data(), reply_.size(), MSG_NOSIGNAL);
          continue;
        }
        ::close(wait.fd);
        wait.fd = -1;
        --left;
      }
    }
  }

  std::string reply_;
  int socket_;
  std::thread thread_;
};

void print(const char* what, int clients, double hertz, std::vector<double>& taken) {
  std::printf(
      "%3d clients at %5.1f Hz, %s: %7zu updates, p50 %.3f ms, p99 %.3f ms, greatest %.3f ms",
      clients, hertz, what, taken.size(), quantile(taken, 0.5) / 1e3, quantile(taken, 0.99) / 1e3,
      quantile(taken, 1.0) / 1e3);
}

/// The server, and a bare echo of the same bytes: what of the time is the machine's.
void latency(const char* file, const std::string& robot, int clients, double hertz,
             double seconds) {
  std::string reply;
  std::ptrdiff_t lines = 0;
  {
    Served served(file, Pace::kRealTime);
    std::vector<double> taken = ask(
        served.board.port(), [&](Client& client) { return client.join(robot); }, clients, hertz,
        seconds);
    const BoardStatistics statistics = served.board.statistics();
    print("server", clients, hertz, taken);
    std::printf("; %llu cycles, %llu missed\n", static_cast<unsigned long long>(statistics.cycles),
                static_cast<unsigned long long>(statistics.missedCycles));
    Client one(served.board.port());
    lines = one.join(robot);
    one.send("READ\n");
    reply = one.lines(lines);
  }
  Echo echo(reply, clients);
  std::vector<double> taken =
      ask(echo.port(), [&](Client&) { return lines; }, clients, hertz, seconds);
  print("echo  ", clients, hertz, taken);
  std::printf("\n");
}

double cpuTime(int who) {
  rusage usage{};
  ::getrusage(who, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// CPU time of all other threads [us] for each of @p count questions of this one.
double serverTime(Client& client, std::ptrdiff_t lines, int count) {
  const double before = cpuTime(RUSAGE_SELF) - cpuTime(RUSAGE_THREAD);
  for (int i = 0; i < count; ++i) {
    client.send("READ\n");
    client.lines(lines);
  }
  return (cpuTime(RUSAGE_SELF) - cpuTime(RUSAGE_THREAD) - before) / count * 1e6;
}

void cpu(const char* file, const std::string& robot) {
  constexpr int kCount = 20'000;
  Served served(file, Pace::kRealTime);
  Client client(served.board.port());
  const std::ptrdiff_t lines = client.join(robot);
  client.send("PAUSE\n");  // so that no CPU time is the simulation's
  client.lines(1);
  client.send("READ\n");
  const std::string reply = client.lines(lines);
  std::vector<double> ours;
  std::vector<double> bare;
  for (int round = 0; round < 5; ++round) {
    ours.push_back(serverTime(client, lines, kCount));
    Echo echo(reply);
    Client other(echo.port());
    bare.push_back(serverTime(other, lines, kCount));
  }
  std::printf(
      "CPU of the server for an update of %zu bytes: %.2f us, bare echo %.2f us, ratio %.2f\n",
      reply.size(), quantile(ours, 0.5), quantile(bare, 0.5),
      quantile(ours, 0.5) / quantile(bare, 0.5));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "server_bench WORLD ROBOT [SECONDS]\n");
    return 2;
  }
  const double seconds = argc > 3 ? std::atof(argv[3]) : 5.0;
  std::ifstream in(argv[2], std::ios::binary);
  const std::string robot{std::istreambuf_iterator<char>(in), {}};
  try {
    latency(argv[1], robot, 3, 100.0, seconds);
    latency(argv[1], robot, 200, 10.0, seconds);
    cpu(argv[1], robot);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "server_bench: %s\n", error.what());
    return 1;
  }
}
