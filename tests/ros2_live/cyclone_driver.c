// cyclone_driver DOMAIN SPACE [stamped|real]  who drives a robot of ROS 2, on Cyclone DDS, and
// knows nothing of ours: tells velocities (stamped: TwistStamped) at SPACE/cmd_vel as its standard
// input says, and prints what it hears. SPACE is a namespace, or - for none. A real robot has no
// clock but the stamps of its odometry.
//   drive V W METRES   V and W until odometry has moved on so far; of W alone: turned so many rad
//   once V W           one command
//   rest               no command, until odometry stands still
//   wander SECONDS     ahead where scans are free, else turning, for so long by the robot's clock
//   hear SECONDS       no command, for so long by the robot's clock
// It prints "clock", "odom", "scan", "range", "truth", "tf", "static", "map", "diagnostics" of what
// counts relocalizations, and "told STAMP_NS V W" of commands, by the newest clock; "-" for none.
// It fails if something takes 100 s longer than that.
#include <math.h>
#include <string.h>

#include "cyclone_parts.h"
#include "messages.h"

enum { kMostReaders = 9, kPatience = 100 };

static dds_entity_t participant, commands;
static const char* space;
static bool is_stamped, is_real;

// What was heard last.
static struct {
  long long clock;  // [ns]; -1: none
  double x, y, theta, v, w;
  bool has_odometry, has_scan;
  double way, turned;  // of odometry altogether [m, rad]
  double ahead;        // least range within 30 degrees of ahead [m]
  double clock_at;     // when the clock was heard last, by our own [s]
} heard = {.clock = -1, .ahead = 0.0};

static long long nanoseconds(const builtin_interfaces_msg_dds__Time_* t) {
  return 1000000000LL * t->sec + t->nanosec;
}

static void print_clock(const void* sample) {
  heard.clock = nanoseconds(&((const rosgraph_msgs_msg_dds__Clock_*)sample)->clock);
  heard.clock_at = wall_seconds();
  printf("clock %lld\n", heard.clock);
}

static void print_odometry(const void* sample) {
  const nav_msgs_msg_dds__Odometry_* m = sample;
  const double x = m->pose.pose.position.x, y = m->pose.pose.position.y;
  const double theta = 2.0 * atan2(m->pose.pose.orientation.z, m->pose.pose.orientation.w);
  if (heard.has_odometry) {
    heard.way += hypot(x - heard.x, y - heard.y);
    heard.turned += fabs(remainder(theta - heard.theta, 2.0 * M_PI));
  }
  if (is_real) heard.clock = nanoseconds(&m->header.stamp), heard.clock_at = wall_seconds();
  heard.x = x, heard.y = y, heard.theta = theta, heard.has_odometry = true;
  heard.v = m->twist.twist.linear.x, heard.w = m->twist.twist.angular.z;
  printf("odom %lld %s %s %.17g %.17g %.17g %.17g %.17g\n", nanoseconds(&m->header.stamp),
         m->header.frame_id, m->child_frame_id, x, y, theta, heard.v, heard.w);
}

static void print_scan(const void* sample) {
  const sensor_msgs_msg_dds__LaserScan_* m = sample;
  heard.has_scan = true, heard.ahead = INFINITY;
  printf("scan %lld %s %.9g %.9g %.9g %u", nanoseconds(&m->header.stamp), m->header.frame_id,
         m->angle_min, m->angle_increment, m->range_max, m->ranges._length);
  for (uint32_t i = 0; i < m->ranges._length; ++i) {
    const double angle = m->angle_min + i * (double)m->angle_increment;
    if (fabs(angle) < 0.52 && m->ranges._buffer[i] < heard.ahead)
      heard.ahead = m->ranges._buffer[i];
    printf(" %.9g", m->ranges._buffer[i]);
  }
  printf("\n");
}

static void print_range(const void* sample) {
  const sensor_msgs_msg_dds__Range_* m = sample;
  printf("range %lld %s %d %.9g %.9g %.9g %.9g\n", nanoseconds(&m->header.stamp),
         m->header.frame_id, m->radiation_type, m->field_of_view, m->max_range, m->range,
         m->variance);
}

