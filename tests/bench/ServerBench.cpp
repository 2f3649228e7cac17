// What an update costs over the network (paper, section 2.2), on loopback, server and clients in
// one process: latency with 3 clients and with 200, also while a viewer asks for maps of a robot
// that is localized here, and the server's CPU time against a bare echo.
//
//   server_bench WORLD ROBOT [SECONDS]
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "BenchClient.hpp"
#include "Figures.hpp"
#include "ortung/mcl_served/LocalizationCommands.hpp"
#include "ortung/mcl_served/LocalizedWorld.hpp"
#include "ortung/mcl_served/WorldTables.hpp"
#include "ortung/served/ServedSimulation.hpp"
#include "ortung/server/MessageBoard.hpp"

namespace {

using namespace ortung;
using bench::Client;
using bench::Figures;
using bench::loopback;
using Clock = std::chrono::steady_clock;

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
/// @param onReady called once, when all are connected
template <class Connect, class Ready>
std::vector<double> ask(std::uint16_t port, Connect connect, int clients, double hertz,
                        double seconds, Ready onReady) {
  constexpr int kThreads = 4;
  const int used = std::min(kThreads, clients);
  std::vector<std::vector<double>> taken(kThreads);
  std::vector<std::thread> threads;
  std::barrier all(used, [&]() noexcept { onReady(); });
  for (int t = 0; t < used; ++t) {
    threads.emplace_back([&, t] {
      std::vector<std::unique_ptr<Client>> own;
      std::ptrdiff_t lines = 0;
      for (int i = t; i < clients; i += kThreads) {
        own.push_back(std::make_unique<Client>(port));
        lines = connect(*own.back());
      }
      all.arrive_and_wait();
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
  std::vector<double> times;
  for (const auto& some : taken) times.insert(times.end(), some.begin(), some.end());
  return times;
}

/// A field that is served, maybe with a robot of its own that wanders about and is localized.
class Served {
 public:
  explicit Served(const char* world, const std::string& resident = "")
      : simulation_(sceneOf(world, resident), {}) {
    BoardConfig config;
    config.control = {"*"};
    config.limits.sessionsOfAddress = config.limits.sessions;
    ServedWorld* served = &simulation_;
    if (!resident.empty()) {
      localized_.emplace(simulation_, LocalizedWorld::Config{[resident](RobotId robot) {
                                                               return robot == 1 ? resident : "";
                                                             },
                                                             learnedTables(world),
                                                             {"all"},
                                                             1});
      config.commands = localizationCommands(*localized_);
      served = &*localized_;
    }
    board_ = std::make_unique<MessageBoard>(*served, config);
    thread_ = std::thread([this] { board_->run(); });
  }
  ~Served() {
    board_->stop();
    thread_.join();
  }
  const MessageBoard& board() const { return *board_; }

 private:
  static Scene sceneOf(const char* world, const std::string& resident) {
    Scene scene = Scene::open(world);
    if (resident.empty()) return scene;
    SceneRobot& robot = scene.robots.emplace_back();
    robot.file = resident;
    robot.name = "resident";
    robot.wanders = true;
    return scene;
  }

  ServedSimulation simulation_;
  std::optional<LocalizedWorld> localized_;
  std::unique_ptr<MessageBoard> board_;
  std::thread thread_;
};

/// Asks for one map of all features after another.
class Viewer {
 public:
  explicit Viewer(std::uint16_t port) : client_(port) {
    client_.send("HELLO ortung/1 role=viewer\n");
    client_.lines(1);
    std::string state;
    do {  // until the tables are learned
      client_.send("LOCALIZE robot=1\n");
      state = client_.lines(1);
    } while (state.find("state=learning") != state.npos);
    thread_ = std::thread([this] {
      while (!isOver_) {
        client_.send("HEATMAP robot=1\n");
        client_.bytes();
        ++maps_;
      }
    });
  }
  ~Viewer() {
    isOver_ = true;
    thread_.join();
  }
  int maps() const { return maps_; }

 private:
  Client client_;
  std::atomic<int> maps_{0};
  std::atomic<bool> isOver_{false};
  std::thread thread_;
};

/// Processor time of the threads of this program that stand back behind others [s].
double timeOfLowPriority() {
  double sum = 0.0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    const std::string number = task.path().filename();
    double nanoseconds = 0.0;
    std::ifstream(task.path() / "schedstat") >> nanoseconds;
    if (::getpriority(PRIO_PROCESS, static_cast<id_t>(std::stoul(number))) > 0)
      sum += nanoseconds * 1e-9;
  }
  return sum;
}

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

/// Prints and keeps how long answers took. @returns the name of its figures
std::string report(Figures& figures, const char* what, int clients, double hertz,
                   std::vector<double>& taken) {
  const std::string name = std::to_string(clients) + " clients/" + what;
  figures.put(name, "p50_ms", quantile(taken, 0.5) / 1e3);
  figures.put(name, "p99_ms", quantile(taken, 0.99) / 1e3);
  std::printf(
      "%3d clients at %5.1f Hz, %-12s: %7zu updates, p50 %.3f ms, p99 %.3f ms, greatest %.3f ms",
      clients, hertz, what, taken.size(), quantile(taken, 0.5) / 1e3, quantile(taken, 0.99) / 1e3,
      quantile(taken, 1.0) / 1e3);
  return name;
}

/// Players of robots on a field that is served; prints how long their answers took, and the cycles
/// of that time.
std::string askServer(Figures& figures, const Served& served, const std::string& robot,
                      const char* what, int clients, double hertz, double seconds) {
  BoardStatistics before;
  std::vector<double> taken = ask(
      served.board().port(), [&](Client& client) { return client.join(robot); }, clients, hertz,
      seconds, [&] { before = served.board().statistics(); });
  const BoardStatistics after = served.board().statistics();
  std::string name = report(figures, what, clients, hertz, taken);
  const auto cycles = after.cycles - before.cycles;
  const auto missed = after.missedCycles - before.missedCycles;
  figures.put(name, "cycles", static_cast<double>(cycles));
  figures.put(name, "missed", static_cast<double>(missed));
  std::printf("; %llu cycles, %llu missed", static_cast<unsigned long long>(cycles),
              static_cast<unsigned long long>(missed));
  return name;
}

/// The server, and a bare echo of the same bytes: what of the time is the machine's.
void latency(Figures& figures, const char* file, const std::string& robot, int clients,
             double hertz, double seconds) {
  std::string reply;
  std::ptrdiff_t lines = 0;
  {
    const Served served(file);
    askServer(figures, served, robot, "server", clients, hertz, seconds);
    std::printf("\n");
    Client one(served.board().port());
    lines = one.join(robot);
    one.send("READ\n");
    reply = one.lines(lines);
  }
  Echo echo(reply, clients);
  std::vector<double> taken =
      ask(echo.port(), [&](Client&) { return lines; }, clients, hertz, seconds, [] {});
  report(figures, "echo", clients, hertz, taken);
  std::printf("\n");
}

/// The same beside a robot that is localized, without a viewer and with one who wants maps of it.
void maps(Figures& figures, const char* file, const char* robotFile, const std::string& robot,
          int clients, double hertz, double seconds) {
  for (const bool isViewed : {false, true}) {
    const Served served(file, robotFile);
    std::optional<Viewer> viewer(served.board().port());
    if (!isViewed) viewer.reset();
    const double before = timeOfLowPriority();
    const int mapsBefore = viewer ? viewer->maps() : 0;
    const auto begin = Clock::now();
    const std::string name =
        askServer(figures, served, robot, isViewed ? "maps" : "no maps", clients, hertz, seconds);
    const double gone = microseconds(Clock::now() - begin) * 1e-6;
    if (viewer) {
      const double rate = (viewer->maps() - mapsBefore) / gone;
      const double share = (timeOfLowPriority() - before) / gone;
      figures.put(name, "maps/s", rate);
      figures.put(name, "cores", share);
      std::printf("; %.1f maps/s, %.2f of a core", rate, share);
    }
    std::printf("\n");
  }
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

void cpu(Figures& figures, const char* file, const std::string& robot) {
  constexpr int kCount = 20'000;
  const Served served(file);
  Client client(served.board().port());
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
  figures.put("update", "cpu_us", quantile(ours, 0.5));
  figures.put("update", "x_echo", quantile(ours, 0.5) / quantile(bare, 0.5));
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
    Figures figures;
    latency(figures, argv[1], robot, 3, 100.0, seconds);
    latency(figures, argv[1], robot, 200, 10.0, seconds);
    maps(figures, argv[1], argv[2], robot, 200, 10.0, seconds);
    cpu(figures, argv[1], robot);
    figures.write();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "server_bench: %s\n", error.what());
    return 1;
  }
}
