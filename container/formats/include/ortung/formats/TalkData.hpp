#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/core/SensorData.hpp"
#include "ortung/formats/FormatNames.hpp"

namespace ortung {

/// The messages that a robot has received since its last reading. It neither learns nor localizes,
/// but extractors may make features of it that do.
/// Words: a text is the number of its bytes, and its bytes, four a word, the first one lowest, the
/// last word filled up with 0. The reading is the text of the listener's name, then three for each
/// message: its age [us], the text of its sender's name, the text of the message.
/// Not thread-safe, see SensorData.
class ORTUNG_API TalkData : public SensorData {
 public:
  static constexpr const char* kFormat = formats::kTalk;
  static constexpr std::size_t kMostMessages = 1000;
  static constexpr std::size_t kLongestName = 64;   ///< most characters of a name
  static constexpr std::size_t kLongestText = 400;  ///< most characters of a message
  struct Message {
    double age = 0.0;  ///< age of the message at the time of the reading [s]
    std::string from;  ///< name of the robot or program that sent it
    std::string text;  ///< content, printable ASCII
  };
  struct Reading {
    std::string listener;  ///< name of the robot that received the messages
    std::vector<Message> messages;
  };

  explicit TalkData(SensorId id);
  ~TalkData() override;

  const Reading& reading() const { return reading_; }
  /// @throws std::invalid_argument for more or longer messages than a reading can hold, and for
  ///   characters that can't be printed
  static std::vector<std::uint32_t> encode(const Reading& reading);
  Format format() const override;
  std::string wordsHelp() const override;

 private:
  void check(std::span<const std::uint32_t> words) const override;
  void decode(std::span<const std::uint32_t> words) override;
  Reading reading_;
};

}  // namespace ortung
