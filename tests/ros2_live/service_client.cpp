/// service_client DOMAIN  calls services as rmw_fastrtps does, on Fast DDS: for each line "call
/// NAME TYPE HEX" at the standard input, whose HEX is a request in CDR, it prints "answer HEX", or
/// "none" after 10 s. "listen TOPIC TYPE" prints "heard TOPIC HEX" for what comes there, "say TOPIC
/// TYPE HEX" says it. A line "wait SECONDS" listens so long.
#include <fastdds/rtps/common/WriteParams.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

#include <charconv>
#include <chrono>
#include <condition_variable>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <iostream>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>

#include "DdsBytes.hpp"
#include "Participant.hpp"

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using ortung::ros2::Bytes;

std::string unhex(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    unsigned byte = 0;
    std::from_chars(text.data() + i, text.data() + i + 2, byte, 16);
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

std::string hex(const std::string& bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    text += kDigits[static_cast<unsigned char>(c) >> 4U];
    text += kDigits[static_cast<unsigned char>(c) & 15U];
  }
  return text;
}

std::mutex mutex;
std::condition_variable arrived;

class Answers : public dds::DataReaderListener {
 public:
  void on_data_available(dds::DataReader* reader) override {
    Bytes bytes;
    dds::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      const std::lock_guard lock(mutex);
      found[info.related_sample_identity.sequence_number()] = bytes.cdr;
      arrived.notify_all();
    }
  }
  std::map<rtps::SequenceNumber_t, std::string> found;
};

class Printer : public dds::DataReaderListener {
 public:
  explicit Printer(std::string topic) : topic_(std::move(topic)) {}
  void on_data_available(dds::DataReader* reader) override {
    Bytes bytes;
    dds::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      const std::lock_guard lock(mutex);
      if (info.valid_data)
        std::cout << "heard " << topic_ << ' ' << hex(bytes.cdr) << "\n" << std::flush;
    }
  }

 private:
  const std::string topic_;
};

class Client {
 public:
  explicit Client(std::uint32_t domain) {
    dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports = {udp};
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(domain, qos);
    publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  }
  ~Client() {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  std::optional<std::string> call(const std::string& name, const std::string& type,
                                  const std::string& request) {
    dds::DataReader* const reader = readerOf("rr" + name + "Reply", type + "_Response", &answers_);
    dds::DataWriter* const writer = writerOf("rq" + name + "Request", type + "_Request");
    if (!awaitMatch(writer)) return std::nullopt;
    Bytes bytes{request};
    rtps::WriteParams which;
    which.related_sample_identity().writer_guid() = reader->guid();
    if (!writer->write(&bytes, which)) return std::nullopt;
    std::unique_lock lock(mutex);
    const auto number = which.sample_identity().sequence_number();
    arrived.wait_for(lock, std::chrono::seconds(10),
                     [&] { return answers_.found.contains(number); });
    const auto found = answers_.found.find(number);
    if (found == answers_.found.end()) return std::nullopt;
    std::string answer = found->second;
    answers_.found.clear();
    return answer;
  }
  void listen(const std::string& topic, const std::string& type) {
    printers_.push_back(std::make_unique<Printer>(topic));
    readerOf("rt" + topic, type, printers_.back().get());
  }
  void say(const std::string& topic, const std::string& type, const std::string& cdr) {
    dds::DataWriter* const writer = writerOf("rt" + topic, type);
    awaitMatch(writer);
    Bytes bytes{cdr};
    writer->write(&bytes);
  }

 private:
  static bool awaitMatch(dds::DataWriter* writer) {
    for (int i = 0; i < 2000; ++i) {
      dds::PublicationMatchedStatus status;
      writer->get_publication_matched_status(status);
      if (status.current_count > 0) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  dds::Topic* topicOf(const std::string& name, const std::string& type) {
    dds::TypeSupport support(new ortung::ros2::BytesType(ortung::ros2::ddsType(type)));
    support.register_type(participant_);
    dds::Topic*& topic = topics_[name];
    if (topic == nullptr)
      topic = participant_->create_topic(name, ortung::ros2::ddsType(type), dds::TOPIC_QOS_DEFAULT);
    return topic;
  }
  dds::DataReader* readerOf(const std::string& name, const std::string& type,
                            dds::DataReaderListener* listener) {
    dds::DataReader*& reader = readers_[name];
    dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 100;
    qos.endpoint().history_memory_policy = rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
    qos.data_sharing().off();
    if (reader == nullptr)
      reader = subscriber_->create_datareader(topicOf(name, type), qos, listener);
    return reader;
  }
  dds::DataWriter* writerOf(const std::string& name, const std::string& type) {
    dds::DataWriter*& writer = writers_[name];
    dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
    qos.endpoint().history_memory_policy = rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
    qos.data_sharing().off();
    if (writer == nullptr) writer = publisher_->create_datawriter(topicOf(name, type), qos);
    return writer;
  }

  dds::DomainParticipant* participant_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
  dds::Subscriber* subscriber_ = nullptr;
  Answers answers_;
  std::vector<std::unique_ptr<Printer>> printers_;
  std::map<std::string, dds::Topic*> topics_;
  std::map<std::string, dds::DataReader*> readers_;
  std::map<std::string, dds::DataWriter*> writers_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  Client client(static_cast<std::uint32_t>(std::stoul(argv[1])));
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string what;
    std::string name;
    std::string type;
    std::string bytes;
    words >> what >> name >> type >> bytes;
    if (what == "wait") std::this_thread::sleep_for(std::chrono::duration<double>(std::stod(name)));
    if (what == "listen") client.listen(name, type);
    if (what == "say") client.say(name, type, unhex(bytes));
    if (what != "call") continue;
    const auto answer = client.call(name, type, unhex(bytes));
    const std::lock_guard lock(mutex);
    std::cout << (answer ? "answer " + hex(*answer) : "none") << "\n" << std::flush;
  }
  return 0;
}
