#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <limits>

#include "Files.hpp"
#include "Seeded.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/records/RecordEnd.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung {
namespace {

using test::messageOf;
using test::TemporaryFolder;
using test::writeBytes;

const std::string kMagic = std::string(kRecordMagic) + "\n";

std::string lineOf(const Message& message) {
  std::string line;
  writeLine(message, line);
  return line;
}

std::string whyNot(const std::string& line) {
  std::string why;
  EXPECT_FALSE(parseLine(line, &why).has_value()) << line;
  return why;
}

TEST(RecordLine, IsReadableByPeople) {
  EXPECT_EQ(lineOf({1700000000123456, {"LMS200", "LRF", "scan"}, {1, 4294967295, 0}}),
            "1700000000123456 LMS200/LRF/scan 3 1 4294967295 0");
  EXPECT_EQ(lineOf({-5, {"a", "b", "c"}, {}}), "-5 a/b/c 0");
}

rc::Gen<std::string> anyName() {
  static const std::string kLetters = "abzAZ09_.-";
  return rc::gen::suchThat(rc::gen::container<std::string>(rc::gen::elementOf(kLetters)),
                           [](const std::string& s) { return !s.empty() && s.size() <= 64; });
}

RC_GTEST_PROP(RecordLineProperty, AnyMessageComesBack, ()) {
  const Message message{*rc::gen::arbitrary<std::int64_t>(),
                        {*anyName(), *anyName(), *anyName()},
                        *rc::gen::arbitrary<std::vector<std::uint32_t>>()};
  std::string why = "untouched";
  const auto parsed = parseLine(lineOf(message), &why);
  RC_ASSERT(parsed.has_value());
  RC_ASSERT(*parsed == message);
}

TEST(RecordLine, ExtremesOfTimeComeBack) {
  for (const Timestamp t :
       {std::numeric_limits<Timestamp>::min(), std::numeric_limits<Timestamp>::max()}) {
    const Message message{t, {"a", "b", "c"}, {}};
    EXPECT_EQ(parseLine(lineOf(message)), message);
  }
}

TEST(RecordLine, SaysWhatIsWrong) {
  EXPECT_EQ(whyNot(""), "found '', expected a time stamp in microseconds");
  EXPECT_EQ(whyNot("NaN a/b/c 0"), "found 'NaN', expected a time stamp in microseconds");
  EXPECT_EQ(whyNot("1.5 a/b/c 0"), "found '1.5', expected a time stamp in microseconds");
  EXPECT_EQ(whyNot("9223372036854775808 a/b/c 0"),
            "found '9223372036854775808', expected a time stamp in microseconds");
  EXPECT_EQ(whyNot("1"), "found '': a feature's name is model/type/feature, with two '/'");
  EXPECT_EQ(whyNot("1 a/b 0"), "found 'a/b': a feature's name is model/type/feature, with two '/'");
  EXPECT_EQ(whyNot("1 a/b/c"), "found '', expected a number of words");
  EXPECT_EQ(whyNot("1 a/b/c -1"), "found '-1', expected a number of words");
  EXPECT_EQ(whyNot("1 a/b/c 99999999 1"), "found '99999999', expected a number of words");
  EXPECT_EQ(whyNot("1 a/b/c 100 1"), "the line is torn: it announces 100 words");
  EXPECT_EQ(whyNot("1 a/b/c 2 17"), "found 1 words, expected 2 as the line announces");
  EXPECT_EQ(whyNot("1 a/b/c 1 1 1"), "found 2 words, expected 1 as the line announces");
  EXPECT_EQ(whyNot("1 a/b/c 1 nan"), "found 'nan', expected an unsigned 32-bit word");
  EXPECT_EQ(whyNot("1 a/b/c 1 -1"), "found '-1', expected an unsigned 32-bit word");
  EXPECT_EQ(whyNot("1 a/b/c 1 4294967296"), "found '4294967296', expected an unsigned 32-bit word");
  EXPECT_EQ(whyNot("1 a/b/c 1  5"), "found '', expected an unsigned 32-bit word");
  EXPECT_EQ(whyNot("1 a/b/c 1 5 "), "the line ends with a blank");
  EXPECT_EQ(whyNot("1 a/b/c 1 5  "), "the line ends with a blank");
  EXPECT_EQ(whyNot("1 a/b/c 0 "), "the line ends with a blank");
  EXPECT_EQ(whyNot("1 a/b/c 1 5\t"), "found '5?', expected an unsigned 32-bit word");
  EXPECT_EQ(whyNot(" 1 a/b/c 0"), "found '', expected a time stamp in microseconds");
  EXPECT_EQ(whyNot("1  a/b/c 0"), "found '': a feature's name is model/type/feature, with two '/'");
  EXPECT_EQ(whyNot("1 a/b/c 1 5\r"), "found '5?', expected an unsigned 32-bit word");
  EXPECT_EQ(whyNot(std::string("\x1b[2J\x80", 5)),
            "found '?[2J?', expected a time stamp in microseconds");
  for (const std::size_t length : {39u, 40u})
    EXPECT_EQ(whyNot(std::string(length, '9')),
              "found '" + std::string(length, '9') + "', expected a time stamp in microseconds");
  for (const std::size_t length : {41u, 100u})
    EXPECT_EQ(whyNot(std::string(length, '9')),
              "found '" + std::string(40, '9') + "...', expected a time stamp in microseconds");
}

TEST(RecordLine, SurvivesAHundredThousandMutations) {
  const std::string seed =
      lineOf({123456789, {"LMS200", "LRF", "scan"}, {1, 22, 333, 4444, 55555, 4294967295}});
  static const std::string kNasty = " /-+.0123456789eEnaNx\n\t\"#";
  Random random(1);
  int taken = 0;
  for (int i = 0; i < 100000; ++i) {
    std::string line = seed;
    for (std::uint64_t k = 1 + random.below(4); k > 0 && !line.empty(); --k) {
      const std::size_t at = random.below(line.size());
      switch (random.below(5)) {
        case 0:
          line[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          line[at] = kNasty[random.below(kNasty.size())];
          break;
        case 2:
          line.erase(at, 1 + random.below(8));
          break;
        case 3:
          line.insert(at, line.substr(random.below(line.size()), random.below(12)));
          break;
        default:
          line.resize(at);
          break;
      }
    }
    std::string why;
    const auto parsed = parseLine(line, &why);
    ASSERT_EQ(parsed.has_value(), why.empty()) << line;
    if (!parsed) continue;
    ++taken;
    const std::string again = lineOf(*parsed);
    ASSERT_EQ(parseLine(again), parsed) << line;
    // Only zeros before a number can be more than what would be written.
    ASSERT_EQ(std::count(again.begin(), again.end(), ' '),
              std::count(line.begin(), line.end(), ' '))
        << line;
    ASSERT_LE(again.size(), line.size()) << line;
  }
  EXPECT_GT(taken, 1000) << "the mutations should not all be refused";
}

TEST(Record, ComesBackWithItsWorld) {
  const TemporaryFolder folder;
  const std::vector<Message> messages = {
      {-3, {"a", "b", "c"}, {1, 2}}, {5, {"a", "b", "d"}, {}}, {5, {"a", "b", "c"}, {7}}};
  RecordWriter writer(folder / "run.rec", "0123456789abcdef");
  for (const Message& m : messages) writer.write(m);
  EXPECT_EQ(writer.messages(), 3u);
  EXPECT_FALSE(std::filesystem::exists(folder / "run.rec")) << "not before commit()";
  writer.commit();
  RecordSource source(folder / "run.rec");
  EXPECT_EQ(source.worldFingerprint(), "0123456789abcdef");
  for (const Message& expected : messages) {
    Message found;
    ASSERT_TRUE(source.next(found));
    EXPECT_EQ(found, expected);
  }
  Message none;
  EXPECT_FALSE(source.next(none));
  EXPECT_DOUBLE_EQ(source.progress(), 1.0);
  EXPECT_EQ(folder.files(), 1u);
}

// Lines are read in pieces; the pieces' ends must leave no trace, wherever they fall.
TEST(Record, LinesOfAnyLengthComeBack) {
  const TemporaryFolder folder;
  std::vector<Message> written;
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    Message message{i, {"LMS200", "LRF", "scan"}, {}};
    for (int k = 0; k < 36 * i; ++k) {
      message.words.push_back(static_cast<std::uint32_t>(random.uniform(0.0, 4294967295.0)));
    }
    written.push_back(std::move(message));
  }
  RecordWriter writer(folder / "long.rec");
  for (const Message& message : written) writer.write(message);
  writer.commit();
  RecordSource source(folder / "long.rec");
  Message read;
  for (const Message& message : written) {
    ASSERT_TRUE(source.next(read));
    EXPECT_EQ(read.words, message.words) << message.stamp;
  }
  EXPECT_FALSE(source.next(read));
}

/// All stamps of a record, and what its source remarks.
struct Played {
  std::vector<Timestamp> stamps;
  std::string remark;
};
Played play(const std::filesystem::path& file) {
  RecordSource source(file);
  Played played;
  for (Message m; source.next(m);) played.stamps.push_back(m.stamp);
  played.remark = source.remark();
  EXPECT_DOUBLE_EQ(source.progress(), 1.0);
  return played;
}

TEST(Record, OfLinesThatIsLiveIsThereFromItsFirstMomentOnAndGrowsMomentByMoment) {
  const TemporaryFolder folder;
  const auto file = folder / "run.txt";
  writeBytes(file, "old");
  {
    RecordWriter writer(file, "abc", RecordWriter::Pace::kLive);
    writer.write({1, {"a", "b", "c"}, {1}});
    writer.write({1, {"a", "b", "d"}, {2}});
    EXPECT_EQ(test::readBytes(file), "old") << "the moment may not be whole yet";
    writer.write({2, {"a", "b", "c"}, {3}});
    EXPECT_EQ(play(file).stamps, (std::vector<Timestamp>{1, 1}));
    writer.endMoment();
    EXPECT_EQ(play(file).stamps, (std::vector<Timestamp>{1, 1, 2}));
    writer.write({3, {"a", "b", "c"}, {4}});
  }
  const Played played = play(file);
  EXPECT_EQ(played.stamps, (std::vector<Timestamp>{1, 1, 2})) << "nobody said that 3 is whole";
  EXPECT_EQ(played.remark, "");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(Record, WithoutCommitTheOldFileStaysAndNothingElse) {
  const TemporaryFolder folder;
  writeBytes(folder / "run.rec", "old");
  {
    RecordWriter(folder / "run.rec").write({1, {"a", "b", "c"}, {1}});
  }
  EXPECT_EQ(test::readBytes(folder / "run.rec"), "old");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(Record, SkipsCommentsAnywhere) {
  const TemporaryFolder folder;
  writeBytes(folder / "x",
             kMagic + "# robot pioneer\n# world abc\n1 a/b/c 0\n# note lunch\n2 a/b/c 0\n");
  RecordSource source(folder / "x");
  EXPECT_EQ(source.worldFingerprint(), "abc");
  Message m;
  EXPECT_TRUE(source.next(m));
  EXPECT_TRUE(source.next(m));
  EXPECT_EQ(m.stamp, 2);
  EXPECT_FALSE(source.next(m));
}

/// What reading all of a record with this content says.
std::string complaint(const TemporaryFolder& folder, const std::string& content) {
  const auto file = folder / "x.rec";
  writeBytes(file, content);
  const std::string message = messageOf<std::runtime_error>([&] {
    RecordSource source(file);
    Message m;
    while (source.next(m)) {
    }
  });
  const std::string name = file.string();
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

TEST(Record, NamesFileLineAndWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string expected = ", expected '# ortung record 1' or a compressed record";
  EXPECT_EQ(complaint(folder, ""), ":1: found ''" + expected);
  EXPECT_EQ(
      complaint(folder, "PARAM x\n"),
      ":1: found 'PARAM x'" + expected + "; it is a log of CARMEN (as a source: carmen:FILE)");
  EXPECT_EQ(complaint(folder, "# ortung record 2\n"), ":1: found '# ortung record 2'" + expected);
  EXPECT_EQ(complaint(folder, kMagic + "# world x\n1 a/b/c 1 NaN\n"),
            ":3: found 'NaN', expected an unsigned 32-bit word");
  EXPECT_EQ(complaint(folder, kMagic + "1 a/b/c 0\nFLASER 180 1.2\n"),
            ":3: found 'FLASER', expected a time stamp in microseconds");
  EXPECT_EQ(complaint(folder, kMagic + "1 a/b/c 0\n\n"),
            ":3: found '', expected a time stamp in microseconds");
  EXPECT_EQ(complaint(folder, kMagic + "5 a/b/c 0\n# x\n4 a/b/c 0\n"),
            ":4: time runs backwards: found 4 us after 5 us");
}

TEST(Record, ThatIsTornIsPlayedUpToItsLastWholeMomentAndSaysSo) {
  const TemporaryFolder folder;
  const auto file = folder / "x.rec";
  const std::string whole = kMagic + "10 a/b/c 0\n200 a/b/c 0\n";
  const auto played = [&](const std::string& more) {
    writeBytes(file, whole + more);
    return play(file);
  };
  using Stamps = std::vector<Timestamp>;
  EXPECT_EQ(played("").stamps, (Stamps{10, 200}));
  EXPECT_EQ(played("").remark, "");
  EXPECT_EQ(played("300 a/b/c 1 7").stamps, (Stamps{10, 200}));
  EXPECT_EQ(played("300 a/b/c 1 7").remark,
            file.string() +
                " is torn: its last 13 bytes are no whole moment and are left out (was "
                "the recorder killed, or is it still writing?)");
  // Of the moment that was torn nothing is left, whatever lines of it are whole.
  EXPECT_EQ(played("300 a/b/c 0\n# lunch\n300 a/b/d 0\n300 a").stamps, (Stamps{10, 200}));
  EXPECT_EQ(played("200 a/b/d 0\n200 a").stamps, (Stamps{10}));
  // The moment of a stamp that is torn itself may be the one before.
  EXPECT_EQ(played("20").stamps, (Stamps{10}));
  EXPECT_EQ(played("30").stamps, (Stamps{10, 200}));
  EXPECT_EQ(played("200").stamps, (Stamps{10}));
  EXPECT_EQ(played("2000").stamps, (Stamps{10, 200}));
  EXPECT_EQ(played("# note lun").stamps, (Stamps{10, 200}));
  EXPECT_EQ(tornEnd(file)->begin, whole.size());
  EXPECT_EQ(tornEnd(file)->bytes, 10u);
}

TEST(Record, ThatIsTornWithinItsHeadHasNoReadingsAndNoWorld) {
  const TemporaryFolder folder;
  writeBytes(folder / "x.rec", kMagic + "# world 0123");
  RecordSource source(folder / "x.rec");
  EXPECT_EQ(source.worldFingerprint(), "");
  Message m;
  EXPECT_FALSE(source.next(m));
  EXPECT_NE(source.remark().find("its last 12 bytes"), std::string::npos) << source.remark();
}

// What is written goes to the system moment by moment, so wherever the recorder is killed, all but
// the last moment is there, under its own name.
TEST(Record, OfLinesWhoseRecorderIsKilledIsReadableUnderItsName) {
  const TemporaryFolder folder;
  const auto file = folder / "run.txt";
  Random random(23);
  std::size_t torn = 0;
  for (int run = 0; run < 100; ++run) {
    std::filesystem::remove(file);
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      RecordWriter writer(file, "abc", RecordWriter::Pace::kLive);
      const std::vector<std::uint32_t> words(2000, 4294967295u);
      for (Timestamp stamp = 0;; ++stamp) {
        for (const char* feature : {"a", "b", "c"})
          writer.write({stamp, {"m", "t", feature}, words});
        if (stamp == 1 && ::write(ready[1], "", 1) != 1) ::_exit(1);
      }
    }
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    for (std::uint64_t i = random.below(20000); i > 0; --i)
      std::atomic_signal_fence(std::memory_order_seq_cst);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(ready[0]);
    ::close(ready[1]);
    const Played played = play(file);
    torn += played.remark.empty() ? 0 : 1;
    ASSERT_GE(played.stamps.size(), 3u);
    // The system stops between two pages; that there a line ends is rare, and nobody could tell.
    if (std::filesystem::file_size(file) % 4096 != 0) {
      EXPECT_EQ(played.stamps.size() % 3, 0u) << "moments are whole";
    }
    EXPECT_EQ(folder.files(), 1u);
  }
  RecordProperty("torn", std::to_string(torn));
}

// Of a pipe the end is not known beforehand; and a file may grow after it was opened.
TEST(Record, ThatIsTornWhereItEndsLaterIsPlayedUpToItsLastWholeLine) {
  const TemporaryFolder folder;
  writeBytes(folder / "x.rec", kMagic + "1 a/b/c 0\n");
  RecordSource source(folder / "x.rec");
  writeBytes(folder / "x.rec", kMagic + "1 a/b/c 0\n2 a/b/c 0\n2 a/b");
  Message m;
  EXPECT_TRUE(source.next(m));
  EXPECT_TRUE(source.next(m));
  EXPECT_FALSE(source.next(m));
  EXPECT_NE(source.remark().find("its last 5 bytes"), std::string::npos) << source.remark();
}

// A moment of which there is no end must not make the search for its begin last for ever.
TEST(Record, ThatIsTornInAnEndlessMomentIsReadQuickly) {
  const TemporaryFolder folder;
  std::string text = kMagic;
  for (int i = 0; i < 200000; ++i) text += "7 a/b/c 0\n";
  writeBytes(folder / "x.rec", text + "7 a");
  const auto torn = tornEnd(folder / "x.rec");
  ASSERT_TRUE(torn.has_value());
  EXPECT_EQ(torn->begin + torn->bytes, text.size() + 3);
  EXPECT_EQ(torn->bytes, 65536u * 10 + 3);
}

TEST(Record, RefusesMissingFilesAndFolders) {
  const TemporaryFolder folder;
  EXPECT_EQ(messageOf<std::runtime_error>([&] { RecordSource(folder / "none"); }),
            (folder / "none").string() + ": can't be read: No such file or directory");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { RecordSource(folder.path()); }),
            folder.path().string() + ": can't be read: Is a directory");
  EXPECT_THROW(RecordWriter(folder / "no" / "where.rec"), std::runtime_error);
}

// 4 GiB of nothing in a sparse file: reading must give up at 64 MiB, not eat the memory.
TEST(Record, GivesUpOnAnEndlessLine) {
  const TemporaryFolder folder;
  writeBytes(folder / "x.rec", kMagic);
  std::filesystem::resize_file(folder / "x.rec", std::uintmax_t{4} << 30);
  RecordSource source(folder / "x.rec");
  Message m;
  EXPECT_EQ(messageOf<std::runtime_error>([&] { source.next(m); }),
            (folder / "x.rec").string() + ":2: the line is longer than 64 MiB");
}

TEST(Record, EveryTruncationOfAFileIsToldAndGivesWholeMomentsOnly) {
  const TemporaryFolder folder;
  const auto file = folder / "x.rec";
  const std::string moments[] = {kMagic + "# world abc\n", "1 a/b/c 2 3 4\n1 a/b/d 0\n",
                                 "2 a/b/d 0\n2 a/b/e 1 7\n", "30 a/b/c 1 123\n"};
  std::string whole;
  for (const std::string& moment : moments) whole += moment;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const bool endsAtALine = size > 0 && whole[size - 1] == '\n';
    if (size < kMagic.size()) {
      EXPECT_EQ(complaint(folder, whole.substr(0, size)).substr(0, 10), ":1: found ") << size;
      continue;
    }
    writeBytes(file, whole.substr(0, size));
    const Played played = play(file);
    EXPECT_EQ(played.remark.empty(), endsAtALine) << size;
    if (endsAtALine) continue;
    for (const Timestamp stamp : {1, 2, 30})
      EXPECT_NE(std::count(played.stamps.begin(), played.stamps.end(), stamp), 1) << size;
  }
}

