#include "Sources.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "Console.hpp"
#include "ortung/formats/PoseData.hpp"

namespace ortung::app {
namespace {

constexpr std::size_t kUnknownKept = 1000;  ///< names of unknown features; a hostile log has more

SourceText parse(const std::string& text) {
  try {
    return parseSourceText(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

std::unique_ptr<Source> openRecord(const SourceText& text) {
  if (!text.options.empty()) {
    throw UsageError(fmt::format("record:{}: a record knows no option '{}'", text.path,
                                 text.options.begin()->first));
  }
  return std::make_unique<RecordSource>(text.path);
}

}  // namespace

std::unique_ptr<Source> openSource(const std::string& text, const std::filesystem::path& robotFile,
                                   PluginFactory& factory) {
  return openSource(parse(text), robotFile, factory);
}

std::unique_ptr<Source> openSource(const SourceText& text, const std::filesystem::path& robotFile,
                                   PluginFactory& factory) {
  if (text.kind == "record") return openRecord(text);
  Parameters parameters(text.kind + ":" + text.path);
  for (const auto& [key, value] : text.options) {
    if (key == "path" || key == "robot_file") {
      throw UsageError(fmt::format("{}: '{}' is no option of a source", parameters.where(), key));
    }
    parameters.set(key, value);
  }
  parameters.set("path", text.path);
  parameters.set("robot_file", robotFile.string());
  return factory.make<Source>(text.kind, parameters);
}

Feeder::Feeder(std::string name, Source& source, SensorContainer& container)
    : name_(std::move(name)), source_(source), container_(container), reader_(source) {}

bool Feeder::next() {
  if (!reader_.next(frame_)) return false;
  stamp_ = frame_.front().stamp;
  if (moments_++ == 0) first_ = stamp_;
  truth_.reset();
  try {
    for (const Message& message : frame_) look(message);
    container_.set(frame_);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: reading at {} us: {}", name_, stamp_, error.what()));
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

void Feeder::warnOfUnknown() const {
  constexpr std::size_t kNamed = 5;
  if (unknown_.empty()) return;
  std::string text;
  std::size_t named = 0;
  for (const auto& [name, count] : unknown_) {
    if (named++ == kNamed) break;
    text += fmt::format("{}{} ({} readings)", named == 1 ? "" : ", ", name, count);
  }
  if (unknown_.size() > kNamed) text += fmt::format(" and {} more", unknown_.size() - kNamed);
  warn(fmt::format("{} gives features that the robot file does not have: {}", name_, text));
}

}  // namespace ortung::app
