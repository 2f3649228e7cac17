// cyclone_peer DOMAIN PACE  a robot of ROS 2 on Cyclone DDS, which knows nothing of ours: says what
// the lines at its standard input tell, PACE times as fast as their stamps, and prints what it
// hears.
//   static PARENT CHILD X Y THETA
//   odom STAMP_NS X Y THETA V W
//   scan STAMP_NS FRAME ANGLE_MIN STEP RANGE_MAX COUNT RANGE...
//   cloud STAMP_NS FRAME COUNT X Y Z...   at `points`
//   initial X Y THETA
//   map FILE.pgm RESOLUTION X Y YAW      as map_server does with black, white and grey
//   await STAMP_NS                   goes on once a pose of this time or a later one was heard
//   sample scan ... or cloud ...     what `ready` says meanwhile
//   ready                            goes on once everybody is there
// It prints "said STAMP_NS AT" of odometry, "scanned STAMP_NS AT" of scans, "matched SECONDS" once
// all it needs is there, "node
// ...", "tf ...", "pose ...", "particles ...", "diagnostics ...", "diagnosed KEY VALUE" of floors,
// "floor NAME" and "map WIDTH HEIGHT RESOLUTION X Y OCCUPIED FREE".
#define _GNU_SOURCE
#include <dds/dds.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>
#include <time.h>

#include "messages.h"

enum { kMostRanges = 65536, kTopics = 8 };

static dds_entity_t participant;

static void must(dds_return_t result, const char* what) {
  if (result >= 0) return;
  fprintf(stderr, "cyclone_peer: %s: %s\n", what, dds_strretcode(-result));
  exit(1);
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void rest(double seconds) {
  if (seconds > 0.0) dds_sleepfor((dds_duration_t)(seconds * 1e9));
}

static dds_qos_t* qos_of(int reliable, int latched, int kept) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(100));
  dds_qset_durability(qos, latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, kept);
  if (latched) dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, 1, -1, -1, -1);
  return qos;
}

static dds_entity_t writer(const char* name, const dds_topic_descriptor_t* type, int reliable,
                           int latched) {
  dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
  must(topic, name);
  dds_qos_t* qos = qos_of(reliable, latched, latched ? 1 : 1000);
  dds_entity_t made = dds_create_writer(participant, topic, qos, NULL);
  must(made, name);
  dds_delete_qos(qos);
  return made;
}

static dds_entity_t reader(const char* name, const dds_topic_descriptor_t* type, int reliable,
                           int latched) {
  dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
  must(topic, name);
  dds_qos_t* qos = qos_of(reliable, latched, 1000);
  dds_entity_t made = dds_create_reader(participant, topic, qos, NULL);
  must(made, name);
  dds_delete_qos(qos);
  return made;
}

static long long nanoseconds(const builtin_interfaces_msg_dds__Time_* t) {
  return 1000000000LL * t->sec + t->nanosec;
}

static void set_time(builtin_interfaces_msg_dds__Time_* t, long long stamp) {
  t->sec = (int32_t)(stamp / 1000000000LL);
  t->nanosec = (uint32_t)(stamp % 1000000000LL);
}

static void print_tf(const void* sample) {
  const tf2_msgs_msg_dds__TFMessage_* m = sample;
  for (uint32_t i = 0; i < m->transforms._length; ++i) {
    const geometry_msgs_msg_dds__TransformStamped_* t = &m->transforms._buffer[i];
    printf("tf %lld %s %s %.17g %.17g %.17g %.17g %.6f\n", nanoseconds(&t->header.stamp),
           t->header.frame_id, t->child_frame_id, t->transform.translation.x,
           t->transform.translation.y, t->transform.rotation.z, t->transform.rotation.w, now());
  }
}
static _Atomic long long newest_pose = -1;

