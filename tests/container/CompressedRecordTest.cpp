#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <functional>
#include <limits>
#include <thread>

#include "Files.hpp"
#include "Seeded.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/records/RecordEnd.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung {
namespace {

using test::messageOf;
using test::readBytes;
using test::TemporaryFolder;
using test::writeBytes;
using Pace = RecordWriter::Pace;
using Form = RecordWriter::Form;

const SensorId kScan{"laser", "LRF", "scan"};
const SensorId kImage{"camera", "image", "front"};

std::vector<Message> readAll(Source& source) {
  std::vector<Message> messages;
  for (Message message; source.next(message);) messages.push_back(message);
  return messages;
}

std::vector<Message> readAll(const std::filesystem::path& file, const RecordPart& part = {}) {
  RecordSource source(file, part);
  return readAll(source);
}

void write(const std::filesystem::path& file, const std::vector<Message>& messages,
           Pace pace = Pace::kWhole, Form form = Form::kByName) {
  RecordWriter writer(file, "0123456789abcdef", pace, form);
  for (const Message& message : messages) writer.write(message);
  writer.commit();
}

/// A scan each 0.1 s and a picture each second.
std::vector<Message> drive(int scans) {
  Random random(5);
  std::vector<Message> messages;
  for (int i = 0; i < scans; ++i) {
    const Timestamp stamp = 1'700'000'000'000'000 + 100'000 * i;
    std::vector<std::uint32_t> words(181);
    for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random.below(8000));
    messages.push_back({stamp, kScan, words});
    if (i % 10 != 0) continue;
    std::vector<std::uint32_t> pixels(6000);
    for (std::uint32_t& word : pixels)
      word = 0x20304050U + static_cast<std::uint32_t>(random.below(4));
    messages.push_back({stamp, kImage, pixels});
  }
  return messages;
}

std::string outputOf(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  EXPECT_EQ(::pclose(pipe), 0) << command;
  return text;
}

TEST(CompressedRecord, IsPrintedAsLinesByZstdcatWithoutWhatIsTooLargeForALine) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = drive(40);
  write(folder / "x.rec", messages);
  std::vector<Message> scans;
  std::ranges::copy_if(messages, std::back_inserter(scans),
                       [](const Message& message) { return message.id == kScan; });
  write(folder / "x.txt", scans);
  const std::string printed = outputOf("zstdcat " + (folder / "x.rec").string());
  writeBytes(folder / "printed", printed);
  EXPECT_EQ(readAll(folder / "printed"), scans);
  EXPECT_NE(printed.find("\n# binary 1700000001000000 camera/image/front 6000 "), printed.npos);
  std::string lines;
  for (std::size_t at = 0, end = 0; at < printed.size(); at = end + 1) {
    end = printed.find('\n', at);
    if (printed.compare(at, 9, "# binary ") != 0) lines += printed.substr(at, end + 1 - at);
  }
  EXPECT_TRUE(lines == readBytes(folder / "x.txt"));
}

