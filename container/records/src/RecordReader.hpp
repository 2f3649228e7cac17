#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "ortung/core/Message.hpp"

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
  virtual std::string world() const = 0;
};

inline constexpr std::string_view kWorldNote = "# world ";

/// What who reads a torn record is told.
std::string tornRemark(const std::filesystem::path& file, std::uintmax_t bytes);
/// @throws std::runtime_error if time runs backwards
void checkOrder(const std::string& where, Timestamp last, Timestamp next);

std::unique_ptr<RecordReader> readText(const std::filesystem::path& file, std::ifstream in);
std::unique_ptr<RecordReader> readChunks(const std::filesystem::path& file, std::ifstream in);

}  // namespace ortung
