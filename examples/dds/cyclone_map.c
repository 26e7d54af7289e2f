// SPDX-License-Identifier: BSD-3-Clause
// A map that is published once, with a bug that many first programs on DDS have: cyclone_map server|robot [mended].
//
// The server publishes as soon as it knows of a subscriber. But the subscriber may not know of the server yet: each
// learns of the other by messages of its own. Then the map, whose durability is volatile, is missed. In the mended
// twin it is kept for late subscribers.
#include <dds/dds.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "reading.h"

static int serve(dds_entity_t participant, dds_entity_t topic, const dds_qos_t* quality) {
  const dds_entity_t writer = dds_create_writer(participant, topic, quality, NULL);
  dds_publication_matched_status_t matched = {0};
  while (matched.current_count == 0) {
    dds_sleepfor(DDS_MSECS(1));
    dds_get_publication_matched_status(writer, &matched);
  }
  const example_Reading map = {1, 0};
  dds_write(writer, &map);
  dds_sleepfor(DDS_SECS(2));
  return 0;
}

static int drive(dds_entity_t participant, dds_entity_t topic, const dds_qos_t* quality) {
  const dds_entity_t reader = dds_create_reader(participant, topic, quality, NULL);
  const dds_entity_t waits = dds_create_waitset(participant);
  dds_waitset_attach(waits, dds_create_readcondition(reader, DDS_ANY_STATE), 0);
  const bool has_map = dds_waitset_wait(waits, NULL, 0, DDS_SECS(1)) > 0;
  if (!has_map) fprintf(stderr, "cyclone_map: the robot has no map\n");
  return has_map ? 0 : 1;
}

int main(int argc, char** argv) {
  const bool is_server = argc >= 2 && strcmp(argv[1], "server") == 0;
  const dds_entity_t participant = dds_create_participant(DDS_DOMAIN_DEFAULT, NULL, NULL);
  const dds_entity_t topic = dds_create_topic(participant, &example_Reading_desc, "map", NULL, NULL);
  dds_qos_t* const quality = dds_create_qos();
  if (argc == 3 && strcmp(argv[2], "mended") == 0) {
    dds_qset_durability(quality, DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_reliability(quality, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  }
  const int status = is_server ? serve(participant, topic, quality) : drive(participant, topic, quality);
  dds_delete_qos(quality);
  dds_delete(participant);
  return status;
}
