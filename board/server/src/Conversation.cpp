#include "Conversation.hpp"

#include <algorithm>
#include <array>

namespace ortung::server {

namespace {

// What a client gets done before it is another one's turn.
constexpr int kLinesOfTurn = 32;
constexpr Timestamp kTimeOfTurn = 100;         // [us]
constexpr std::size_t kTalkOfTurn = 8u << 10;  // [bytes]
constexpr double kTalkOfNewcomers = 0.2;  // share of a second's talk: so coming back gives nothing

}  // namespace

Conversation::Conversation(Host& host, ClientId id, std::unique_ptr<Outlet> outlet)
    : host_(host),
      id_(id),
      outlet_(std::move(outlet)),
      talk_(host.config.limits.talkLines, host.config.limits.talkBytes, kTalkOfNewcomers) {}

Conversation::~Conversation() { *isGone_ = true; }

const std::vector<Conversation::Command>& Conversation::commands() {
  using C = Conversation;
  const Role all = Role::kViewer;
  const Role player = Role::kPlayer;
  const Role control = Role::kOperator;
  static const std::vector<Command> list = {
      {"HELLO", all, &C::hello, "ortung/1 [name=NAME] [token=TOKEN] [role=viewer|player|operator]"},
      {"TIME", all, &C::time, "the clock of the stamps when this came and when the reply left"},
      {"STATUS", all, &C::status, "how the world is doing"},
      {"LIST", all, &C::list, "worlds|plugins|clients|robots"},
      {"DESCRIBE", all, &C::describe, "world|field|robot|robots|players [robot=N]"},
      {"CREATE", player, &C::create,
       "NAME [x_m=X y_m=Y theta_deg=T] [drive=wander], then a robot file, then a line with a dot"},
      {"REMOVE", player, &C::remove, "[robot=N]"},
      {"VELOCITY", player, &C::velocity, "[v_m_s=V] [w_rad_s=W] [robot=N]"},
      {"MOTION", player, &C::motion, "NUMBER ... [robot=N], the motion plugin's own command"},
      {"MANIPULATOR", player, &C::manipulator, "NAME STATE [robot=N]"},
      {"UPDATE", all, &C::update, "[MODEL/TYPE/FEATURE ...] [robot=N] [form=binary], what is new"},
      {"READ", all, &C::read, "the same, also what was sent before"},
      {"SUBSCRIBE", all, &C::subscribe,
       "[period_s=S] [ahead=N] [MODEL/TYPE/FEATURE ...] [robot=N] [form=binary]"},
      {"UNSUBSCRIBE", all, &C::unsubscribe, "[robot=N]"},
      {"GOT", all, &C::got, "[robot=N], an update was read: for SUBSCRIBE with ahead=N"},
      {"LOCKSTEP", player, &C::lockstep, "on|off, the world waits for every NEXT of this client"},
      {"NEXT", player, &C::next, "[cycles=N] and as UPDATE; answered when they are over"},
      {"TELL", player, &C::tellTeam, "[robot=N] TEXT to all others of the robot's team"},
      {"HEAR", player, &C::hearTeam, "[robot=N], what others of its team have told"},
      {"SAY", all, &C::say, "TEXT to all other clients"},
      {"SCORE", all, &C::score, "[left=N right=N], which is for operators"},
      {"PAUSE", control, &C::pause, ""},
      {"RESUME", control, &C::resume, ""},
      {"STEP", control, &C::step, "[cycles=N] of a paused world"},
      {"SPEED", control, &C::speed, "FACTOR of real time, 0: as fast as possible"},
      {"RESET", control, &C::reset, "[seed=N], the world starts over"},
      {"SEEK", control, &C::seek, "time_s=T, of a record's time line"},
      {"PLACE", control, &C::place, "robot=N|object=NAME x_m=X y_m=Y [theta_deg=T]"},
      {"HELP", all, &C::help, "this list"},
      {"BYE", all, &C::bye, ""}};
  return list;
}

const char* Conversation::toText(Role role) {
  constexpr std::array<const char*, 3> kNames = {"viewer", "player", "operator"};
  return kNames[static_cast<std::size_t>(role)];
}

// --- input

void Conversation::receive(std::string_view bytes) {
  received_ = wallTime();
  input_ += bytes;
  takeLines();
}

void Conversation::takeLines() {
  if (isReceiving_ || isTurnOver_) return;
  isReceiving_ = true;
  isTurnOver_ = takeTurn();
  isReceiving_ = false;
  outlet_->flush();
  if (isTurnOver_) host_.queue(weak_from_this());
  if (isOver_) {
    input_.clear();
    taken_ = searched_ = 0;
  } else if (taken_ == input_.size() || taken_ > (1u << 14)) {
    input_.erase(0, taken_);
    searched_ -= taken_;
    taken_ = 0;
  }
}

/// @returns whether it ended before there was nothing more to take
bool Conversation::takeTurn() {
  const Timestamp begin = wallTime();
  for (int lines = 0; mayTakeLine(); ++lines) {
    const bool isLate = lines > 0 && wallTime() - begin >= kTimeOfTurn;  // one is always taken
    if (lines == kLinesOfTurn || isLate) return true;
    if (!takeLine()) return false;
  }
  return false;
}

bool Conversation::takeLine() {
  const std::size_t end = input_.find('\n', searched_);
  const std::size_t length = std::min(end, input_.size()) - taken_;
  if (length > host_.config.limits.line) {
    dismiss("ERR line a line is longer than " + std::to_string(host_.config.limits.line) +
            " bytes");
    return false;
  }
  if (end == input_.npos) {
    searched_ = input_.size();
    return false;
  }
  std::string line = input_.substr(taken_, length);
  taken_ = searched_ = end + 1;
  if (line.ends_with('\r')) line.pop_back();
  handleLine(line);
  return true;
}

void Conversation::handleLine(std::string_view line) {
  if (configuration_) {
    handleConfigurationLine(line);
    return;
  }
  if (line.empty()) return;
  Request request(line);
  if (!request.fault().empty()) {
    refuse(request.tag(), "ERR syntax " + request.fault());
    return;
  }
  try {
    dispatch(request);
  } catch (...) {
    if (request.command() == "CREATE")  // its robot file is on its way all the same
      configuration_ = Configuration{request.tag(), RobotWish(), {}, currentErrorText()};
    else
      refuse(request.tag(), currentErrorText());
  }
}

void Conversation::dispatch(Request& request) {
  const auto& all = commands();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Command& command) {
    return command.name == request.command();
  });
  const BoardCommand* added = found == all.end() ? findAdded(request.command()) : nullptr;
  if (found == all.end() && added == nullptr)
    throw ServeError("unknown",
                     "there is no command " + printable(request.command()) + "; HELP lists them");
  const bool isGreeting =
      request.command() == "HELLO" || request.command() == "HELP" || request.command() == "BYE";
  if (!hasJoined_ && !isGreeting) throw ServeError("hello", "say HELLO ortung/1 first");
  if (added != nullptr) {
    callAdded(*added, request);
    return;
  }
  if (!isGreeting) checkRole(request.command(), found->role);
  (this->*found->handle)(request);
}

