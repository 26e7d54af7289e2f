// SPDX-License-Identifier: BSD-3-Clause
// Prints readings that come by Cyclone DDS, up to the one before NUMBER, or until none has come for ten seconds:
// cyclone_listener NUMBER [reliable]. Without `reliable`, those that the network loses are not sent again.
#include <dds/dds.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reading.h"

enum { at_once = 16 };

static int print_all(dds_entity_t reader) {
  void* readings[at_once] = {NULL};
  dds_sample_info_t infos[at_once];
  const int count = dds_take(reader, readings, infos, at_once, at_once);
  int last = -1;
  for (int i = 0; i < count; ++i) {
    if (!infos[i].valid_data) continue;
    const example_Reading* const reading = readings[i];
    printf("%u %.1f\n", reading->number, reading->range_m);
    last = (int)reading->number;
  }
  if (count > 0) dds_return_loan(reader, readings, count);
  return last;
}

int main(int argc, char** argv) {
  const int count = argc >= 2 ? atoi(argv[1]) : 0;
  const bool is_reliable = argc == 3 && strcmp(argv[2], "reliable") == 0;
  const dds_entity_t participant = dds_create_participant(DDS_DOMAIN_DEFAULT, NULL, NULL);
  if (count <= 0 || participant < 0) {
    fprintf(stderr, "cyclone_listener: expected a number of readings, and a network\n");
    return 2;
  }
  const dds_entity_t topic = dds_create_topic(participant, &example_Reading_desc, "reading", NULL, NULL);
  dds_qos_t* const quality = dds_create_qos();
  if (is_reliable) dds_qset_reliability(quality, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  if (is_reliable) dds_qset_history(quality, DDS_HISTORY_KEEP_ALL, 0);
  const dds_entity_t reader = dds_create_reader(participant, topic, quality, NULL);
  dds_delete_qos(quality);
  const dds_entity_t waits = dds_create_waitset(participant);
  dds_waitset_attach(waits, dds_create_readcondition(reader, DDS_ANY_STATE), 0);
  for (int last = -1; last < count - 1;) {
    if (dds_waitset_wait(waits, NULL, 0, DDS_SECS(10)) <= 0) {
      printf("nothing for 10 s\n");
      break;
    }
    const int newest = print_all(reader);
    if (newest > last) last = newest;
  }
  dds_delete(participant);
  return 0;
}
