#include "ortung/server/ServedPlayback.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "PlaybackRun.hpp"
#include "Request.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/server/CallArguments.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostRuns = 16;
constexpr std::size_t kMostQueries = 64;
constexpr std::int64_t kMostReadings = 5000;    // of a feature, in a history
constexpr std::size_t kMostBytes = 512u << 10;  // of a history, as text
const SensorId kRobots{"world", "truth", "robots"};

[[noreturn]] void refuse() {
  throw ServeError("record", "what happened in a record can't be changed");
}

/// Refuses all commands.
class Mute final : public RobotCommands {
 public:
  ~Mute() override = default;
  void setTranslationalVelocity(double) override { refuse(); }
  void setRotationalVelocity(double) override { refuse(); }
  void setMotion(std::span<const double>) override { refuse(); }
  void setManipulator(std::string_view, std::string_view) override { refuse(); }
};

void check(const ServedPlayback::Config& config) {
  if (config.runs.empty() || config.runs.size() > kMostRuns)
    throw std::invalid_argument("there are " + std::to_string(config.runs.size()) +
                                " records, expected 1 to " + std::to_string(kMostRuns));
  if (!(config.period >= 0.001 && config.period <= 10.0))
    throw std::invalid_argument("the period is " + std::to_string(config.period) +
                                " s, must be in [0.001, 10]");
  for (const ServedPlayback::Run& run : config.runs)
    if (!server::isName(run.name))
      throw std::invalid_argument("a robot's name is '" + server::printable(run.name) +
                                  "', expected 1 to 32 of [A-Za-z0-9_-]");
}

}  // namespace

struct ServedPlayback::Parts {
  Config config;
  std::vector<std::unique_ptr<server::PlaybackRun>> runs;
  std::vector<Mark> marks;
  Timestamp length = 0;
  Timestamp now = 0;
  Mute mute;
  std::vector<Message> truth{{0, kRobots, {}}};

  server::PlaybackRun& run(RobotId robot) const {
    if (robot == 0 || robot > runs.size())
      throw ServeError("no-robot", "there is no robot " + std::to_string(robot));
    return *runs[robot - 1];
  }
};

ServedPlayback::ServedPlayback(const Config& config, const std::function<bool(double)>& progress)
    : parts_(std::make_unique<Parts>()) {
  check(config);
  parts_->config = config;
  const auto all = static_cast<double>(config.runs.size());
  for (const Run& run : config.runs) {
    const auto before = static_cast<double>(parts_->runs.size());
    const auto share = [&](double done) { return !progress || progress((before + done) / all); };
    auto one = std::make_unique<server::PlaybackRun>(run, share);
    parts_->marks.insert(parts_->marks.end(), one->marks().begin(), one->marks().end());
    parts_->length = std::max(parts_->length, one->length());
    parts_->runs.push_back(std::move(one));
  }
  std::stable_sort(parts_->marks.begin(), parts_->marks.end(),
                   [](const Mark& a, const Mark& b) { return a.stamp < b.stamp; });
  seek(0);
}

ServedPlayback::~ServedPlayback() = default;

const std::vector<ServedPlayback::Mark>& ServedPlayback::marks() const { return parts_->marks; }
Timestamp ServedPlayback::length() const { return parts_->length; }

const std::vector<ServedPlayback::Content>& ServedPlayback::contents(RobotId robot) const {
  return parts_->run(robot).contents();
}

std::vector<Message> ServedPlayback::history(RobotId robot, const std::vector<std::string>& queries,
                                             std::size_t most,
                                             const std::function<bool()>& goOn) const {
  std::vector<SensorQuery> wanted;
  for (const std::string& text : queries) wanted.push_back(parseSensorQuery(text));
  return parts_->run(robot).history(wanted, most, goOn);
}

WorldDescription ServedPlayback::describe() const {
  const auto& runs = parts_->runs;
  WorldDescription world{parts_->config.name, runs.front()->fingerprint(), "record",
                         parts_->config.bounds};
  world.length = parts_->length;
  if (world.bounds) return world;
  for (const auto& run : runs) {
    if (!run->bounds()) continue;
    const FieldBounds its = *run->bounds();
    const FieldBounds all = world.bounds.value_or(its);
    world.bounds = {std::min(all.xMin, its.xMin), std::min(all.yMin, its.yMin),
                    std::max(all.xMax, its.xMax), std::max(all.yMax, its.yMax)};
  }
  return world;
}

std::vector<std::string> ServedPlayback::field() const { return parts_->config.field; }

std::vector<ServedFeature> ServedPlayback::truthFeatures() const {
  return {{kRobots,
           "for each robot: number, x [mm + 2^31], y [mm + 2^31], heading [1/100 degree], 0",
           {},
           formats::kWorldRobots}};
}

std::span<Message> ServedPlayback::truth() {
  Message& robots = parts_->truth.front();
  robots.stamp = 0;  // becomes that of the newest pose, to compare it with others of its time
  robots.words.clear();
  RobotId number = 0;
  for (const auto& run : parts_->runs) {
    ++number;
    if (!run->truth()) continue;
    robots.stamp = std::max(robots.stamp, run->truthStamp());
    const auto words = robotWords(number, *run->truth(), 0);
    robots.words.insert(robots.words.end(), words.begin(), words.end());
  }
  return parts_->truth;
}

