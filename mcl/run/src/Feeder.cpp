#include "ortung/run/Feeder.hpp"

#include <stdexcept>
#include <utility>

#include "ortung/formats/PoseData.hpp"

namespace ortung {
namespace {

constexpr std::size_t kUnknownKept = 1000;  ///< names of unknown features; a hostile log has more

}  // namespace

Feeder::Feeder(std::string name, Source& source, SensorContainer& container)
    : name_(std::move(name)), source_(source), container_(container), reader_(source) {}

bool Feeder::next() {
  if (!reader_.next(frame_)) return false;
  stamp_ = frame_.front().stamp;
  if (moments_++ == 0) first_ = stamp_;
  truth_.reset();
  try {
    for (const Message& message : frame_) look(message);
    if (record_ != nullptr) record_->endMoment();
    if (listener_) listener_(frame_);
    container_.set(frame_);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(name_ + ": reading at " + std::to_string(stamp_) +
                             " us: " + error.what());
  }
  return true;
}

void Feeder::look(const Message& message) {
  if (record_ != nullptr) record_->write(message);
  if (message.id.type == kGroundTruth && (!truthId_ || *truthId_ == message.id)) {
    truthId_ = message.id;
    PoseData truth(message.id);
    truth.setData(message.stamp, message.words);
    truth_ = truth.reading();
    return;
  }
  if (container_.findExactly(message.id) != nullptr) return;
  const std::string name = toText(message.id);
  const auto known = unknown_.find(name);
  if (known != unknown_.end()) {
    ++known->second;
  } else if (unknown_.size() < kUnknownKept) {
    unknown_.emplace(name, 1);
  }
}

}  // namespace ortung
