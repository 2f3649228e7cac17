#include "Participant.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>

#include "Cdr.hpp"
#include "ParticipantParts.hpp"
#include "Service.hpp"
#include "TypeHashes.hpp"

namespace ortung::ros2 {
namespace {

constexpr int kDepth = 10;
constexpr int kReading = 100;  ///< messages that wait for the thread that takes them

/// Hands the messages of a topic on.
class Listener : public dds::DataReaderListener {
 public:
  Listener(Participant::Taker taker, std::atomic<std::uint64_t>& refused)
      : taker_(std::move(taker)), refused_(refused) {}
  void on_data_available(dds::DataReader* reader) override {
    dds::SampleInfo info;
    while (reader->take_next_sample(&bytes_, &info) == ReturnCode_t::RETCODE_OK) {
      try {
        if (info.valid_data) taker_(bytes_.cdr);
      } catch (const std::exception&) {
        ++refused_;  // whatever somebody has sent, it must not end the thread of DDS
      }
    }
  }

 private:
  Participant::Taker taker_;
  std::atomic<std::uint64_t>& refused_;
  Bytes bytes_;  ///< used by one thread at a time, as DDS calls a listener
};

template <class Endpoint>
void setQos(Endpoint& qos, Qos wanted, int depth, const std::string& userData) {
  qos.user_data().setValue({userData.begin(), userData.end()});
  const bool isLatched = wanted == Qos::kLatched;
  qos.reliability().kind =
      wanted == Qos::kSensor ? dds::BEST_EFFORT_RELIABILITY_QOS : dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind =
      isLatched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = isLatched ? 1 : depth;
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
  qos.data_sharing().off();
}

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::string ddsTopic(const std::string& topic) {
  return "rt" + (topic.starts_with('/') ? topic : "/" + topic);
}

std::string ddsType(std::string_view type) {
  std::string name;
  std::size_t begin = 0;
  for (std::size_t slash = type.find('/'); slash != type.npos; slash = type.find('/', begin)) {
    name += std::string(type.substr(begin, slash - begin)) + "::";
    begin = slash + 1;
  }
  return name + "dds_::" + std::string(type.substr(begin)) + "_";
}

std::string releaseHere() {
  const std::string release = environment("ROS_DISTRO");
  return release.empty() ? "humble" : release;
}

Distro distroOf(std::string_view release) {
  const bool isOld = release == "humble" || release == "galactic" || release == "foxy";
  return isOld ? Distro::kHumble : Distro::kJazzy;
}

void Participant::Options::readEnvironment() {
  constexpr std::uint32_t kMostDomains = 232;
  if (const std::string text = environment("ROS_DOMAIN_ID"); !text.empty()) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
    if (error != std::errc() || end != text.data() + text.size() || domain > kMostDomains)
      throw std::runtime_error("ROS_DOMAIN_ID is '" + text + "', expected 0 to 232");
  }
  if (environment("ROS_LOCALHOST_ONLY") == "1") isLocal = true;
  const std::string range = environment("ROS_AUTOMATIC_DISCOVERY_RANGE");
  if (range == "LOCALHOST") isLocal = true;
  if (range == "SUBNET") isLocal = false;
  if (!range.empty() && range != "LOCALHOST" && range != "SUBNET" && range != "SYSTEM_DEFAULT")
    throw std::runtime_error("ROS_AUTOMATIC_DISCOVERY_RANGE is '" + range +
                             "', expected LOCALHOST, SUBNET or SYSTEM_DEFAULT");
}

dds::Topic* Participant::Parts::topic(const std::string& name, const std::string& type) {
  dds::Topic*& known = topics[name];
  if (known != nullptr) return known;
  dds::TypeSupport support(new BytesType(type));
  support.register_type(participant);
  known = participant->create_topic(name, type, dds::TOPIC_QOS_DEFAULT);
  if (known == nullptr) throw std::runtime_error("DDS has no topic " + name + " of " + type);
  return known;
}

dds::DataWriter* Participant::Parts::writer(const std::string& name, const std::string& type,
                                            const std::string& userData, Qos qos,
                                            dds::DataWriterListener* listener) {
  dds::DataWriterQos wanted = dds::DATAWRITER_QOS_DEFAULT;
  setQos(wanted, qos, kDepth, userData);
  // Not by DDS's own thread: in Fast DDS 2.9 it and the end of a reader may wait for each other for
  // ever. Sending does not block, since the transport drops what does not fit.
  wanted.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
  const auto mask =
      listener == nullptr ? dds::StatusMask::none() : dds::StatusMask::publication_matched();
  dds::DataWriter* const made =
      publisher->create_datawriter(topic(name, type), wanted, listener, mask);
  if (made == nullptr) throw std::runtime_error("DDS can't write " + name);
  return made;
}

dds::DataReader* Participant::Parts::reader(const std::string& name, const std::string& type,
                                            const std::string& userData, Qos qos,
                                            dds::DataReaderListener* listener) {
  dds::DataReaderQos wanted = dds::DATAREADER_QOS_DEFAULT;
  setQos(wanted, qos, kReading, userData);
  dds::DataReader* const made = subscriber->create_datareader(topic(name, type), wanted, listener,
                                                              dds::StatusMask::data_available());
  if (made == nullptr) throw std::runtime_error("DDS can't read " + name);
  return made;
}

std::string Participant::Parts::userDataOf(std::string_view type) const {
  const std::string_view hash = typeHashOf(type);
  if (options.distro == Distro::kHumble || hash.empty()) return "";
  return "typehash=RIHS01_" + std::string(hash) + ";";
}

/// Tells which topics belong to the node: rmw_dds_common/msg/ParticipantEntitiesInfo.
void Participant::Parts::tellGraph() {
  const std::size_t size = options.distro == Distro::kHumble ? 24 : 16;
  CdrWriter out;
  const auto add = [&](const GUID_t& id) {
    std::array<std::uint8_t, 24> bytes{};
    std::copy_n(id.guidPrefix.value, 12, bytes.begin());
    std::copy_n(id.entityId.value, 4, bytes.begin() + 12);
    for (std::size_t i = 0; i < size; ++i) out(bytes[i]);
  };
  const auto addAll = [&](const std::vector<GUID_t>& ids) {
    out(static_cast<std::uint32_t>(ids.size()));
    for (const GUID_t& id : ids) add(id);
  };
  add(participant->guid());
  out(std::uint32_t{1});
  out(options.names.space);
  out(options.names.node);
  addAll(readerIds);
  addAll(writerIds);
  Bytes bytes{out.take()};
  if (!graph->write(&bytes)) ++dropped;
}

Participant::Participant(const Options& options) : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.options = options;
  dds::Log::SetVerbosity(dds::Log::Kind::Error);
  // Intraprocess delivery calls the reader's listener while the writer's lock is held, which
  // deadlocks a caller that publishes under a lock that the listener takes, too.
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.name(options.names.node);
  const std::string enclave = "enclave=/;";
  qos.user_data().setValue({enclave.begin(), enclave.end()});
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  if (options.isLocal) udp->interfaceWhiteList = {"127.0.0.1"};
  constexpr std::uint32_t kBuffer = 4U << 20;  // a burst of scans and a map [bytes]
  udp->receiveBufferSize = kBuffer;
  udp->sendBufferSize = kBuffer;
  udp->non_blocking_send = true;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {udp};
  p.participant =
      dds::DomainParticipantFactory::get_instance()->create_participant(options.domain, qos);
  if (p.participant == nullptr)
    throw std::runtime_error("DDS can't begin in domain " + std::to_string(options.domain));
  p.publisher = p.participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  p.subscriber = p.participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  if (p.publisher == nullptr || p.subscriber == nullptr)
    throw std::runtime_error("DDS has no room for a node");
  constexpr std::string_view kGraph = "rmw_dds_common/msg/ParticipantEntitiesInfo";
  p.graph = p.writer("ros_discovery_info", ddsType(kGraph), p.userDataOf(kGraph), Qos::kLatched);
  p.tellGraph();
}

