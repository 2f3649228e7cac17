#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <memory>
#include <stdexcept>

#include "Files.hpp"
#include "MendedFiles.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {
namespace {

using test::messageOf;
using test::readBytes;
using test::TemporaryFolder;
using test::writeBytes;

const std::vector<std::uint8_t> kBytes = {0, 1, 255, 7, 8, 9};
const std::vector<std::uint16_t> kShorts = {65535, 0, 1};
const std::vector<std::int32_t> kInts = {-1, std::numeric_limits<std::int32_t>::min(), 5, 6};
const std::vector<float> kFloats = {1.5F, -0.0F};
const std::vector<double> kDoubles = {0.1, 1e300, -2.5};

void writeExample(const std::filesystem::path& file) {
  TableWriter writer(file);
  writer.add<std::uint8_t>("bytes", {2, 3}, kBytes);
  writer.add<std::uint16_t>("shorts", {3}, kShorts);
  writer.addText("meta.json", "{\"a\": 1}\n");
  writer.add<std::int32_t>("ints", {2, 1, 2}, kInts);
  writer.add<float>("floats", {2}, kFloats);
  writer.add<double>("a.b-c_9", {3, 1}, kDoubles);
  writer.add<double>("none", {0, 4}, {});
  writer.commit();
}

bool isExample(const TableFile& file) {
  const auto same = [](const auto& found, const auto& expected) {
    return std::equal(found.begin(), found.end(), expected.begin(), expected.end());
  };
  return same(file.get<std::uint8_t>("bytes", {2, 3}), kBytes) &&
         same(file.get<std::uint16_t>("shorts", {3}), kShorts) &&
         same(file.get<std::int32_t>("ints", {2, 1, 2}), kInts) &&
         same(file.get<float>("floats", {0}), kFloats) &&
         same(file.get<double>("a.b-c_9", {3, 0}), kDoubles) && file.array("none").bytes.empty() &&
         file.text("meta.json") == "{\"a\": 1}\n" && file.arrays().size() == 6;
}

TEST(TableFile, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  EXPECT_TRUE(isExample(TableFile(folder / "t.npz")));
}

TEST(TableFile, NamesMayHaveAllLettersAndDigits) {
  const TemporaryFolder folder;
  const std::string name = "abcxyzABCXYZ0189_.-";
  TableWriter writer(folder / "t.npz");
  writer.add<std::uint8_t>(name, {2, 3}, kBytes);
  writer.commit();
  EXPECT_EQ(TableFile(folder / "t.npz").get<std::uint8_t>(name, {2, 3}).size(), 6u);
}

TEST(TableFile, LaysArraysAtMultiplesOf64Bytes) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  const TableFile file(folder / "t.npz");
  for (const TableArray& array : file.arrays()) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.bytes.data()) % 64, 0u) << array.name;
  }
}

// NumPy's format description, version 1.0: a length of two bytes follows the version, the text ends
// with a line feed, and all of it is a multiple of 64 bytes long.
TEST(TableFile, HeadersOfArraysAreAsNumPyWantsThem) {
  for (const std::size_t extent : {1u, 10u, 100u}) {
    for (std::size_t more = 0; more < 40; ++more) {  // texts of all lengths
      const TemporaryFolder folder;
      TableWriter writer(folder / "t.npz");
      const std::vector<std::uint8_t> values(extent, 7);
      std::vector<std::size_t> shape(1 + more, 1);
      shape[0] = extent;
      writer.add<std::uint8_t>("t", shape, values);
      writer.commit();
      const std::string bytes = test::readBytes(folder / "t.npz");
      const std::size_t at = bytes.find("\x93NUMPY\x01");
      ASSERT_NE(at, bytes.npos);
      const std::size_t length = 10 + static_cast<unsigned char>(bytes[at + 8]) +
                                 256u * static_cast<unsigned char>(bytes[at + 9]);
      EXPECT_EQ(length % 64, 0u);
      EXPECT_EQ(bytes.at(at + length - 1), '\n');
      EXPECT_EQ(bytes.at(at + length), '\7');
    }
  }
}

