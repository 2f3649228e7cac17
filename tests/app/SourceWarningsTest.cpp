// What users are told of a source after its end.
#include <gtest/gtest.h>

#include <functional>

#include "Console.hpp"
#include "SourceArguments.hpp"
#include "ortung/core/SensorContainer.hpp"

namespace ortung::app {
namespace {

/// Readings without words of features f1, f2, ...: one of the first, two of the second, ...
class Strangers : public Source {
 public:
  Strangers(int features, std::string remark) : remark_(std::move(remark)) {
    for (int i = 1; i <= features; ++i)
      for (int k = 0; k < i; ++k) messages_.push_back({k, {"m", "t", "f" + std::to_string(i)}, {}});
    std::ranges::stable_sort(messages_, {}, &Message::stamp);
  }
  ~Strangers() override = default;
  bool next(Message& message) override {
    if (next_ == messages_.size()) return false;
    message = messages_[next_++];
    return true;
  }
  std::string remark() const override { return remark_; }

 private:
  std::string remark_;
  std::vector<Message> messages_;
  std::size_t next_ = 0;
};

std::string warningsOf(int features, const std::string& remark) {
  Strangers source(features, remark);
  SensorContainer container;
  Feeder feeder("log", source, container);
  while (feeder.next()) {
  }
  setCommandName("ortung eval");
  testing::internal::CaptureStderr();
  warnOf("record:run.rec", source, feeder);
  return testing::internal::GetCapturedStderr();
}

TEST(SourceWarnings, NothingIsSaidWhereAllIsWell) { EXPECT_EQ(warningsOf(0, ""), ""); }

TEST(SourceWarnings, FeaturesThatTheRobotLacksAreNamedAndCounted) {
  const std::string begin =
      "ortung eval: warning: record:run.rec has features that are not in the robot file: ";
  EXPECT_EQ(warningsOf(2, ""), begin + "m/t/f1 (1 readings), m/t/f2 (2 readings)\n");
  const std::string five =
      "m/t/f1 (1 readings), m/t/f2 (2 readings), m/t/f3 (3 readings), m/t/f4 (4 readings), m/t/f5 "
      "(5 readings)";
  EXPECT_EQ(warningsOf(5, ""), begin + five + "\n");
  EXPECT_EQ(warningsOf(7, ""), begin + five + " and 2 more\n");
}

TEST(SourceWarnings, TheSourcesOwnRemarkComesFirst) {
  EXPECT_TRUE(warningsOf(1, "the log is\ntorn")
                  .starts_with("ortung eval: warning: the log is\\x0atorn\nortung eval: warning: "
                               "record:run.rec has"));
}

}  // namespace
}  // namespace ortung::app
