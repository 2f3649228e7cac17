#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "Commands.hpp"
#include "Console.hpp"
#include "EstimatesText.hpp"
#include "Localizing.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "Rescue.hpp"
#include "SourceArguments.hpp"

namespace ortung::app {
namespace {

/// Where the poses go: to a file, which appears whole or, of a live source, grows with each pose;
/// or to stdout, where whoever reads it gets each pose as soon as it is known.
class PoseOutput {
 public:
  PoseOutput(const Outputs& outputs, const std::filesystem::path& file, bool isLive)
      : isLive_(isLive) {
    if (!file.empty()) file_.emplace(outputs.ready(file));
    text_ = kEstimatesHeader;
  }
  void add(const PoseEstimate& estimate) {
    appendEstimate(estimate, text_);
    if (file_) {
      file_->write(text_);
      if (isLive_) file_->publish();
    } else {
      fmt::print("{}", text_);
      flushOutput();
    }
    text_.clear();
  }
  void commit() {
    if (file_) file_->commit();
  }

 private:
  bool isLive_;
  std::optional<NewFile> file_;
  std::string text_;
};

}  // namespace

int runLocalize(const LocalizeArguments& arguments) {
  const LocalizationArguments& run = arguments.localization;
  Outputs outputs(run.force);
  declareInputs(run, outputs);
  outputs.writes("--out", arguments.out, OutputKind::kPoses);
  const std::unique_ptr<Localization> localization = openLocalization(run);
  const Source& source = localization->source();
  PoseOutput output(outputs, arguments.out, source.isLive());
  Rescue rescue([&] { output.commit(); });
  constexpr double kPatience = 5.0;  // for the first odometry of a live source [s]
  std::size_t updates = 0;
  bool warned = false;
  {
    Progress progress("localizing", run.progress);
    while (const std::optional<EvaluationStep> step = nextStep(*localization, run)) {
      ++updates;
      if (!warned && localization->feeder().seconds() > kPatience)
        warned = warnWithoutOdometry(*localization, run);
      {
        const auto held = rescue.hold();
        output.add(step->estimate);
      }
      if (!arguments.out.empty()) progress.update(localization->feeder().progress());
    }
  }
  warnOf(run.source, source, localization->feeder());
  requireUpdates(updates, run);
  if (!warned) warnWithoutOdometry(*localization, run);
  const auto held = rescue.hold();
  output.commit();
  return 0;
}

}  // namespace ortung::app