TEST(TableFile, IsTheSameForTheSameContent) {
  const TemporaryFolder folder;
  writeExample(folder / "a.npz");
  writeExample(folder / "b.npz");
  EXPECT_EQ(readBytes(folder / "a.npz"), readBytes(folder / "b.npz"));
}

// The system tells errors only of calls that fail.
TEST(TableFile, IsReadAfterSomethingElseHasFailed) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  errno = EIO;
  EXPECT_TRUE(isExample(TableFile(folder / "t.npz")));
}

TEST(TableFile, KeepsWhatIsMadeOfItForAllWhoAskByTheSameName) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  const TableFile file(folder / "t.npz");
  int made = 0;
  const auto ask = [&](const char* name) {
    return file.shared<int>(name, [&] { return std::make_shared<int>(++made); });
  };
  EXPECT_THROW(
      file.shared<int>("a", []() -> std::shared_ptr<int> { throw std::runtime_error("no such"); }),
      std::runtime_error);
  const std::shared_ptr<const int> a = ask("a");
  EXPECT_EQ(*a, 1);
  EXPECT_EQ(ask("a"), a);
  EXPECT_EQ(*ask("b"), 2);
  EXPECT_EQ(made, 2);
}

TEST(TableFile, SaysWhichTableIsMissingOrOther) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  const TableFile file(folder / "t.npz");
  const std::string name = (folder / "t.npz").string();
  EXPECT_EQ(messageOf<TableError>([&] { file.array("gone"); }), name + ": has no table gone");
  EXPECT_EQ(messageOf<TableError>([&] { (void)file.text("gone.json"); }),
            name + ": has no member gone.json, so it is no table file");
  EXPECT_EQ(messageOf<TableError>([&] { file.get<float>("ints", {2, 1, 2}); }),
            name + ": table ints has <i4 2 x 1 x 2, expected <f4 2 x 1 x 2");
  EXPECT_EQ(messageOf<TableError>([&] { file.get<std::int32_t>("ints", {0, 4}); }),
            name + ": table ints has <i4 2 x 1 x 2, expected <i4 any x 4");
}

TEST(TableFile, RefusesWhatIsNone) {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& file) {
    return messageOf<TableError>([&] { TableFile(folder / file); });
  };
  EXPECT_EQ(told("gone"),
            (folder / "gone").string() + ": can't be read: No such file or directory");
  writeBytes(folder / "empty", "");
  EXPECT_EQ(told("empty"), (folder / "empty").string() + ": is empty or can't be mapped");
  writeBytes(folder / "text", "this is no table file at all, but long enough to be one");
  EXPECT_EQ(
      told("text"),
      (folder / "text").string() +
          ": is torn or no table file: it is no table file, or cut off: the end record is missing");
  std::filesystem::create_directory(folder / "folder");
  EXPECT_EQ(told("folder"), (folder / "folder").string() + ": can't be read: Is a directory");
}

TEST(TableFile, EveryTruncationIsRefused) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  const std::string whole = readBytes(folder / "t.npz");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    writeBytes(folder / "cut.npz", whole.substr(0, size));
    ASSERT_THROW(TableFile(folder / "cut.npz"), TableError) << size;
  }
}

TEST(TableFile, EveryFlippedByteIsRefusedOrChangesNothing) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  const std::string whole = readBytes(folder / "t.npz");
  int harmless = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      writeBytes(folder / "bad.npz", bytes);
      try {
        const TableFile file(folder / "bad.npz");
        // A name in the directory may change: then the table is missing, which is told as well.
        ASSERT_TRUE(isExample(file)) << "byte " << at << " flipped by " << flip;
        ++harmless;
      } catch (const TableError&) {  // refused
      }
    }
  }
  // Versions, dates and padding; the rest is checked.
  EXPECT_LT(harmless, static_cast<int>(whole.size()) * 3 / 2);
}

