// SPDX-License-Identifier: BSD-3-Clause
// Publishes readings by Cyclone DDS, ten a second: cyclone_talker NUMBER. They are kept until all reliable subscribers
// have them.
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>

#include "reading.h"

int main(int argc, char** argv) {
  const int count = argc == 2 ? atoi(argv[1]) : 0;
  const dds_entity_t participant = dds_create_participant(DDS_DOMAIN_DEFAULT, NULL, NULL);
  if (count <= 0 || participant < 0) {
    fprintf(stderr, "cyclone_talker: expected a number of readings, and a network\n");
    return 2;
  }
  const dds_entity_t topic = dds_create_topic(participant, &example_Reading_desc, "reading", NULL, NULL);
  dds_qos_t* const quality = dds_create_qos();
  dds_qset_history(quality, DDS_HISTORY_KEEP_ALL, 0);
  const dds_entity_t writer = dds_create_writer(participant, topic, quality, NULL);
  dds_delete_qos(quality);
  for (int i = 0; i < count; ++i) {
    const example_Reading reading = {(uint32_t)i, 0.5 * i};
    dds_write(writer, &reading);
    dds_sleepfor(DDS_MSECS(100));
  }
  dds_wait_for_acks(writer, DDS_SECS(30));
  dds_delete(participant);
  return 0;
}