static void print_pose(const void* sample) {
  const geometry_msgs_msg_dds__PoseWithCovarianceStamped_* m = sample;
  newest_pose = nanoseconds(&m->header.stamp);
  printf("pose %lld %s %.17g %.17g %.17g %.17g %.6g %.6g %.6f\n", nanoseconds(&m->header.stamp),
         m->header.frame_id, m->pose.pose.position.x, m->pose.pose.position.y,
         m->pose.pose.orientation.z, m->pose.pose.orientation.w, m->pose.covariance[0],
         m->pose.covariance[35], now());
}
static void print_particles(const void* sample) {
  const nav2_msgs_msg_dds__ParticleCloud_* m = sample;
  double sum = 0.0;
  for (uint32_t i = 0; i < m->particles._length; ++i) sum += m->particles._buffer[i].weight;
  printf("particles %lld %u %.9f\n", nanoseconds(&m->header.stamp), m->particles._length, sum);
}
static void print_diagnostics(const void* sample) {
  const diagnostic_msgs_msg_dds__DiagnosticArray_* m = sample;
  for (uint32_t i = 0; i < m->status._length; ++i) {
    const diagnostic_msgs_msg_dds__DiagnosticStatus_* one = &m->status._buffer[i];
    printf("diagnostics %lld %d %s %s\n", nanoseconds(&m->header.stamp), one->level, one->name,
           one->message);
    for (uint32_t j = 0; j < one->values._length; ++j)
      if (strncmp(one->values._buffer[j].key, "floor", 5) == 0)
        printf("diagnosed %s %s\n", one->values._buffer[j].key, one->values._buffer[j].value);
  }
}
static void print_floor(const void* sample) {
  printf("floor %s\n", ((const std_msgs_msg_dds__String_*)sample)->data);
}
static void print_map(const void* sample) {
  const nav_msgs_msg_dds__OccupancyGrid_* m = sample;
  uint32_t occupied = 0, open = 0;
  for (uint32_t i = 0; i < m->data._length; ++i) {
    occupied += m->data._buffer[i] == 100;
    open += m->data._buffer[i] == 0;
  }
  printf("map %u %u %.6g %.9g %.9g %u %u\n", m->info.width, m->info.height, m->info.resolution,
         m->info.origin.position.x, m->info.origin.position.y, occupied, open);
}
static void print_likelihood(const void* sample) {
  const nav_msgs_msg_dds__OccupancyGrid_* m = sample;
  uint32_t best = 0, open = 0;
  for (uint32_t i = 0; i < m->data._length; ++i) {
    if (m->data._buffer[i] > m->data._buffer[best]) best = i;
    if (m->data._buffer[i] >= 0) ++open;
  }
  printf("likelihood %lld %s %u %d %.9g %.9g\n", nanoseconds(&m->header.stamp), m->header.frame_id,
         open, m->data._length > 0 ? m->data._buffer[best] : -1,
         m->info.origin.position.x + (best % m->info.width + 0.5) * m->info.resolution,
         m->info.origin.position.y + (best / m->info.width + 0.5) * m->info.resolution);
}
static void print_nodes(const void* sample) {
  const rmw_dds_common_msg_dds__ParticipantEntitiesInfo_* m = sample;
  for (uint32_t i = 0; i < m->node_entities_info_seq._length; ++i) {
    const rmw_dds_common_msg_dds__NodeEntitiesInfo_* n = &m->node_entities_info_seq._buffer[i];
    printf("node %s %s %u %u\n", n->node_namespace, n->node_name, n->reader_gid_seq._length,
           n->writer_gid_seq._length);
  }
}

typedef struct {
  dds_entity_t entity;
  void (*print)(const void*);
} Heard;

static int hear_once(const Heard* heard) {
  int count = 0;
  for (int i = 0; i < kTopics; ++i) {
    for (;;) {
      void* sample = NULL;
      dds_sample_info_t info;
      if (dds_take(heard[i].entity, &sample, &info, 1, 1) <= 0) break;
      if (info.valid_data) heard[i].print(sample), ++count;
      dds_return_loan(heard[i].entity, &sample, 1);
    }
  }
  if (count > 0) fflush(stdout);
  return count;
}

