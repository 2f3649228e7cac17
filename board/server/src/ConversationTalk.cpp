// Greetings, clocks, lists, and what clients tell each other.
#include <algorithm>
#include <cmath>

#include "Conversation.hpp"
#include "ortung/server/DescribeText.hpp"

namespace ortung::server {
namespace {

using Reply = std::optional<std::string>;

constexpr std::int64_t kMostGoals = 999;
constexpr double kLastRobot = 0xFFFFFFFF;
constexpr const char* kWrongToken = "ERR token it is missing or wrong";

void addLine(std::string& lines, std::size_t& count, const std::string& line) {
  lines += line + '\n';
  ++count;
}

}  // namespace

Conversation::Role Conversation::parseRole(const std::string& text) {
  for (const Role role : {Role::kViewer, Role::kPlayer, Role::kOperator})
    if (text == toText(role)) return role;
  throw ServeError("syntax", "a role is viewer, player or operator");
}

void Conversation::hello(Request& request) {
  if (hasJoined_) throw ServeError("state", "HELLO was said already");
  const std::string version = request.takeWord("the version of the protocol: HELLO ortung/1");
  if (version != "ortung/1")
    throw ServeError("version", "found '" + printable(version) + "', this server speaks ortung/1");
  Greeting greeting{.tag = request.tag(),
                    .name = request.takeText("name").value_or("guest"),
                    .token = request.takeText("token").value_or(""),
                    .role = {}};
  if (const auto role = request.takeText("role")) greeting.role = parseRole(*role);
  request.refuseRest();
  if (!isName(greeting.name))
    throw ServeError("syntax", "a client's name is 1 to 32 of [A-Za-z0-9_-]");
  const Timestamp pause = host_.door.pause(outlet_->peer(), received_);
  if (pause == 0) {
    checkToken(greeting);
    return;
  }
  greeting.due = received_ + pause;
  greeting_ = std::move(greeting);
  ++waiting_;
}

void Conversation::checkToken(const Greeting& greeting) {
  if (host_.door.isRight(greeting.name, greeting.token)) {
    join(greeting);
    return;
  }
  const Timestamp now = wallTime();
  host_.door.refuse(outlet_->peer(), greeting.name, now);
  const bool hasWaited = greeting.due != 0;
  if (hasWaited) {
    dismiss(kWrongToken);
    return;
  }
  greeting_ = greeting;
  greeting_->due = now + host_.door.pause(outlet_->peer(), now);
  greeting_->isRefused = true;
  ++waiting_;
}

/// A greeting that had to wait.
void Conversation::look(Timestamp now) {
  if (!greeting_ || isOver_ || now < greeting_->due) return;
  const Greeting greeting = *std::exchange(greeting_, std::nullopt);
  --waiting_;
  if (greeting.isRefused) {
    dismiss(kWrongToken);
    return;
  }
  try {
    checkToken(greeting);
  } catch (...) {
    refuse(greeting.tag, currentErrorText());
  }
  goOn();
}

void Conversation::join(const Greeting& greeting) {
  const Role most = host_.door.mayControl(greeting.name) ? Role::kOperator : Role::kPlayer;
  const Role role = greeting.role.value_or(most);
  if (role > most)
    throw ServeError("role", "'" + greeting.name + "' may not control; see --allow-control");
  name_ = greeting.name;
  role_ = role;
  hasJoined_ = true;
  order(greeting.tag, [id = id_, name = name_, role, host = &host_](WorldKeeper& keeper,
                                                                    WorldKeeper::Done&) {
    keeper.join(id, name, role == Role::kOperator);
    return Reply("OK HELLO ortung/1 client=" + std::to_string(id) + " role=" + toText(role) +
                 " kind=" + host->description.kind + " world=" + oneWord(host->description.name) +
                 " now=" + std::to_string(keeper.clock().at(wallTime())) +
                 " state=" + keeper.stateText());
  });
}

void Conversation::bye(Request& request) {
  request.refuseRest();
  answer(request.tag(), [tag = request.tag()](Conversation& self) {
    self.reply(tag, "OK BYE");
    self.hangUp();
    self.outlet_->finish();
  });
}

void Conversation::help(Request& request) {
  request.refuseRest();
  std::string lines;
  for (const Command& command : commands())
    lines += std::string(command.name) + (*command.help != 0 ? " " : "") + command.help + '\n';
  const auto& added = host_.config.commands;
  for (const BoardCommand& command : added)
    lines += command.name + (command.help.empty() ? "" : " ") + command.help + '\n';
  const std::size_t count = commands().size() + added.size();
  answer(request.tag(), [tag = request.tag(), lines, count](Conversation& self) {
    self.reply(tag, "OK HELP lines=" + std::to_string(count), lines);
  });
}

void Conversation::time(Request& request) {
  request.refuseRest();
  const BoardClock& clock = host_.keeper.clock();
  const std::string received = std::to_string(clock.at(received_));
  answer(request.tag(), [tag = request.tag(), received](Conversation& self) {
    const Timestamp sent = self.host_.keeper.clock().at(wallTime());
    self.reply(tag, "OK TIME received=" + received + " sent=" + std::to_string(sent));
  });
}

void Conversation::status(Request& request) {
  request.refuseRest();
  order(request.tag(), [](WorldKeeper& keeper, WorldKeeper::Done&) {
    const BoardStatistics statistics = keeper.statistics();
    return Reply("OK STATUS state=" + keeper.stateText() +
                 " now=" + std::to_string(keeper.clock().at(wallTime())) +
                 " cycles=" + std::to_string(statistics.cycles) +
                 " missed=" + std::to_string(statistics.missedCycles) +
                 " clients=" + std::to_string(statistics.clients) +
                 " robots=" + std::to_string(statistics.robots) + keeper.paceText());
  });
}

void Conversation::list(Request& request) {
  const std::string what = request.takeWord("worlds, plugins, clients or robots");
  request.refuseRest();
  if (what != "worlds" && what != "plugins" && what != "clients" && what != "robots")
    throw ServeError("syntax", "LIST knows worlds, plugins, clients and robots");
  auto lines = std::make_shared<std::string>();
  order(
      request.tag(),
      [what, lines, host = &host_](WorldKeeper& keeper, WorldKeeper::Done&) {
        std::size_t count = 0;
        if (what == "worlds") addLine(*lines, count, "world=" + oneWord(host->description.name));
        if (what == "plugins")
          for (const std::string& plugin : host->plugins)
            addLine(*lines, count, "plugin=" + plugin);
        if (what == "clients")
          for (const auto& [id, client] : keeper.clients())
            addLine(*lines, count,
                    "client=" + std::to_string(id) + " name=" + client.name +
                        " robots=" + std::to_string(client.robots.size()) +
                        " lockstep=" + (client.isLockstep ? "on" : "off"));
        if (what == "robots")
          for (const auto& [id, robot] : keeper.robots())
            addLine(*lines, count,
                    "robot=" + std::to_string(id) + " name=" + robot.readings->name() +
                        " client=" + std::to_string(robot.owner) + keeper.world().side(id));
        return Reply("OK LIST lines=" + std::to_string(count));
      },
      [lines](Conversation& self, const std::string& tag, const std::string& text) {
        self.reply(tag, text, *lines);
      });
}

void Conversation::describe(Request& request) {
  const std::string what = request.takeWord("world, field, robot, robots or players");
  if (what == "world" || what == "field" || what == "players" || what == "robots") {
    request.refuseRest();
    if (what == "world") describeWorld(request.tag());
    if (what == "field") describeField(request.tag());
    if (what == "players") describeKinds(request.tag(), host_.players);
    if (what == "robots") describeKinds(request.tag(), host_.robotKinds);
    return;
  }
  if (what != "robot")
    throw ServeError("syntax", "DESCRIBE knows world, field, robot, robots and players");
  const RobotId robot = takeRobot(request, true);
  request.refuseRest();
  auto lines = std::make_shared<std::string>();
  order(
      request.tag(),
      [robot, lines](WorldKeeper& keeper, WorldKeeper::Done&) {
        std::size_t count = 0;
        const std::vector<std::string> abilities =
            robot == 0 ? std::vector<std::string>() : keeper.world().abilities(robot);
        for (const std::string& line : robotText(keeper.readings(robot)->features(), abilities))
          addLine(*lines, count, line);
        return Reply("OK DESCRIBE lines=" + std::to_string(count));
      },
      [lines](Conversation& self, const std::string& tag, const std::string& text) {
        self.reply(tag, text, *lines);
      });
}

void Conversation::describeWorld(const std::string& tag) {
  std::string lines;
  std::size_t count = 0;
  for (const std::string& line : worldText(host_.description)) addLine(lines, count, line);
  answer(tag, [tag, lines, count](Conversation& self) {
    self.reply(tag, "OK DESCRIBE lines=" + std::to_string(count), lines);
  });
}

/// Large maps have many walls: it is put together where it is known, and sent at once.
void Conversation::describeField(const std::string& tag) {
  auto lines = std::make_shared<std::string>();
  order(
      tag,
      [lines](WorldKeeper& keeper, WorldKeeper::Done&) {
        std::size_t count = 0;
        for (const std::string& line : keeper.world().field())
          addLine(*lines, count, printable(line, kLongestDescription));
        return Reply("OK DESCRIBE lines=" + std::to_string(count));
      },
      [lines](Conversation& self, const std::string& itsTag, const std::string& text) {
        self.reply(itsTag, text, *lines);
      });
}

void Conversation::describeKinds(const std::string& tag, const std::vector<std::string>& kinds) {
  std::string lines;
  std::size_t count = 0;
  for (const std::string& line : kinds) addLine(lines, count, printable(line, kLongestDescription));
  const std::string head =
      count == 0 ? "OK DESCRIBE" : "OK DESCRIBE lines=" + std::to_string(count);
  answer(tag, [tag, lines, head](Conversation& self) { self.reply(tag, head, lines); });
}

void Conversation::say(Request& request) {
  const std::string& text = request.rest();
  if (text.size() > host_.config.limits.say)
    throw ServeError(
        "limit", "a text to SAY has at most " + std::to_string(host_.config.limits.say) + " bytes");
  answer(request.tag(), [tag = request.tag(), text](Conversation& self) {
    const Timestamp now = wallTime();
    const double wait = std::max(self.talk_.wait(now), self.host_.talk.wait(now));
    if (wait > 0.0) {
      self.error(tag, "ERR limit that is too much talk for all who hear it; say it again in " +
                          std::to_string(std::lround(std::ceil(wait * 1e3))) + " ms");
      return;
    }
    const std::string line =
        "SAY client=" + std::to_string(self.id_) + " name=" + self.name_ + " " + text;
    const auto listeners = static_cast<double>(self.host_.listeners(self.id_));
    const auto bytes = static_cast<double>(line.size());
    self.talk_.spend(std::max(1.0, listeners), bytes * std::max(1.0, listeners));
    self.host_.talk.spend(listeners, bytes * listeners);
    self.host_.spread(self.id_, line);
    self.reply(tag, "OK SAY");
  });
}

void Conversation::tellTeam(Request& request) {
  const RobotId robot = owned_.empty() ? 0 : *owned_.begin();
  std::string text = request.rest();
  RobotId teller = robot;
  if (text.starts_with("robot=")) {
    const std::string number = text.substr(6, text.find(' ') - 6);
    teller = static_cast<RobotId>(parseNumber(number, "robot", 1.0, kLastRobot));
    text = text.substr(std::min(text.size(), 6 + number.size() + 1));
  }
  if (teller == 0) throw ServeError("no-robot", "this client has no robot; CREATE makes one");
  order(request.tag(), [id = id_, teller, text](WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.checkOwner(id, teller);
    keeper.world().tell(teller, text);
    return Reply("OK TELL");
  });
}

void Conversation::hearTeam(Request& request) {
  const RobotId robot = takeRobot(request);
  request.refuseRest();
  auto lines = std::make_shared<std::string>();
  order(
      request.tag(),
      [id = id_, robot, lines](WorldKeeper& keeper, WorldKeeper::Done&) {
        keeper.checkOwner(id, robot);
        const std::vector<ServedTalk> talk = keeper.world().takeHeard(robot);
        for (const ServedTalk& one : talk)
          *lines += std::to_string(one.stamp) + " " + oneWord(one.from) + " " + one.text + "\n";
        return Reply("OK HEAR robot=" + std::to_string(robot) +
                     " lines=" + std::to_string(talk.size()));
      },
      [lines](Conversation& self, const std::string& tag, const std::string& text) {
        self.reply(tag, text, *lines);
      });
}

void Conversation::score(Request& request) {
  const auto left = request.takeInteger("left", 0, kMostGoals);
  const auto right = request.takeInteger("right", 0, kMostGoals);
  request.refuseRest();
  if ((left || right) && role_ != Role::kOperator)
    throw ServeError("role", "setting the SCORE needs the role operator");
  order(request.tag(), [left, right](WorldKeeper& keeper, WorldKeeper::Done&) {
    if (left) keeper.score.left = static_cast<int>(*left);
    if (right) keeper.score.right = static_cast<int>(*right);
    return Reply("OK SCORE left=" + std::to_string(keeper.score.left) +
                 " right=" + std::to_string(keeper.score.right));
  });
}

}  // namespace ortung::server