void Conversation::checkRole(const std::string& command, Role least) const {
  if (role_ < least)
    throw ServeError("role", command + " needs the role " + toText(least) + ", this client is a " +
                                 toText(role_));
}

bool Conversation::knows(std::string_view command) {
  const auto& all = commands();
  return std::any_of(all.begin(), all.end(),
                     [&](const Command& known) { return known.name == command; });
}

// --- output

/// Not to a client that does not read.
bool Conversation::mayReply() {
  if (isOver_) return false;
  const BoardLimits& limits = host_.config.limits;
  const std::size_t readings = outlet_->outstandingReadings();
  const bool isReadings = readings > limits.readings;
  if (!isReadings && outlet_->outstanding() - readings <= limits.output) return true;
  dismiss("ERR slow more than " + std::to_string(isReadings ? limits.readings : limits.output) +
          " bytes wait to be read");
  return false;
}

void Conversation::reply(const std::string& tag, std::string_view text, std::string_view body) {
  if (isOver_) return;
  std::string out;
  out.reserve(tag.size() + text.size() + body.size() + 2);
  if (!tag.empty()) out.append(tag).append(" ");
  out.append(text).append("\n").append(body);
  if (!mayReply()) return;
  put(out);
  if (!text.starts_with("ERR")) errors_ = 0;
}

/// What follows the line is not copied.
void Conversation::reply(const std::string& tag, std::string_view text, Output&& body) {
  if (!mayReply()) return;
  Output out;
  if (!tag.empty()) out.text().append(tag).append(" ");
  out.text().append(text).append("\n");
  out.add(std::move(body));
  outlet_->add(std::move(out));
  flushSoon();
  errors_ = 0;
}