TEST(CompressedRecord, IsALessThanAThirdOfItsLines) {
  const TemporaryFolder folder;
  std::vector<Message> messages;
  for (int i = 0; i < 1000; ++i) {  // a wall that comes nearer
    std::vector<std::uint32_t> words;
    for (int k = 0; k < 181; ++k)
      words.push_back(static_cast<std::uint32_t>(5000 - 3 * i + (k * 7919 + i * 104729) % 20));
    messages.push_back({100'000 * i, kScan, words});
  }
  write(folder / "x.txt", messages);
  for (const Pace pace : {Pace::kWhole, Pace::kLive}) {
    write(folder / "x.rec", messages, pace);
    EXPECT_LT(3 * std::filesystem::file_size(folder / "x.rec"),
              std::filesystem::file_size(folder / "x.txt"));
  }
}

/// Readings of any size, some too large for a line, whose stamps stand still, step and leap.
rc::Gen<std::vector<Message>> anyMessages() {
  const auto sizes = rc::gen::weightedOneOf<std::size_t>(
      {{8, rc::gen::inRange<std::size_t>(0, 40)},
       {1, rc::gen::element<std::size_t>(4095, 4096, 4097, 5000, 70000)}});
  const auto one = rc::gen::mapcat(sizes, [](std::size_t size) {
    return rc::gen::map(
        rc::gen::tuple(rc::gen::element<Timestamp>(0, 0, 1, 300'000, 2'000'000, 1LL << 45),
                       rc::gen::arbitrary<std::uint32_t>(),
                       rc::gen::element<std::uint32_t>(0, 1, 257, 77)),
        [size](const std::tuple<Timestamp, std::uint32_t, std::uint32_t>& seed) {
          Message message{std::get<0>(seed), size % 2 == 0 ? kScan : kImage, {}};
          std::uint32_t word = std::get<1>(seed);
          for (std::size_t i = 0; i < size; ++i)
            message.words.push_back(word = word * 1664525U * std::get<2>(seed) + 7U);
          return message;
        });
  });
  return rc::gen::map(rc::gen::container<std::vector<Message>>(one), [](std::vector<Message> all) {
    Timestamp stamp = -5'000'000;
    for (Message& message : all) message.stamp = stamp += message.stamp;
    return all;
  });
}

RC_GTEST_PROP(CompressedRecordProperty, AnyMessagesComeBackAndSoDoesEachPartOfThem, ()) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = *anyMessages();
  const Pace pace = *rc::gen::element(Pace::kWhole, Pace::kLive);
  const double from = *rc::gen::element(0.0, 0.1, 0.3, 2.0, 5.0, 1e9);
  const double to = from + *rc::gen::element(0.0, 0.4, 3.0, 1e8);
  write(folder / "x.rec", messages, pace, Form::kCompressed);
  RC_ASSERT(readAll(folder / "x.rec") == messages);
  RC_ASSERT(!tornEnd(folder / "x.rec").has_value());
  std::vector<Message> part;
  for (const Message& message : messages) {
    const double seconds = static_cast<double>(message.stamp - messages.front().stamp) / 1e6;
    if (seconds >= from && seconds < to) part.push_back(message);
  }
  RC_ASSERT(readAll(folder / "x.rec", {from, to}) == part);
  write(folder / "x.txt", messages);
  RC_ASSERT(readAll(folder / "x.txt", {from, to}) == part);
}

TEST(CompressedRecord, ExtremesOfTimeComeBack) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = {{std::numeric_limits<Timestamp>::min(), kScan, {1}},
                                         {0, kScan, {}},
                                         {std::numeric_limits<Timestamp>::max(), kScan, {2}}};
  for (const Pace pace : {Pace::kWhole, Pace::kLive}) {
    write(folder / "x.rec", messages, pace);
    EXPECT_EQ(readAll(folder / "x.rec"), messages);
    EXPECT_EQ(readAll(folder / "x.rec", {1e9, 2e9}).size(), 0u);
  }
}

TEST(CompressedRecord, OfAMomentThatIsLargeComesBack) {
  const TemporaryFolder folder;
  std::vector<Message> messages;
  const std::vector<std::uint32_t> words(4096, 4294967295U);
  for (int i = 0; i < 1700; ++i) messages.push_back({7, kScan, words});  // 76 MB as lines
  write(folder / "x.rec", messages);
  EXPECT_TRUE(readAll(folder / "x.rec") == messages);
  EXPECT_TRUE(readAll(folder / "x.rec", {0.0, 1.0}) == messages);
}

TEST(CompressedRecord, ThatIsLiveIsThereFromItsFirstMomentOnAndLacksASecondAtMost) {
  const TemporaryFolder folder;
  const auto file = folder / "run.rec";
  writeBytes(file, "old");
  const std::vector<Message> messages = drive(100);
  {
    RecordWriter writer(file, "abc", Pace::kLive);
    writer.write(messages[0]);
    EXPECT_EQ(readBytes(file), "old") << "the moment may not be whole yet";
    writer.write(messages[1]);
    for (std::size_t i = 2; i < messages.size(); ++i) {
      writer.write(messages[i]);
      const std::vector<Message> found = readAll(file);
      ASSERT_GE(found.size(), 2u);
      ASSERT_TRUE(std::equal(found.begin(), found.end(), messages.begin()));
      EXPECT_LE(messages[i].stamp - found.back().stamp, 1'100'000) << "a second and a moment";
      EXPECT_NE(found.back().stamp, messages[i].stamp);
    }
  }
  const std::vector<Message> found = readAll(file);
  EXPECT_EQ(found.size(), messages.size() - 1) << "nobody said that the last moment is whole";
  EXPECT_EQ(folder.files(), 1u);
}

// A short log is one chunk, of which all is read at once but not yet used.
TEST(CompressedRecord, ProgressIsThatOfReadingsNotOfChunks) {
  const TemporaryFolder folder;
  const auto file = folder / "x.rec";
  const std::vector<Message> messages = drive(40);
  write(file, messages);
  RecordSource source(file);
  EXPECT_LT(source.progress(), 0.05);
  double last = 0.0;
  Message message;
  for (std::size_t i = 1; source.next(message); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(messages.size());
    EXPECT_NEAR(source.progress(), share, 0.2) << i;
    EXPECT_GE(source.progress(), last);
    last = source.progress();
  }
  EXPECT_DOUBLE_EQ(source.progress(), 1.0);
}

TEST(CompressedRecord, CutAnywhereGivesAllWholeChunksAndSaysWhatIsLeftOut) {
  const TemporaryFolder folder;
  const auto file = folder / "x.rec";
  std::vector<Message> messages = drive(24);
  for (Message& message : messages) message.words.resize(message.id == kScan ? 6 : 4100);
  write(file, messages, Pace::kLive);
  const std::string whole = readBytes(file);
  std::vector<std::size_t> counts;
  int unremarked = 0;
  for (std::size_t size = 24; size < whole.size(); ++size) {
    writeBytes(file, whole.substr(0, size));
    RecordSource source(file);
    const std::vector<Message> found = readAll(source);
    ASSERT_TRUE(std::equal(found.begin(), found.end(), messages.begin())) << size;
    EXPECT_DOUBLE_EQ(source.progress(), 1.0);
    const auto torn = tornEnd(file);
    ASSERT_EQ(torn.has_value(), !source.remark().empty()) << size;
    if (!torn) ++unremarked;
    ASSERT_EQ(torn ? torn->begin + torn->bytes : size, size);
    if (counts.empty() || counts.back() != found.size()) counts.push_back(found.size());
    if (!found.empty()) {
      EXPECT_NE(found.back().id == kScan && found.back().stamp % 1'000'000 == 0, true)
          << "moments are whole";
    }
    // Without an index, too, parts are found.
    ASSERT_EQ(readAll(file, {1.0, 1.5}).size(),
              std::min<std::size_t>(6, found.size() - std::min<std::size_t>(11, found.size())));
    if (!torn || size % 50 != 0) continue;
    EXPECT_EQ(mendRecord(file)->bytes, torn->bytes);
    EXPECT_EQ(readBytes(file), whole.substr(0, torn->begin));
  }
  EXPECT_EQ(unremarked, static_cast<int>(counts.size()) + 1) << "at the ends of chunks alone";
  EXPECT_GE(counts.size(), 4u);
  EXPECT_EQ(counts.back(), messages.size());
}

// A file system that was cut off from power may have made the file longer, but not filled it.
TEST(CompressedRecord, ThatEndsInNothingIsTornThere) {
  const TemporaryFolder folder;
  const auto file = folder / "x.rec";
  const std::vector<Message> messages = drive(24);
  {
    RecordWriter writer(file, "abc", Pace::kLive);
    for (const Message& message : messages) writer.write(message);
    writer.endMoment();
  }
  const std::string whole = readBytes(file);
  writeBytes(file, whole + std::string(5000, 0));
  EXPECT_EQ(readAll(file), messages);
  ASSERT_TRUE(tornEnd(file).has_value());
  EXPECT_EQ(tornEnd(file)->bytes, 5000u);
  EXPECT_EQ(mendRecord(file)->bytes, 5000u);
  EXPECT_TRUE(readBytes(file) == whole);
  writeBytes(file, whole + std::string(5000, 0) + "x");
  EXPECT_THROW(readAll(file), std::runtime_error);
}

TEST(CompressedRecord, OfARecorderThatIsKilledIsReadableUnderItsName) {
  const TemporaryFolder folder;
  const auto file = folder / "run.rec";
  Random random(23);
  for (int run = 0; run < 50; ++run) {
    std::filesystem::remove(file);
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      RecordWriter writer(file, "abc", Pace::kLive);
      std::vector<std::uint32_t> words(5000);
      for (Timestamp stamp = 0;; stamp += 250'000) {
        for (const char* feature : {"a", "b", "c"}) {
          words[0] = static_cast<std::uint32_t>(stamp);
          writer.write({stamp, {"m", "t", feature}, words});
        }
        if (stamp == 250'000 && ::write(ready[1], "", 1) != 1) ::_exit(1);
      }
    }
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    for (std::uint64_t i = random.below(200000); i > 0; --i)
      std::atomic_signal_fence(std::memory_order_seq_cst);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(ready[0]);
    ::close(ready[1]);
    const std::vector<Message> found = readAll(file);
    ASSERT_GE(found.size(), 3u);
    EXPECT_EQ(found.size() % 3, 0u) << "moments are whole";
    EXPECT_EQ(folder.files(), 1u);
  }
}

// What lies before a part is not read: here it is no record any more.
TEST(CompressedRecord, PartIsReadWithoutWhatLiesBefore) {
  const TemporaryFolder folder;
  const auto file = folder / "x.rec";
  const std::vector<Message> messages = drive(3000);
  write(file, messages);
  const std::string whole = readBytes(file);
  const std::vector<Message> expected = readAll(file, {250.0, 260.0});
  EXPECT_EQ(expected.size(), 110u);
  std::string damaged = whole;
  for (std::size_t i = whole.size() / 3; i < whole.size() / 2; ++i) damaged[i] = 'x';
  writeBytes(file, damaged);
  EXPECT_EQ(readAll(file, {250.0, 260.0}), expected);
  EXPECT_THROW(readAll(file), std::runtime_error);
  // Without the index heads are read, one after another; a recorder that was killed leaves none.
  writeBytes(file, whole.substr(0, whole.size() - 1));
  EXPECT_EQ(readAll(file, {250.0, 260.0}), expected);
  EXPECT_EQ(outputOf("cat " + file.string() + " | " + "wc -c"),
            std::to_string(whole.size() - 1) + "\n");
}

TEST(CompressedRecord, FromAPipeIsTheSameAndSoAreItsParts) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = drive(300);
  write(folder / "x.rec", messages);
  const std::string bytes = readBytes(folder / "x.rec");
  for (const RecordPart part : {RecordPart{}, RecordPart{10.0, 12.0}}) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    std::thread feeder([&] {
      for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t count = ::write(ends[1], bytes.data() + at, bytes.size() - at);
        if (count <= 0) break;
        at += static_cast<std::size_t>(count);
      }
      ::close(ends[1]);
    });
    RecordSource source("/proc/self/fd/" + std::to_string(ends[0]), part);
    EXPECT_TRUE(source.isLive());
    EXPECT_EQ(source.worldFingerprint(), "0123456789abcdef");
    EXPECT_EQ(source.progress(), -1.0);
    EXPECT_EQ(readAll(source), readAll(folder / "x.rec", part));
    std::string rest(1 << 20, 0);  // so that nobody writes where nobody reads
    while (::read(ends[0], rest.data(), rest.size()) > 0) {
    }
    feeder.join();
    ::close(ends[0]);
  }
}