Timestamp ServedPlayback::now() const { return parts_->now; }
bool ServedPlayback::isAtEnd() const { return parts_->now > parts_->length; }

void ServedPlayback::step() {
  parts_->now += fromSeconds(parts_->config.period);
  for (const auto& run : parts_->runs) run->play(parts_->now);
}

void ServedPlayback::seek(Timestamp stamp) {
  parts_->now = std::clamp<Timestamp>(stamp, 0, parts_->length);
  // Readings with exactly that stamp are included.
  for (const auto& run : parts_->runs) run->seek(parts_->now + 1);
}

std::vector<Resident> ServedPlayback::residents() const {
  std::vector<Resident> residents;
  for (const auto& run : parts_->runs)
    residents.push_back(
        {static_cast<RobotId>(residents.size() + 1), run->run().name, run->features()});
  return residents;
}

ServedRobot ServedPlayback::addRobot(RobotId, RobotWish) {
  throw ServeError("record", "robots can't join what has happened already");
}

std::vector<std::string> ServedPlayback::abilities(RobotId robot) const {
  return parts_->run(robot).run().abilities;
}

void ServedPlayback::removeRobot(RobotId) {}

std::span<Message> ServedPlayback::readings(RobotId robot) { return parts_->run(robot).newest(); }

RobotCommands& ServedPlayback::commands(RobotId) { return parts_->mute; }

void ServedPlayback::reset(std::optional<std::uint64_t>) { seek(0); }
void ServedPlayback::placeRobot(RobotId, const Pose2&) { refuse(); }
void ServedPlayback::placeObject(const std::string&, const Pose2&) { refuse(); }

namespace {

using Call = BoardCommand::Call;
using Reply = BoardCommand::Reply;

Reply tellEvents(const ServedPlayback& playback, const Call& call) {
  Reply reply;
  const auto& marks = playback.marks();
  for (std::size_t i = sinceOf(call); i < marks.size(); ++i)
    reply.lines.push_back(std::to_string(i) + " " + std::to_string(marks[i].stamp) + " " +
                          marks[i].text);
  reply.words = "next=" + std::to_string(marks.size());
  return reply;
}

RobotId takeRobot(CallArguments& arguments) {
  return static_cast<RobotId>(arguments.takeInteger("robot", 1, kMostRuns).value_or(1));
}

Reply tellContents(const ServedPlayback& playback, const Call& call) {
  CallArguments arguments("CONTENTS", call);
  const RobotId robot = takeRobot(arguments);
  arguments.refuseRest();
  Reply reply{"robot=" + std::to_string(robot)};
  for (const ServedPlayback::Content& one : playback.contents(robot))
    reply.lines.push_back(toText(one.id) + " readings=" + std::to_string(one.readings) +
                          " first_us=" + std::to_string(one.first) +
                          " last_us=" + std::to_string(one.last));
  return reply;
}

/// The readings as lines; if all together are too long for an answer, every so many of each
/// feature, the last one among them.
std::vector<std::string> linesOf(const std::vector<Message>& messages) {
  std::vector<std::string> lines;
  std::map<std::string, std::size_t> counts;
  std::size_t bytes = 0;
  for (const Message& message : messages) {
    writeLine(message, lines.emplace_back());
    bytes += lines.back().size() + 1;
    ++counts[toText(message.id)];
  }
  const std::size_t step = (bytes + kMostBytes - 1) / kMostBytes;
  if (step < 2) return lines;
  std::vector<std::string> few;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (--counts[toText(messages[i].id)] % step == 0) few.push_back(std::move(lines[i]));
  return few;
}

Reply tellHistory(const ServedPlayback& playback, const Call& call) {
  CallArguments arguments("HISTORY", call);
  const RobotId robot = takeRobot(arguments);
  const std::vector<std::string> queries = arguments.takeWords();
  const auto most = arguments.takeInteger("most", 1, kMostReadings).value_or(1000);
  arguments.refuseRest();
  if (queries.empty()) throw ServeError("syntax", "HISTORY needs features, MODEL/TYPE/FEATURE");
  if (queries.size() > kMostQueries)
    throw ServeError("limit", "a request has at most " + std::to_string(kMostQueries) + " queries");
  return {
      "robot=" + std::to_string(robot),
      linesOf(playback.history(robot, queries, static_cast<std::size_t>(most), call.isAwaited))};
}

}  // namespace

std::vector<BoardCommand> playbackCommands(const ServedPlayback& playback) {
  return {{.name = "EVENTS",
           .help = "[since=N]: what happened, from number N on",
           .handle = [&playback](const Call& call) { return tellEvents(playback, call); }},
          {.name = "CONTENTS",
           .help = "[robot=N]: which features the record has, and how many readings of each",
           .handle = [&playback](const Call& call) { return tellContents(playback, call); }},
          {.name = "HISTORY",
           .help = "[robot=N] MODEL/TYPE/FEATURE ... [most=1000]: readings of the whole record, "
                   "evenly chosen",
           .handle = [&playback](const Call& call) { return tellHistory(playback, call); },
           .isSlow = true}};
}

}  // namespace ortung