static atomic_int all_is_said;

// A thread of its own: who waits for what is heard says nothing meanwhile. Once all is said, it
// ends when nothing has come for a second.
static int hear(void* of_topics) {
  const Heard* heard = of_topics;
  for (double quiet = now(); !all_is_said || now() - quiet < 1.0; rest(0.001))
    if (hear_once(heard) > 0 || !all_is_said) quiet = now();
  return 0;
}

static void say_map(dds_entity_t maps, const char* line) {
  char file[1024];
  float resolution;
  double x, y, yaw;
  unsigned width, height;
  if (sscanf(line, "map %1023s %f %lf %lf %lf", file, &resolution, &x, &y, &yaw) != 5)
    fprintf(stderr, "bad map\n"), exit(1);
  FILE* picture = fopen(file, "rb");
  if (picture == NULL || fscanf(picture, "P5 %u %u 255", &width, &height) != 2 ||
      fgetc(picture) != '\n')
    fprintf(stderr, "cyclone_peer: %s is no picture\n", file), exit(1);
  nav_msgs_msg_dds__OccupancyGrid_ m = {.header = {{1, 0}, "map"}};
  m.info.resolution = resolution, m.info.width = width, m.info.height = height;
  m.info.origin.position.x = x, m.info.origin.position.y = y;
  m.info.origin.orientation.z = sin(0.5 * yaw), m.info.origin.orientation.w = cos(0.5 * yaw);
  m.data._length = m.data._maximum = width * height;
  m.data._buffer = malloc(width * height);
  for (unsigned row = height; row-- > 0;)
    for (unsigned column = 0; column < width; ++column) {
      const int grey = fgetc(picture);
      m.data._buffer[row * width + column] = grey < 90 ? 100 : grey > 250 ? 0 : -1;
    }
  fclose(picture);
  must(dds_write(maps, &m), "map");
  free(m.data._buffer);
}

static float ranges[kMostRanges];

static void say_scan(dds_entity_t scans, const char* line) {
  char frame[256];
  long long stamp;
  unsigned count = 0;
  int used = 0;
  sensor_msgs_msg_dds__LaserScan_ m = {.header = {{0, 0}, frame}};
  if (sscanf(line, "scan %lld %255s %f %f %f %u%n", &stamp, frame, &m.angle_min, &m.angle_increment,
             &m.range_max, &count, &used) < 6 ||
      count > kMostRanges)
    fprintf(stderr, "cyclone_peer: bad line: %.60s\n", line), exit(1);
  char* at = (char*)line + used;
  for (unsigned i = 0; i < count; ++i) ranges[i] = strtof(at, &at);
  set_time(&m.header.stamp, stamp);
  m.angle_max = m.angle_min + (float)(count - 1) * m.angle_increment;
  m.ranges._length = m.ranges._maximum = count, m.ranges._buffer = ranges;
  must(dds_write(scans, &m), "scan");
  printf("scanned %lld %.6f\n", stamp, now());
}