// Devices and pipes are read by others as it comes; whoever wants lines in a file says so.
TEST(CompressedRecord, IsLinesWhereItIsNoFileAndWhereItsNameEndsInTxt) {
  const TemporaryFolder folder;
  write(folder / "x.txt", drive(2));
  EXPECT_TRUE(
      readBytes(folder / "x.txt").starts_with("# ortung record 1\n# world 0123456789abcdef\n17"));
  EXPECT_FALSE(RecordSource(folder / "x.txt").isCompressed());
  write(folder / "x.txt", drive(2), Pace::kWhole, Form::kCompressed);
  EXPECT_TRUE(RecordSource(folder / "x.txt").isCompressed());
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  write("/proc/self/fd/" + std::to_string(ends[1]), {{1, kScan, {2}}});
  char bytes[100];
  const ssize_t count = ::read(ends[0], bytes, sizeof bytes);
  EXPECT_EQ(std::string(bytes, static_cast<std::size_t>(count)),
            "# ortung record 1\n# world 0123456789abcdef\n1 laser/LRF/scan 1 2\n");
  ::close(ends[0]);
  ::close(ends[1]);
}

// --- bytes of whoever means harm ---

std::string number(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 0xFF);
  return text;
}

/// A line of this many bytes that says nothing.
std::string comment(std::size_t bytes) { return std::string(bytes, '#'); }