std::vector<std::string> textsOf(const FeatureFormats& formats) {
  std::vector<std::string> texts;
  for (const auto& [id, format] : formats) texts.push_back(toText(id) + " " + format.toText());
  return texts;
}

TEST(Record, TellsTheFormatsOfItsFeatures) {
  const TemporaryFolder folder;
  const SensorId scan{"LMS200", "LRF", "scan"};
  const SensorId radar{"acme", "radar", "echoes"};
  const std::string scanText = "scan beams=2 first_deg=0 step_deg=1 max_m=8";
  const std::string radarText = "radar row=range_mm,bearing_cdeg";
  for (const char* name : {"a.txt", "a.rec"}) {
    RecordWriter writer(
        folder / name,
        RecordNotes{"abc", {{scan, parseFormat(scanText)}, {radar, parseFormat(radarText)}}});
    writer.write({1, scan, {7, 8}});
    writer.commit();
    RecordSource source(folder / name);
    EXPECT_EQ(source.worldFingerprint(), "abc");
    EXPECT_EQ(
        textsOf(source.formats()),
        (std::vector<std::string>{toText(scan) + " " + scanText, toText(radar) + " " + radarText}));
    Message message;
    ASSERT_TRUE(source.next(message));
    EXPECT_EQ(message.words, (std::vector<std::uint32_t>{7, 8}));
  }
}

TEST(Record, NotesThatAreNoFormatsArePassedOver) {
  const TemporaryFolder folder;
  writeBytes(folder / "a.txt",
             "# ortung record 1\n# format\n# format a/b/c\n# format a/b scan\n"
             "# format a/b/c SCAN\n# format a/b/d pose\n1 a/b/d 0\n");
  RecordSource source(folder / "a.txt");
  EXPECT_EQ(textsOf(source.formats()), std::vector<std::string>{"a/b/d pose"});
  Message message;
  EXPECT_TRUE(source.next(message));
}

}  // namespace
}  // namespace ortung
