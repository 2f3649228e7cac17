// Every bit of a table file with a feature of each format, flipped: as an accident (checksums catch
// it) and with the checksums mended, as a hostile writer would. What is taken then weighs poses.
#include "FlippedBits.hpp"
#include "Golden.hpp"
#include "MendedFiles.hpp"
#include "TableUser.hpp"
#include "ortung/robot/TableInfo.hpp"

namespace ortung {
namespace {

using test::Fate;
using test::flipBits;
using test::goldenFile;
using test::readBytes;
using test::TemporaryFolder;
using test::writeBytes;
void useTables(const std::filesystem::path& file) {
  SensorContainer container;
  test::fillForTables(container);
  loadTables(std::make_shared<TableFile>(file), container);
  ASSERT_EQ(test::complaintOfWeighing(container), "");
}

TEST(FlippedBits, OfTables) {
  const TemporaryFolder folder;
  const std::string whole = readBytes(goldenFile("tables1.ortung"));
  const Fate fate = flipBits<TableError>(
      whole,
      [&](const std::string& bytes) {
        writeBytes(folder / "t.ortung", bytes);
        useTables(folder / "t.ortung");
      },
      test::everyOrAll(11));
  EXPECT_GT(fate.taken, 0);  // dates and padding
  EXPECT_GT(fate.refused, fate.taken);
}

TEST(FlippedBits, OfTablesWithMendedChecksums) {
  const TemporaryFolder folder;
  const std::string whole = readBytes(goldenFile("tables1.ortung"));
  std::string mended = whole;
  test::mendZip(mended);
  ASSERT_TRUE(mended == whole) << "mending must change nothing where nothing is wrong";
  const Fate fate = flipBits<TableError>(
      whole,
      [&](std::string bytes) {
        test::mendZip(bytes);
        writeBytes(folder / "t.ortung", bytes);
        useTables(folder / "t.ortung");
      },
      test::everyOrAll(7));
  EXPECT_GT(fate.taken, 1000) << "levels, names";
  EXPECT_GT(fate.refused, 1000) << "keys, shapes, row numbers";
}

}  // namespace
}  // namespace ortung
