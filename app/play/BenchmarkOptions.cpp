#include "Benchmark.hpp"
#include "CommandModule.hpp"
#include "Football.hpp"
#include "OptionBuilder.hpp"

namespace ortung::app {
namespace {

void addGoalkeeper(Builder& build) {
  const auto a = build.command<GoalkeeperBenchmarkArguments>(
      "benchmark goalkeeper",
      "ortung benchmark goalkeeper --episodes 1000 --threads 2 --json matrix.json",
      runGoalkeeperBenchmark);
  build
      .option("--keepers", a->keepers,
              "Goalkeepers: policies (still, random, pattern, blocking, intercepting, mixed) or "
              "players PLUGIN[:key=value&...]; default: all policies")
      .splitsAt(',');
  build
      .option("--strikers", a->strikers,
              "Strikers: kinds (roll, shot, dribble, feint, seeker, yardstick-v1) or players "
              "PLUGIN[:key=value&...]; default: all kinds")
      .splitsAt(',');
  build
      .option("--sees", a->sees,
              "How keepers perceive themselves and the ball; each plays with each of: truth, "
              "features (the ball by its camera), scan (itself by single scans, too), localized "
              "(by MCL)")
      .splitsAt(',')
      .oneOf({"truth", "features", "scan", "localized"});
  build.option("--episodes", a->episodes, "Episodes of each pair").within(1, 1e7).showsDefault();
  build.option("--seed", a->seed, "Seed of all situations").showsDefault();
  build.option("--threads", a->threads, "Episodes that are played at the same time")
      .within(1, 256)
      .showsDefault();
  build.shard(a->shard, a->job);
  build.option("--json", a->json, "Also write all figures and episodes");
  build.option("--html", a->html, "Also write a page with all figures and pictures of episodes");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addFootball(Builder& build) {
  const auto a = build.command<FootballBenchmarkArguments>(
      "benchmark football",
      "ortung benchmark football --leagues f2000 --halves 10 --half-s 60 --threads 2",
      runFootballBenchmark);
  build.option("--leagues", a->leagues, "Leagues: f2000, msl; default: both")
      .splitsAt(',')
      .oneOf({"f2000", "msl"});
  build
      .option("--teams", a->teams,
              "Teams PLAYER[+KEEPER], both PLUGIN[:key=value&...]; the keeper's default is that of "
              "the league's scene; a single team plays against itself")
      .splitsAt(',')
      .showsDefault();
  build
      .option("--against", a->against,
              "Opponents of all teams, e.g. footballer-v1; default: each other")
      .splitsAt(',');
  build
      .option("--sees", a->sees,
              "How teams perceive; each plays with each of: truth, features (ball and robots by "
              "cameras), localized (their poses by MCL, too)")
      .splitsAt(',')
      .oneOf({"truth", "features", "localized"});
  build.option("--halves", a->halves, "Halves of each pair in each league")
      .within(1, 1e6)
      .showsDefault();
  build.option("--half-s", a->seconds, "Length of a half [s]; 0: 600 in f2000, 900 in msl")
      .within(0.0, 7200.0)
      .showsDefault();
  build.option("--seed", a->seed, "Seed of all halves").showsDefault();
  build.option("--threads", a->threads, "Halves that are played at the same time")
      .within(1, 256)
      .showsDefault();
  build.shard(a->shard, a->job);
  build.option("--json", a->json, "Also write all figures and halves");
  build.flag("--force", a->force, kForce);
  build.flag("--progress", a->progress, kProgress);
}

void addVerify(Builder& build) {
  const auto a = build.command<BenchmarkVerifyArguments>(
      "benchmark verify", "ortung benchmark verify matrix.json --sample 500", runBenchmarkVerify);
  build.option("file", a->file, "JSON of `ortung benchmark goalkeeper` or `football`").required();
  build
      .option("--sample", a->sample,
              "How many episodes are played again, of all pairs together and as many of each as of "
              "the others, or one more")
      .within(1, 1e7)
      .showsDefault();
  build.option("--seed", a->seed, "Seed of the choice").showsDefault();
  build.option("--threads", a->threads, "Episodes that are played at the same time")
      .within(1, 256)
      .showsDefault();
  build.flag("--progress", a->progress, kProgress);
}

void addMerge(Builder& build) {
  const auto a = build.command<BenchmarkMergeArguments>(
      "benchmark merge", "ortung benchmark merge 1.part 2.part --json matrix.json",
      runBenchmarkMerge);
  build.option("files", a->files, "Parts of all shards").required();
  build.option("--json", a->json, "File to write");
  build.option("--html", a->html, "Also write a page with all figures and pictures of episodes");
  build.flag("--force", a->force, kForce);
}

}  // namespace
}  // namespace ortung::app

ORTUNG_COMMAND_MODULE(ortung::app::addGoalkeeper, ortung::app::addFootball, ortung::app::addVerify,
                      ortung::app::addMerge)