static void print_truth(const void* sample) {
  const geometry_msgs_msg_dds__PoseStamped_* m = sample;
  printf("truth %lld %s %.17g %.17g %.17g\n", nanoseconds(&m->header.stamp), m->header.frame_id,
         m->pose.position.x, m->pose.position.y,
         2.0 * atan2(m->pose.orientation.z, m->pose.orientation.w));
}

static void print_frames(const char* what, const void* sample) {
  const tf2_msgs_msg_dds__TFMessage_* m = sample;
  for (uint32_t i = 0; i < m->transforms._length; ++i) {
    const geometry_msgs_msg_dds__TransformStamped_* t = &m->transforms._buffer[i];
    printf("%s %lld %s %s %.17g %.17g %.17g\n", what, nanoseconds(&t->header.stamp),
           t->header.frame_id, t->child_frame_id, t->transform.translation.x,
           t->transform.translation.y,
           2.0 * atan2(t->transform.rotation.z, t->transform.rotation.w));
  }
}
static void print_tf(const void* sample) { print_frames("tf", sample); }
static void print_static(const void* sample) { print_frames("static", sample); }

static void print_map(const void* sample) {
  const nav_msgs_msg_dds__OccupancyGrid_* m = sample;
  uint32_t occupied = 0;
  for (uint32_t i = 0; i < m->data._length; ++i) occupied += m->data._buffer[i] == 100;
  printf("map %s %.9g %u %u %.9g %.9g %u\n", m->header.frame_id, m->info.resolution, m->info.width,
         m->info.height, m->info.origin.position.x, m->info.origin.position.y, occupied);
}

static const char* value_of(const diagnostic_msgs_msg_dds__DiagnosticStatus_* s, const char* key) {
  for (uint32_t i = 0; i < s->values._length; ++i)
    if (strcmp(s->values._buffer[i].key, key) == 0) return s->values._buffer[i].value;
  return NULL;
}

static void print_diagnostics(const void* sample) {
  const diagnostic_msgs_msg_dds__DiagnosticArray_* m = sample;
  for (uint32_t i = 0; i < m->status._length; ++i) {
    const diagnostic_msgs_msg_dds__DiagnosticStatus_* s = &m->status._buffer[i];
    const char* count = value_of(s, "relocalizations");
    const char* cause = value_of(s, "relocalization");
    if (count != NULL && cause != NULL)
      printf("diagnostics %lld %s %d %s %s\n", nanoseconds(&m->header.stamp), s->name, s->level,
             count, cause);
  }
}

static struct {
  dds_entity_t entity;
  void (*print)(const void*);
} readers[kMostReaders];
static int reader_count;

static void listen_to(const char* topic, bool is_global, const dds_topic_descriptor_t* type,
                      int latched, void (*print)(const void*)) {
  char name[256];
  snprintf(name, sizeof name, "rt%s/%s", is_global ? "" : space, topic);
  readers[reader_count].entity = ros_reader(participant, name, type, 1, latched);
  readers[reader_count++].print = print;
}

static void hear(void) {
  for (int i = 0; i < reader_count; ++i) {
    for (;;) {
      void* sample = NULL;
      dds_sample_info_t info;
      if (dds_take(readers[i].entity, &sample, &info, 1, 1) <= 0) break;
      if (info.valid_data) readers[i].print(sample);
      dds_return_loan(readers[i].entity, &sample, 1);
    }
  }
  fflush(stdout);
}

static void tell(double v, double w) {
  geometry_msgs_msg_dds__Twist_ twist = {.linear = {.x = v}, .angular = {.z = w}};
  if (is_stamped) {
    geometry_msgs_msg_dds__TwistStamped_ stamped = {.header = {.frame_id = "base_link"},
                                                    .twist = twist};
    stamped.header.stamp.sec = (int32_t)(heard.clock / 1000000000LL);
    stamped.header.stamp.nanosec = (uint32_t)(heard.clock % 1000000000LL);
    must(dds_write(commands, &stamped), "cmd_vel");
  } else {
    must(dds_write(commands, &twist), "cmd_vel");
  }
  printf("told %lld %.9g %.9g\n", heard.clock, v, w);
}

