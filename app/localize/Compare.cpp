#include "Compare.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "Comparison.hpp"
#include "Outputs.hpp"
#include "RunFile.hpp"

namespace ortung::app {

int runCompare(const CompareArguments& arguments) {
  Outputs outputs(arguments.force);
  outputs.reads(arguments.before);
  outputs.reads(arguments.after);
  outputs.writes("--json", arguments.json, OutputKind::kComparison);
  const Comparison comparison = compare(readRuns(arguments.before), readRuns(arguments.after));
  if (comparison.pairs == 0) {
    const auto first = [](const std::vector<std::string>& names) {
      return names.empty() ? std::string("none") : "'" + names.front() + "'";
    };
    throw std::runtime_error(fmt::format(
        "{} and {} have no run in common: pairs are of the same source, robot, start, seed, "
        "faults and case; the first ones are {} and {}",
        arguments.before.string(), arguments.after.string(), first(comparison.onlyBefore),
        first(comparison.onlyAfter)));
  }
  if (!arguments.json.empty()) outputs.write(arguments.json, toJson(comparison));
  fmt::print("{}", toText(comparison));
  return 0;
}

}  // namespace ortung::app