Participant::~Participant() {
  Parts& p = *parts_;
  for (const auto& service : p.services) service->close();
  p.desk.close();
  for (dds::DataReader* reader : p.readers) reader->set_listener(nullptr);
  for (dds::DataWriter* writer : p.writers) writer->set_listener(nullptr);
  if (p.participant == nullptr) return;
  p.participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(p.participant);
}

void Participant::subscribe(const std::string& topic, std::string_view type, Qos qos, Taker taker) {
  Parts& p = *parts_;
  const std::lock_guard lock(p.mutex);
  p.listeners.push_back(std::make_unique<Listener>(std::move(taker), p.refused));
  dds::DataReader* const reader = p.reader(ddsTopic(p.options.names.resolve(topic)), ddsType(type),
                                           p.userDataOf(type), qos, p.listeners.back().get());
  p.readers.push_back(reader);
  p.readerIds.push_back(reader->guid());
  p.tellGraph();
}

Participant::Sender Participant::publish(const std::string& topic, std::string_view type, Qos qos) {
  Parts& p = *parts_;
  const std::lock_guard lock(p.mutex);
  dds::DataWriter* const writer =
      p.writer(ddsTopic(p.options.names.resolve(topic)), ddsType(type), p.userDataOf(type), qos);
  p.offered[p.options.names.resolve(topic)] = writer;
  p.writerIds.push_back(writer->guid());
  p.tellGraph();
  return [&p, writer](std::string_view cdr) {
    Bytes bytes{std::string(cdr)};
    if (!writer->write(&bytes)) ++p.dropped;
  };
}

std::string Participant::wholeName(const std::string& name) const {
  return parts_->options.names.resolve(name);
}

bool Participant::isHeard(const std::string& topic) const {
  Parts& p = *parts_;
  const std::lock_guard lock(p.mutex);
  const auto found = p.offered.find(p.options.names.resolve(topic));
  if (found == p.offered.end()) return false;
  dds::PublicationMatchedStatus status;
  found->second->get_publication_matched_status(status);
  return status.current_count > 0;
}

void Participant::serve(const std::string& service, std::string_view type, Handler handler) {
  Parts& p = *parts_;
  const std::lock_guard lock(p.mutex);
  p.services.push_back(std::make_unique<Service>(p, std::move(handler)));
  p.services.back()->open(p.options.names.resolve(service), type);
  p.tellGraph();
}

std::uint64_t Participant::dropped() const { return parts_->dropped; }
std::uint64_t Participant::refused() const { return parts_->refused; }

}  // namespace ortung::ros2
