// The lifecycle of a managed node, its bond, and its parameters, as their services tell them.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "Bond.hpp"
#include "Lifecycle.hpp"
#include "ParameterServices.hpp"

namespace ortung::ros2 {
namespace {

using State = Lifecycle::State;

// By the design of managed nodes: state, number of a transition, state after it.
constexpr std::array<std::array<int, 3>, 7> kDesign = {
    {{1, 1, 2}, {2, 2, 1}, {2, 3, 3}, {3, 4, 2}, {1, 5, 4}, {2, 6, 4}, {3, 7, 4}}};
const std::map<int, std::vector<std::uint8_t>> kWays = {{1, {}}, {2, {1}}, {3, {1, 3}}, {4, {5}}};

TEST(Lifecycle, HasTheTransitionsOfItsDesignAndNoOthers) {
  for (const auto& [state, way] : kWays) {
    for (int transition = 0; transition < 100; ++transition) {
      Lifecycle lifecycle(false);
      for (const std::uint8_t step : way) ASSERT_TRUE(lifecycle.change(step));
      ASSERT_EQ(static_cast<int>(lifecycle.state()), state);
      int expected = state;
      bool isOne = false;
      for (const auto& [from, number, to] : kDesign)
        if (from == state && number == transition) expected = to, isOne = true;
      EXPECT_EQ(lifecycle.change(static_cast<std::uint8_t>(transition)), isOne) << transition;
      EXPECT_EQ(static_cast<int>(lifecycle.state()), expected) << state << " " << transition;
    }
  }
}

TEST(Lifecycle, IsLedByLabelsToo) {
  Lifecycle lifecycle(false);
  EXPECT_FALSE(lifecycle.change(1, "activate")) << "the label counts";
  EXPECT_TRUE(lifecycle.change(0, "configure"));
  EXPECT_TRUE(lifecycle.change(0, "activate"));
  EXPECT_TRUE(lifecycle.change(0, "shutdown"));
  EXPECT_EQ(lifecycle.state(), State::kFinalized);
}

TEST(Lifecycle, BelongsToAManagerFromItsFirstWordOn) {
  std::vector<State> heard;
  Lifecycle lifecycle(true, [&](auto, State state) { heard.push_back(state); });
  EXPECT_EQ(lifecycle.state(), State::kActive);
  EXPECT_TRUE(lifecycle.change(1)) << "though it is active by itself";
  EXPECT_EQ(lifecycle.state(), State::kInactive);
  EXPECT_TRUE(lifecycle.change(3));
  EXPECT_FALSE(lifecycle.change(1)) << "now it is the manager's";
  EXPECT_EQ(heard, (std::vector{State::kInactive, State::kActive}));
}

TEST(Lifecycle, TellsItsGraph) {
  Lifecycle lifecycle(false);
  ASSERT_EQ(lifecycle.available().size(), 2U);
  EXPECT_EQ(lifecycle.available()[0].goal.label, "configuring");
  const auto graph = Lifecycle::graph();
  EXPECT_EQ(graph.size(), 28U);
  std::set<int> numbers;
  for (const auto& one : graph) numbers.insert(one.transition.id);
  EXPECT_EQ(numbers.size(), graph.size()) << "each has a number of its own";
  const auto states = Lifecycle::states();
  for (const auto& one : graph)
    for (const auto& end : {one.start, one.goal})
      EXPECT_TRUE(std::any_of(states.begin(), states.end(), [&](const auto& state) {
        return state.id == end.id && state.label == end.label;
      })) << end.label;
}

class BondTest : public testing::Test {
 protected:
  void SetUp() override {
    bond_.sendBy([this](std::string_view cdr) {
      BondStatus status;
      readCdr(cdr, status);
      said_.push_back(status);
    });
  }
  Bond::Clock::time_point at(double seconds) const {
    return begin_ + std::chrono::duration_cast<Bond::Clock::duration>(
                        std::chrono::duration<double>(seconds));
  }
  Bond bond_{"amcl", 0.1};
  Bond::Clock::time_point begin_ = Bond::Clock::now();
  std::vector<BondStatus> said_;
};

TEST_F(BondTest, BeatsWhileItLasts) {
  bond_.tick(at(0));
  EXPECT_TRUE(said_.empty()) << "not before it began";
  bond_.start(at(0));
  for (double t = 0.0; t < 1.0; t += 0.02) bond_.tick(at(t));
  EXPECT_NEAR(static_cast<double>(said_.size()), 10.0, 1.0);
  for (const BondStatus& status : said_) {
    EXPECT_TRUE(status.isActive);
    EXPECT_EQ(status.id, "amcl");
    EXPECT_EQ(status.instance, said_.front().instance);
    EXPECT_FLOAT_EQ(status.timeout, 4.0F);
    EXPECT_FLOAT_EQ(status.period, 0.1F);
  }
  said_.clear();
  bond_.stop(at(1));
  for (double t = 1.0; t < 5.0; t += 0.02) bond_.tick(at(t));
  EXPECT_GE(said_.size(), 3U) << "a message may be lost";
  EXPECT_LE(said_.size(), 8U) << "then it is quiet";
  for (const BondStatus& status : said_) EXPECT_FALSE(status.isActive);
  const std::string first = said_.front().instance;
  bond_.start(at(6));
  EXPECT_NE(said_.back().instance, first) << "another one";
}

TEST_F(BondTest, EndsWithTheOtherSide) {
  bond_.start(at(0));
  const BondStatus own = said_.back();
  const auto hear = [&](const std::string& id, const std::string& instance, bool isActive) {
    bond_.hear(cdrOf(BondStatus{{}, id, instance, isActive, 4.0F, 0.1F}), at(0.05));
  };
  hear("amcl", own.instance, false);  // its own words
  hear("map_server", "x", false);     // of another node
  hear("amcl", "x", true);
  EXPECT_EQ(said_.size(), 1U);
  hear("amcl", "x", false);
  ASSERT_EQ(said_.size(), 2U);
  EXPECT_FALSE(said_.back().isActive);
  EXPECT_THROW(bond_.hear("\0\1\0\0"), std::invalid_argument);
}

class ParameterServicesTest : public testing::Test {
 protected:
  NamedParameter number(const std::string& name, double value) const {
    NamedParameter one{name, {}};
    one.value.type = ParameterValue::kDouble;
    one.value.number = value;
    return one;
  }
  std::vector<SetParameterResult> set(const std::vector<NamedParameter>& wanted) {
    std::vector<SetParameterResult> results;
    readCdr(services_.set(cdrOf(wanted)), results);
    return results;
  }
  AmclParameters parameters_;
  std::vector<AmclSettings> heard_;
  ParameterServices services_{parameters_, "/amcl",
                              [this](const auto& settings) { heard_.push_back(settings); }};
};

TEST_F(ParameterServicesTest, SetWhatMayBeSet) {
  const auto results = set({number("transform_tolerance", 0.5), number("alpha1", -1),
                            number("nothing", 1), number("base_frame_id", 1)});
  ASSERT_EQ(results.size(), 4U);
  EXPECT_TRUE(results[0].isDone);
  EXPECT_FALSE(results[1].isDone);
  EXPECT_NE(results[1].reason.find("expected 0 to 100"), std::string::npos);
  EXPECT_NE(results[2].reason.find("none of that name"), std::string::npos);
  EXPECT_NE(results[3].reason.find("expected a text"), std::string::npos);
  ASSERT_EQ(heard_.size(), 1U);
  EXPECT_DOUBLE_EQ(heard_[0].transformTolerance, 0.5);
  NamedParameter frame{"base_frame_id", {}};
  frame.value.type = ParameterValue::kString;
  frame.value.text = "base";
  EXPECT_NE(set({frame})[0].reason.find("read-only"), std::string::npos);
  NamedParameter list{"alpha1", {}};
  list.value.type = 8;
  EXPECT_NE(set({list})[0].reason.find("found a list"), std::string::npos);
}

TEST_F(ParameterServicesTest, SetAllOrNone) {
  SetParameterResult result;
  readCdr(services_.setAtomically(
              cdrOf(std::vector{number("transform_tolerance", 0.5), number("alpha1", -1)})),
          result);
  EXPECT_FALSE(result.isDone);
  EXPECT_TRUE(heard_.empty());
  EXPECT_EQ(std::get<double>(parameters_.get("transform_tolerance")), 1.0);
  readCdr(services_.setAtomically(
              cdrOf(std::vector{number("transform_tolerance", 0.5), number("alpha1", 1)})),
          result);
  EXPECT_TRUE(result.isDone);
  EXPECT_EQ(std::get<double>(parameters_.get("alpha1")), 1.0);
}

TEST_F(ParameterServicesTest, TellThem) {
  using Names = std::vector<std::string>;
  const Names names = {"max_particles", "tf_broadcast", "odom_frame_id", "sigma_hit"};
  std::vector<ParameterValue> values;
  readCdr(services_.get(cdrOf(names)), values);
  ASSERT_EQ(values.size(), 4U);
  EXPECT_EQ(values[0].integer, 2000);
  EXPECT_TRUE(values[1].flag);
  EXPECT_EQ(values[2].text, "odom");
  EXPECT_EQ(values[3].number, 0.2);
  std::vector<std::uint8_t> types;
  readCdr(services_.types(cdrOf(names)), types);
  EXPECT_EQ(types, (std::vector<std::uint8_t>{2, 1, 4, 3}));
  std::vector<ParameterDescriptor> about;
  readCdr(services_.describe(cdrOf(names)), about);
  ASSERT_EQ(about.size(), 4U);
  EXPECT_TRUE(about[2].isReadOnly);
  EXPECT_NE(about[3].description.find("without effect"), std::string::npos);
  ASSERT_EQ(about[3].floatRange.size(), 1U);

  const auto list = [&](const Names& prefixes, std::uint64_t depth) {
    std::pair<Names, Names> found;
    readCdr(services_.list(cdrOf(prefixes, depth)), found.first, found.second);
    return found;
  };
  EXPECT_EQ(list({}, 0).first.size(), AmclParameters::all().size());
  EXPECT_EQ(list({}, 0).second, Names{"initial_pose"});
  EXPECT_EQ(list({"initial_pose"}, 0).first.size(), 10U);
  EXPECT_TRUE(list({"initial"}, 0).first.empty()) << "a prefix is a whole word";
  EXPECT_TRUE(list({}, 1).second.empty());
  EXPECT_EQ(list({"max_particles", "tf_broadcast"}, 1).first.size(), 2U);
}

}  // namespace
}  // namespace ortung::ros2
