#pragma once

#include <atomic>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "DdsBytes.hpp"
#include "Participant.hpp"
#include "ServiceDesk.hpp"

namespace ortung::ros2 {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::GUID_t;

/// What a participant has in DDS.
struct Participant::Parts {
  Options options;
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::map<std::string, dds::Topic*> topics;  ///< by name
  std::vector<std::unique_ptr<dds::DataReaderListener>> listeners;
  std::vector<std::unique_ptr<Service>> services;
  std::vector<dds::DataReader*> readers;
  std::vector<dds::DataWriter*> writers;            ///< those that have a listener
  std::map<std::string, dds::DataWriter*> offered;  ///< by the topic's whole name
  std::vector<GUID_t> readerIds, writerIds;
  dds::DataWriter* graph = nullptr;  ///< tells of the node
  std::atomic<std::uint64_t> dropped = 0, refused = 0;
  std::mutex mutex;  ///< for all but these numbers
  ServiceDesk desk;  ///< last, since what it runs uses the others

  dds::Topic* topic(const std::string& name, const std::string& type);
  dds::DataWriter* writer(const std::string& name, const std::string& type,
                          const std::string& userData, Qos qos,
                          dds::DataWriterListener* listener = nullptr);
  dds::DataReader* reader(const std::string& name, const std::string& type,
                          const std::string& userData, Qos qos, dds::DataReaderListener* listener);
  /// What an endpoint says of its type.
  std::string userDataOf(std::string_view type) const;
  void tellGraph();
};

}  // namespace ortung::ros2
