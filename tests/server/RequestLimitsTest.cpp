// Limits of the numbers in requests: the limit itself is taken, what is beyond it is refused.
#include <gtest/gtest.h>

#include "Command.hpp"
#include "FakeHost.hpp"
#include "RunningBoard.hpp"

namespace ortung::test {
namespace {

struct Limit {
  std::string request;  ///< with @ where the number stands
  std::string what;
  std::vector<std::string> fine;
  std::vector<std::string> wrong;
};

/// What an operator with a robot, in lockstep, is answered first.
std::string answerTo(const std::string& request) {
  CountingWorld world;
  FakeHost host(world, controlledConfig());
  auto [client, outlet] = host.join("operator");
  client.receive("CREATE r\n" + kAnyRobot + ".\nLOCKSTEP on\n");
  if (request.starts_with("STEP")) client.receive("PAUSE\n");
  host.settle();
  host.told.clear();
  client.receive(request + "\n" + (request.starts_with("CREATE") ? kAnyRobot + ".\n" : ""));
  host.settle();
  return host.told.empty() ? "" : host.told.front().second;
}

TEST(RequestLimits, AreThoseThatRefusalsTell) {
  const std::vector<Limit> limits = {
      {"VELOCITY v_m_s=@", "v_m_s", {"-1000", "1000"}, {"-1000.001", "1000.001"}},
      {"VELOCITY w_rad_s=@", "w_rad_s", {"-1000", "1000"}, {"-1000.001", "1000.001"}},
      {"VELOCITY v_m_s=0 robot=@", "robot", {"1", "4294967295"}, {"0", "4294967296"}},
      {"SUBSCRIBE period_s=@", "period_s", {"0", "3600"}, {"-0.001", "3600.001"}},
      {"NEXT cycles=@", "cycles", {"1", "1000000"}, {"0", "1000001"}},
      {"STEP cycles=@", "cycles", {"1", "1000000"}, {"0", "1000001"}},
      {"SPEED @", "the speed", {"0", "0.001", "1000"}, {"-1", "0.0009", "1000.001"}},
      {"SCORE left=@", "left", {"0", "999"}, {"-1", "1000"}},
      {"SCORE right=@", "right", {"0", "999"}, {"-1", "1000"}},
      {"RESET seed=@", "seed", {"0", "18446744073709551615"}, {"-1", "18446744073709551616"}},
      {"PLACE robot=1 x_m=@ y_m=0", "x_m", {"-1e6", "1e6"}, {"-1000001", "1000001"}},
      {"PLACE robot=1 x_m=0 y_m=@", "y_m", {"-1e6", "1e6"}, {"-1000001", "1000001"}},
      {"PLACE robot=1 x_m=0 y_m=0 theta_deg=@",
       "theta_deg",
       {"-360", "360"},
       {"-360.001", "360.001"}},
      {"PLACE robot=1 x_m=0 y_m=0 theta_rad=@", "theta_rad", {"-7", "7"}, {"-7.001", "7.001"}},
      {"CREATE b x_m=@ y_m=0", "x_m", {"-1e6", "1e6"}, {"-1000001", "1000001"}},
      {"MOTION 0 @", "a number of the command", {"-1000", "1e3"}, {"-1000.001", "1000.001"}}};
  for (const Limit& limit : limits) {
    const auto answer = [&](const std::string& number) {
      std::string request = limit.request;
      return answerTo(request.replace(request.find('@'), 1, number));
    };
    for (const std::string& number : limit.fine)
      EXPECT_TRUE(answer(number).find("ERR") == std::string::npos ||
                  answer(number) == "ERR no-robot there is no robot 4294967295")
          << limit.request << " " << number << ": " << answer(number);
    for (const std::string& number : limit.wrong)
      EXPECT_TRUE(answer(number).starts_with("ERR number " + limit.what + " is "))
          << limit.request << " " << number << ": " << answer(number);
  }
}

// A word that is passed over is a mistake that nobody hears of.
TEST(RequestLimits, NoCommandTakesAWordThatItDoesNotKnow) {
  const std::map<std::string, std::vector<std::string>> requests = {
      {"HELP", {"HELP"}},
      {"BYE", {"BYE"}},
      {"TIME", {"TIME"}},
      {"STATUS", {"STATUS"}},
      {"LIST", {"LIST worlds", "LIST plugins", "LIST clients", "LIST robots"}},
      {"DESCRIBE", {"DESCRIBE world", "DESCRIBE robot robot=1"}},
      {"CREATE", {"CREATE b"}},
      {"REMOVE", {"REMOVE", "REMOVE robot=1"}},
      {"VELOCITY", {"VELOCITY v_m_s=0"}},
      {"MANIPULATOR", {"MANIPULATOR kicker 1"}},
      {"SUBSCRIBE", {"SUBSCRIBE period_s=1"}},
      {"UNSUBSCRIBE", {"UNSUBSCRIBE", "UNSUBSCRIBE robot=1"}},
      {"GOT", {"GOT"}},
      {"LOCKSTEP", {"LOCKSTEP on", "LOCKSTEP off"}},
      {"NEXT", {"NEXT cycles=2"}},
      {"UPDATE", {"UPDATE"}},
      {"READ", {"READ"}},
      {"HEAR", {"HEAR"}},
      {"SCORE", {"SCORE", "SCORE left=1"}},
      {"PAUSE", {"PAUSE"}},
      {"RESUME", {"RESUME"}},
      {"STEP", {"STEP", "STEP cycles=2"}},
      {"SPEED", {"SPEED 2"}},
      {"RESET", {"RESET", "RESET seed=1"}},
      {"SEEK", {"SEEK time_s=1"}},
      {"PLACE", {"PLACE robot=1 x_m=1 y_m=1", "PLACE object=ball x_m=1 y_m=1"}}};
  const std::set<std::string> others = {"HELLO", "TELL", "SAY", "MOTION"};  // of texts and numbers
  const server::CommandTable table;
  for (const server::Command& command : table.all()) {
    if (others.contains(command.name)) continue;
    ASSERT_TRUE(requests.contains(command.name)) << command.name << " has no request here";
    for (const std::string& request : requests.at(command.name)) {
      const std::string answer = answerTo(request + " surplus=1");
      EXPECT_EQ(answer, "ERR syntax " + command.name + " does not know 'surplus='");
    }
  }
}

}  // namespace
}  // namespace ortung::test
