#include "Localize.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "Console.hpp"
#include "EstimatesText.hpp"
#include "EvenTimes.hpp"
#include "LocalizedText.hpp"
#include "Localizing.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "PublishedRecord.hpp"
#include "Rescue.hpp"
#include "RobotSettings.hpp"
#include "SourceArguments.hpp"

namespace ortung::app {
namespace {

constexpr double kPatience = 5.0;                  // wait for odometry of a live source [s]
constexpr Timestamp kBetweenBeliefs = 10'000'000;  // between savings, for live sources [us]

enum class Format : std::uint8_t { kText, kJson, kTum };

Format formatOf(const LocalizeArguments& arguments) {
  if (arguments.format == "json") return Format::kJson;
  return arguments.format == "tum" ? Format::kTum : Format::kText;
}

OutputKind kindOf(Format format) {
  if (format == Format::kJson) return OutputKind::kPosesJson;
  return format == Format::kTum ? OutputKind::kPosesTum : OutputKind::kPoses;
}

/// The output of poses: a file, which appears when it is complete or, for a live source, grows with
/// each pose; or stdout, which is flushed after each pose.
class PoseOutput {
 public:
  PoseOutput(const Outputs& outputs, const LocalizeArguments& arguments, bool isLive,
             const Building& building)
      : isLive_(isLive),
        format_(formatOf(arguments)),
        isEven_(arguments.rate.has_value()),
        building_(building) {
    if (!arguments.out.empty()) file_.emplace(outputs.ready(arguments.out));
    if (format_ == Format::kTum) text_ = kTumHeader;
    if (format_ != Format::kText) return;
    text_ = kEstimatesHeader;
    if (!isEven_) return;
    text_.back() = ' ';
    text_ += std::string(kAgeColumns) + "\n";
  }
  /// @param age time since samples were last weighed [s]
  void add(const PoseEstimate& estimate, std::optional<double> age) {
    if (format_ == Format::kJson) {
      appendEstimateJson(estimate, age, building_, text_);
    } else if (format_ == Format::kTum) {
      appendTum(estimate.stamp, estimate.pose, text_);
    } else {
      isEven_ ? appendEstimate(estimate, age, text_) : appendEstimate(estimate, text_);
    }
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
  Format format_;
  bool isEven_;
  const Building& building_;  ///< borrowed
  std::optional<NewFile> file_;
  std::string text_;
};

/// A belief that is kept in a file between runs.
class KeptBelief {
 public:
  /// Restores the belief if the file exists.
  KeptBelief(std::filesystem::path file, Localization& localization)
      : file_(std::move(file)), localization_(localization) {
    if (!file_.empty() && std::filesystem::exists(file_)) localization_.restoreBelief(file_);
  }
  /// Saves the belief repeatedly for a live source, which may end unexpectedly. A failure is not an
  /// error, since the robot must go on.
  void saveNowAndThen() {
    const Timestamp now = localization_.feeder().stamp();
    if (file_.empty() || !localization_.source().isLive()) return;
    if (last_ && now >= *last_ && now - *last_ < kBetweenBeliefs) return;
    last_ = now;
    try {
      save();
    } catch (const std::exception& error) {
      if (!warned_) warn(error.what());
      warned_ = true;
    }
  }
  /// @throws std::runtime_error
  void save() const {
    if (!file_.empty()) localization_.saveBelief(file_);
  }

 private:
  std::filesystem::path file_;
  Localization& localization_;
  std::optional<Timestamp> last_;
  bool warned_ = false;
};

/// Runs MCL over the source, and writes poses: one after each update, or at even times.
class LocalizeRun {
 public:
  LocalizeRun(const LocalizeArguments& arguments, const Outputs& outputs,
              Localization& localization)
      : arguments_(arguments),
        localization_(localization),
        belief_(arguments.belief, localization),
        output_(outputs, arguments, localization.source().isLive(),
                localization.robot().tables.region.building),
        rescue_([this] {
          output_.commit();
          if (record_) record_->commit();
        }) {
    if (arguments.rate) times_.emplace(*arguments.rate);
    if (!arguments.record.empty())
      record_ = std::make_unique<PublishedRecord>(outputs.ready(arguments.record), localization);
    if (arguments.truth.empty()) return;
    truth_.emplace(outputs.ready(arguments.truth));
    truth_->write(kTumHeader);
  }

