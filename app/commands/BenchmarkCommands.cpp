#include "BenchmarkCommands.hpp"

#include "Commands.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addGoalkeeper(Builder& build, CLI::App& app) {
  const auto a = build.command<GoalkeeperBenchmarkArguments>(
      app, "goalkeeper", "Every goalkeeper against every striker, from the same situations",
      "ortung benchmark goalkeeper --episodes 1000 --threads 2 --json matrix.json",
      runGoalkeeperBenchmark);
  build
      .option("--keepers", a->keepers,
              "Goalkeepers: policies (still, random, pattern, blocking, intercepting, mixed) or "
              "players PLUGIN[:key=value&...]; default: all policies")
      ->delimiter(',');
  build
      .option("--strikers", a->strikers,
              "Strikers: kinds (roll, shot, dribble, feint, seeker, yardstick-v1) or players "
              "PLUGIN[:key=value&...]; default: all kinds")
      ->delimiter(',');
  build
      .option("--sees", a->sees,
              "How keepers know where they and the ball are; each plays in each way: truth, "
              "features (the ball by its camera), scan (itself by single scans, too), localized "
              "(by MCL)")
      ->delimiter(',')
      ->check(CLI::IsMember({"truth", "features", "scan", "localized"}));
  build.option("--episodes", a->episodes, "Episodes of each pair")
      ->check(within(1, 1e7))
      ->capture_default_str();
  build.option("--seed", a->seed, "Seed of all situations")->capture_default_str();
  build.option("--threads", a->threads, "Episodes that are played at the same time")
      ->check(within(1, 256))
      ->capture_default_str();
  build
      .option("--shard", a->shard,
              "I/N: play the I-th of N parts only; `ortung benchmark merge` joins them")
      ->capture_default_str();
  build.option("--json", a->json, "Also write all figures and episodes");
  build.option("--html", a->html, "Also write a page with all figures and pictures of episodes");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addVerify(Builder& build, CLI::App& app) {
  const auto a = build.command<BenchmarkVerifyArguments>(
      app, "verify", "Play some episodes of a result again and compare them bit for bit",
      "ortung benchmark verify matrix.json --sample 500", runBenchmarkVerify);
  build.option("file", a->file, "JSON of `ortung benchmark goalkeeper`")->required();
  build
      .option("--sample", a->sample,
              "How many episodes are played again, of all pairs together; at least one of each")
      ->check(within(1, 1e7))
      ->capture_default_str();
  build.option("--seed", a->seed, "Seed of the choice")->capture_default_str();
  build.option("--threads", a->threads, "Episodes that are played at the same time")
      ->check(within(1, 256))
      ->capture_default_str();
  build.flag("--progress", a->progress, kProgress);
}

void addMerge(Builder& build, CLI::App& app) {
  const auto a = build.command<BenchmarkMergeArguments>(
      app, "merge", "Join the shards of a benchmark",
      "ortung benchmark merge part1.json part2.json --json matrix.json", runBenchmarkMerge);
  build.option("files", a->files, "JSON of all shards")->required();
  build.option("--json", a->json, "File to write");
  build.option("--html", a->html, "Also write a page with all figures and pictures of episodes");
  build.flag("--force", a->force, kForce);
}

}  // namespace

void addBenchmark(Builder& build, CLI::App& app) {
  CLI::App* benchmark =
      app.add_subcommand("benchmark", "Measure players, and check what others have measured");
  benchmark->require_subcommand(1);
  benchmark->footer("Example:\n  ortung benchmark goalkeeper --episodes 1000");
  addGoalkeeper(build, *benchmark);
  addVerify(build, *benchmark);
  addMerge(build, *benchmark);
}

}  // namespace ortung::app
