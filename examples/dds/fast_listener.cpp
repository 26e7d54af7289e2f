// SPDX-License-Identifier: BSD-3-Clause
// Prints readings that come by Fast DDS, up to the one before NUMBER, or until none has come for ten seconds:
// fast_listener NUMBER [reliable]. Without `reliable`, those that the network loses are not sent again.
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <mutex>
#include <string_view>

#include "examples/dds/fast_reading.hpp"

using namespace eprosima::fastdds::dds;

namespace {

class Printer : public DataReaderListener {
 public:
  void on_data_available(DataReader* reader) override {
    example::Reading reading;
    SampleInfo info;
    while (reader->take_next_sample(&reading, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      const std::lock_guard lock(mutex_);
      std::printf("%u %.1f\n", reading.number, reading.range_m);
      last_ = static_cast<int>(reading.number);
      came_.notify_all();
    }
  }
  void wait_for(int last) {
    std::unique_lock lock(mutex_);
    for (int before = last_; last_ < last; before = last_)
      if (!came_.wait_for(lock, std::chrono::seconds(10), [&] { return last_ != before; })) {
        std::printf("nothing for 10 s\n");
        return;
      }
  }

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  int last_ = -1;
};

}  // namespace

int main(int argc, char** argv) {
  const int count = argc >= 2 ? std::atoi(argv[1]) : 0;
  DomainParticipantFactory& factory = *DomainParticipantFactory::get_instance();
  DomainParticipant* const participant = factory.create_participant(0, PARTICIPANT_QOS_DEFAULT);
  if (count <= 0 || participant == nullptr) {
    std::fprintf(stderr, "fast_listener: expected a number of readings, and a network\n");
    return 2;
  }
  const TypeSupport type(new example::ReadingType);
  type.register_type(participant);
  Topic* const topic = participant->create_topic("reading", type.get_type_name(), TOPIC_QOS_DEFAULT);
  DataReaderQos quality = DATAREADER_QOS_DEFAULT;
  if (argc == 3 && std::string_view(argv[2]) == "reliable") {
    quality.reliability().kind = RELIABLE_RELIABILITY_QOS;
    quality.history().kind = KEEP_ALL_HISTORY_QOS;
  }
  Printer printer;
  participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT)->create_datareader(topic, quality, &printer);
  printer.wait_for(count - 1);
  participant->delete_contained_entities();
  factory.delete_participant(participant);
}
