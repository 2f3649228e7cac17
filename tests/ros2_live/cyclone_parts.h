// What programs on Cyclone DDS share that speak with ours.
#pragma once

#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static inline void must(dds_return_t result, const char* what) {
  if (result >= 0) return;
  fprintf(stderr, "%s: %s\n", what, dds_strretcode(-result));
  exit(1);
}

static inline double wall_seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// As rmw_cyclonedds has it: latched topics also serve those who come later.
static inline dds_qos_t* ros_qos(int reliable, int latched) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(100));
  dds_qset_durability(qos, latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, latched ? 1 : 1000);
  if (latched) dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, 1, -1, -1, -1);
  return qos;
}

static inline dds_entity_t ros_topic(dds_entity_t participant, const char* name,
                                     const dds_topic_descriptor_t* type) {
  dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
  must(topic, name);
  return topic;
}

static inline dds_entity_t ros_writer(dds_entity_t participant, const char* name,
                                      const dds_topic_descriptor_t* type, int latched) {
  dds_qos_t* qos = ros_qos(1, latched);
  dds_entity_t made = dds_create_writer(participant, ros_topic(participant, name, type), qos, NULL);
  must(made, name);
  dds_delete_qos(qos);
  return made;
}

static inline dds_entity_t ros_reader(dds_entity_t participant, const char* name,
                                      const dds_topic_descriptor_t* type, int reliable,
                                      int latched) {
  dds_qos_t* qos = ros_qos(reliable, latched);
  dds_entity_t made = dds_create_reader(participant, ros_topic(participant, name, type), qos, NULL);
  must(made, name);
  dds_delete_qos(qos);
  return made;
}
