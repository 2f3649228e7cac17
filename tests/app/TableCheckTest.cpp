#include <algorithm>
#include <cstring>
#include <set>

#include "Workspace.hpp"
#include "ortung/base/Random.hpp"
#include "ortung/run/Localization.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung::test {
namespace {

/// A table file taken to pieces, so that it can be put together otherwise, with right checksums.
struct Pieces {
  struct Array {
    TableArray array;
    std::vector<std::byte> bytes;
  };
  std::vector<Array> arrays;
  std::string meta;

  explicit Pieces(const std::filesystem::path& file) {
    const TableFile tables(file);
    meta = tables.text("meta.json");
    for (const TableArray& array : tables.arrays())
      arrays.push_back({array, {array.bytes.begin(), array.bytes.end()}});
  }
  void write(const std::filesystem::path& file) const {
    TableWriter writer(file);
    for (const Array& one : arrays) {
      TableArray array = one.array;
      array.bytes = one.bytes;
      writer.addBytes(array);
    }
    writer.addText("meta.json", meta);
    writer.commit();
  }
};

/// One of what a bad disk does not do, but a foreign program, another version or an attacker.
void damage(Pieces& pieces, Random& random) {
  Pieces::Array& one = pieces.arrays[random.below(pieces.arrays.size())];
  switch (random.below(6)) {
    case 0:  // not the robot file's text, which only check reads
      pieces.meta[random.below(pieces.meta.find("\"robot_file\""))] =
          static_cast<char>(' ' + random.below(95));
      break;
    case 1:
      one.array.name[random.below(one.array.name.size())] = 'x';
      break;
    case 2:
      pieces.arrays.erase(pieces.arrays.begin() + (&one - pieces.arrays.data()));
      break;
    case 3: {  // one row less
      const std::size_t row = one.bytes.size() / one.array.shape[0];
      one.array.shape[0] -= 1;
      one.bytes.resize(one.bytes.size() - row);
      break;
    }
    case 4:
      std::fill(one.bytes.begin(), one.bytes.end(),
                static_cast<std::byte>(random.below(2) == 0 ? 0xFF : 0x7F));
      break;
    default:
      one.bytes[random.below(one.bytes.size())] = static_cast<std::byte>(random.below(256));
      break;
  }
}

class TableCheck : public Workspace {
 protected:
  /// Why a localization can't work with the tables; "" if it can.
  std::string refusal(const std::string& tables) const {
    try {
      LocalizationConfig config;
      config.robot = path("robot.toml");
      config.tables = tables;
      const ortung::Localization localization(config);
      return "";
    } catch (const std::exception& error) {
      return error.what();
    }
  }
};

TEST_F(TableCheck, RefusesWhateverALocalizationRefuses) {
  const Outcome learned =
      ortung({"learn", "--world", path("hall.toml"), "--robot", path("robot.toml"), "--out",
              path("hall.ortung"), "--cell", "0.5", "--heading-step", "10"});
  ASSERT_EQ(learned.exitCode, 0) << learned.err;
  const Pieces whole(path("hall.ortung"));
  whole.write(path("same.ortung"));
  EXPECT_EQ(ortung({"check", path("same.ortung")}).exitCode, 0);

  Random random(25);
  std::vector<std::string> command = {"check"};
  std::set<std::string> bad;
  constexpr int kDamaged = 150;
  for (int i = 0; i < kDamaged; ++i) {
    Pieces pieces = whole;
    damage(pieces, random);
    const std::string file = path(std::to_string(i) + ".ortung");
    pieces.write(file);
    command.push_back(file);
    if (!refusal(file).empty()) bad.insert(file);
  }
  EXPECT_GT(bad.size(), 40u);
  EXPECT_LT(bad.size(), 140u);
  const Outcome outcome = ortung(command);
  EXPECT_EQ(outcome.exitCode, 1);
  for (const std::string& file : bad)
    EXPECT_NE(outcome.err.find(file + ": "), std::string::npos) << file << ": " << refusal(file);
}

TEST_F(TableCheck, SaysThatTablesWithoutARobotFileWereNotLoaded) {
  learnTables();
  Pieces pieces(path("hall.ortung"));
  const std::size_t key = pieces.meta.find(" \"robot_file\"");
  const std::size_t end = pieces.meta.find(",\n", key) + 2;
  pieces.meta.erase(key, end - key);
  pieces.write(path("old.ortung"));
  const Outcome outcome = ortung({"check", path("old.ortung")});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: " + path("old.ortung")), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("--robot"), std::string::npos);
  EXPECT_EQ(ortung({"check", path("old.ortung"), "--robot", path("robot.toml")}).err, "");
}

}  // namespace
}  // namespace ortung::test
