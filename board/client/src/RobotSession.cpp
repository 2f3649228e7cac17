#include "ortung/client/RobotSession.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <utility>

#include "LineSocket.hpp"
#include "Replies.hpp"
#include "ortung/core/ReadingLine.hpp"

namespace ortung {
namespace {

using client::valueOf;

constexpr std::size_t kLongestName = 32;
constexpr std::size_t kMostNews = 1000;
constexpr std::size_t kMostLines = 1u << 20;
constexpr std::size_t kMostBytes = 256u << 20;

/// Shortest text that gives the same number again.
std::string shown(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

bool isPrintableWord(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 127; });
}

/// Whether a name stays one word of a request: one with a blank would be further words and keys.
bool isName(std::string_view text) {
  constexpr std::string_view kPermitted =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  return !text.empty() && text.find_first_not_of(kPermitted) == text.npos;
}

/// A text of the caller's, fit for a message.
std::string inQuotes(std::string_view text) {
  std::string result = "'";
  for (const char c : text.substr(0, 80)) result += c >= ' ' && c < 127 ? c : '?';
  return result + "'";
}

void checkTime(double seconds, const char* what) {
  if (!(seconds > 0.0))
    throw std::invalid_argument(std::string(what) + " is " + std::to_string(seconds) +
                                " s, expected more than 0");
}

/// A line with a single dot would end the robot file, so dots at the beginning are doubled.
std::string withDotsDoubled(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (text.front() == '.') result += '.';
    result.append(text.substr(0, end)).append("\n");
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

}  // namespace

ConnectionLost::~ConnectionLost() = default;
ServerRefused::~ServerRefused() = default;

void SessionOptions::check() const {
  if (!isName(name) || name.size() > kLongestName)
    throw std::invalid_argument("the name is " + inQuotes(name) +
                                ", expected 1 to 32 of [A-Za-z0-9_-]");
  if (!isPrintableWord(token))  // and not said, since it is a secret
    throw std::invalid_argument("the token has a blank or a character that is not printable ASCII");
  if (!team.empty() && (!isName(team) || team.size() > kLongestName))
    throw std::invalid_argument("the team is " + inQuotes(team) +
                                ", expected 1 to 32 of [A-Za-z0-9_-]");
  checkTime(timeout, "timeout");
  checkTime(patience, "patience");
}

RobotSession::RobotSession(const SessionOptions& options, std::string_view robotToml)
    : options_(options) {
  options_.check();
  socket_ = std::make_unique<client::LineSocket>(options_);
  std::string hello = "HELLO ortung/1 name=" + options_.name;
  if (!options_.token.empty()) hello += " token=" + options_.token;
  const std::string greeting = ask(hello);
  kind_ = valueOf(greeting, "kind");
  if (!valueOf(greeting, "now").empty()) newest_ = stampOf(greeting, "now");
  if (kind_ != "robot") create(robotToml);
  std::vector<std::string> world;
  ask("DESCRIBE world", &world);
  if (!world.empty()) fingerprint_ = valueOf(world.front(), "fingerprint");
}

RobotSession::~RobotSession() = default;

void RobotSession::create(std::string_view robotToml) {
  std::string create = "CREATE " + options_.name;
  if (options_.start)
    create += " x_m=" + shown(options_.start->x) + " y_m=" + shown(options_.start->y) +
              " theta_rad=" + shown(options_.start->theta);
  if (!options_.team.empty()) create += " team=" + options_.team;
  if (options_.wanders) create += " drive=wander";
  exchange(create + "\n" + withDotsDoubled(robotToml) + ".", options_.timeout);
}

void RobotSession::failOn(std::string_view what) const {
  throw ConnectionLost(options_.server() + ": found '" + std::string(what.substr(0, 80)) +
                       "', which is not ortung/1");
}

/// What the server says unasked.
void RobotSession::note(std::string_view line) {
  line.remove_prefix(std::min<std::size_t>(2, line.size()));
  if (line.starts_with("ERR ") || line.starts_with("BYE"))
    throw ConnectionLost(options_.server() + ": the server says " + std::string(line));
  if (news_.size() < kMostNews) news_.emplace_back(line);
}

std::string RobotSession::exchange(const std::string& request, double timeout) {
  const std::string tag = "#" + std::to_string(++lastTag_) + " ";
  socket_->send(tag + request + "\n");
  while (true) {
    const std::string_view line = socket_->line(timeout);
    if (line.starts_with("* ")) {
      note(line);
      continue;
    }
    if (!line.starts_with(tag)) failOn(line);
    std::string reply(line.substr(tag.size()));
    if (reply.starts_with("OK ")) return reply;
    if (!reply.starts_with("ERR ")) failOn(line);
    const std::string code = reply.substr(4, reply.find(' ', 4) - 4);
    throw ServerRefused(
        code, options_.server() + ": the server refuses " +
                  request.substr(0, std::min(request.find_first_of(" \n"), request.size())) + ": " +
                  reply.substr(std::min(reply.size(), 5 + code.size())) + " (" + code + ")");
  }
}

/// A number of the reply; 0 if it is not there.
std::size_t RobotSession::countOf(const std::string& reply, std::string_view key,
                                  std::size_t most) const {
  const std::string_view text = valueOf(reply, key);
  if (text.empty()) return 0;
  const auto count = client::numberFrom<std::size_t>(text);
  if (!count || *count > most) failOn(reply);
  return *count;
}

Timestamp RobotSession::stampOf(const std::string& reply, std::string_view key) const {
  const auto stamp = client::numberFrom<Timestamp>(valueOf(reply, key));
  if (!stamp) failOn(reply);
  return *stamp;
}

std::string RobotSession::ask(const std::string& request, std::vector<std::string>* body) {
  if (request.find_first_of("\r\n") != request.npos)  // the rest would be another request
    throw std::invalid_argument("a request to the server has more than one line");
  std::string reply = exchange(request, options_.timeout);
  for (std::size_t lines = countOf(reply, "lines", kMostLines); lines > 0; --lines) {
    const std::string_view line = socket_->line(options_.timeout);
    if (body != nullptr) body->emplace_back(line);
  }
  return reply;
}

/// A reading in binary form; its words go where they stay. @param left bytes of the reply
Message RobotSession::takeBinary(const std::string& reply, std::size_t& left) {
  const auto refuse = [&] { failOn(reply + ", then other bytes"); };
  const std::string_view head = socket_->line(options_.timeout);
  const std::size_t blank = head.rfind(' ');
  if (blank == head.npos || head.size() >= left) refuse();
  const auto count = client::numberFrom<std::size_t>(head.substr(blank + 1));
  std::optional<Message> reading = parseLine(std::string(head.substr(0, blank)) + " 0");
  left -= head.size() + 1;
  if (!count || !reading || *count > left / sizeof(std::uint32_t)) refuse();
  const std::size_t size = *count * sizeof(std::uint32_t);
  reading->words.resize(*count);
  socket_->read({reinterpret_cast<char*>(reading->words.data()), size}, options_.timeout);
  if constexpr (std::endian::native == std::endian::big)
    for (std::uint32_t& word : reading->words) word = __builtin_bswap32(word);
  left -= size;
  return std::move(*reading);
}

std::vector<Message> RobotSession::takeReadings(const std::string& reply) {
  std::vector<Message> readings;
  const std::string_view leftOut = valueOf(reply, "left_out");
  if (!leftOut.empty() && leftOut != "0")
    throw ServerRefused("limit", options_.server() + ": " + std::string(leftOut) +
                                     " readings are too large for the form of text; ask for the "
                                     "binary form (SessionOptions::isBinary)");
  for (std::size_t lines = countOf(reply, "lines", kMostLines); lines > 0; --lines) {
    const std::string_view line = socket_->line(options_.timeout);
    std::optional<Message> reading = parseLine(line);
    if (!reading) failOn(line);
    readings.push_back(std::move(*reading));
  }
  for (std::size_t left = countOf(reply, "bytes", kMostBytes); left > 0;)
    readings.push_back(takeBinary(reply, left));
  if (!readings.empty()) newest_ = readings.back().stamp;
  return readings;
}

std::string RobotSession::withForm(std::string request) const {
  return options_.isBinary ? std::move(request) + " form=binary" : request;
}

std::vector<Message> RobotSession::update(const std::string& queries) {
  if (queries.find_first_of("=\r\n") != queries.npos)  // would be a key, or another request
    throw std::invalid_argument("found the queries " + inQuotes(queries) +
                                ", expected model/type/feature, separated by blanks");
  std::vector<Message> readings = takeReadings(
      exchange(withForm(queries.empty() ? "UPDATE" : "UPDATE " + queries), options_.timeout));
  // Of a robot that is nobody's own the server gives the newest, sent before or not.
  if (kind_ == "robot") std::erase_if(readings, [this](const Message& m) { return !isNew(m); });
  return readings;
}

bool RobotSession::isNew(const Message& reading) {
  const auto [last, isFirst] = stamps_.try_emplace(toText(reading.id), reading.stamp);
  if (!isFirst && reading.stamp <= last->second) return false;
  last->second = reading.stamp;
  return true;
}

void RobotSession::setLockstep(bool isOn) {
  ask(isOn ? "LOCKSTEP on" : "LOCKSTEP off");
  clock_ = stampOf(ask("TIME"), "received");
}

std::optional<std::vector<Message>> RobotSession::next(std::uint64_t cycles) {
  try {
    const std::string reply =
        exchange(withForm(cycles == 1 ? "NEXT" : "NEXT cycles=" + std::to_string(cycles)),
                 options_.patience);
    std::vector<Message> readings = takeReadings(reply);
    const Timestamp now = stampOf(reply, "now");
    newest_ = now - (now - clock_) / static_cast<Timestamp>(std::max<std::uint64_t>(cycles, 1));
    clock_ = now;
    return readings;
  } catch (const ServerRefused& refusal) {
    if (refusal.code() == "end") return std::nullopt;
    throw;
  }
}

void RobotSession::tell(const std::string& request) {
  try {
    ask(request);
  } catch (const ServerRefused& refusal) {
    for (const char* code : {"argument", "number", "no-manipulator"})
      if (refusal.code() == code) throw std::invalid_argument(refusal.what());
    throw;
  }
}

void RobotSession::setTranslationalVelocity(double metresPerSecond) {
  tell("VELOCITY v_m_s=" + shown(metresPerSecond));
}

void RobotSession::setRotationalVelocity(double radiansPerSecond) {
  tell("VELOCITY w_rad_s=" + shown(radiansPerSecond));
}

void RobotSession::setMotion(std::span<const double> command) {
  std::string request = "MOTION";
  for (const double number : command) request += " " + shown(number);
  tell(request);
}

void RobotSession::setManipulator(std::string_view manipulator, std::string_view state) {
  if (!isName(manipulator) || !isName(state))
    throw std::invalid_argument("found the manipulator " + inQuotes(manipulator) +
                                " and the state " + inQuotes(state) +
                                ", expected names of [A-Za-z0-9_-]");
  std::string request = "MANIPULATOR ";
  request.append(manipulator).append(" ").append(state);
  tell(request);
}

void RobotSession::say(const std::string& text) { ask("SAY " + text); }

void RobotSession::tellTeam(const std::string& text) { tell("TELL " + text); }

std::vector<TeamWords> RobotSession::hearTeam() {
  std::vector<std::string> lines;
  ask("HEAR", &lines);
  std::vector<TeamWords> talk;
  for (const std::string& line : lines) {
    const std::size_t name = line.find(' ');
    const std::size_t text = name == line.npos ? name : line.find(' ', name + 1);
    const auto stamp = client::numberFrom<Timestamp>(std::string_view(line).substr(0, name));
    if (text == line.npos || !stamp) failOn(line);
    talk.push_back({*stamp, line.substr(name + 1, text - name - 1), line.substr(text + 1)});
  }
  return talk;
}

std::string RobotSession::game() {
  constexpr std::string_view kHead = "OK GAME ";
  try {
    const std::string reply = ask("GAME");
    if (!reply.starts_with(kHead)) failOn(reply);
    return reply.substr(kHead.size());
  } catch (const ServerRefused& refused) {
    if (refused.code() != "unknown") throw;
    return {};
  }
}

RobotDescription RobotSession::describe() {
  std::vector<std::string> lines;
  ask("DESCRIBE robot", &lines);
  try {
    return parseRobotDescription(lines);
  } catch (const std::invalid_argument& line) {
    failOn(line.what());
  }
}

std::vector<std::string> RobotSession::takeNews() { return std::exchange(news_, {}); }

}  // namespace ortung
