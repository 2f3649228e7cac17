#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include "ortung/core/Message.hpp"
#include "ortung/core/Source.hpp"

namespace ortung {

/// A record of one form or the other, read from its begin. Not thread-safe.
class RecordReader {
 public:
  virtual ~RecordReader();
  virtual bool next(Message& message) = 0;  ///< reads the next reading, as Source::next()
  /// Goes on with a reading that is not later than the first one from @p from on, where that is
  /// quicker than to read all that lies before.
  virtual void seek(Timestamp from) = 0;
  virtual double progress() const = 0;
  virtual bool isFile() const = 0;
  virtual std::string remark() const = 0;
  const std::string& world() const { return world_; }
  /// Returns the formats that its notes say, without those that can't be read.
  const FeatureFormats& formats() const { return formats_; }

 protected:
  /// Takes what a line before the first reading says.
  void takeNote(std::string_view line);

 private:
  std::string world_;
  FeatureFormats formats_;
};

inline constexpr std::string_view kWorldNote = "# world ";
inline constexpr std::string_view kFormatNote = "# format ";

/// What who reads a torn record is told.
std::string tornRemark(const std::filesystem::path& file, std::uintmax_t bytes);
/// @throws std::runtime_error if time runs backwards
void checkOrder(const std::string& where, Timestamp last, Timestamp next);

std::unique_ptr<RecordReader> readText(const std::filesystem::path& file, std::ifstream in);
std::unique_ptr<RecordReader> readChunks(const std::filesystem::path& file, std::ifstream in);

}  // namespace ortung
