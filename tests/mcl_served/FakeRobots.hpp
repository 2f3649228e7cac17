#pragma once

#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "ortung/mcl_served/LocalizationCommands.hpp"

namespace ortung::test {

/// One robot, number 7, that a test has filled; notes what it is told.
class FakeRobots final : public LocalizedRobots {
 public:
  explicit FakeRobots(std::shared_ptr<const Robot> robot = nullptr) : robot_(std::move(robot)) {}
  ~FakeRobots() override = default;
  std::optional<RobotId> usual() const override {
    return hasUsual ? std::optional(7U) : std::nullopt;
  }
  bool isForAll() const override { return false; }
  LocalizationState state(RobotId robot) override {
    check(robot);
    return {LocalizationState::Kind::kLearning, 0.5, ""};
  }
  void order(RobotId robot, const LocalizationOrder& order) override {
    check(robot);
    orders.push_back(order);
  }
  std::shared_ptr<const Robot> perceiver(RobotId robot) const override {
    check(robot);
    if (!robot_) throw ServeError("state", "it is off");
    return robot_;
  }

  bool hasUsual = true;
  std::vector<LocalizationOrder> orders;

 private:
  static void check(RobotId robot) {
    if (robot != 7) throw ServeError("no-robot", "there is no such robot");
  }
  std::shared_ptr<const Robot> robot_;
};

/// What a client says, with the answers as they go over the wire: "ERR code text", or the words.
class Asking {
 public:
  explicit Asking(LocalizedRobots& robots) : commands_(localizationCommands(robots)) {}
  BoardCommand::Reply ask(const std::string& line,
                          BoardCommand::Role role = BoardCommand::Role::kOperator) const {
    BoardCommand::Call call;
    call.role = role;
    std::string name;
    std::istringstream in(line);
    in >> name;
    for (std::string word; in >> word;) {
      const std::size_t end = word.find('=');
      if (end == word.npos)
        call.words.push_back(word);
      else
        call.keys[word.substr(0, end)] = word.substr(end + 1);
    }
    for (const BoardCommand& command : commands_)
      if (command.name == name) return command.handle(call);
    throw std::logic_error("no command " + name);
  }
  std::string words(const std::string& line,
                    BoardCommand::Role role = BoardCommand::Role::kOperator) const {
    try {
      return ask(line, role).words;
    } catch (const ServeError& error) {
      return "ERR " + error.code() + " " + error.what();
    } catch (const std::invalid_argument& error) {
      return std::string("ERR argument ") + error.what();
    }
  }

 private:
  std::vector<BoardCommand> commands_;
};

}  // namespace ortung::test
