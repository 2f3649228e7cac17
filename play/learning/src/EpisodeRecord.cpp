#include "EpisodeRecord.hpp"

#include <unistd.h>

#include <stdexcept>
#include <string_view>
#include <system_error>

#include "ortung/base/FileKind.hpp"

namespace ortung::learning {
namespace {

void replaceAll(std::string& text, std::string_view what, const std::string& by) {
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

/// Refuses a file that holds something else.
const std::filesystem::path& checked(const std::filesystem::path& file) {
  std::error_code error;
  const bool isThere =
      std::filesystem::is_regular_file(file, error) && std::filesystem::file_size(file, error) > 0;
  if (isThere && kindOfFile(file) != FileKind::kRecord)
    throw std::runtime_error(file.string() + ": is there already, and is no record" +
                             whatItIs(file) + "; expected a new file or a record");
  return file;
}

}  // namespace

std::filesystem::path EpisodeRecord::fileOf(const std::filesystem::path& pattern,
                                            std::uint64_t seed, std::uint64_t number) {
  std::string text = pattern.string();
  replaceAll(text, "{seed}", std::to_string(seed));
  replaceAll(text, "{number}", std::to_string(number));
  return text;
}

EpisodeRecord::EpisodeRecord(const std::filesystem::path& file, const std::string& world,
                             const SensorContainer& container)
    : writer_(std::make_unique<RecordWriter>(
          checked(file), RecordNotes{world, formatsOf(container)}, RecordWriter::Pace::kLive)),
      process_(::getpid()) {}

EpisodeRecord::~EpisodeRecord() {
  // The file and what is not written of it belong to the process from which this one was forked.
  if (isHere()) return;
  [[maybe_unused]] const RecordWriter* const left = writer_.release();
}

bool EpisodeRecord::isHere() const { return ::getpid() == process_; }

void EpisodeRecord::write(std::span<const Message> readings) {
  if (!isHere() || readings.empty()) return;
  for (const Message& reading : readings) writer_->write(reading);
  writer_->endMoment();
}

void EpisodeRecord::end() {
  if (isHere()) writer_->commit();
}

}  // namespace ortung::learning
