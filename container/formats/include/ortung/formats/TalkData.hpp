#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"

namespace ortung {

/// What others have told a robot since its last reading: it neither learns nor localizes, but
/// extractors may find in it what does.
/// Words: a text is the number of its bytes, and its bytes, four a word, the first one lowest, the
/// last word filled up with 0. The reading is the text of the listener's name, then three for each
/// message: how long ago [us], the text of who said it, the text of what was said.
/// Not thread-safe, see SensorData.
class ORTUNG_API TalkData : public SensorData {
 public:
  static constexpr std::size_t kMostMessages = 1000;
  static constexpr std::size_t kLongestName = 64;   ///< [characters]
  static constexpr std::size_t kLongestText = 400;  ///< [characters]
  struct Message {
    double age = 0.0;  ///< when the reading was taken [s]
    std::string from;  ///< name of the robot, or of whoever spoke
    std::string text;  ///< printable ASCII
  };
  struct Reading {
    std::string listener;  ///< name of the robot that was told
    std::vector<Message> messages;
  };

  explicit TalkData(SensorId id);
  ~TalkData() override;

  const Reading& reading() const { return reading_; }
  /// @throws std::invalid_argument for more or longer messages than a reading can hold, and for
  ///   characters that can't be printed
  static std::vector<std::uint32_t> encode(const Reading& reading);
  /// One with the words of another feature of this format; null if it is of none (readingAs()).
  static std::unique_ptr<TalkData> like(const SensorData& feature);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Reading reading_;
};

}  // namespace ortung