// Hears on, and gives up after a time that nobody needs.
static void go_on(double begin, const char* what) {
  if (wall_seconds() - begin > kPatience)
    fprintf(stderr, "cyclone_driver: '%s' has not ended after %d s\n", what, kPatience), exit(1);
  dds_sleepfor(DDS_MSECS(5));
  hear();
}

static bool obey(const char* line) {
  const double begin = wall_seconds();
  const double way = heard.way, turned = heard.turned;
  const long long since = heard.clock;
  double v = 0.0, w = 0.0, much = 0.0, turn = 0.6;
  if (sscanf(line, "drive %lf %lf %lf", &v, &w, &much) == 3) {
    for (; (v != 0.0 ? heard.way - way : heard.turned - turned) < much; go_on(begin, line)) {
      tell(v, w);
      dds_sleepfor(DDS_MSECS(15));
    }
  } else if (sscanf(line, "once %lf %lf", &v, &w) == 2) {
    tell(v, w);
  } else if (strncmp(line, "rest", 4) == 0) {
    do go_on(begin, line);
    while (heard.v != 0.0 || heard.w != 0.0);
  } else if (sscanf(line, "wander %lf", &much) == 1) {
    for (bool is_free = true; (double)(heard.clock - since) < 1e9 * much;
         go_on(heard.clock_at, line)) {
      const bool was_free = is_free;
      is_free = heard.ahead > (is_free ? 0.7 : 1.0);
      if (was_free && !is_free) turn = -turn;
      is_free ? tell(0.3, 0.0) : tell(0.0, turn);
      dds_sleepfor(DDS_MSECS(15));
    }
  } else if (sscanf(line, "hear %lf", &much) == 1) {
    while ((double)(heard.clock - since) < 1e9 * much) go_on(heard.clock_at, line);
  } else {
    return false;
  }
  return true;
}

static void wait_for_robot(void) {
  const double begin = wall_seconds();
  dds_publication_matched_status_t matched;
  do {
    go_on(begin, "nobody is there");
    dds_get_publication_matched_status(commands, &matched);
  } while (!matched.current_count || heard.clock < 0 || !heard.has_odometry ||
           !(heard.has_scan || is_real));
}

int main(int argc, char** argv) {
  if (argc < 3) return fprintf(stderr, "usage: cyclone_driver DOMAIN SPACE [stamped|real]\n"), 2;
  space = strcmp(argv[2], "-") == 0 ? "" : argv[2];
  is_stamped = argc > 3 && strcmp(argv[3], "stamped") == 0;
  is_real = argc > 3 && strcmp(argv[3], "real") == 0;
  participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  must(participant, "participant");
  char name[256];
  snprintf(name, sizeof name, "rt%s/cmd_vel", space);
  commands = ros_writer(
      participant, name,
      is_stamped ? &geometry_msgs_msg_dds__TwistStamped__desc : &geometry_msgs_msg_dds__Twist__desc,
      0);
  listen_to("clock", true, &rosgraph_msgs_msg_dds__Clock__desc, 0, print_clock);
  listen_to("diagnostics", true, &diagnostic_msgs_msg_dds__DiagnosticArray__desc, 0,
            print_diagnostics);
  listen_to("tf", false, &tf2_msgs_msg_dds__TFMessage__desc, 0, print_tf);
  listen_to("tf_static", false, &tf2_msgs_msg_dds__TFMessage__desc, 1, print_static);
  listen_to("odom", false, &nav_msgs_msg_dds__Odometry__desc, 0, print_odometry);
  listen_to("scan", false, &sensor_msgs_msg_dds__LaserScan__desc, 0, print_scan);
  listen_to("range/sonar/sonar0", false, &sensor_msgs_msg_dds__Range__desc, 0, print_range);
  listen_to("ground_truth", false, &geometry_msgs_msg_dds__PoseStamped__desc, 0, print_truth);
  listen_to("map", false, &nav_msgs_msg_dds__OccupancyGrid__desc, 1, print_map);
  wait_for_robot();
  char* line = NULL;
  size_t size = 0;
  while (getline(&line, &size, stdin) > 0)
    if (!obey(line)) return fprintf(stderr, "cyclone_driver: bad line: %s", line), 1;
  hear();
  free(line);
  dds_delete(participant);
  return 0;
}
