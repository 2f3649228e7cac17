#include "ortung/study/Splice.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "ortung/base/Pose2.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/run/Feeder.hpp"

namespace ortung {
namespace {

constexpr Timestamp kLongestPause = 1'000'000;  ///< longest pause between two pieces [us]
constexpr Timestamp kUsualPause = 100'000;      ///< pause where the log has no next time step [us]

using Names = std::set<std::string>;

Names odometryOf(const SensorContainer& robot) {
  Names names;
  for (const auto& data : robot.all())
    if (isOf(*data, formats::kOdometry)) names.insert(toText(data->id()));
  return names;
}

/// Odometry of one feature, whose frame differs from piece to piece.
struct JoinedOdometry {
  std::size_t piece = 0;
  std::optional<Pose2> told;  ///< newest pose, as reported
  Pose2 frame;                ///< odometry frame of the piece in that of the first one

  void join(Message& message, std::size_t now) {
    OdometryData data(message.id);
    try {
      data.setData(message.stamp, message.words);
    } catch (const std::invalid_argument&) {
      return;  // the consumer reports what is wrong
    }
    OdometryData::Reading reading = data.reading();
    if (piece != now && told) frame = *told * inverse(reading.pose);
    const bool isAsItWas = now == 0 || (piece != now && !told);
    piece = now;
    if (isAsItWas) {
      told = reading.pose;
      return;
    }
    reading.pose = frame * reading.pose;
    told = reading.pose;
    message.words = OdometryData::encode(reading);
  }
};

class SplicedSource : public Source {
 public:
  SplicedSource(std::shared_ptr<const Splice> splice, const SensorContainer& robot)
      : splice_(std::move(splice)),
        odometry_(odometryOf(robot)),
        next_(splice_->pieces().front().begin) {}

  bool next(Message& message) override {
    const std::vector<Piece>& pieces = splice_->pieces();
    if (piece_ < pieces.size() && next_ == pieces[piece_].end && ++piece_ < pieces.size())
      next_ = pieces[piece_].begin;
    if (piece_ == pieces.size()) return false;
    message = splice_->recording().messages()[next_++];
    message.stamp += splice_->shift(piece_);
    const std::string name = toText(message.id);
    if (odometry_.contains(name)) joined_[name].join(message, piece_);
    return true;
  }

  double progress() const override {
    std::size_t all = 0;
    std::size_t done = 0;
    for (std::size_t i = 0; i < splice_->pieces().size(); ++i) {
      const Piece& piece = splice_->pieces()[i];
      all += piece.end - piece.begin;
      if (i < piece_) done += piece.end - piece.begin;
      if (i == piece_) done += next_ - piece.begin;
    }
    return static_cast<double>(done) / static_cast<double>(all);
  }
  std::string worldFingerprint() const override { return splice_->recording().worldFingerprint(); }

 private:
  std::shared_ptr<const Splice> splice_;
  Names odometry_;
  std::map<std::string, JoinedOdometry> joined_;
  std::size_t piece_ = 0;
  std::size_t next_;  ///< message
};

}  // namespace

Splice::Splice(std::shared_ptr<const Recording> recording, std::vector<Piece> pieces)
    : recording_(std::move(recording)), pieces_(std::move(pieces)) {
  const std::vector<Message>& messages = recording_->messages();
  if (pieces_.empty()) throw std::invalid_argument("a splice has at least one piece");
  for (const Piece& piece : pieces_) {
    if (piece.begin >= piece.end || piece.end > messages.size())
      throw std::invalid_argument("a piece has messages of its recording, at least one");
    if (shifts_.empty()) {
      shifts_.push_back(0);
      continue;
    }
    const std::size_t before = pieces_[shifts_.size() - 1].end;
    const Timestamp last = messages[before - 1].stamp;
    const Timestamp pause = before < messages.size() ? std::clamp(messages[before].stamp - last,
                                                                  Timestamp{1}, kLongestPause)
                                                     : kUsualPause;
    joins_.push_back(last + shifts_.back() + pause);
    shifts_.push_back(joins_.back() - messages[piece.begin].stamp);
  }
}

Splice::~Splice() = default;

Timestamp Splice::first() const { return recording_->messages()[pieces_.front().begin].stamp; }

std::size_t Splice::readings(const SensorContainer& robot, Timestamp from, Timestamp to) const {
  const Names odometry = odometryOf(robot);
  std::size_t count = 0;
  std::optional<Timestamp> counted;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    for (std::size_t m = pieces_[i].begin; m < pieces_[i].end; ++m) {
      const Message& message = recording_->messages()[m];
      const Timestamp stamp = message.stamp + shifts_[i];
      if (stamp < from || stamp >= to || counted == stamp) continue;
      if (message.id.type == kGroundTruth || odometry.contains(toText(message.id))) continue;
      counted = stamp;
      ++count;
    }
  }
  return count;
}

std::unique_ptr<Source> play(std::shared_ptr<const Splice> splice, const SensorContainer& robot) {
  return std::make_unique<SplicedSource>(std::move(splice), robot);
}

}  // namespace ortung
