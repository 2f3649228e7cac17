#include "Football.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"

namespace ortung::app {
namespace {

FootballRun runOf(unsigned threads, Progress& progress) {
  return {threads, [&progress](double share) {
            checkInterrupt();
            progress.update(share);
            return true;
          }};
}

FootballConfig configOf(const FootballBenchmarkArguments& a, const Shard& shard) {
  FootballConfig config;
  config.leagues = a.leagues;
  if (config.leagues.empty())
    for (const auto league : footballLeagues()) config.leagues.emplace_back(league);
  for (const std::string& team : a.teams) {
    if (a.sees.empty()) config.teams.push_back(team);
    for (const std::string& sees : a.sees) config.teams.push_back(withTeamSight(team, sees));
  }
  config.against = a.against;
  config.halves = a.halves;
  config.seconds = a.seconds;
  config.seed = a.seed;
  config.shard = shard.number;
  config.shards = shard.count;
  try {
    config.check();
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return config;
}

std::string toText(const FootballHalf& half) {
  return fmt::format("{} : {}, digest {:08x}", half.goals[0], half.goals[1], half.digest);
}

}  // namespace

int runFootballBenchmark(const FootballBenchmarkArguments& a) {
  const Shard shard = a.shard.empty() ? Shard() : readShard(a.shard);
  const FootballConfig config = configOf(a, shard);
  const bool isPart = !a.shard.empty();
  if (isPart && a.json.empty())
    throw UsageError("--shard writes a part, expected its name: --json");
  Outputs outputs(a.force);
  outputs.writes("--json", a.json, isPart ? OutputKind::kPart : OutputKind::kFootball);
  FootballMatrix matrix;
  {
    Progress progress("playing", a.progress);
    matrix = playFootball(config, runOf(a.threads, progress));
  }
  if (isPart) {
    PartWriter part(outputs.ready(a.json), {kFootballParts, a.job, shard});
    addLongText(part.content(), kFootballParts, toJson(matrix, ORTUNG_VERSION));
    part.commit();
    fmt::print("{}: part {}\n", a.json.string(), app::toText(shard));
    return 0;
  }
  if (!a.json.empty()) outputs.write(a.json, toJson(matrix, ORTUNG_VERSION));
  fmt::print("{}", ortung::toText(matrix));
  return 0;
}

int verifyFootballFile(const BenchmarkVerifyArguments& a, std::string_view text) {
  const FootballMatrix matrix = readFootball(text, a.file.string());
  const FootballConfig& c = matrix.config;
  for (std::size_t i = 0; i < c.leagues.size(); ++i)
    if (const std::string here = FootballHalves().fingerprint(c.leagues[i]);
        here != matrix.worlds[i])
      throw std::runtime_error(
          fmt::format("{}: {} was played in the world {}, but the one here "
                      "is {}",
                      a.file.string(), c.leagues[i], matrix.worlds[i], here));
  const std::vector<std::string> wrong = wrongFigures(text, matrix);
  constexpr std::size_t kTold = 10;
  for (std::size_t i = 0; i < wrong.size() && i < kTold; ++i)
    fail(printable(fmt::format("{}: {}", a.file.string(), wrong[i])));
  std::uint64_t played = 0;
  std::uint64_t all = 0;
  for (const FootballCell& cell : matrix.cells) all += cell.halves.size();
  std::vector<FootballMismatch> others;
  {
    Progress progress("playing", a.progress);
    others = verifyFootball(matrix, a.sample, a.seed, runOf(a.threads, progress), played);
  }
  const auto entrants = c.entrants();
  for (const FootballMismatch& one : others) {
    const FootballCell& cell = matrix.cells[one.cell];
    fail(printable(
        fmt::format("{}: half {} of '{}' against '{}' ({}) is {} in the file, but {} "
                    "when it is played again",
                    a.file.string(), one.number, entrants[cell.first], entrants[cell.second],
                    cell.league, toText(one.told), toText(one.found))));
  }
  fmt::print("{} of {} halves were played again, {} with another result\n", played, all,
             others.size());
  return others.empty() && wrong.empty() ? 0 : 1;
}

}  // namespace ortung::app