// As many drivers lay points out: coordinates, and a word that is no coordinate.
static void say_cloud(dds_entity_t clouds, const char* line) {
  enum { kMostPoints = 65536 };
  static float points[kMostPoints][4];
  static sensor_msgs_msg_dds__PointField_ fields[4] = {
      {"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"intensity", 12, 7, 1}};
  char frame[256];
  long long stamp;
  unsigned count = 0;
  int used = 0;
  if (sscanf(line, "cloud %lld %255s %u%n", &stamp, frame, &count, &used) < 3 ||
      count > kMostPoints)
    fprintf(stderr, "cyclone_peer: bad line: %.60s\n", line), exit(1);
  char* at = (char*)line + used;
  for (unsigned i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = strtof(at, &at);
  sensor_msgs_msg_dds__PointCloud2_ m = {.header = {{0, 0}, frame}, .height = 1, .width = count};
  set_time(&m.header.stamp, stamp);
  m.point_step = sizeof points[0], m.row_step = (uint32_t)sizeof points[0] * count;
  m.fields._length = m.fields._maximum = 4, m.fields._buffer = fields;
  m.data._length = m.data._maximum = m.row_step, m.data._buffer = (uint8_t*)points;
  m.is_dense = true;
  must(dds_write(clouds, &m), "points");
}

static int is_cloud(const char* line) { return line != NULL && strncmp(line, "cloud ", 6) == 0; }

// What the endpoints that write a topic say of themselves: the hash of its type, since Iron.
static void print_user_data(const char* name, dds_entity_t topic_reader) {
  dds_instance_handle_t writers[8];
  const int count = dds_get_matched_publications(topic_reader, writers, 8);
  for (int i = 0; i < count && i < 8; ++i) {
    dds_builtintopic_endpoint_t* one = dds_get_matched_publication_data(topic_reader, writers[i]);
    void* data = NULL;
    size_t size = 0;
    if (one == NULL) continue;
    if (dds_qget_userdata(one->qos, &data, &size) && size > 0)
      printf("userdata %s %.*s\n", name, (int)size, (char*)data);
    dds_free(data);
    dds_builtintopic_free_endpoint(one);
  }
}

static void wait_for_peers(const char* sample, dds_entity_t scan, dds_entity_t odom,
                           dds_entity_t fixed, const Heard* heard) {
  const double begin = now();
  double said = 0.0;
  for (;;) {
    dds_publication_matched_status_t a, b, c;
    dds_subscription_matched_status_t d, e;
    dds_get_publication_matched_status(scan, &a);
    dds_get_publication_matched_status(odom, &b);
    dds_get_publication_matched_status(fixed, &c);
    dds_get_subscription_matched_status(heard[0].entity, &d);
    dds_get_subscription_matched_status(heard[1].entity, &e);
    if (a.current_count && b.current_count && c.current_count && d.current_count && e.current_count)
      break;
    if (sample != NULL && a.current_count && now() - said > 0.2)
      (is_cloud(sample) ? say_cloud : say_scan)(scan, sample), said = now();
    if (now() - begin > 30.0)
      fprintf(stderr, "cyclone_peer: nobody is there after 30 s\n"), exit(1);
    rest(0.005);
  }
  printf("matched %.3f\n", now() - begin);
  print_user_data("tf", heard[0].entity);
  print_user_data("amcl_pose", heard[1].entity);
}

int main(int argc, char** argv) {
  if (argc != 3) return fprintf(stderr, "usage: cyclone_peer DOMAIN PACE\n"), 2;
  const double pace = atof(argv[2]);
  participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  must(participant, "participant");
  dds_entity_t scans = writer("rt/scan", &sensor_msgs_msg_dds__LaserScan__desc, 0, 0);
  dds_entity_t clouds = writer("rt/points", &sensor_msgs_msg_dds__PointCloud2__desc, 0, 0);
  dds_entity_t odometry = writer("rt/odom", &nav_msgs_msg_dds__Odometry__desc, 1, 0);
  dds_entity_t fixed = writer("rt/tf_static", &tf2_msgs_msg_dds__TFMessage__desc, 1, 1);
  dds_entity_t maps = writer("rt/map", &nav_msgs_msg_dds__OccupancyGrid__desc, 1, 1);
  dds_entity_t initial =
      writer("rt/initialpose", &geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc, 1, 0);
  Heard heard[kTopics] = {
      {reader("rt/tf", &tf2_msgs_msg_dds__TFMessage__desc, 1, 0), print_tf},
      {reader("rt/amcl_pose", &geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc, 1, 1),
       print_pose},
      {reader("rt/particle_cloud", &nav2_msgs_msg_dds__ParticleCloud__desc, 0, 0), print_particles},
      {reader("rt/diagnostics", &diagnostic_msgs_msg_dds__DiagnosticArray__desc, 1, 0),
       print_diagnostics},
      {reader("ros_discovery_info", &rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc, 1, 1),
       print_nodes},
      {reader("rt/likelihood_map", &nav_msgs_msg_dds__OccupancyGrid__desc, 1, 1), print_likelihood},
      {reader("rt/floor", &std_msgs_msg_dds__String__desc, 1, 1), print_floor},
      {reader("rt/map", &nav_msgs_msg_dds__OccupancyGrid__desc, 1, 1), print_map}};
  thrd_t listener;
  if (thrd_create(&listener, hear, heard) != thrd_success) return fprintf(stderr, "no thread\n"), 1;
  char* line = NULL;
  size_t size = 0;
  long long first = -1;
  double begin = now();
  char* sample = NULL;
  while (getline(&line, &size, stdin) > 0) {
    char frame[256], child[256];
    double x, y, theta, v, w;
    long long stamp = -1;
    if (sscanf(line, "scan %lld", &stamp) == 1 || sscanf(line, "cloud %lld", &stamp) == 1 ||
        sscanf(line, "odom %lld", &stamp) == 1) {
      if (first < 0) first = stamp;
      const double due = begin + 1e-9 * (double)(stamp - first) / pace;
      while (now() < due) rest(0.001);
      begin += now() - due;
    }
    if (sscanf(line, "static %255s %255s %lf %lf %lf", frame, child, &x, &y, &theta) == 5) {
      geometry_msgs_msg_dds__TransformStamped_ one = {
          {{0, 0}, frame}, child, {{x, y, 0}, {0, 0, sin(theta / 2), cos(theta / 2)}}};
      tf2_msgs_msg_dds__TFMessage_ m = {{1, 1, &one, false}};
      must(dds_write(fixed, &m), "tf_static");
      rest(0.2);
    } else if (sscanf(line, "odom %lld %lf %lf %lf %lf %lf", &stamp, &x, &y, &theta, &v, &w) == 6) {
      nav_msgs_msg_dds__Odometry_ m = {.header = {{0, 0}, "odom"}, .child_frame_id = "base_link"};
      set_time(&m.header.stamp, stamp);
      m.pose.pose.position.x = x, m.pose.pose.position.y = y;
      m.pose.pose.orientation.z = sin(theta / 2), m.pose.pose.orientation.w = cos(theta / 2);
      m.twist.twist.linear.x = v, m.twist.twist.angular.z = w;
      must(dds_write(odometry, &m), "odom");
      printf("said %lld %.6f\n", stamp, now());
    } else if (sscanf(line, "initial %lf %lf %lf", &x, &y, &theta) == 3) {
      geometry_msgs_msg_dds__PoseWithCovarianceStamped_ m = {.header = {{0, 0}, "map"}};
      m.pose.pose.position.x = x, m.pose.pose.position.y = y;
      m.pose.pose.orientation.z = sin(theta / 2), m.pose.pose.orientation.w = cos(theta / 2);
      m.pose.covariance[0] = m.pose.covariance[7] = 0.01, m.pose.covariance[35] = 0.003;
      must(dds_write(initial, &m), "initialpose");
    } else if (sscanf(line, "await %lld", &stamp) == 1) {
      fflush(stdout);
      const double longest = 30.0;
      for (const double since = now(); newest_pose < stamp && now() - since < longest;) rest(0.001);
    } else if (strncmp(line, "map ", 4) == 0) {
      say_map(maps, line);
    } else if (strncmp(line, "sample ", 7) == 0) {
      sample = strdup(line + 7);
    } else if (strncmp(line, "ready", 5) == 0) {
      wait_for_peers(sample, is_cloud(sample) ? clouds : scans, odometry, fixed, heard);
      begin = now();
    } else if (is_cloud(line)) {
      say_cloud(clouds, line);
    } else {
      say_scan(scans, line);
    }
    fflush(stdout);
  }
  all_is_said = 1;
  thrd_join(listener, NULL);
  free(line);
  free(sample);
  dds_delete(participant);
  return 0;
}