TEST(TableFile, SurvivesRandomDamage) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  const std::string whole = readBytes(folder / "t.npz");
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = whole;
    for (std::uint64_t k = 1 + random.below(6); k > 0; --k) {
      // Mostly in the directory at the end, where the numbers stand that say where things are.
      const std::size_t at =
          random.below(3) == 0 ? random.below(bytes.size()) : bytes.size() - 1 - random.below(500);
      bytes[at] = random.below(2) == 0 ? static_cast<char>(random.below(256))
                                       : static_cast<char>(random.below(2) == 0 ? 0 : -1);
    }
    writeBytes(folder / "bad.npz", bytes);
    try {
      const TableFile file(folder / "bad.npz");
      for (const TableArray& array : file.arrays()) {
        unsigned sum = 0;  // every byte must be readable
        for (const std::byte b : array.bytes) sum += static_cast<unsigned>(b);
        ASSERT_LE(sum, array.bytes.size() * 255);
      }
    } catch (const TableError&) {  // refused
    }
  }
}

/// Replaces @p from by @p to (of the same length) in the headers and mends the checksums.
void forge(const std::filesystem::path& file, const std::string& from, const std::string& to) {
  ASSERT_EQ(from.size(), to.size());
  std::string bytes = readBytes(file);
  const std::size_t at = bytes.find(from);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, from.size(), to);
  test::mendZip(bytes);
  writeBytes(file, bytes);
}

TEST(TableFile, RefusesShapesThatDoNotFitTheirBytes) {
  const TemporaryFolder folder;
  const auto file = folder / "t.npz";
  const std::vector<double> value = {1.0};
  for (const std::string shape :
       {"(9223372036854775808, 2, 1, 1),", "(18446744073709551615, 0001),",
        "(99999999999999999999, 1),    ", "(1, 1, 1, 1, 1, 1, 1, 1, 1),    ", "(-1, 1), ",
        "(1.5, ), ", "(1, 1, 2)", "(", "(a, b, c)"}) {
    TableWriter writer(file);
    writer.add<double>("x", {1, 1, 1}, value);
    writer.commit();
    const std::string header = "(1, 1, 1), }" + std::string(40, ' ');
    std::string forged = shape;
    forged += std::string(header.size() - forged.size(), ' ');
    forge(file, header, forged);
    EXPECT_EQ(messageOf<TableError>([&] { TableFile t(file); }),
              file.string() + ": member x.npy is no array of a kind that is used here")
        << shape;
  }
}

TEST(TableFile, RefusesOtherKindsOfElements) {
  const TemporaryFolder folder;
  const auto file = folder / "t.npz";
  const std::vector<double> value = {1.0};
  for (const std::string kind : {"<c8", "|O8", ">f8", "<i8", "|S8"}) {
    TableWriter writer(file);
    writer.add<double>("x", {1}, value);
    writer.commit();
    forge(file, "<f8", kind);
    EXPECT_THROW(TableFile t(file), TableError) << kind;
  }
}

TEST(TableFile, ForgingWithoutAChangeIsFine) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  forge(folder / "t.npz", "|u1", "|u1");
  EXPECT_TRUE(isExample(TableFile(folder / "t.npz"))) << "or the two tests above prove nothing";
}

// What a careless or hostile writer may do: an array that does not begin where its elements may.
TEST(TableFile, RefusesArraysThatAreNotAligned) {
  const TemporaryFolder folder;
  const auto file = folder / "t.npz";
  const std::vector<double> value = {1.0, 2.0};
  TableWriter writer(file);
  writer.add<double>("x", {2}, value);
  writer.commit();
  std::string bytes = readBytes(file);
  // One byte more in front of the data: in the padding of the first member.
  const auto extra = static_cast<unsigned char>(bytes[28]);
  bytes[28] = static_cast<char>(extra + 1);
  bytes.insert(30 + static_cast<unsigned char>(bytes[26]) + extra, 1, '\0');
  std::uint32_t directory = 0;
  std::memcpy(&directory, bytes.data() + bytes.size() - 6, 4);
  ++directory;
  std::memcpy(bytes.data() + bytes.size() - 6, &directory, 4);
  writeBytes(file, bytes);
  EXPECT_NE(messageOf<TableError>([&] { TableFile t(file); }).find("not aligned"),
            std::string::npos);
}

TEST(TableWriter, WithoutCommitTheOldFileStaysAndNothingElse) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  {
    TableWriter writer(folder / "t.npz");
    writer.add<std::uint8_t>("bytes", {6}, kBytes);
  }
  EXPECT_TRUE(isExample(TableFile(folder / "t.npz")));
  EXPECT_EQ(folder.files(), 1u);
}

