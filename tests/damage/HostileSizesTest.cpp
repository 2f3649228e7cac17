// Files whose numbers promise far more than they hold, and files that hold too much of something:
// refused with a sentence before memory is taken for it.
#include "FlippedBits.hpp"
#include "ortung/core/BinaryReading.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung {
namespace {

using test::kPlenty;
using test::MemoryLimit;
using test::messageOf;
using test::TemporaryFolder;
using test::writeBytes;

void expectHas(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

/// What reading a record to its end says.
std::string toldOf(const std::filesystem::path& file) {
  return messageOf<std::runtime_error>([&] {
    RecordSource source(file);
    FrameReader reader(source);
    for (std::vector<Message> frame; reader.next(frame);) {
    }
  });
}

TEST(HostileRecords, AnnouncedWordsTakeNoMemory) {
  const TemporaryFolder folder;
  const MemoryLimit limit(kPlenty / 8);
  for (const char* count : {"16777216", "16777217", "4294967295", "18446744073709551615"}) {
    writeBytes(folder / "a.rec", "# ortung record 1\n0 a/b/c " + std::string(count) + " 1 2\n");
    const std::string told = toldOf(folder / "a.rec");
    EXPECT_TRUE(told.find("torn") != told.npos || told.find("a number of words") != told.npos)
        << told;
    const std::string binary = "0 a/b/c " + std::string(count) + "\nabcd";
    std::string_view bytes = binary;
    std::string why;
    EXPECT_FALSE(parseBinary(bytes, &why));
    EXPECT_NE(why, "");
  }
}

TEST(HostileRecords, LinesWithoutAnEndAreReadWithinBounds) {
  const TemporaryFolder folder;
  writeBytes(folder / "a.rec", "# ortung record 1\n0 a/b/c 1 ");
  std::filesystem::resize_file(folder / "a.rec", std::uintmax_t{4} << 30);  // of holes
  const MemoryLimit limit(kPlenty);
  expectHas(toldOf(folder / "a.rec"), "the line is longer than 64 MiB");
}

TEST(HostileRecords, ReadingsOfOneMomentAreBounded) {
  const TemporaryFolder folder;
  const auto readings = [](int count) {
    std::string record = "# ortung record 1\n";
    for (int i = 0; i < count; ++i) record += "7 a/b/c 0\n";
    return record;
  };
  writeBytes(folder / "most.rec", readings(65536));
  EXPECT_EQ(toldOf(folder / "most.rec"), "(nothing was thrown)");
  writeBytes(folder / "more.rec", readings(65537));
  expectHas(toldOf(folder / "more.rec"), "more than 65536 readings at 7 us");
}

/// A table file with this meta.json and a region of one cell.
std::string toldOfMeta(const TemporaryFolder& folder, const std::string& meta) {
  const std::vector<std::uint8_t> cell{1};
  TableWriter writer(folder / "t.ortung");
  writer.add<std::uint8_t>("open", {1, 1}, cell);
  writer.add<std::uint8_t>("standable", {1, 1}, cell);
  writer.addText("meta.json", meta);
  writer.commit();
  const TableFile file(folder / "t.ortung");
  const MemoryLimit limit(kPlenty);
  return messageOf<TableError>([&] { readTableInfo(file); });
}

std::string metaWith(const std::string& more) {
  return R"({"format": "ortung tables", "version": 1, "world": "w", "robot": "r",
             "world_fingerprint": "", "heading_step_rad": 0.1, "origin_x_m": 0, "origin_y_m": 0,
             "cell_m": 0.1, "features": [])" +
         more + "}";
}

TEST(HostileTables, DescriptionsAreReadWithinBounds) {
  const TemporaryFolder folder;
  EXPECT_EQ(toldOfMeta(folder, metaWith("")), "(nothing was thrown)");
  expectHas(toldOfMeta(folder, metaWith(", \"field\": " + std::string(30 << 20, '['))),
            "nested deeper than 8");
  expectHas(toldOfMeta(folder, std::string(65 << 20, ' ')), "bytes, expected at most 67108864");
  const auto numbers = [](const char* key, const std::string& entry, int count) {
    std::string list = std::string(", \"field\": {\"") + key + "\": [" + entry;
    for (int i = 1; i < count; ++i) list += "," + entry;
    return list + "]}";
  };
  expectHas(toldOfMeta(folder, metaWith(numbers("lines", "0", 100'001))),
            "lines are more than 100000");
}

// Cells beyond what the learner makes: indices of cells have 31 bits in loops over samples.
TEST(HostileTables, RegionsOfTooManyCellsAreRefused) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> cells((std::size_t{1} << 26) + 1, 1);
  TableWriter writer(folder / "t.ortung");
  writer.add<std::uint8_t>("open", {1, cells.size()}, cells);
  writer.addText("meta.json", metaWith(""));
  writer.commit();
  expectHas(messageOf<TableError>([&] { readTableInfo(TableFile(folder / "t.ortung")); }),
            "impossible shape");
}

}  // namespace
}  // namespace ortung
