#include "ortung/core/SensorContainer.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "Extraction.hpp"

namespace ortung {
namespace {

bool matches(std::string_view wanted, const std::string& name) {
  return wanted.empty() || wanted == "*" || wanted == name;
}

}  // namespace

bool matches(const SensorQuery& query, const SensorId& id) {
  return matches(query.model, id.model) && matches(query.type, id.type) &&
         matches(query.feature, id.feature);
}

SensorQuery parseSensorQuery(std::string_view text) {
  const std::size_t first = text.find('/');
  const std::size_t second = first == text.npos ? text.npos : text.find('/', first + 1);
  if (second == text.npos || text.find('/', second + 1) != text.npos) {
    throw std::invalid_argument("'" + std::string(text) +
                                "' is not model/type/feature (each may be *)");
  }
  return {text.substr(0, first), text.substr(first + 1, second - first - 1),
          text.substr(second + 1)};
}

SensorContainer::SensorContainer() : extraction_(std::make_unique<Extraction>()) {}
SensorContainer::~SensorContainer() = default;

SensorData& SensorContainer::add(std::unique_ptr<SensorData> data) {
  if (findExactly(data->id()) != nullptr) {
    throw std::invalid_argument("feature already in the container: " + toText(data->id()) +
                                "; give one of the two another model, type or feature");
  }
  return *data_.emplace_back(std::move(data));
}

void SensorContainer::add(std::string name, std::unique_ptr<Extractor> extractor,
                          std::vector<SensorData*> outputs) {
  extraction_->add(std::move(name), std::move(extractor), std::move(outputs));
}

void SensorContainer::connect() { extraction_->connect(data_); }

std::vector<const SensorData*> SensorContainer::inputsOf(const SensorData& made) const {
  return extraction_->inputsOf(made);
}

void SensorContainer::setField(std::shared_ptr<const FieldModel> field) {
  const std::unique_lock lock(mutex_);
  extraction_->setField(std::move(field));
}

void SensorContainer::extract() {
  if (!extraction_->isEmpty()) extraction_->run(mutex_);
}

SensorData* SensorContainer::find(const SensorQuery& query) const {
  const auto it = std::find_if(data_.begin(), data_.end(),
                               [&](const auto& d) { return matches(query, d->id()); });
  return it == data_.end() ? nullptr : it->get();
}

std::vector<SensorData*> SensorContainer::findAll(const SensorQuery& query) const {
  std::vector<SensorData*> found;
  for (const auto& data : data_) {
    if (matches(query, data->id())) found.push_back(data.get());
  }
  return found;
}

SensorData* SensorContainer::findExactly(const SensorId& id) const {
  const auto it =
      std::find_if(data_.begin(), data_.end(), [&](const auto& d) { return d->id() == id; });
  return it == data_.end() ? nullptr : it->get();
}

bool SensorContainer::set(const Message& message) { return set({&message, 1}) == 0; }

std::size_t SensorContainer::set(std::span<const Message> frame) {
  bool isRead = false;
  const std::size_t unknown = take(frame, isRead);
  if (isRead) extract();
  return unknown;
}

/// @param isRead out: whether an extractor reads a feature of the frame
std::size_t SensorContainer::take(std::span<const Message> frame, bool& isRead) {
  const std::unique_lock lock(mutex_);
  targets_.clear();
  std::size_t unknown = 0;
  for (const Message& message : frame) {
    SensorData* data = targets_.emplace_back(findExactly(message.id));
    if (data == nullptr) {
      ++unknown;
    } else {
      data->checkData(message.words);
    }
  }
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (targets_[i] != nullptr) {
      targets_[i]->setData(frame[i].stamp, frame[i].words);
      isRead = isRead || extraction_->reads(*targets_[i]);
    }
  }
  return unknown;
}

SensorContainer::ReadLock SensorContainer::read() const { return ReadLock(mutex_); }

void SensorContainer::getProbability(const SampleView& poses,
                                     std::span<float> logProbability) const {
  for (const auto& data : data_) data->getProbability(poses, logProbability);
}

double SensorContainer::getProbability(const Pose2& pose) const {
  const auto x = static_cast<float>(pose.x);
  const auto y = static_cast<float>(pose.y);
  const auto theta = static_cast<float>(pose.theta);
  const SampleView one{{&x, 1}, {&y, 1}, {&theta, 1}};
  double sum = 0.0;  // double, since many features in float are added up
  bool any = false;
  for (const auto& data : data_) {
    const std::shared_ptr<const Weigher> weigher = data->weigher();
    if (!weigher) continue;
    float logProbability = 0.0F;
    weigher->getProbability(one, {&logProbability, 1});
    sum += static_cast<double>(logProbability);
    any = true;
  }
  return any ? std::exp(sum) : kNoExpectation;
}

}  // namespace ortung