std::string frame(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), 0);
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  return out;
}

std::string skippable(int variant, const std::string& bytes) {
  return number(0x184D2A50U + static_cast<unsigned>(variant), 4) + number(bytes.size(), 4) + bytes;
}

const std::string kMagic = skippable(13, "ortung record 2\n");

struct Head {
  std::uint64_t first = 5, last = 5;
  std::uint32_t readings = 1, apart = 0;
  std::uint64_t textBytes = 0, packedBytes = 0, apartBytes = 0;
  std::string bytes() const {
    return skippable(13, "CHNK" + frame(number(first, 8) + number(last, 8) + number(readings, 4) +
                                        number(apart, 4) + number(textBytes, 8) +
                                        number(packedBytes, 8) + number(apartBytes, 8)));
  }
};

/// A chunk with these lines and this behind them, its head changed.
std::string chunk(
    const std::string& lines, const std::string& apart = "",
    const std::function<void(Head&)>& change = [](Head&) {}) {
  const std::string packed = frame(lines);
  Head head;
  head.textBytes = lines.size();
  head.packedBytes = packed.size();
  head.apartBytes = apart.size();
  change(head);
  return head.bytes() + packed + apart;
}

std::string complaint(const std::string& content) {
  const TemporaryFolder folder;
  const auto file = folder / "x.rec";
  writeBytes(file, content);
  const std::string message = messageOf<std::runtime_error>([&] { readAll(file); });
  const std::string name = file.string() + ": ";
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

TEST(HostileRecord, OfOneChunkIsReadIfNothingIsWrongWithIt) {
  EXPECT_EQ(complaint(kMagic + chunk("5 a/b/c 1 7\n")), "(nothing was thrown)");
}

TEST(HostileRecord, ThatSaysMoreThanItHoldsIsRefusedWithoutTheMemory) {
  const std::string at = "the chunk at byte 24 ";
  // 100 GB, out of nothing; as much as is permitted, out of nothing; what is there is more, is
  // less.
  EXPECT_EQ(complaint(kMagic +
                      chunk("5 a/b/c 1 7\n", "", [](Head& h) { h.textBytes = 100'000'000'000; })),
            at + "says that it holds 100000000000 bytes, expected at most 67108864");
  EXPECT_EQ(
      complaint(kMagic + chunk("5 a/b/c 1 7\n", "", [](Head& h) { h.textBytes = 64U << 20; })),
      at + "holds 12 bytes, expected 67108864");
  EXPECT_EQ(complaint(kMagic + chunk(comment(70'000'000), "", [](Head& h) { h.textBytes = 1; })),
            at + "has a head that contradicts itself");
  EXPECT_EQ(complaint(kMagic + chunk(comment(4'000'000), "", [](Head& h) { h.textBytes = 1; })),
            at + "holds 4000000 bytes, expected 1");
  EXPECT_EQ(
      complaint(kMagic + chunk("5 a/b/c 1 7\n", "", [](Head& h) { h.packedBytes = 1ULL << 62; })),
      at + "has a head that contradicts itself");
  EXPECT_EQ(
      complaint(kMagic + chunk("5 a/b/c 1 7\n", "", [](Head& h) { h.apartBytes = 1ULL << 62; })),
      at + "has a head that contradicts itself");
}

// A frame whose own head says 60 MB, and a few bytes.
TEST(HostileRecord, WhoseFrameCanNotHoldWhatItSaysIsRefusedBeforeItIsUnpacked) {
  std::string packed = frame(comment(60'000'000)).substr(0, 1000);
  Head head;
  head.textBytes = 60'000'000;
  head.packedBytes = packed.size();
  EXPECT_EQ(complaint(kMagic + head.bytes() + packed),
            "the chunk at byte 24 can't hold the 60000000 bytes that it announces");
}

// 10 kB that unpack to 300 MB: chunk by chunk, never more than one of them.
TEST(HostileRecord, OfManyLinesOutOfFewBytesIsReadInPieces) {
  std::string lines = "5 a/b/c 1 7\n";
  while (lines.size() < 60'000'000) lines += std::string(1'000'000, '#') + "\n";
  std::string bomb = kMagic;
  for (int i = 0; i < 5; ++i) bomb += chunk(lines);
  EXPECT_LT(bomb.size(), 40'000u);
  EXPECT_EQ(complaint(bomb), "(nothing was thrown)");
}

TEST(HostileRecord, WhoseChunkIsNotWhatItsHeadSaysIsRefused) {
  const auto refused = [](const std::string& lines, const std::function<void(Head&)>& change) {
    return complaint(kMagic + chunk(lines, "", change));
  };
  const std::string count = "the chunk at byte 24 does not hold as much as its head says";
  EXPECT_EQ(refused("5 a/b/c 1 7\n", [](Head& h) { h.readings = 2; }), count);
  EXPECT_EQ(refused("5 a/b/c 1 7\n5 a/b/c 0\n", [](Head&) {}), count);
  EXPECT_EQ(refused("5 a/b/c 1 7\n", [](Head& h) { h.apart = 1; }), count);
  EXPECT_EQ(refused("5 a/b/c 1 7\n", [](Head& h) { h.apart = 2; }),
            "the chunk at byte 24 has a head that contradicts itself");
  const std::string line = "line 1 of the chunk at byte 24: ";
  EXPECT_EQ(refused("6 a/b/c 1 7\n", [](Head&) {}),
            line + "found a time stamp that is not of this chunk");
  EXPECT_EQ(refused("5 a/b/c 1 7", [](Head&) {}), line + "found no end of it");
  EXPECT_EQ(refused("x\n", [](Head&) {}),
            line + "found 'x', expected a time stamp in microseconds");
  EXPECT_EQ(complaint(kMagic + chunk("5 a/b/c 0\n") +
                      chunk("4 a/b/c 0\n", "", [](Head& h) { h.first = h.last = 4; }))
                    .substr(0, 80)
                    .find("time runs backwards") != std::string::npos,
            true);
}

TEST(HostileRecord, OfReadingsBehindTheLinesIsRefusedWithTheReason) {
  const auto refused = [](const std::string& line, const std::string& apart) {
    return complaint(kMagic + chunk(line, apart, [](Head& h) { h.apart = 1; }));
  };
  const std::string words(20000, 'w');
  const std::string good = skippable(14, frame(words));
  EXPECT_EQ(refused("# binary 5 a/b/c 5000 0\n", good), "(nothing was thrown)");
  const std::string line = "line 1 of the chunk at byte 24: announces no reading that can be there";
  EXPECT_EQ(refused("# binary 5 a/b/c 0 0\n", good), line);
  EXPECT_EQ(refused("# binary 5 a/b/c 99999999 0\n", good), line);
  EXPECT_EQ(refused("# binary 5 a/b/c x 0\n", good), line);
  EXPECT_EQ(refused("# binary 5 a/b/c 5000 2\n", good), line);
  EXPECT_EQ(refused("# binary 5 a/b/c 5000\n", good), line);
  EXPECT_EQ(refused("# binary \n", good), line);
  const std::string at = "the chunk at byte 24 ";
  EXPECT_EQ(refused("# binary 5 a/b/c 5001 0\n", good),
            at + "has a reading that holds 20000 bytes, expected 20004");
  EXPECT_EQ(refused("# binary 5 a/b/c 5000 0\n", skippable(13, frame(words))),
            at + "lacks a reading that it announces");
  EXPECT_EQ(refused("# binary 5 a/b/c 5000 0\n", good + good),
            at + "does not hold as much as its head says");
}

// An index that lies must not lead to other readings than those that are there.
TEST(HostileRecord, WhoseIndexIsWrongGivesTheSameOrIsRefused) {
  const TemporaryFolder folder;
  std::string bytes = kMagic;
  std::vector<std::uint64_t> offsets;
  for (std::uint64_t i = 0; i < 10; ++i) {
    offsets.push_back(bytes.size());
    const std::uint64_t stamp = 1'000'000 * i;
    bytes +=
        chunk(std::to_string(stamp) + " a/b/c 0\n", "", [&](Head& h) { h.first = h.last = stamp; });
  }
  const auto played = [&](const std::vector<std::pair<std::uint64_t, std::uint64_t>>& places) {
    std::string entries;
    for (const auto& [offset, first] : places) entries += number(offset, 8) + number(first, 8);
    writeBytes(folder / "x.rec", bytes + skippable(13, "INDX" + frame(entries) +
                                                           number(bytes.size(), 8) + "ORTINDEX"));
    std::vector<Timestamp> stamps;
    for (const Message& message : readAll(folder / "x.rec", {5.0, 7.0}))
      stamps.push_back(message.stamp / 1'000'000);
    return stamps;
  };
  const std::vector<Timestamp> right = {5, 6};
  EXPECT_EQ(played({{offsets[0], 0}, {offsets[4], 4'000'000}, {offsets[6], 6'000'000}}), right);
  EXPECT_EQ(played({}), right);
  EXPECT_EQ(played({{offsets[4], 4'000'000}, {offsets[0], 0}}), right) << "not in order";
  EXPECT_EQ(played({{1ULL << 60, 0}}), right) << "beyond the end";
  EXPECT_EQ(played({{1ULL << 60, 0}}), right) << "beyond the end";
  EXPECT_EQ(played({{bytes.size(), 0}}), right) << "the index itself";
  EXPECT_EQ(played({{0, 0}}), right) << "the beginning of the file, which is no chunk";
  EXPECT_EQ(played({{kMagic.size() - 1, 0}}), right) << "within it";
  EXPECT_EQ(played({{offsets[4], 4'000'000}, {offsets[4], 4'000'000}}), right) << "twice";
  EXPECT_EQ(played({{offsets[4], 4'000'000}, {offsets[5], 3'000'000}}), right) << "back in time";
  EXPECT_THROW(played({{offsets[4] + 1, 4'000'000}}), std::runtime_error);
  EXPECT_THROW(played({{offsets[8], 0}}), std::runtime_error) << "that chunk begins at 8 s";
  EXPECT_EQ(played({{offsets[6], 6'000'000}}), right) << "others lie before";
}

// Checksums cover all that readings are made of.
TEST(HostileRecord, WithAFlippedBitNeverGivesOtherReadings) {
  const TemporaryFolder folder;
  std::vector<Message> messages = drive(12);
  for (Message& message : messages) message.words.resize(message.id == kScan ? 6 : 4100);
  write(folder / "x.rec", messages, Pace::kLive);
  const std::string whole = readBytes(folder / "x.rec");
  int refused = 0;
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string bytes = whole;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
    writeBytes(folder / "y.rec", bytes);
    try {
      RecordSource source(folder / "y.rec");
      const std::vector<Message> found = readAll(source);
      ASSERT_TRUE(std::equal(found.begin(), found.end(), messages.begin())) << bit;
      ASSERT_TRUE(found.size() == messages.size() || !source.remark().empty()) << bit;
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, static_cast<int>(4 * whole.size())) << "of 8 bits a byte";
}

}  // namespace
}  // namespace ortung
