#include "RobotReadings.hpp"

#include <algorithm>

#include "Request.hpp"
#include "ortung/core/BinaryReading.hpp"
#include "ortung/core/ReadingLine.hpp"

namespace ortung::server {

namespace {

/// Readings with more words are sent in binary form only: a picture as text is four times as large,
/// and slow. Scans have 8192 words at most.
constexpr std::size_t kMostWordsOfALine = 8192;

}  // namespace

Query::Query(const std::string& text) {
  try {
    const SensorQuery query = parseSensorQuery(text);
    model = query.model;
    type = query.type;
    feature = query.feature;
    for (const std::string* part : {&model, &type, &feature})
      if (*part != "*" && part->find('*') != part->npos) throw std::invalid_argument(text);
  } catch (const std::invalid_argument&) {
    throw ServeError("syntax", "found '" + printable(text) +
                                   "', expected model/type/feature, each a whole name or *");
  }
}

bool Query::matches(const SensorId& id) const {
  return ortung::matches({model, type, feature}, id);
}

bool Choice::wants(const SensorId& id) const {
  return queries.empty() || std::any_of(queries.begin(), queries.end(),
                                        [&](const Query& query) { return query.matches(id); });
}

RobotReadings::RobotReadings(RobotId robot, std::string name, std::vector<ServedFeature> features)
    : robot_(robot),
      name_(std::move(name)),
      features_(std::move(features)),
      entries_(features_.size()),
      wantedUntil_(features_.size(), 0),
      told_(features_.size(), 0) {
  for (std::size_t i = 0; i < entries_.size(); ++i) entries_[i].newest.id = features_[i].id;
}

void RobotReadings::publish(std::span<Message> frame) {
  const std::lock_guard lock(mutex_);
  ++cycle_;
  std::size_t place = 0;  // a frame has features in their order, so one walk finds them all
  for (Message& message : frame) {
    std::size_t tried = 0;
    while (tried < entries_.size() && entries_[place].newest.id != message.id) {
      place = (place + 1) % entries_.size();
      ++tried;
    }
    if (tried == entries_.size()) continue;
    Entry& entry = entries_[place];
    entry.newest.stamp = message.stamp;
    if (message.words.size() > kMostWordsOfALine) {
      entry.newest.words.clear();
      entry.large = std::make_shared<const Message>(
          Message{message.stamp, message.id, std::move(message.words)});
    } else {
      entry.newest.words = message.words;
      entry.large.reset();
    }
    entry.line.clear();
    ++entry.count;
    entry.isThere = true;
  }
}

std::optional<std::vector<SensorId>> RobotReadings::takeWanted() {
  const std::lock_guard lock(mutex_);
  bool isNew = false;
  for (std::size_t i = 0; i < told_.size(); ++i) {
    const char is = wantedUntil_[i] > cycle_ ? 1 : 0;
    isNew = isNew || is != told_[i];
    told_[i] = is;
  }
  if (!isNew) return std::nullopt;
  std::vector<SensorId> wanted;
  for (std::size_t i = 0; i < told_.size(); ++i)
    if (told_[i] != 0) wanted.push_back(features_[i].id);
  return wanted;
}

void RobotReadings::forget() {
  const std::lock_guard lock(mutex_);
  for (Entry& entry : entries_) {
    entry.isThere = false;
    entry.large.reset();
  }
  std::fill(told_.begin(), told_.end(), char{0});  // the robots may have changed
}

void RobotReadings::append(Entry& entry, bool binary, Output& out) const {
  if (entry.large) {
    out.add(entry.large);
  } else if (binary) {
    writeBinary(entry.newest, out.text());
  } else {
    if (entry.line.empty()) {
      writeLine(entry.newest, entry.line);
      entry.line += '\n';
    }
    out.text() += entry.line;
  }
}

Written RobotReadings::write(const Choice& choice, std::vector<std::uint64_t>& sent, Output& out) {
  chosen_.clear();
  for (std::size_t i = 0; i < features_.size(); ++i)  // without the lock, as it may take long
    if (choice.wants(features_[i].id)) chosen_.push_back(i);
  const std::lock_guard lock(mutex_);
  sent.resize(entries_.size(), 0);
  if (choice.binary || !choice.queries.empty())
    for (const std::size_t i : chosen_) wantedUntil_[i] = cycle_ + kPatience;
  std::erase_if(chosen_, [&](std::size_t i) {
    return !entries_[i].isThere || (!choice.again && entries_[i].count == sent[i]);
  });
  std::stable_sort(chosen_.begin(), chosen_.end(), [&](std::size_t a, std::size_t b) {
    return entries_[a].newest.stamp < entries_[b].newest.stamp;
  });
  Written written;
  for (const std::size_t i : chosen_) {
    if (entries_[i].large && !choice.binary) {
      ++written.leftOut;
      continue;
    }
    append(entries_[i], choice.binary, out);
    sent[i] = entries_[i].count;
    ++written.readings;
  }
  return written;
}

}  // namespace ortung::server
