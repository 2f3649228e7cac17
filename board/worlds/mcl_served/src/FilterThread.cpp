#include "ortung/mcl_served/FilterThread.hpp"

#include <algorithm>
#include <utility>

#include "Orders.hpp"
#include "ortung/formats/FeatureOf.hpp"
#include "ortung/formats/FormatNames.hpp"
#include "ortung/formats/OdometryData.hpp"
#include "ortung/server/Patience.hpp"

namespace ortung {
namespace {

using Kind = LocalizationState::Kind;

constexpr const char* kModel = "mcl";
constexpr const char* kType = "LOCALIZATION";

void add(const SensorId& id, std::vector<SensorId>& ids) {
  if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
}

void addWithInputs(const SensorContainer& container, const SensorData& data,
                   std::vector<SensorId>& ids) {
  add(data.id(), ids);
  for (const SensorData* input : container.inputsOf(data)) addWithInputs(container, *input, ids);
}

std::vector<SensorId> needsOf(const SensorContainer& container) {
  std::vector<SensorId> ids;
  for (const auto& data : container.all())
    if (data->localizes() || isOf(*data, formats::kOdometry)) addWithInputs(container, *data, ids);
  return ids;
}

/// Whether something that was given is of this kind.
template <typename What>
struct IsA {
  bool operator()(const auto& given) const { return std::holds_alternative<What>(given); }
};

bool isOff(const LocalizationOrder& order) { return order.kind == LocalizationOrder::Kind::kOff; }

LocalizationStart startOf(const LocalizationOrder& order) {
  if (order.kind != LocalizationOrder::Kind::kPlace) return {};
  return {LocalizationStart::Kind::kPose, order.pose, order.sigmaPosition, order.sigmaHeading};
}

}  // namespace

FilterThread::FilterThread(Config config)
    : config_(std::move(config)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

FilterThread::~FilterThread() = default;

// --- for others

void FilterThread::take(std::span<const Message> moment) {
  {
    const std::lock_guard lock(mutex_);
    if (!perceiver_) return;
    Moment needed;
    for (const Message& message : moment)
      if (std::find(needs_.begin(), needs_.end(), message.id) != needs_.end())
        needed.push_back(message);
    if (needed.empty()) return;
    give(std::move(needed), kMostMoments);
  }
  news_.notify_one();
}

void FilterThread::order(const LocalizationOrder& order) {
  std::shared_ptr<Localization> known;
  {
    const std::lock_guard lock(mutex_);
    known = perceiver_;
  }
  if (known && order.kind == Order::Kind::kPlace) known->checkPose(order.pose, order.sigmaPosition);
  {
    const std::lock_guard lock(mutex_);
    isWanted_ = !isOff(order);
    if (!isWanted_)
      state_ = {};
    else if (state_.kind == Kind::kOff || state_.kind == Kind::kFailed)
      state_ = {Kind::kLearning};
    give(order, kMostOrders);
  }
  news_.notify_one();
}

void FilterThread::restart() {
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(inbox_, IsA<Moment>());
    give(Restart(), 1);
    published_.clear();
  }
  news_.notify_one();
}

void FilterThread::wantSamples(bool wanted) {
  const std::lock_guard lock(mutex_);
  wantsSamples_ = wanted;
  if (perceiver_) perceiver_->wantSamples(wanted);
}

/// @pre mutex_ is locked
template <typename Given>
void FilterThread::give(Given given, std::size_t most) {
  const auto those = std::ranges::count_if(inbox_, IsA<Given>());
  if (static_cast<std::size_t>(those) == most)
    inbox_.erase(std::ranges::find_if(inbox_, IsA<Given>()));
  inbox_.emplace_back(std::move(given));
}

LocalizationState FilterThread::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

std::shared_ptr<const Robot> FilterThread::perceiver() const {
  const std::lock_guard lock(mutex_);
  if (!perceiver_) return nullptr;
  return {perceiver_, &perceiver_->robot()};
}

std::vector<SensorId> FilterThread::needs() const {
  const std::lock_guard lock(mutex_);
  return needs_;
}

void FilterThread::takePublished(std::vector<Message>& out) {
  const std::lock_guard lock(mutex_);
  for (Message& message : published_) out.push_back(std::move(message));
  published_.clear();
}

void FilterThread::requestStop() { thread_.request_stop(); }

// --- the thread

void FilterThread::run(const std::stop_token& stop) {
  const Patience patience(Patience::kBeside);
  while (auto inbox = await(stop)) {
    while (!inbox->empty() && !stop.stop_requested()) {
      try {
        take(*inbox, stop);
      } catch (const std::exception& error) {
        close({Kind::kFailed, 0.0, error.what()});
      } catch (...) {  // plugins may throw anything
        close({Kind::kFailed, 0.0, "it threw no std::exception"});
      }
    }
  }
  isOver_ = true;
}

/// What there is to do; nothing at the end.
std::optional<FilterThread::Inbox> FilterThread::await(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const bool hasNews = news_.wait(lock, stop, [this] { return !inbox_.empty(); });
  if (!hasNews || stop.stop_requested()) return std::nullopt;
  return std::exchange(inbox_, {});
}

void FilterThread::take(Inbox& inbox, const std::stop_token& stop) {
  bool hasReadings = false;
  while (!inbox.empty() && !stop.stop_requested()) {
    if (const Order* order = std::get_if<Order>(&inbox.front()); order && !isOff(*order))
      localize(std::exchange(hasReadings, false));  // may throw: then the order still waits
    const auto given = std::move(inbox.front());
    inbox.pop_front();
    if (const Order* order = std::get_if<Order>(&given)) {
      obey(*order, stop);
      localize(false);
    } else if (!localization_) {
      continue;
    } else if (const Moment* moment = std::get_if<Moment>(&given)) {
      localization_->container().set(*moment);
      hasReadings = true;
    } else {
      open({});
      hasReadings = false;
    }
  }
  if (hasReadings) localize(true);
}

void FilterThread::obey(const Order& order, const std::stop_token& stop) {
  if (isOff(order)) return close({});
  if (!localization_) return start(order, stop);
  ortung::obey(order, *localization_);
}

void FilterThread::start(const Order& order, const std::stop_token& stop) {
  if (!tables_) {
    const auto goOn = [&](double share) {
      set({Kind::kLearning, share});
      return isWanted_ && !stop.stop_requested();
    };
    tables_ = config_.tables(*openRobot(config_.robot), goOn);
  }
  if (tables_)
    open(startOf(order));
  else
    close({});
}

void FilterThread::open(const LocalizationStart& start) {
  LocalizationConfig config;
  config.robot = config_.robot;
  config.seed = config_.seed;
  config.threads = 1;
  config.start = start;
  config.publish = true;
  config.keepsTime = true;  // moments that come meanwhile would be dropped
  localization_ =
      std::make_shared<Localization>(openRobot(config_.robot, *tables_), nullptr, config);
  const SensorContainer& container = localization_->container();
  outputs_.clear();
  for (const SensorData* data : container.findAll({kModel, kType, {}}))
    outputs_.push_back({data, 0});
  const std::lock_guard lock(mutex_);
  perceiver_ = localization_;
  perceiver_->wantSamples(wantsSamples_);
  needs_ = needsOf(container);
  published_.clear();
  if (isWanted_) state_ = {Kind::kSearching, 1.0};
}

void FilterThread::close(LocalizationState state) {
  localization_.reset();
  outputs_.clear();
  const std::lock_guard lock(mutex_);
  perceiver_.reset();
  needs_.clear();
  published_.clear();
  if (isWanted_ && state.kind == Kind::kOff)
    state_ = {Kind::kLearning};
  else if (isWanted_)
    state_ = std::move(state);
}

void FilterThread::localize(bool hasReadings) {
  if (!localization_) return;
  if (hasReadings) localization_->update();
  set(stateOf(*localization_));
  publish();
}

void FilterThread::publish() {
  std::vector<Message> fresh;
  {
    const SensorContainer::ReadLock lock = localization_->container().read();
    for (Output& output : outputs_) {
      if (output.data->sequence() == output.seen) continue;
      output.seen = output.data->sequence();
      const std::span<const std::uint32_t> words = output.data->getData();
      fresh.push_back({output.data->stamp(), output.data->id(), {words.begin(), words.end()}});
    }
  }
  const std::lock_guard lock(mutex_);
  if (std::ranges::any_of(inbox_, IsA<Restart>()))
    return;  // meanwhile: it is of a time that has not come yet
  std::erase_if(published_, [&](const Message& old) {
    return std::any_of(fresh.begin(), fresh.end(),
                       [&](const Message& one) { return one.id == old.id; });
  });
  for (Message& message : fresh) published_.push_back(std::move(message));
}

void FilterThread::set(LocalizationState state) {
  const std::lock_guard lock(mutex_);
  if (isWanted_) state_ = std::move(state);
}

}  // namespace ortung
