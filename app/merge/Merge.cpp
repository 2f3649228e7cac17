#include "Merge.hpp"

#include <fmt/format.h>

#include <string>

#include "CalibrateNoise.hpp"
#include "Console.hpp"
#include "EvalParts.hpp"
#include "Football.hpp"
#include "GoalkeeperParts.hpp"
#include "LearnParts.hpp"
#include "NoiseParts.hpp"
#include "Outputs.hpp"
#include "PartSet.hpp"
#include "ortung/benchmark/MatrixPage.hpp"
#ifdef ORTUNG_HAS_PICTURES
#include "PictureParts.hpp"
#endif

namespace ortung::app {
namespace {

/// Declares the output of tables, figures, ..., and returns its name.
const std::filesystem::path& outOf(const MergeArguments& arguments, Outputs& outputs,
                                   OutputKind kind) {
  outputs.writes("--out", arguments.out, kind);
  return outputs.ready(arguments.out);
}

void mergeRuns(const PartSet& parts, const MergeArguments& arguments, Outputs& outputs) {
  const std::filesystem::path& out = outOf(arguments, outputs, OutputKind::kFigures);
  const std::vector<KeptRun> runs = mergeEvaluated(parts);
  outputs.write(out, figuresOf(runs));
  fmt::print("{}", toText(runs));
}

void mergeBenchmark(const PartSet& parts, const MergeArguments& arguments, Outputs& outputs) {
  const std::filesystem::path& out = outOf(arguments, outputs, OutputKind::kBenchmark);
  outputs.writes("--html", arguments.html, OutputKind::kPage);
  const GoalMatrix matrix = mergeMatrices(parts);
  outputs.write(out, toJson(matrix, ORTUNG_VERSION));
  if (!arguments.html.empty()) outputs.write(arguments.html, toHtml(matrix, ORTUNG_VERSION));
  fmt::print("{}", toText(matrix));
}

void mergeHalves(const PartSet& parts, const MergeArguments& arguments, Outputs& outputs) {
  const std::filesystem::path& out = outOf(arguments, outputs, OutputKind::kFootball);
  const FootballMatrix matrix = mergeFootballParts(parts);
  outputs.write(out, toJson(matrix, ORTUNG_VERSION));
  fmt::print("{}", toText(matrix));
}

void merge(const MergeArguments& arguments) {
  Outputs outputs(arguments.force);
  for (const auto& part : arguments.parts) outputs.reads(part);
  const PartSet parts(arguments.parts);
  const std::string& kind = parts.head().kind;
  if (!arguments.html.empty() && kind != kGoalkeeperParts)
    throw UsageError("--html is for parts of `ortung benchmark goalkeeper`; these are of '" +
                     printable(kind) + "'");
  if (kind == kLearnParts)
    return mergeLearned(parts, outOf(arguments, outputs, OutputKind::kTables), arguments.progress);
  if (kind == kNoiseParts) {
    const std::filesystem::path& out = outOf(arguments, outputs, OutputKind::kSettings);
    return outputs.write(out, mergeNoise(parts));
  }
  if (kind == kEvalParts) return mergeRuns(parts, arguments, outputs);
  if (kind == kGoalkeeperParts) return mergeBenchmark(parts, arguments, outputs);
  if (kind == kFootballParts) return mergeHalves(parts, arguments, outputs);
#ifdef ORTUNG_HAS_PICTURES
  if (kind == kPictureParts) {
    fmt::print("{}: {} pictures\n", arguments.out.string(),
               mergePictures(parts, arguments.out, arguments.force));
    return;
  }
#endif
  throw PartError({"the parts are of '" + kind + "', which this program can't join"});
}

}  // namespace

int runMerge(const MergeArguments& arguments) {
  try {
    merge(arguments);
    return 0;
  } catch (const PartError& error) {
    for (const std::string& reason : error.reasons()) fail(printable(reason));
  } catch (const TableError& error) {
    fail(printable(error.what()));
  }
  return kBadParts;
}

}  // namespace ortung::app
