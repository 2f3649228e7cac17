// Pictures of 640 x 480 in colour: over the message board, and in records.
#include <benchmark/benchmark.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "CountingWorld.hpp"
#include "Files.hpp"
#include "RunningBoard.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/client/RobotSession.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace {

using namespace ortung;

constexpr std::size_t kWords = 3 + 640 * 480 * 3 / 4;
constexpr std::size_t kBytes = 4 * kWords;

/// A client in lockstep asks for a cycle and takes its picture; the world makes it in between.
void overTheBoard(benchmark::State& state) {
  test::CountingWorld world(kWords);
  const test::RunningBoard board(world, test::lockstepConfig());
  SessionOptions options;
  options.port = board.port();
  options.isBinary = true;
  RobotSession session(options, test::kAnyRobot);
  session.setLockstep(true);
  for (auto _ : state) {
    const auto readings = session.next(1);
    if (!readings || readings->size() != 2 || readings->back().words.size() != kWords)
      throw std::runtime_error("no picture came");
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(kBytes) * state.iterations());
}

/// As little as there can be: the same bytes through a pair of sockets, and the world's own work.
void bareSockets(benchmark::State& state) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) throw std::runtime_error("no sockets");
  std::thread server([&] {
    for (char ask = 0; ::read(ends[1], &ask, 1) == 1;) {
      const std::vector<std::uint32_t> picture(kWords, 4'000'000'000U);
      const char* bytes = reinterpret_cast<const char*>(picture.data());
      for (std::size_t done = 0; done < kBytes;) {
        const ssize_t count = ::write(ends[1], bytes + done, kBytes - done);
        if (count <= 0) return;
        done += static_cast<std::size_t>(count);
      }
    }
  });
  for (auto _ : state) {
    std::vector<std::uint32_t> picture(kWords);
    if (::write(ends[0], "", 1) != 1) throw std::runtime_error("the socket broke");
    for (std::size_t done = 0; done < kBytes;) {
      const ssize_t count =
          ::read(ends[0], reinterpret_cast<char*>(picture.data()) + done, kBytes - done);
      if (count <= 0) throw std::runtime_error("the socket broke");
      done += static_cast<std::size_t>(count);
    }
    benchmark::DoNotOptimize(picture.data());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(kBytes) * state.iterations());
  ::close(ends[0]);
  server.join();
  ::close(ends[1]);
}

/// A floor with lines and noise of a camera.
Message picture(Random& random, Timestamp stamp) {
  Message message{stamp, {"camera", "image", "front"}, std::vector<std::uint32_t>(kWords)};
  auto* bytes = reinterpret_cast<std::uint8_t*>(message.words.data() + 3);
  for (std::size_t i = 0; i < 640 * 480; ++i) {
    const bool isLine = i % 640 % 97 < 6;
    for (std::size_t c = 0; c < 3; ++c)
      bytes[3 * i + c] =
          static_cast<std::uint8_t>((isLine ? 220 : 60 + 40 * (c == 1)) + random.below(8));
  }
  return message;
}

/// 181 ranges of a robot that drives, every 0.1 s.
Message scan(Random& random, int i) {
  Message message{100'000 * i, {"LMS200", "LRF", "180DegreeScan"}, std::vector<std::uint32_t>(181)};
  for (std::size_t k = 0; k < 181; ++k)
    message.words[k] = static_cast<std::uint32_t>(
        3000 + 10 * (k % 60) + static_cast<std::size_t>(i) % 500 + random.below(20));
  return message;
}

std::vector<Message> content(bool isPictures) {
  Random random(7);
  std::vector<Message> messages;
  for (int i = 0; i < (isPictures ? 20 : 5000); ++i)
    messages.push_back(isPictures ? picture(random, 33'333 * i) : scan(random, i));
  return messages;
}

/// args: whether pictures, whether lines of text
void writeRecord(benchmark::State& state) {
  const test::TemporaryFolder folder;
  const std::vector<Message> messages = content(state.range(0) != 0);
  const auto form =
      state.range(1) != 0 ? RecordWriter::Form::kText : RecordWriter::Form::kCompressed;
  for (auto _ : state) {
    RecordWriter writer(folder / "x.rec", "", RecordWriter::Pace::kWhole, form);
    for (const Message& message : messages) writer.write(message);
    writer.commit();
  }
  state.counters["bytes"] = static_cast<double>(std::filesystem::file_size(folder / "x.rec"));
  state.SetItemsProcessed(static_cast<std::int64_t>(messages.size()) * state.iterations());
}

void readRecord(benchmark::State& state) {
  const test::TemporaryFolder folder;
  const std::vector<Message> messages = content(state.range(0) != 0);
  {
    RecordWriter writer(
        folder / "x.rec", "", RecordWriter::Pace::kWhole,
        state.range(1) != 0 ? RecordWriter::Form::kText : RecordWriter::Form::kCompressed);
    for (const Message& message : messages) writer.write(message);
    writer.commit();
  }
  for (auto _ : state) {
    RecordSource source(folder / "x.rec");
    std::size_t count = 0;
    for (Message message; source.next(message);) ++count;
    if (count != messages.size()) throw std::runtime_error("readings are missing");
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(messages.size()) * state.iterations());
}

BENCHMARK(overTheBoard)->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK(bareSockets)->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK(writeRecord)
    ->ArgsProduct({{0, 1}, {0, 1}})
    ->ArgNames({"pictures", "lines"})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(readRecord)
    ->ArgsProduct({{0, 1}, {0, 1}})
    ->ArgNames({"pictures", "lines"})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
