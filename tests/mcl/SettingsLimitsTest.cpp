// What [mcl] and MclConfig take, and what they refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "Files.hpp"
#include "Paths.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/mcl/MclConfig.hpp"

namespace ortung {
namespace {

std::string complaintAbout(const std::string& key, double value) {
  Parameters p("r.toml");
  p.set(key, value);
  return test::messageOf<ConfigError>([&] { MclConfig::read(p); });
}

/// The next number beyond a limit that the option's kind has.
double beyond(const MclConfig::Option& option, double limit, double direction) {
  return limit + direction * (option.kind == MclConfig::Option::Kind::kInteger ? 1.0 : 1e-3);
}

MclConfig::Option optionOf(const std::string& key) {
  for (const MclConfig::Option& option : MclConfig::options())
    if (option.key == key) return option;
  throw std::invalid_argument("there is no key " + key);
}

TEST(MclSettingsLimits, KeysTakeTheirWholeRangeAndNothingBeyond) {
  for (const MclConfig::Option& option : MclConfig::options()) {
    if (option.kind == MclConfig::Option::Kind::kFlag) continue;
    const auto [low, high] = option.range;
    const double most = std::string(option.key) == "min_particles" ? 20000.0 : high;  // particles
    for (const double fine : {low, most})
      EXPECT_EQ(complaintAbout(option.key, fine), "(nothing was thrown)") << option.key << fine;
    for (const double wrong : {beyond(option, low, -1.0), beyond(option, most, 1.0)}) {
      const std::string text = complaintAbout(option.key, wrong);
      EXPECT_EQ(text.find(std::string("r.toml: ") + option.key + " is "), 0u) << text;
      EXPECT_NE(text.find("must be in ["), text.npos) << text;
    }
  }
}

// The ranges themselves, for what would make no sense.
TEST(MclSettingsLimits, RangesLeaveOutWhatMakesNoSense) {
  EXPECT_GT(optionOf("particles").range.low, 0.0);
  EXPECT_GT(optionOf("kld_error").range.low, 0.0);
  EXPECT_LT(optionOf("kld_error").range.high, 1.0);
  for (const char* share : {"resample_below", "recover_fast", "recover_slow"}) {
    EXPECT_EQ(optionOf(share).range.low, 0.0) << share;
    EXPECT_EQ(optionOf(share).range.high, 1.0) << share;
  }
  for (const char* size : {"bin_m", "bin_deg", "budget_ms"})
    EXPECT_GT(optionOf(size).range.low, 0.0) << size;
}

// Whoever fills in the fields by hand is told, too.
TEST(MclSettingsLimits, FieldsTakeTheirWholeRangeAndNothingBeyond) {
  for (const MclConfig::Option& option : MclConfig::options()) {
    const auto complaint = [&](double value) {
      MclConfig c;
      option.set(c, value);
      return test::messageOf<std::invalid_argument>([&] { c.check(); });
    };
    const auto [low, high] = option.range;
    const double most = std::string(option.key) == "min_particles" ? 20000.0 : high;
    EXPECT_EQ(complaint(most), "(nothing was thrown)") << option.key;
    if (option.kind == MclConfig::Option::Kind::kFlag) continue;
    if (std::string(option.key) != "particles") {  // there are 500 at least
      EXPECT_EQ(complaint(low), "(nothing was thrown)") << option.key;
    }
    for (const double wrong : {beyond(option, low, -1.0), beyond(option, most, 1.0)}) {
      if (wrong < 0.0 && option.kind == MclConfig::Option::Kind::kInteger) continue;
      EXPECT_EQ(complaint(wrong).find(std::string("MclConfig: ") + option.key + " is "), 0u)
          << option.key << " = " << wrong << ": " << complaint(wrong);
    }
    if (option.kind == MclConfig::Option::Kind::kNumber) {
      EXPECT_NE(complaint(std::nan("")), "(nothing was thrown)") << option.key;
    }
  }
  MclConfig c;
  c.threads = 257;
  EXPECT_THROW(c.check(), std::invalid_argument);
  c.threads = 0;
  EXPECT_THROW(c.check(), std::invalid_argument);
}

// The page's table is for people; what it says of keys and defaults is what the code does.
TEST(MclSettingsLimits, ThePageHasEachKeyWithItsDefault) {
  const std::string page = test::readBytes(ORTUNG_SOURCE_DIR "/docs/mcl.md");
  std::map<std::string, std::string> rows;  // default by key
  for (std::size_t at = page.find("\n| `"); at != page.npos; at = page.find("\n| `", at + 1)) {
    std::istringstream row(page.substr(at + 1, page.find('\n', at + 1) - at - 1));
    std::string nothing, keys, defaults;
    std::getline(std::getline(std::getline(row, nothing, '|'), keys, '|'), defaults, '|');
    std::istringstream all(keys), values(defaults);
    for (std::string key, value; std::getline(all, key, ',') && std::getline(values, value, ',');) {
      const auto strip = [](const std::string& text) {
        const std::size_t first = text.find_first_not_of(" `");
        return text.substr(first, text.find_last_not_of(" `") + 1 - first);
      };
      rows.emplace(strip(key), strip(value));
    }
  }
  for (const MclConfig::Option& option : MclConfig::options()) {
    ASSERT_TRUE(rows.contains(option.key)) << "docs/mcl.md has no row of `" << option.key << "`";
    const std::string& row = rows[option.key];
    const double value = row == "true" ? 1.0 : row == "false" ? 0.0 : std::stod(row);
    EXPECT_NEAR(value, option.get(MclConfig()), 0.02 * std::abs(value)) << option.key;
  }
}

TEST(MclSettingsLimits, TheFuzzersWordsHaveEachKey) {
  const std::string words = test::readBytes(ORTUNG_SOURCE_DIR "/tests/fuzz/robot.dict");
  for (const MclConfig::Option& option : MclConfig::options())
    EXPECT_NE(words.find("\"" + std::string(option.key) + " = \""), words.npos) << option.key;
}

}  // namespace
}  // namespace ortung
