#include "ortung/mcl_served/LocalizationCommands.hpp"

#include <utility>

#include "NumberText.hpp"
#include "ortung/base/Angles.hpp"
#include "ortung/mcl_served/HeatMap.hpp"
#include "ortung/mcl_served/Why.hpp"
#include "ortung/server/CallArguments.hpp"

namespace ortung {
namespace {

using Call = BoardCommand::Call;
using Reply = BoardCommand::Reply;
using OrderKind = LocalizationOrder::Kind;

constexpr std::int64_t kLastRobot = 0xFFFFFFFF;
constexpr std::size_t kMostQueries = 64;
constexpr std::int64_t kMostCells = 250'000;
constexpr std::int64_t kMostValue = 65'535;

RobotId takeRobot(CallArguments& arguments, const Call& call, const PerceivingRobots& robots) {
  const auto named = arguments.takeInteger("robot", 1, kLastRobot);
  const auto robot = named ? std::optional(static_cast<RobotId>(*named)) : robots.usual();
  if (!robot) throw ServeError("no-robot", "robot=N is missing; LIST robots tells the numbers");
  if (call.role == BoardCommand::Role::kPlayer && !robots.isForAll())
    throw ServeError("not-yours", "players know of their own robots only");
  return *robot;
}

std::vector<std::string> takeQueries(CallArguments& arguments) {
  std::vector<std::string> queries = arguments.takeWords();
  if (queries.size() > kMostQueries)
    throw ServeError("limit", "a request has at most " + std::to_string(kMostQueries) + " queries");
  return queries;
}

/// theta_deg or theta_rad without a place.
std::optional<double> takeHeading(CallArguments& arguments) {
  const auto degrees = arguments.takeNumber("theta_deg", -360.0, 360.0);
  const auto turn = arguments.takeNumber("theta_rad", -7.0, 7.0);
  if (degrees && turn) throw ServeError("syntax", "a heading is theta_deg or theta_rad, not both");
  return degrees ? std::optional(radians(*degrees)) : turn;
}

// --- LOCALIZE

std::optional<LocalizationOrder> takeOrder(CallArguments& arguments) {
  const std::vector<std::string> words = arguments.takeWords();
  LocalizationOrder order;
  const auto sigma = arguments.takeNumber("sigma_m", 0.001, 1000.0);
  const auto sigmaDegrees = arguments.takeNumber("sigma_deg", 0.01, 180.0);
  const auto pose = arguments.takePose();
  if (words.size() > 1 ||
      (words.size() == 1 && words[0] != "on" && words[0] != "off" && words[0] != "anywhere"))
    throw ServeError("syntax", "LOCALIZE takes one of on, off and anywhere, or a place");
  if (pose && !words.empty() && words[0] != "on")
    throw ServeError("syntax", "LOCALIZE takes a place or " + words[0] + ", not both");
  if (!pose && (sigma || sigmaDegrees))
    throw ServeError("syntax", "sigma_m and sigma_deg are of a place, x_m and y_m");
  if (pose) {
    order.kind = OrderKind::kPlace;
    order.pose = *pose;
    order.sigmaPosition = sigma.value_or(order.sigmaPosition);
    if (sigmaDegrees) order.sigmaHeading = radians(*sigmaDegrees);
    return order;
  }
  if (words.empty()) return std::nullopt;
  if (words[0] == "off") order.kind = OrderKind::kOff;
  if (words[0] == "anywhere") order.kind = OrderKind::kAnywhere;
  return order;
}

Reply localize(LocalizedRobots& robots, const Call& call) {
  CallArguments arguments("LOCALIZE", call);
  const RobotId robot = takeRobot(arguments, call, robots);
  const std::optional<LocalizationOrder> order = takeOrder(arguments);
  arguments.refuseRest();
  if (order) {
    if (call.role != BoardCommand::Role::kOperator)
      throw ServeError("role", "telling a localization something needs the role operator");
    robots.order(robot, *order);
  }
  const LocalizationState state = robots.state(robot);
  return {"robot=" + std::to_string(robot) + " state=" + nameOf(state.kind) +
          " progress=" + numberText(state.progress) + (state.text.empty() ? "" : " ") + state.text};
}

// --- HEATMAP

HeatMapWish takeWish(CallArguments& arguments) {
  HeatMapWish wish{.queries = takeQueries(arguments), .heading = takeHeading(arguments)};
  const std::string of = arguments.takeText("of").value_or("probability");
  if (of != "probability" && of != "expectation")
    throw ServeError("syntax", "of is '" + of + "', expected probability or expectation");
  wish.isExpectation = of == "expectation";
  const std::string scale = arguments.takeText("scale").value_or("linear");
  if (scale != "linear" && (scale != "log" || wish.isExpectation))
    throw ServeError("syntax",
                     "scale is '" + scale + "', expected linear, or log of probabilities");
  wish.isLogarithmic = scale == "log";
  const auto index = arguments.takeInteger("index", 0, kMostValue);
  if (index && !wish.isExpectation)
    throw ServeError("syntax", "index is of a value that of=expectation expects");
  wish.index = static_cast<std::size_t>(index.value_or(0));
  if (const auto cells = arguments.takeInteger("cells", 1, kMostCells))
    wish.mostCells = static_cast<std::size_t>(*cells);
  return wish;
}

Reply showMap(const PerceivingRobots& robots, const Call& call) {
  CallArguments arguments("HEATMAP", call);
  const RobotId robot = takeRobot(arguments, call, robots);
  const HeatMapWish wish = takeWish(arguments);
  arguments.refuseRest();
  const std::shared_ptr<const Robot> perceiver = robots.perceiver(robot);
  std::optional<HeatMap> map = heatMap(*perceiver, wish, call.isAwaited);
  if (!map) return {};  // nobody waits for it any more
  const FieldGrid& grid = map->grid;
  Reply reply{"robot=" + std::to_string(robot) + " stamp=" + std::to_string(map->stamp) +
              " columns=" + std::to_string(grid.columns) + " rows=" + std::to_string(grid.rows) +
              " x_min_m=" + numberText(grid.originX) + " y_min_m=" + numberText(grid.originY) +
              " step_m=" + numberText(grid.cell) + " low=" + numberText(map->low) +
              " high=" + numberText(map->high)};
  if (!wish.isExpectation) reply.words += " readings=" + std::to_string(map->readings);
  if (wish.isExpectation)
    reply.words += std::string(map->isAngle ? " unit=rad" : " unit=m") +
                   " values=" + std::to_string(map->values);
  reply.bytes = std::move(map->bytes);
  return reply;
}

// --- WHY

void addValues(const std::string& feature, const std::vector<ReadingValue>& values,
               std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::string line = "value " + feature + " " + std::to_string(i) +
                       (values[i].isAngle ? " unit=rad" : " unit=m");
    if (values[i].measured) line += " measured=" + numberText(*values[i].measured);
    if (values[i].expected) line += " expected=" + numberText(*values[i].expected);
    lines.push_back(std::move(line));
  }
}

Reply tellWhy(const PerceivingRobots& robots, const Call& call) {
  CallArguments arguments("WHY", call);
  const RobotId robot = takeRobot(arguments, call, robots);
  const std::optional<Pose2> pose = arguments.takePose();
  const std::vector<std::string> queries = takeQueries(arguments);
  arguments.refuseRest();
  if (!pose) throw ServeError("syntax", "WHY needs a pose, x_m=X y_m=Y theta_deg=T");
  const Why why = whyAt(*robots.perceiver(robot), queries, *pose);
  Reply reply{"robot=" + std::to_string(robot) + " p=" + numberText(why.p)};
  for (const Why::Feature& one : why.features) {
    const std::string name = toText(one.id);
    reply.lines.push_back(name + " p=" + numberText(one.p) +
                          " values=" + std::to_string(one.values.size()));
    addValues(name, one.values, reply.lines);
  }
  return reply;
}

}  // namespace

std::vector<BoardCommand> perceptionCommands(const PerceivingRobots& robots) {
  return {
      {.name = "HEATMAP",
       .help = "robot=N [MODEL/TYPE/FEATURE ...] [theta_deg=T] [of=probability|expectation] "
               "[index=I] [scale=linear|log] [cells=MOST], p of its readings all over the field",
       .handle = [&robots](const Call& call) { return showMap(robots, call); },
       .isSlow = true,
       .isReplaceable = true},
      {.name = "WHY",
       .help = "robot=N x_m=X y_m=Y theta_deg=T [MODEL/TYPE/FEATURE ...], p of its readings there",
       .handle = [&robots](const Call& call) { return tellWhy(robots, call); },
       .isSlow = true,
       .isReplaceable = true}};
}

std::vector<BoardCommand> localizationCommands(LocalizedRobots& robots) {
  std::vector<BoardCommand> commands = perceptionCommands(robots);
  commands.insert(
      commands.begin(),
      {.name = "LOCALIZE",
       .help = "robot=N [on|off|anywhere] [x_m=X y_m=Y theta_deg=T [sigma_m=S sigma_deg=D]]",
       .handle = [&robots](const Call& call) { return localize(robots, call); }});
  return commands;
}

}  // namespace ortung
