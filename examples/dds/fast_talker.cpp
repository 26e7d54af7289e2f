// SPDX-License-Identifier: BSD-3-Clause
// Publishes readings by Fast DDS, ten a second: fast_talker NUMBER. They are kept until all reliable subscribers have
// them.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "examples/dds/fast_reading.hpp"

using namespace eprosima::fastdds::dds;

int main(int argc, char** argv) {
  const int count = argc == 2 ? std::atoi(argv[1]) : 0;
  DomainParticipantFactory& factory = *DomainParticipantFactory::get_instance();
  DomainParticipant* const participant = factory.create_participant(0, PARTICIPANT_QOS_DEFAULT);
  if (count <= 0 || participant == nullptr) {
    std::fprintf(stderr, "fast_talker: expected a number of readings, and a network\n");
    return 2;
  }
  const TypeSupport type(new example::ReadingType);
  type.register_type(participant);
  Topic* const topic = participant->create_topic("reading", type.get_type_name(), TOPIC_QOS_DEFAULT);
  DataWriterQos quality = DATAWRITER_QOS_DEFAULT;
  quality.history().kind = KEEP_ALL_HISTORY_QOS;
  DataWriter* const writer = participant->create_publisher(PUBLISHER_QOS_DEFAULT)->create_datawriter(topic, quality);
  for (int i = 0; i < count; ++i) {
    example::Reading reading{static_cast<std::uint32_t>(i), 0.5 * i};
    writer->write(&reading);
    usleep(100'000);
  }
  writer->wait_for_acknowledgments({30, 0});
  participant->delete_contained_entities();
  factory.delete_participant(participant);
}