void Conversation::put(std::string_view text) {
  if (!isReceiving_ && pending_ == 0) {
    outlet_->send(text);
    return;
  }
  outlet_->append(text);
  flushSoon();
}

/// What is followed by more soon is not sent piece by piece.
void Conversation::flushSoon() {
  if (isReceiving_) return;
  if (pending_ == 0) {
    outlet_->flush();
    return;
  }
  if (std::exchange(isFlushPosted_, true)) return;
  host_.post([weak = weak_from_this()] {
    const auto self = weak.lock();
    if (!self) return;
    self->isFlushPosted_ = false;
    self->outlet_->flush();
  });
}

void Conversation::error(const std::string& tag, std::string_view text) {
  reply(tag, text);
  if (++errors_ >= host_.config.limits.errors) dismiss("ERR errors too many in a row");
}

/// Says an error in its turn.
void Conversation::refuse(const std::string& tag, const std::string& text) {
  answer(tag, [tag, text](Conversation& self) { self.error(tag, text); });
}

/// There is room for more lines. They are taken in a turn, however many orders were executed.
void Conversation::goOn() {
  const bool hasLine = input_.find('\n', searched_) != std::string::npos;
  if (hasLine && !isReceiving_ && !std::exchange(isTurnOver_, true)) host_.queue(weak_from_this());
  if (!hasLine && wantsInput()) outlet_->resume();
}

void Conversation::nextTurn() {
  isTurnOver_ = false;
  takeLines();
  if (wantsInput()) outlet_->resume();
}

/// Has the world's thread execute @p run, and then @p then here; by default that sends the reply.
/// @param holdsLines whether the lines behind it depend on what becomes of it
void Conversation::order(const std::string& tag, WorldKeeper::Order run, Then then,
                         bool holdsLines) {
  ++pending_;
  waiting_ += holdsLines ? 1 : 0;
  auto done = [weak = weak_from_this(), host = &host_, tag, holdsLines,
               then = std::move(then)](std::string text) {
    host->post([weak, tag, holdsLines, then, text = std::move(text)] {
      const auto self = weak.lock();
      if (!self) return;
      --self->pending_;
      self->waiting_ -= holdsLines ? 1 : 0;
      if (self->isOver_) return;
      if (text.starts_with("ERR "))
        self->error(tag, text);
      else if (then)
        then(*self, tag, text);
      else
        self->reply(tag, text);
      self->goOn();
    });
  };
  host_.keeper.give(id_, std::move(run), std::move(done));
}

/// Says something that needs no order, but not before what was asked for earlier.
void Conversation::answer(const std::string& tag, std::function<void(Conversation&)> say) {
  if (pending_ == 0) {
    say(*this);
    return;
  }
  order(
      tag, [](WorldKeeper&, WorldKeeper::Done&) { return std::optional<std::string>(""); },
      [say = std::move(say)](Conversation& self, const std::string&, const std::string&) {
        say(self);
      },
      true);  // what comes behind it must not change what it says
}

void Conversation::tell(std::string_view text) {
  if (!hasJoined_ || isOver_) return;
  put("* " + std::string(text) + "\n");
}

void Conversation::hear(std::string_view text) {
  if (!hasJoined_ || isOver_) return;
  if (heard_.size() + text.size() > host_.config.limits.talk)
    ++unheard_;
  else
    heard_.append("* ").append(text).append("\n");
}

bool Conversation::hearOn() {
  if (isOver_ || (heard_.empty() && unheard_ == 0) || outlet_->outstanding() > 0) return false;
  if (heard_.size() > kTalkOfTurn) {
    const std::size_t end = heard_.find('\n', kTalkOfTurn) + 1;
    outlet_->send(std::string_view(heard_).substr(0, end));
    heard_.erase(0, end);
    return true;
  }
  if (unheard_ > 0) heard_ += "* LOST says=" + std::to_string(std::exchange(unheard_, 0)) + "\n";
  outlet_->send(std::exchange(heard_, {}));
  return false;
}

void Conversation::dismiss(std::string_view text) {
  if (isOver_) return;
  outlet_->send("* " + std::string(text) + "\n");
  hangUp();
  outlet_->finish();
}

void Conversation::hangUp() {
  if (isOver_) return;
  isOver_ = true;
  *isGone_ = true;
  endSubscriptions();
  if (!hasJoined_) return;
  host_.keeper.give(id_,
                    [id = id_](WorldKeeper& keeper, WorldKeeper::Done&) {
                      keeper.leave(id);
                      return std::optional<std::string>("");
                    },
                    {});
}

}  // namespace ortung::server
