// What a client does with its robots: configuration, commands, readings, lockstep.
#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "Conversation.hpp"
#include "ortung/robot/NetworkRobot.hpp"

namespace ortung::server {
namespace {

constexpr double kMostSpeed = 1e3;  ///< of any command [m/s, rad/s]; drives have their own limits
constexpr double kLongestPeriod = 3600.0;  // [s]
constexpr std::int64_t kMostCycles = 1'000'000;
constexpr std::int64_t kLastRobot = 0xFFFFFFFF;
constexpr std::int64_t kMostAhead = 1000;
constexpr std::size_t kMostSubscriptions = 64;

using Reply = std::optional<std::string>;

/// Gives what a robot does not take a code of its own.
template <class Command>
void refusedAs(const char* code, const Command& command) {
  try {
    command();
  } catch (const std::invalid_argument& error) {
    throw ServeError(code, error.what());
  }
}

}  // namespace

/// robot=N, or the client's first; the only one of a live world.
RobotId Conversation::takeRobot(Request& request, bool orWorld) const {
  if (const auto robot = request.takeInteger("robot", orWorld ? 0 : 1, kLastRobot))
    return static_cast<RobotId>(*robot);
  if (owned_.empty() && host_.liveRobot != 0) return host_.liveRobot;
  if (owned_.empty()) throw ServeError("no-robot", "this client has no robot; CREATE makes one");
  return *owned_.begin();
}

// --- creating and removing

void Conversation::create(Request& request) {
  if (host_.liveRobot != 0)
    throw ServeError("live", "this is a running robot: no other can join it");
  RobotWish wish;
  wish.name = request.takeWord("a name for the robot");
  if (!isName(wish.name)) throw ServeError("syntax", "a robot's name is 1 to 32 of [A-Za-z0-9_-]");
  wish.start = request.takePose();
  const std::string drive = request.takeText("drive").value_or("commands");
  if (drive != "commands" && drive != "wander")
    throw ServeError("syntax", "drive is '" + printable(drive) + "', expected commands or wander");
  wish.wanders = drive == "wander";
  wish.team = request.takeText("team").value_or("");
  if (!wish.team.empty() && !isName(wish.team))
    throw ServeError("syntax", "a team is 1 to 32 of [A-Za-z0-9_-]");
  request.refuseRest();
  configuration_ = Configuration{request.tag(), std::move(wish), {}, {}};
}

void Conversation::handleConfigurationLine(std::string_view line) {
  if (line == ".") {
    finishConfiguration();
    return;
  }
  if (line.starts_with('.')) line.remove_prefix(1);  // as in mail: a text's own dot is doubled
  std::string& text = configuration_->text;
  if (text.size() + line.size() + 1 > host_.config.limits.configuration) {
    if (configuration_->fault.empty())
      configuration_->fault = "ERR limit a robot file has at most " +
                              std::to_string(host_.config.limits.configuration) + " bytes";
    text.clear();
    return;
  }
  text.append(line).append("\n");
}

/// Reads the robot file. That takes a while for a nasty one, so it is done elsewhere.
void Conversation::finishConfiguration() {
  auto configuration = std::make_shared<Configuration>(std::move(*configuration_));
  configuration_.reset();
  if (!configuration->fault.empty()) {
    refuse(configuration->tag, configuration->fault);
    return;
  }
  ++waiting_;
  host_.work([weak = weak_from_this(), host = &host_, configuration] {
    try {
      readConfiguration(*configuration, *host);
    } catch (...) {
      configuration->fault = currentErrorText();
    }
    host->post([weak, configuration] {
      const auto self = weak.lock();
      if (!self) return;
      --self->waiting_;
      if (self->isOver_) return;
      if (configuration->fault.empty())
        self->createRobot(configuration->tag, std::move(configuration->wish));
      else
        self->refuse(configuration->tag, configuration->fault);
      self->goOn();
    });
  });
}

void Conversation::readConfiguration(Configuration& configuration, const Host& host) {
  RobotConfig& config = configuration.wish.config;
  config = readNetworkRobot(configuration.text, "robot file", host.plugins);
  const std::size_t most = host.config.limits.sensors;
  if (config.sensors.size() > most)
    throw ServeError("limit", "the robot has " + std::to_string(config.sensors.size()) +
                                  " sensors, at most " + std::to_string(most) + " are permitted");
  config.name = configuration.wish.name;
}

void Conversation::createRobot(const std::string& tag, RobotWish wanted) {
  auto created = std::make_shared<std::shared_ptr<RobotReadings>>();
  auto wish = std::make_shared<RobotWish>(std::move(wanted));
  order(
      tag,
      [id = id_, wish, created](WorldKeeper& keeper, WorldKeeper::Done&) {
        *created = keeper.createRobot(id, std::move(*wish));
        return Reply("");
      },
      [created](Conversation& self, const std::string& itsTag, const std::string&) {
        const RobotId robot = (*created)->robot();
        self.owned_.insert(robot);
        self.views_[robot].readings = *created;
        self.reply(itsTag, "OK CREATE robot=" + std::to_string(robot) +
                               " features=" + std::to_string((*created)->features().size()));
      },
      true);
}

void Conversation::remove(Request& request) {
  const RobotId robot = takeRobot(request);
  request.refuseRest();
  order(
      request.tag(),
      [id = id_, robot](WorldKeeper& keeper, WorldKeeper::Done&) {
        keeper.removeRobot(id, robot);
        return Reply("");
      },
      [robot](Conversation& self, const std::string& tag, const std::string&) {
        self.owned_.erase(robot);
        self.views_.erase(robot);
        self.endSubscription(robot);
        self.reply(tag, "OK REMOVE");
      },
      true);
}

// --- commands

void Conversation::velocity(Request& request) {
  const auto v = request.takeNumber("v_m_s", -kMostSpeed, kMostSpeed);
  const auto w = request.takeNumber("w_rad_s", -kMostSpeed, kMostSpeed);
  const RobotId robot = takeRobot(request);
  request.refuseRest();
  if (!v && !w) throw ServeError("syntax", "VELOCITY needs v_m_s or w_rad_s");
  order(request.tag(), [id = id_, robot, v, w](WorldKeeper& keeper, WorldKeeper::Done&) {
    RobotCommands& commands = keeper.commands(id, robot);
    if (v) commands.setTranslationalVelocity(*v);
    if (w) commands.setRotationalVelocity(*w);
    return Reply("OK VELOCITY");
  });
}

void Conversation::motion(Request& request) {
  const RobotId robot = takeRobot(request);
  std::vector<double> command;
  for (const std::string& word : request.takeWords())
    command.push_back(parseNumber(word, "a number of the command", -kMostSpeed, kMostSpeed));
  request.refuseRest();
  if (command.empty()) throw ServeError("syntax", "MOTION needs numbers");
  order(request.tag(), [id = id_, robot, command](WorldKeeper& keeper, WorldKeeper::Done&) {
    RobotCommands& commands = keeper.commands(id, robot);
    refusedAs("number", [&] { commands.setMotion(command); });
    return Reply("OK MOTION");
  });
}

void Conversation::manipulator(Request& request) {
  const RobotId robot = takeRobot(request);
  const std::string name = request.takeWord("the manipulator's name");
  const std::string state = request.takeWord("a state");
  request.refuseRest();
  if (!isName(name) || !isName(state))
    throw ServeError("syntax", "a manipulator and its state are 1 to 32 of [A-Za-z0-9_-]");
  order(request.tag(), [id = id_, robot, name, state](WorldKeeper& keeper, WorldKeeper::Done&) {
    RobotCommands& commands = keeper.commands(id, robot);
    refusedAs("no-manipulator", [&] { commands.setManipulator(name, state); });
    return Reply("OK MANIPULATOR");
  });
}

// --- readings

Choice Conversation::takeChoice(Request& request, bool again) const {
  Choice choice;
  choice.again = again;
  const std::string form = request.takeText("form").value_or("text");
  if (form != "text" && form != "binary")
    throw ServeError("syntax", "form is '" + printable(form) + "', expected text or binary");
  choice.binary = form == "binary";
  const std::vector<std::string> words = request.takeWords();
  const std::size_t most = host_.config.limits.queries;
  if (words.size() > most)
    throw ServeError("limit", "a request has at most " + std::to_string(most) + " queries");
  for (const std::string& word : words) choice.queries.emplace_back(word);
  return choice;
}

void Conversation::sendReadings(const std::string& tag, const char* command, RobotId robot,
                                const Choice& choice) {
  const auto view = views_.find(robot);
  if (view == views_.end()) {
    error(tag, "ERR no-robot there is no robot " + std::to_string(robot) + " of this client");
    return;
  }
  Output body;
  const Written written = view->second.readings->write(choice, view->second.sent, body);
  std::string head = tag == "*" ? "" : "OK ";  // a push answers nothing
  head.append(command).append(" robot=").append(std::to_string(robot));
  head.append(" now=").append(std::to_string(host_.keeper.clock().at(wallTime())));
  if (choice.binary) head.append(" bytes=").append(std::to_string(body.size()));
  head.append(choice.binary ? " readings=" : " lines=").append(std::to_string(written.readings));
  if (written.leftOut > 0) head.append(" left_out=").append(std::to_string(written.leftOut));
  if (body.readingBytes() > 0)
    reply(tag, head, std::move(body));
  else
    reply(tag, head, body.isEmpty() ? "" : body.text());
}

/// Players play against each other; a live robot has no opponents.
void Conversation::checkMayWatch(RobotId robot) const {
  if (role_ == Role::kPlayer && !owned_.contains(robot) && host_.liveRobot == 0)
    throw ServeError("not-yours", "players see the readings of their own robots only");
}

/// The readings of another client's robot, which operators and viewers may see.
void Conversation::foreignReadings(const std::string& tag, const char* command, RobotId robot,
                                   const Choice& choice) {
  checkMayWatch(robot);
  auto found = std::make_shared<std::shared_ptr<RobotReadings>>();
  order(
      tag,
      [robot, found](WorldKeeper& keeper, WorldKeeper::Done&) {
        *found = keeper.readings(robot);
        return Reply("");
      },
      [robot, found, choice, command](Conversation& self, const std::string& itsTag,
                                      const std::string&) {
        self.views_[robot].readings = *found;
        self.sendReadings(itsTag, command, robot, choice);
        if (!self.subscriptions_.contains(robot))
          self.views_.erase(robot);  // it may leave the field at any time
      });
}

void Conversation::fetch(Request& request, bool again) {
  const char* command = again ? "READ" : "UPDATE";
  const RobotId robot = takeRobot(request, true);
  const Choice choice = takeChoice(request, again);
  request.refuseRest();
  if (!owned_.contains(robot)) {
    foreignReadings(request.tag(), command, robot, choice);
    return;
  }
  answer(request.tag(), [tag = request.tag(), command, robot, choice](Conversation& self) {
    self.sendReadings(tag, command, robot, choice);
  });
}

void Conversation::update(Request& request) { fetch(request, false); }
void Conversation::read(Request& request) { fetch(request, true); }

void Conversation::subscribe(Request& request) {
  Subscription wanted;
  wanted.period = fromSeconds(request.takeNumber("period_s", 0.0, kLongestPeriod).value_or(0.0));
  wanted.ahead = request.takeInteger("ahead", 1, kMostAhead).value_or(0);
  const RobotId robot = takeRobot(request, true);
  wanted.choice = takeChoice(request, false);
  request.refuseRest();
  checkMayWatch(robot);
  auto found = std::make_shared<std::shared_ptr<RobotReadings>>();
  order(
      request.tag(),
      [robot, found](WorldKeeper& keeper, WorldKeeper::Done&) {
        *found = keeper.readings(robot);
        return Reply("");
      },
      [robot, found, wanted](Conversation& self, const std::string& tag, const std::string&) {
        if (self.subscriptions_.size() >= kMostSubscriptions &&
            !self.subscriptions_.contains(robot)) {
          self.error(tag, "ERR limit a client has at most " + std::to_string(kMostSubscriptions) +
                              " subscriptions");
          return;
        }
        self.views_[robot].readings = *found;
        if (self.subscriptions_.empty()) self.host_.countSubscribers(1);
        self.subscriptions_[robot] = wanted;
        self.reply(tag, "OK SUBSCRIBE robot=" + std::to_string(robot));
      });
}

void Conversation::unsubscribe(Request& request) {
  const auto robot = request.takeInteger("robot", 0, kLastRobot);
  request.refuseRest();
  answer(request.tag(), [tag = request.tag(), robot](Conversation& self) {
    if (robot)
      self.endSubscription(static_cast<RobotId>(*robot));
    else
      self.endSubscriptions();
    self.reply(tag, "OK UNSUBSCRIBE");
  });
}

/// The client has read an update, so that another one may be sent to it.
void Conversation::got(Request& request) {
  const RobotId robot = takeRobot(request, true);
  request.refuseRest();
  answer(request.tag(), [tag = request.tag(), robot](Conversation& self) {
    self.reply(tag, "OK GOT");
    const auto found = self.subscriptions_.find(robot);
    if (found == self.subscriptions_.end() || found->second.unread == 0) return;
    --found->second.unread;
    // A world that stands has no next cycle with which it would come.
    if (std::exchange(found->second.isOwed, false)) self.sendSubscribed(robot, found->second);
  });
}

/// The readings of another client's robot are not kept: that may leave the field at any time.
void Conversation::endSubscription(RobotId robot) {
  if (subscriptions_.erase(robot) == 0) return;
  if (!owned_.contains(robot)) views_.erase(robot);
  if (subscriptions_.empty()) host_.countSubscribers(-1);
}

void Conversation::endSubscriptions() {
  while (!subscriptions_.empty()) endSubscription(subscriptions_.begin()->first);
}

void Conversation::onCycle() {
  // Sending may end all subscriptions: who does not read is dismissed.
  for (auto next = subscriptions_.begin(); !isOver_ && next != subscriptions_.end();) {
    const RobotId robot = next->first;
    if (!sendSubscribed(robot, next->second)) {
      tell("REMOVE robot=" + std::to_string(robot));
      views_.erase(robot);
      endSubscription(robot);
    }
    next = subscriptions_.upper_bound(robot);
  }
}

/// @returns false if the robot has left the field
bool Conversation::sendSubscribed(RobotId robot, Subscription& subscription) {
  const auto view = views_.find(robot);
  if (view != views_.end() && view->second.readings->isRetired()) return false;
  const Timestamp now = host_.keeper.clock().at(wallTime());
  if (now < subscription.due && subscription.due - now <= subscription.period) return true;
  // A client that is behind gets less often what is newest.
  constexpr std::size_t kBehind = 64u << 10;
  subscription.isOwed = subscription.ahead > 0 && subscription.unread >= subscription.ahead;
  if (subscription.isOwed || outlet_->outstanding() > kBehind) return true;
  subscription.due += subscription.period;
  // It was the first, or the world has started over.
  if (subscription.due < now || subscription.due - now > subscription.period)
    subscription.due = now + subscription.period;
  ++subscription.unread;
  sendReadings("*", "UPDATE", robot, subscription.choice);
  return true;
}

// --- lockstep

void Conversation::lockstep(Request& request) {
  const std::string word = request.takeWord("on or off");
  request.refuseRest();
  if (word != "on" && word != "off")
    throw ServeError("syntax", "LOCKSTEP is '" + printable(word) + "', expected on or off");
  if (word == "on" && host_.config.pace != Pace::kLockstep && role_ != Role::kOperator)
    throw ServeError("role",
                     "LOCKSTEP makes all others wait: it needs a server started with "
                     "--lockstep, or the role operator");
  order(request.tag(), [id = id_, word](WorldKeeper& keeper, WorldKeeper::Done&) {
    keeper.setLockstep(id, word == "on");
    return Reply("OK LOCKSTEP " + word);
  });
}

void Conversation::next(Request& request) {
  const std::int64_t cycles = request.takeInteger("cycles", 1, kMostCycles).value_or(1);
  const RobotId robot = owned_.empty() ? 0 : takeRobot(request);
  const Choice choice = takeChoice(request, false);
  request.refuseRest();
  order(
      request.tag(),
      [id = id_, cycles](WorldKeeper& keeper, WorldKeeper::Done& done) {
        keeper.next(id, static_cast<std::uint64_t>(cycles), done);
        return Reply();  // when they are over
      },
      [robot, choice](Conversation& self, const std::string& tag, const std::string&) {
        if (robot != 0)
          self.sendReadings(tag, "NEXT", robot, choice);
        else
          self.reply(tag,
                     "OK NEXT now=" + std::to_string(self.host_.keeper.clock().at(wallTime())) +
                         " lines=0");
      },
      true);
}

}  // namespace ortung::server
