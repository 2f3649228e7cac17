#include "Benchmark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "Console.hpp"
#include "Football.hpp"
#include "GoalkeeperParts.hpp"
#include "Interrupt.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "ortung/base/InputFile.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"
#include "ortung/benchmark/MatrixPage.hpp"

namespace ortung::app {
namespace {

std::string readResult(const std::filesystem::path& file) {
  std::string why;
  std::ifstream in = openInput(file, why);
  if (!in) throw std::runtime_error(file.string() + ": " + why);
  // That many are 10,000,000 episodes of several pairs. A device or a pipe may go on for ever.
  constexpr std::size_t kMostBytes = std::size_t{1} << 30;
  constexpr std::size_t kPiece = 1U << 20;
  std::string text;
  while (in && text.size() <= kMostBytes) {
    const std::size_t before = text.size();
    text.resize(before + kPiece);
    in.read(text.data() + before, kPiece);
    text.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  if (text.size() > kMostBytes)
    throw std::runtime_error(file.string() + ": has more than 1 GiB, expected a result of " +
                             "`ortung benchmark`");
  return text;
}

GoalMatrix readMatrix(const std::filesystem::path& file) {
  return readGoalMatrix(readResult(file), file.string());
}

/// Says which figures of a result are not those of its episodes. @return their number
std::size_t tellWrongFigures(const std::filesystem::path& file, const std::string& text,
                             const GoalMatrix& matrix) {
  constexpr std::size_t kTold = 10;
  const std::vector<std::string> wrong = wrongFigures(text, matrix);
  for (std::size_t i = 0; i < std::min(kTold, wrong.size()); ++i)
    fail(printable(fmt::format("{}: {}", file.string(), wrong[i])));
  if (wrong.size() > kTold)
    fail(printable(fmt::format("{}: {} more figures are not those of its episodes", file.string(),
                               wrong.size() - kTold)));
  return wrong.size();
}

GoalMatrixRun runOf(unsigned threads, Progress& progress) {
  return {threads, [&progress](double share) {
            checkInterrupt();
            progress.update(share);
            return true;
          }};
}

std::string toText(const GoalEpisode& episode) {
  return fmt::format("{} after {:.2f} s, digest {:08x}", nameOf(episode.outcome),
                     toSeconds(episode.end), episode.digest);
}

/// Returns each keeper with each kind of perception.
std::vector<std::string> keepersOf(const GoalkeeperBenchmarkArguments& a) {
  std::vector<std::string> names = a.keepers;
  if (names.empty())
    for (const auto policy : goalkeeperPolicies()) names.emplace_back(policy);
  std::vector<std::string> keepers;
  for (const std::string& name : names) {
    if (a.sees.empty()) keepers.push_back(keeperText(name));
    for (const std::string& sees : a.sees) keepers.push_back(withSight(keeperText(name), sees));
  }
  return keepers;
}

void writeResults(const GoalMatrix& matrix, const std::filesystem::path& json,
                  const std::filesystem::path& html, const Outputs& outputs) {
  if (!json.empty()) outputs.write(json, toJson(matrix, ORTUNG_VERSION));
  if (!html.empty()) outputs.write(html, toHtml(matrix, ORTUNG_VERSION));
  fmt::print("{}", toText(matrix));
}

bool isJson(const std::filesystem::path& file) {
  std::string why;
  std::ifstream in = openInput(file, why);
  return in && in.peek() == '{';
}

/// Merges what --shard wrote before there were parts.
GoalMatrix mergeOld(const std::vector<std::filesystem::path>& files) {
  std::vector<GoalMatrix> shards;
  for (const auto& file : files) shards.push_back(readMatrix(file));
  return mergeShards(shards);
}

GoalMatrix mergeParts(const std::vector<std::filesystem::path>& files) {
  const PartSet parts(files);
  if (parts.head().kind != kGoalkeeperParts)
    throw PartError({"the parts are of '" + parts.head().kind +
                     "', expected those of `ortung benchmark goalkeeper`"});
  return mergeMatrices(parts);
}

}  // namespace

int runGoalkeeperBenchmark(const GoalkeeperBenchmarkArguments& a) {
  GoalMatrixConfig config;
  config.episodes = a.episodes;
  config.seed = a.seed;
  const Shard shard = a.shard.empty() ? Shard() : readShard(a.shard);
  config.shard = shard.number;
  config.shards = shard.count;
  for (const std::string& name : a.strikers) config.strikers.push_back(strikerText(name));
  config.keepers = keepersOf(a);
  if (a.strikers.empty())
    for (const auto kind : strikerKinds())
      config.strikers.push_back(strikerText(std::string(kind)));
  try {
    config.check();
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  const bool isPart = !a.shard.empty();
  if (isPart && a.json.empty())
    throw UsageError("--shard writes a part, expected its name: --json");
  if (isPart && !a.html.empty())
    throw UsageError("--html does not go with --shard, but with merge");
  Outputs outputs(a.force);
  outputs.writes("--json", a.json, isPart ? OutputKind::kPart : OutputKind::kBenchmark);
  outputs.writes("--html", a.html, OutputKind::kPage);
  GoalMatrix matrix;
  {
    Progress progress("playing", a.progress);
    matrix = playMatrix(config, runOf(a.threads, progress));
  }
  if (isPart) {
    write(matrix, {kGoalkeeperParts, a.job, shard}, outputs.ready(a.json));
    fmt::print("{}: part {}\n", a.json.string(), toText(shard));
    return 0;
  }
  writeResults(matrix, a.json, a.html, outputs);
  return 0;
}

int runBenchmarkVerify(const BenchmarkVerifyArguments& a) {
  const std::string text = readResult(a.file);
  if (isFootballJson(text)) return verifyFootballFile(a, text);
  const GoalMatrix matrix = readGoalMatrix(text, a.file.string());
  if (const std::string here = GoalEpisodes().fingerprint(); here != matrix.world)
    throw std::runtime_error(fmt::format("{}: was played in the world {}, but the one here is {}",
                                         a.file.string(), matrix.world, here));
  const std::size_t wrong = tellWrongFigures(a.file, text, matrix);
  std::uint64_t played = 0;
  std::vector<GoalMismatch> others;
  {
    Progress progress("playing", a.progress);
    others = verify(matrix, a.sample, a.seed, runOf(a.threads, progress), played);
  }
  for (const GoalMismatch& one : others)
    fail(
        printable(fmt::format("{}: episode {} of '{}' against '{}' is {} in the file, but {} when "
                              "it is played again",
                              a.file.string(), one.number, one.striker, one.keeper,
                              toText(one.told), toText(one.found))));
  fmt::print("{} of {} episodes were played again, {} with another result\n", played,
             matrix.cells.size() * matrix.cells.front().episodes.size(), others.size());
  if (wrong > 0) fmt::print("{} figures are not those of the episodes\n", wrong);
  return others.empty() && wrong == 0 ? 0 : 1;
}

int runBenchmarkMerge(const BenchmarkMergeArguments& a) {
  Outputs outputs(a.force);
  for (const auto& file : a.files) outputs.reads(file);
  outputs.writes("--json", a.json, OutputKind::kBenchmark);
  outputs.writes("--html", a.html, OutputKind::kPage);
  try {
    writeResults(isJson(a.files.front()) ? mergeOld(a.files) : mergeParts(a.files), a.json, a.html,
                 outputs);
    return 0;
  } catch (const PartError& error) {
    for (const std::string& reason : error.reasons()) fail(printable(reason));
  }
  return kBadParts;
}

}  // namespace ortung::app
