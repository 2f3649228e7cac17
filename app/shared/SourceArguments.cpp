#include "SourceArguments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "Console.hpp"
#include "Interrupt.hpp"
#include "ortung/run/OpenSource.hpp"

namespace ortung::app {
namespace {

template <class Text>
std::unique_ptr<Source> open(const Text& text, const std::filesystem::path& robotFile,
                             PluginFactory& factory) {
  try {
    return openSource(text, robotFile, factory);
  } catch (const SourceTextError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

std::unique_ptr<Source> openSourceArgument(const std::string& text,
                                           const std::filesystem::path& robotFile,
                                           PluginFactory& factory) {
  return open(text, robotFile, factory);
}

std::unique_ptr<Source> openSourceArgument(const SourceText& text,
                                           const std::filesystem::path& robotFile,
                                           PluginFactory& factory) {
  return open(text, robotFile, factory);
}

bool unlessInterrupted(const Source& source, const std::function<bool()>& next) {
  const bool isLive = source.isLive();
  // The signal is looked at once, since it may come between two looks.
  const auto isEnd = [isLive] {
    if (interruptSignal() == 0) return false;
    if (!isLive) throw Interrupted();
    return true;
  };
  if (isEnd()) return false;
  try {
    return next();
  } catch (const std::exception&) {  // a signal interrupts waiting, for which sources throw
                                     // different errors
    if (isEnd()) return false;
    throw;
  }
}

RecordNotes notesOf(const Source& source, const SensorContainer& robot) {
  RecordNotes notes{source.worldFingerprint(), source.formats()};
  const FeatureFormats known = notes.formats;
  for (auto& one : formatsOf(robot)) {
    const bool isKnown = std::any_of(known.begin(), known.end(),
                                     [&](const auto& its) { return its.first == one.first; });
    if (!isKnown) notes.formats.push_back(std::move(one));
  }
  return notes;
}

void warnOf(const Source& source) {
  if (const std::string remark = source.remark(); !remark.empty()) warn(remark);
}

void warnOf(const std::string& name, const Source& source, const Feeder& feeder) {
  warnOf(source);
  constexpr std::size_t kNamed = 5;
  const auto& unknown = feeder.unknown();
  if (unknown.empty()) return;
  std::string text;
  std::size_t named = 0;
  for (const auto& [feature, count] : unknown) {
    if (named++ == kNamed) break;
    text += fmt::format("{}{} ({} readings)", named == 1 ? "" : ", ", feature, count);
  }
  if (unknown.size() > kNamed) text += fmt::format(" and {} more", unknown.size() - kNamed);
  warn(fmt::format("{} has features that are not in the robot file: {}", name, text));
}

}  // namespace ortung::app