  void toTheEnd() {
    Progress progress("localizing", arguments_.localization.progress);
    const auto look = [this](const Feeder& feeder) { onMoment(feeder); };
    while (const auto step = nextStep(localization_, arguments_.localization, look)) {
      count_.add(step->estimate);
      weighed_ = step->estimate.stamp;
      if (!warned_ && localization_.feeder().seconds() > kPatience)
        warned_ = warnWithoutOdometry(localization_, arguments_.localization);
      if (!times_) write(step->estimate);
      if (record_) record_->writePublished();
      belief_.saveNowAndThen();
      if (!arguments_.out.empty()) progress.update(localization_.feeder().progress());
    }
  }
  void finish() {
    warnOf(arguments_.localization.source, localization_.source(), localization_.feeder());
    requireUpdates(count_.updates(), arguments_.localization);
    if (times_) writeBefore(localization_.feeder().stamp() + 1);
    if (!warned_) warnWithoutOdometry(localization_, arguments_.localization);
    {
      const auto held = rescue_.hold();
      output_.commit();
      if (truth_) truth_->commit();
      if (record_) record_->commit();
    }
    belief_.save();
    tell();
  }

 private:
  /// Says what was written, and why a run may have no pose that can be relied on.
  void tell() const {
    if (!arguments_.out.empty())
      note(
          fmt::format("{}: {} poses, {:.1f} s", arguments_.out.string(), poses_, count_.seconds()));
    if (!arguments_.record.empty())
      note(fmt::format("{}: all readings, and the results of {} updates",
                       arguments_.record.string(), count_.updates()));
    if (!arguments_.truth.empty()) note(arguments_.truth.string() + ": the true poses");
    if (const std::string why = count_.whyNotTracked(); !why.empty()) note(why);
  }
  /// Writes the poses that are due. A pose uses the readings up to its time; only of odometry the
  /// next reading is used, too, to interpolate between the two.
  void onMoment(const Feeder& feeder) {
    if (truth_ && feeder.truth()) {
      std::string line;
      appendTum(feeder.stamp(), *feeder.truth(), line);
      truth_->write(line);
    }
    if (!times_) return;
    localization_.followOdometry();
    writeBefore(feeder.stamp());
  }
  void writeBefore(Timestamp stamp) {
    for (const Timestamp time : times_->before(stamp))
      if (const auto estimate = localization_.estimate(time)) write(*estimate);
  }
  void write(const PoseEstimate& estimate) {
    std::optional<double> age;
    if (weighed_) age = std::max(0.0, toSeconds(estimate.stamp - *weighed_));
    const auto held = rescue_.hold();
    output_.add(estimate, age);
    ++poses_;
  }

  const LocalizeArguments& arguments_;
  Localization& localization_;
  KeptBelief belief_;
  PoseOutput output_;
  Rescue rescue_;
  std::optional<NewFile> truth_;             ///< ground truth of the source, if it is wanted
  std::unique_ptr<PublishedRecord> record_;  ///< readings and results, if they are wanted
  std::optional<EvenTimes> times_;           ///< even times; nothing: a pose for each update
  std::optional<Timestamp> weighed_;
  UpdateCount count_;
  std::size_t poses_ = 0;
  bool warned_ = false;
};

int localize(const LocalizeArguments& arguments) {
  Outputs outputs(arguments.localization.force);
  declareInputs(arguments.localization, outputs);
  outputs.writes("--out", arguments.out, kindOf(formatOf(arguments)));
  outputs.writes("--truth", arguments.truth, OutputKind::kPosesTum);
  outputs.writes("--belief", arguments.belief, OutputKind::kBelief);
  outputs.writes("--record", arguments.record, OutputKind::kRecord);
  LocalizationArguments wanted = arguments.localization;
  wanted.publish = !arguments.record.empty();
  if (wanted.publish && wanted.filter == "grid")
    throw UsageError("--record needs --filter mcl: the grid filter publishes nothing");
  const std::unique_ptr<Localization> localization = openLocalization(wanted);
  LocalizeRun run(arguments, outputs, *localization);
  run.toTheEnd();
  run.finish();
  return 0;
}

}  // namespace

int runLocalize(const LocalizeArguments& arguments) {
  return withSettings(arguments.localization.robot, arguments.localization.settings,
                      [&] { return localize(arguments); });
}

}  // namespace ortung::app
