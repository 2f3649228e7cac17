#include "ortung/server/Recordings.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace ortung {
namespace {

using Kind = Recordings::State::Kind;

constexpr std::size_t kLongestName = 64;
constexpr int kGreatestNumber = 999'999'999;
constexpr int kMostTries = 40;  // to find a number that no other program has taken meanwhile
const std::string kEnding = ".rec";

/// Returns the name with only such characters as file systems, shells and clients accept.
std::string safe(const std::string& name) {
  std::string text = name.substr(0, kLongestName);
  for (char& c : text) {
    const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (!isPlain) c = '_';
  }
  if (text.empty()) text = "robot";
  if (text.front() == '-') text.front() = '_';  // programs would take it for an option
  return text;
}

}  // namespace

Recordings::Recordings(Config config) : config_(std::move(config)) {
  if (config_.folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(config_.folder, error);
  if (error)
    throw std::runtime_error(config_.folder.string() +
                             ": can't be made a folder for records: " + error.message());
  if (::access(config_.folder.c_str(), W_OK | X_OK) != 0)
    throw std::runtime_error(config_.folder.string() + ": no records can be written there: " +
                             std::generic_category().message(errno));
  noteFiles();
}

Recordings::~Recordings() { endAll(); }

/// Notes the greatest number of each name in the folder. Once, before anything is served: whoever
/// begins a record is waited for by the world.
void Recordings::noteFiles() {
  for (const auto& entry : std::filesystem::directory_iterator(config_.folder)) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(kEnding)) continue;
    const std::size_t dash = file.rfind('-');
    if (dash == file.npos) continue;
    const char* const end = file.data() + file.size() - kEnding.size();
    int number = 0;
    const auto read = std::from_chars(file.data() + dash + 1, end, number);
    if (read.ec != std::errc() || read.ptr != end || number < 1 || number > kGreatestNumber)
      continue;
    int& greatest = numbers_[file.substr(0, dash)];
    greatest = std::max(greatest, number);
  }
}

/// The file is created empty, so that no other program takes the name.
std::string Recordings::newFile(const std::string& name) {
  const std::string begin = safe(name);
  int& greatest = numbers_[begin];
  int step = 1;  // another program may have written as many as it likes
  for (int tries = 0; tries < kMostTries && step <= kGreatestNumber - greatest; ++tries) {
    greatest += step;
    std::string file = begin + "-" + std::to_string(greatest) + kEnding;
    const std::filesystem::path path = config_.folder / file;
    if (std::FILE* const made = std::fopen(path.c_str(), "wxe")) {
      std::fclose(made);
      return file;
    }
    if (errno != EEXIST)
      throw ServeError("disk", file + " can't be made: " + std::generic_category().message(errno));
    if (tries > 0) step *= 2;
  }
  throw ServeError("limit", "the numbers of the records of '" + begin +
                                "' are used up in the server's folder, up to " +
                                std::to_string(greatest));
}

void Recordings::begin(RobotId robot, const std::string& name, const std::string& worldFingerprint,
                       FeatureFormats formats) {
  if (config_.folder.empty())
    throw ServeError("state",
                     "the server has no folder for records; start it with --record-into FOLDER");
  const std::lock_guard lock(mutex_);
  if (records_[robot].writer) return;
  const auto open = std::count_if(records_.begin(), records_.end(),
                                  [](const auto& entry) { return entry.second.writer != nullptr; });
  if (static_cast<std::size_t>(open) >= config_.most)
    throw ServeError("limit",
                     "at most " + std::to_string(config_.most) + " robots are recorded at a time");
  const std::string file = newFile(name);
  try {
    auto writer = std::make_unique<RecordWriter>(config_.folder / file,
                                                 RecordNotes{worldFingerprint, std::move(formats)},
                                                 RecordWriter::Pace::kLive);
    records_[robot] = {std::move(writer), {Kind::kOn, file}, 0};
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::remove(config_.folder / file, ignored);
    throw ServeError("disk", error.what());
  }
}

/// @throws std::runtime_error
void Recordings::write(Record& record, std::span<const Message> readings) {
  for (const Message& message : readings) {
    // Readers would refuse everything behind such a reading.
    if (record.writer->messages() > 0 && message.stamp < record.last)
      throw std::runtime_error("the time of the readings went back, from " +
                               std::to_string(record.last) + " to " +
                               std::to_string(message.stamp) + " us");
    record.writer->write(message);
    record.last = message.stamp;
  }
}

void Recordings::write(RobotId robot, std::span<const Message> moment,
                       std::span<const Message> more) {
  std::string problem;
  {
    const std::lock_guard lock(mutex_);
    const auto found = records_.find(robot);
    if (moment.empty() || found == records_.end() || !found->second.writer) return;
    Record& record = found->second;
    try {
      write(record, moment);
      write(record, more);
      record.writer->endMoment();
      ++record.state.moments;
      return;
    } catch (const std::exception& error) {
      record.state.kind = Kind::kFailed;
      record.state.text = error.what();
      record.writer.reset();  // the whole readings stay in the file
      problem = "the record " + record.state.file + " has ended: " + error.what();
    }
  }
  if (config_.onProblem) config_.onProblem(problem);
}

/// @returns what went wrong; "" if nothing did
std::string Recordings::close(RobotId robot) {
  std::unique_ptr<RecordWriter> writer;
  std::string file;
  {
    const std::lock_guard lock(mutex_);
    const auto found = records_.find(robot);
    if (found == records_.end()) return {};
    State& state = found->second.state;
    file = state.file;
    if (state.kind == Kind::kFailed) state = {Kind::kOff, state.file, state.moments};
    writer = std::move(found->second.writer);
    if (!writer) return {};
    state.kind = Kind::kOff;
  }
  try {
    writer->commit();
    if (!std::filesystem::exists(config_.folder / file))
      throw std::runtime_error(file + " is gone: it was removed or renamed while it was written");
    return {};
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    State& state = records_[robot].state;
    if (state.kind != Kind::kOn) {
      state.kind = Kind::kFailed;
      state.text = error.what();
    }
    return error.what();
  }
}

void Recordings::end(RobotId robot) {
  if (const std::string problem = close(robot); !problem.empty()) throw ServeError("disk", problem);
}

Recordings::State Recordings::state(RobotId robot) const {
  const std::lock_guard lock(mutex_);
  const auto found = records_.find(robot);
  return found == records_.end() ? State() : found->second.state;
}

void Recordings::forget(RobotId robot) {
  const std::string problem = close(robot);
  {
    const std::lock_guard lock(mutex_);
    records_.erase(robot);
  }
  if (!problem.empty() && config_.onProblem) config_.onProblem(problem);
}

std::vector<Recordings::State> Recordings::endAll() {
  std::vector<RobotId> open;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [robot, record] : records_)
      if (record.writer) open.push_back(robot);
  }
  std::vector<State> ended;
  for (const RobotId robot : open) {
    const std::string problem = close(robot);
    if (!problem.empty() && config_.onProblem) config_.onProblem(problem);
    ended.push_back(state(robot));
  }
  return ended;
}

const char* nameOf(Recordings::State::Kind kind) {
  return kind == Kind::kOn ? "on" : kind == Kind::kOff ? "off" : "failed";
}

}  // namespace ortung
