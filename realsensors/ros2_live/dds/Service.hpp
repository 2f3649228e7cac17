#pragma once

#include <fastdds/rtps/common/SampleIdentity.h>

#include <condition_variable>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <mutex>
#include <set>

#include "ParticipantParts.hpp"

namespace ortung::ros2 {

/// A service in DDS: reads requests, and writes answers to those who have asked. A request tells
/// the reader that waits for its answer, by its identifier; an answer names that and the request's
/// number (rmw_fastrtps).
class Participant::Service : public dds::DataReaderListener, public dds::DataWriterListener {
 public:
  Service(Parts& parts, Handler handler) : parts_(parts), handler_(std::move(handler)) {}
  /// @param name whole name of the service @param type "lifecycle_msgs/srv/GetState"
  void open(const std::string& name, std::string_view type);
  /// Ends waiting for readers of answers.
  void close();

  void on_data_available(dds::DataReader* reader) override;
  void on_publication_matched(dds::DataWriter* writer,
                              const dds::PublicationMatchedStatus& status) override;

 private:
  using Asked = eprosima::fastrtps::rtps::SampleIdentity;
  void answer(const std::string& request, const Asked& asked);
  bool waitFor(const GUID_t& reader);

  Parts& parts_;
  Handler handler_;
  Bytes bytes_;  ///< used by one thread at a time, as DDS calls a listener
  dds::DataWriter* answers_ = nullptr;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<GUID_t> waiting_;  ///< readers of answers
  bool isClosed_ = false;
};

}  // namespace ortung::ros2
