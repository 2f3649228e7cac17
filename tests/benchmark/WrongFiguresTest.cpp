/// Each value of a result's file is changed, taken away or added to, one at a time.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "DrawnMatrix.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung {
namespace {

using Json = nlohmann::ordered_json;

/// A matrix with everything that a file may have: ways to see, pose errors, pairs without goals.
GoalMatrix someMatrix() {
  GoalMatrix matrix = test::drawn({{0.5, 0.0}, {0.3, 0.8}}, 10, {strikerText("roll"), "other"});
  matrix.world = "a1b2c3";
  matrix.config.seed = 5;
  matrix.config.keepers = {"keeper:sees=truth", "keeper:sees=scan"};
  for (std::size_t c = 0; c < matrix.cells.size(); ++c) {
    GoalCell& cell = matrix.cells[c];
    cell.keeper = matrix.config.keepers[c / 2];
    for (std::size_t i = 0; i < cell.episodes.size(); ++i) {
      GoalEpisode& one = cell.episodes[i];
      one.end = static_cast<Timestamp>(1'000'000 + 10'000 * i + c);
      one.digest = static_cast<std::uint32_t>(77 * i + c);
      if (c != 1) one.keeper = {static_cast<std::int32_t>(900 + i), 20};
      if (c == 3) one.striker = {30, static_cast<std::int32_t>(40 + 7 * i)};
    }
  }
  return matrix;
}

/// Whether `verify` notices without playing: the file is refused, or a figure is not the right one.
bool isNoticed(const Json& json) {
  const std::string text = json.dump();
  try {
    return !wrongFigures(text, readGoalMatrix(text, "m.json")).empty();
  } catch (const std::runtime_error&) {
    return true;
  }
}

/// The places of all values that have no values in them, and of all others.
void collect(const Json& json, const Json::json_pointer& place,
             std::vector<Json::json_pointer>& places) {
  places.push_back(place);
  if (json.is_object())
    for (const auto& [key, value] : json.items()) collect(value, place / key, places);
  if (json.is_array())
    for (std::size_t i = 0; i < json.size(); ++i) collect(json[i], place / i, places);
}

/// Other values in place of one.
std::vector<Json> othersThan(const Json& value) {
  std::vector<Json> others = {nullptr, "x", -1, Json::array(), Json::object()};
  if (value.is_number_integer()) {
    others.emplace_back(value.get<std::int64_t>() + 1);
    others.emplace_back(value.get<std::int64_t>() - 1);
    others.emplace_back(value.get<double>() + 0.5);
  } else if (value.is_number()) {
    for (const double by : {1.0, -1.0, 1e-5, -1e-5}) others.emplace_back(value.get<double>() + by);
  } else if (value.is_string()) {
    const auto text = value.get<std::string>();
    for (std::size_t i = 0; i < text.size(); i += 1 + text.size() / 5) {
      std::string other = text;
      other[i] = other[i] == '1' ? '0' : '1';
      others.emplace_back(other);
    }
    others.emplace_back(text + "0");
    others.emplace_back(text.substr(0, text.size() / 2));
  }
  std::erase(others, value);
  return others;
}

TEST(WrongFigures, AreNoneInAFileAsItWasWritten) {
  const GoalMatrix matrix = someMatrix();
  const std::string text = toJson(matrix, "1.2");
  EXPECT_EQ(wrongFigures(text, readGoalMatrix(text, "m.json")), std::vector<std::string>{});
}

TEST(WrongFigures, AreFoundWhicheverValueIsAnother) {
  const Json whole = Json::parse(toJson(someMatrix(), "1.2"));
  std::vector<Json::json_pointer> places;
  collect(whole, Json::json_pointer(), places);
  EXPECT_GT(places.size(), 150u);
  // Texts that nothing follows from; the command compares the world with the one here.
  const std::set<std::string> free = {"/version", "/world"};
  std::size_t changes = 0;
  for (const auto& place : places) {
    for (const Json& other : othersThan(whole.at(place))) {
      if (free.contains(place.to_string()) && other.is_string()) continue;
      Json json = whole;
      json.at(place) = other;
      ++changes;
      EXPECT_TRUE(isNoticed(json)) << place.to_string() << " = " << other;
    }
  }
  EXPECT_GT(changes, 1000u);
}

TEST(WrongFigures, AreFoundIfAValueIsMissingOrUnknown) {
  const Json whole = Json::parse(toJson(someMatrix(), "1.2"));
  std::vector<Json::json_pointer> places;
  collect(whole, Json::json_pointer(), places);
  for (const auto& place : places) {
    Json json = whole;
    if (!place.empty()) {
      Json& parent = json.at(place.parent_pointer());
      if (parent.is_object())
        parent.erase(place.back());
      else
        parent.erase(std::stoul(place.back()));
      EXPECT_TRUE(isNoticed(json)) << place.to_string() << " is missing";
    }
    json = whole;
    if (!json.at(place).is_structured()) continue;
    if (json.at(place).is_object())
      json.at(place)["more"] = 1;
    else
      json.at(place).push_back(1);
    EXPECT_TRUE(isNoticed(json)) << place.to_string() << " has more";
  }
}

TEST(WrongFigures, AreNamedWithTheirPlaceAndBothValues) {
  Json json = Json::parse(toJson(someMatrix(), "1.2"));
  const int goals = json["cells"][2]["count"]["goal"];
  json["cells"][2]["count"]["goal"] = goals + 2;
  json["cells"][0].erase("scoring");
  json["cells"][1]["more"] = "words";
  const auto wrong = wrongFigures(json.dump(), someMatrix());
  ASSERT_EQ(wrong.size(), 3u);
  EXPECT_TRUE(wrong[0].starts_with("/cells/0/scoring is missing, expected {")) << wrong[0];
  EXPECT_EQ(wrong[1], "/cells/1/more is \"words\", which is no figure of these episodes");
  EXPECT_EQ(wrong[2], "/cells/2/count/goal is " + std::to_string(goals + 2) +
                          ", but the episodes give " + std::to_string(goals));
}

TEST(VerifiedEpisodes, AreAsManyAsAskedForAndOfAllPairsEqually) {
  GoalMatrix matrix;
  matrix.config.keepers = {keeperText("still")};
  matrix.config.strikers = {strikerText("roll"), strikerText("shot"), strikerText("dribble")};
  matrix.config.episodes = 5;
  for (const std::string& striker : matrix.config.strikers)
    matrix.cells.push_back({matrix.config.keepers[0], striker, std::vector<GoalEpisode>(5)});
  // No episode ends at 0, so each that is played is another.
  for (const std::uint64_t sample : {1u, 2u, 3u, 7u, 14u, 15u, 16u, 1000u}) {
    std::uint64_t played = 0;
    const auto others = verify(matrix, sample, 1, {}, played);
    EXPECT_EQ(played, std::min<std::uint64_t>(sample, 15)) << sample;
    ASSERT_EQ(others.size(), played);
    std::map<std::string, std::set<std::uint64_t>> numbers;
    for (const GoalMismatch& one : others) numbers[one.striker].insert(one.number);
    std::uint64_t different = 0;
    for (const auto& [striker, its] : numbers) {
      different += its.size();
      EXPECT_LE(its.size(), (played + 2) / 3) << striker;
    }
    EXPECT_EQ(different, played) << "none is played twice";
  }
}

}  // namespace
}  // namespace ortung