TEST(TableWriter, KilledInTheMiddleLeavesTheOldFileWhole) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  const auto killed = [&] {
    TableWriter writer(folder / "t.npz");
    writer.add<std::uint8_t>("bytes", {6}, kBytes);
    ::_exit(3);
  };
  EXPECT_EXIT(killed(), ::testing::ExitedWithCode(3), "");
  EXPECT_TRUE(isExample(TableFile(folder / "t.npz")));
}

TEST(TableWriter, SaysWhichFileCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_EQ(messageOf<TableError>([&] { TableWriter(folder / "no" / "t.npz"); }),
            (folder / "no" / "t.npz").string() + ": can't be written: No such file or directory");
  // A folder in the way shows only at the end, and leaves nothing behind either.
  std::filesystem::create_directory(folder / "folder");
  const std::string told = messageOf<TableError>([&] { writeExample(folder / "folder"); });
  EXPECT_TRUE(told.starts_with((folder / "folder").string() + ": can't be")) << told;
  EXPECT_EQ(folder.files(), 1u);
}

TEST(TableWriter, RefusesASecondMemberOfOneName) {
  const TemporaryFolder folder;
  TableWriter writer(folder / "t.npz");
  writer.add<std::uint8_t>("x", {6}, kBytes);
  EXPECT_THROW(writer.add<std::uint8_t>("x", {6}, kBytes), TableError);
}

// 65535 members, all of one small size: reading takes them or refuses them, but soon.
TEST(TableFile, ReadsManyMembersSoon) {
  const TemporaryFolder folder;
  TableWriter writer(folder / "t.npz");
  for (int i = 0; i < 65000; ++i) writer.addText("t" + std::to_string(i), "x");
  writer.commit();
  const std::clock_t begin = std::clock();  // of the processor: others may have it meanwhile
  const TableFile file(folder / "t.npz");
  EXPECT_LT(std::clock() - begin, 3 * CLOCKS_PER_SEC);
  EXPECT_EQ(file.text("t64999"), "x");
}

int python(const std::string& program, const std::filesystem::path& file) {
  for (const std::string interpreter : {"python3", "/usr/bin/python3"}) {
    const int status = std::system(
        (interpreter + " -c \"" + program + "\" " + file.string() + " 2>/dev/null").c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (code == 0 || code == 5) return code;  // 5: the program's own verdict "wrong"
  }
  return -1;
}

// A second implementation of the zip format.
TEST(TableFile, PythonsZipfileFindsNoFault) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  const int code = python(
      "import sys,zipfile,ast\n"
      "z=zipfile.ZipFile(sys.argv[1])\n"
      "ok=z.testzip() is None and len(z.namelist())==7\n"
      "b=z.read('ints.npy')\n"
      "h=ast.literal_eval(b[10:128].decode())\n"
      "ok=ok and h=={'descr':'<i4','fortran_order':False,'shape':(2,1,2)} and "
      "b[128:132]==b'\\\\xff'*4\n"
      "sys.exit(0 if ok else 5)\n",
      folder / "t.npz");
  if (code == -1) GTEST_SKIP() << "there is no python3";
  EXPECT_EQ(code, 0);
}

TEST(TableFile, NumpyReadsIt) {
  const TemporaryFolder folder;
  writeExample(folder / "t.npz");
  const int code = python(
      "import sys,numpy as np\n"
      "z=np.load(sys.argv[1],allow_pickle=False)\n"
      "ok=z['bytes'].tolist()==[[0,1,255],[7,8,9]] and z['shorts'].tolist()==[65535,0,1]\n"
      "ok=ok and z['ints'].tolist()==[[[-1,-2147483648]],[[5,6]]] and "
      "z['floats'].tolist()==[1.5,0]\n"
      "ok=ok and z['a.b-c_9'].tolist()==[[0.1],[1e300],[-2.5]] and z['none'].shape==(0,4)\n"
      "sys.exit(0 if ok else 5)\n",
      folder / "t.npz");
  if (code == -1) GTEST_SKIP() << "there is no python3 with numpy";
  EXPECT_EQ(code, 0);
}

}  // namespace
}  // namespace ortung
