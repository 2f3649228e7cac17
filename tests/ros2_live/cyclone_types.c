// cyclone_types DOMAIN  each type of message by the serializers that Cyclone's generator makes of
// messages.idl: writes one with all its fields at from_cyclone/TYPE, and writes what it has read at
// to_cyclone/TYPE anew at echo/TYPE; until its standard input ends.
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "cyclone_parts.h"
#include "messages.h"

#define LIST(type, ...)                                                                        \
  {sizeof((type[]){__VA_ARGS__}) / sizeof(type), sizeof((type[]){__VA_ARGS__}) / sizeof(type), \
   (type[]){__VA_ARGS__}, false}
#define STAMP {.sec = 1700000000, .nanosec = 123456789}
#define HEADER(name) {.stamp = STAMP, .frame_id = name}
#define POSE(first)                                          \
  {.position = {.x = first, .y = first + 1, .z = first + 2}, \
   .orientation = {.x = first + 3, .y = first + 4, .z = first + 5, .w = first + 6}}
#define COVARIANCE(first) {[0] = first, [7] = first + 1, [34] = first + 2, [35] = first + 3}
#define TWIST(first)                                       \
  {.linear = {.x = first, .y = first + 1, .z = first + 2}, \
   .angular = {.x = first + 3, .y = first + 4, .z = first + 5}}

static geometry_msgs_msg_dds__Twist_ twist = TWIST(0.5);
static geometry_msgs_msg_dds__TwistStamped_ twist_stamped = {.header = HEADER("base"),
                                                             .twist = TWIST(-2.5)};
static rosgraph_msgs_msg_dds__Clock_ clock_now = {.clock = {.sec = 12, .nanosec = 345678901}};
static geometry_msgs_msg_dds__PoseStamped_ pose_stamped = {.header = HEADER("map"),
                                                           .pose = POSE(1.25)};
static geometry_msgs_msg_dds__PoseWithCovarianceStamped_ pose_with_covariance = {
    .header = HEADER("mapp"), .pose = {.pose = POSE(-3.5), .covariance = COVARIANCE(0.125)}};
static nav_msgs_msg_dds__Odometry_ odometry = {
    .header = HEADER("odom"),
    .child_frame_id = "base_link",
    .pose = {.pose = POSE(10.0), .covariance = COVARIANCE(20.0)},
    .twist = {.twist = TWIST(30.0), .covariance = COVARIANCE(40.0)}};

static geometry_msgs_msg_dds__PoseArray_ pose_array = {
    HEADER("map"), LIST(geometry_msgs_msg_dds__Pose_, POSE(1.0), POSE(2.0))};
static nav2_msgs_msg_dds__ParticleCloud_ particles = {
    HEADER("map"), LIST(nav2_msgs_msg_dds__Particle_, {.pose = POSE(1.0), .weight = 0.75},
                        {.pose = POSE(2.0), .weight = 0.25})};
static tf2_msgs_msg_dds__TFMessage_ transforms = {
    LIST(geometry_msgs_msg_dds__TransformStamped_,
         {.header = HEADER("odom"),
          .child_frame_id = "base_link",
          .transform = {.translation = {1, 2, 3}, .rotation = {4, 5, 6, 7}}},
         {.header = HEADER("map"),
          .child_frame_id = "odom",
          .transform = {.translation = {8, 9, 10}, .rotation = {11, 12, 13, 14}}})};
static nav_msgs_msg_dds__OccupancyGrid_ map = {.header = HEADER("map"),
                                               .info = {.map_load_time = {.sec = 7, .nanosec = 8},
                                                        .resolution = 0.05f,
                                                        .width = 3,
                                                        .height = 1,
                                                        .origin = POSE(-1.0)},
                                               .data = LIST(int8_t, -1, 0, 100)};
static sensor_msgs_msg_dds__LaserScan_ scan = {.header = HEADER("laser"),
                                               .angle_min = -1.5f,
                                               .angle_max = 1.5f,
                                               .angle_increment = 0.25f,
                                               .time_increment = 0.125f,
                                               .scan_time = 0.0625f,
                                               .range_min = 0.1f,
                                               .range_max = 8.0f,
                                               .ranges = LIST(float, 1.0f, 2.5f, 3.0f),
                                               .intensities = LIST(float, 7.0f)};
static sensor_msgs_msg_dds__Range_ range = {.header = HEADER("sonar"),
                                            .radiation_type = 1,
                                            .field_of_view = 0.5f,
                                            .min_range = 0.25f,
                                            .max_range = 4.0f,
                                            .range = 2.0f,
                                            .variance = 0.0f};
static sensor_msgs_msg_dds__Image_ image = {.header = HEADER("camera"),
                                            .height = 2,
                                            .width = 3,
                                            .encoding = "mono8",
                                            .is_bigendian = 1,
                                            .step = 4,
                                            .data = LIST(uint8_t, 9, 8, 7, 255, 1)};
static sensor_msgs_msg_dds__Imu_ imu = {.header = HEADER("imu"),
                                        .orientation = {.x = 1, .y = 2, .z = 3, .w = 4},
                                        .orientation_covariance = {[0] = 5, [8] = 6},
                                        .angular_velocity = {.x = 7, .y = 8, .z = 9},
                                        .angular_velocity_covariance = {[0] = 10, [8] = 11},
                                        .linear_acceleration = {.x = 12, .y = 13, .z = 14},
                                        .linear_acceleration_covariance = {[0] = 15, [8] = 16}};
static sensor_msgs_msg_dds__PointCloud2_ cloud = {
    .header = HEADER("radar"),
    .height = 1,
    .width = 2,
    .fields = LIST(sensor_msgs_msg_dds__PointField_,
                   {.name = "x", .offset = 0, .datatype = 7, .count = 1},
                   {.name = "number", .offset = 4, .datatype = 6, .count = 2}),
    .is_bigendian = true,
    .point_step = 8,
    .row_step = 16,
    .data = LIST(uint8_t, 1, 2, 3),
    .is_dense = false};
static diagnostic_msgs_msg_dds__DiagnosticArray_ diagnostics = {
    .header = HEADER(""),
    .status =
        LIST(diagnostic_msgs_msg_dds__DiagnosticStatus_,
             {.level = 1,
              .name = "localization",
              .message = "uncertain",
              .hardware_id = "none",
              .values = LIST(diagnostic_msgs_msg_dds__KeyValue_, {"quality", "0.5"}, {"k", "v"})})};
static std_msgs_msg_dds__UInt32MultiArray_ words = {
    .layout = {.dim = LIST(std_msgs_msg_dds__MultiArrayDimension_,
                           {.label = "row", .size = 2, .stride = 4}),
               .data_offset = 5},
    .data = LIST(uint32_t, 7, 4294967295u)};

static std_msgs_msg_dds__String_ text = {.data = "ground"};
static nav2_msgs_srv_dds__LoadMap_Request_ load_map = {.map_url = "/maps/first.yaml"};
static nav2_msgs_srv_dds__LoadMap_Response_ loaded_map = {
    .grid = {.header = HEADER("map"),
             .info = {.map_load_time = {.sec = 7, .nanosec = 8},
                      .resolution = 0.05f,
                      .width = 3,
                      .height = 1,
                      .origin = POSE(-1.0)},
             .data = LIST(int8_t, -1, 0, 100)},
    .result = 3};

typedef struct {
  const char* name;
  const dds_topic_descriptor_t* type;
  const void* message;
  dds_entity_t from, to, echo;
} Type;

static Type types[] = {
    {"Twist", &geometry_msgs_msg_dds__Twist__desc, &twist, 0, 0, 0},
    {"TwistStamped", &geometry_msgs_msg_dds__TwistStamped__desc, &twist_stamped, 0, 0, 0},
    {"Clock", &rosgraph_msgs_msg_dds__Clock__desc, &clock_now, 0, 0, 0},
    {"PoseStamped", &geometry_msgs_msg_dds__PoseStamped__desc, &pose_stamped, 0, 0, 0},
    {"PoseWithCovarianceStamped", &geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc,
     &pose_with_covariance, 0, 0, 0},
    {"Odometry", &nav_msgs_msg_dds__Odometry__desc, &odometry, 0, 0, 0},
    {"PoseArray", &geometry_msgs_msg_dds__PoseArray__desc, &pose_array, 0, 0, 0},
    {"ParticleCloud", &nav2_msgs_msg_dds__ParticleCloud__desc, &particles, 0, 0, 0},
    {"TFMessage", &tf2_msgs_msg_dds__TFMessage__desc, &transforms, 0, 0, 0},
    {"OccupancyGrid", &nav_msgs_msg_dds__OccupancyGrid__desc, &map, 0, 0, 0},
    {"LaserScan", &sensor_msgs_msg_dds__LaserScan__desc, &scan, 0, 0, 0},
    {"Range", &sensor_msgs_msg_dds__Range__desc, &range, 0, 0, 0},
    {"Image", &sensor_msgs_msg_dds__Image__desc, &image, 0, 0, 0},
    {"Imu", &sensor_msgs_msg_dds__Imu__desc, &imu, 0, 0, 0},
    {"PointCloud2", &sensor_msgs_msg_dds__PointCloud2__desc, &cloud, 0, 0, 0},
    {"DiagnosticArray", &diagnostic_msgs_msg_dds__DiagnosticArray__desc, &diagnostics, 0, 0, 0},
    {"String", &std_msgs_msg_dds__String__desc, &text, 0, 0, 0},
    {"LoadMap_Request", &nav2_msgs_srv_dds__LoadMap_Request__desc, &load_map, 0, 0, 0},
    {"LoadMap_Response", &nav2_msgs_srv_dds__LoadMap_Response__desc, &loaded_map, 0, 0, 0},
    {"UInt32MultiArray", &std_msgs_msg_dds__UInt32MultiArray__desc, &words, 0, 0, 0},
};
enum { kTypes = sizeof types / sizeof types[0] };

static void write_all(dds_entity_t participant) {
  for (int i = 0; i < kTypes; ++i) {
    char name[128];
    Type* one = &types[i];
    snprintf(name, sizeof name, "rt/from_cyclone/%s", one->name);
    one->from = ros_writer(participant, name, one->type, 1);
    snprintf(name, sizeof name, "rt/to_cyclone/%s", one->name);
    one->to = ros_reader(participant, name, one->type, 1, 1);
    snprintf(name, sizeof name, "rt/echo/%s", one->name);
    one->echo = ros_writer(participant, name, one->type, 1);
    must(dds_write(one->from, one->message), one->name);
  }
}

static void echo(const Type* one) {
  void* sample = NULL;
  dds_sample_info_t info;
  if (dds_take(one->to, &sample, &info, 1, 1) <= 0) return;
  if (info.valid_data) must(dds_write(one->echo, sample), one->name);
  dds_return_loan(one->to, &sample, 1);
}

static void run(int domain) {
  dds_entity_t participant = dds_create_participant((dds_domainid_t)domain, NULL, NULL);
  must(participant, "participant");
  write_all(participant);
  char byte;
  fcntl(STDIN_FILENO, F_SETFL, O_NONBLOCK);
  while (read(STDIN_FILENO, &byte, 1) != 0) {
    for (int i = 0; i < kTypes; ++i) echo(&types[i]);
    dds_sleepfor(DDS_MSECS(5));
  }
  dds_delete(participant);
}

int main(int argc, char** argv) {
  if (argc != 2) return fprintf(stderr, "usage: cyclone_types DOMAIN\n"), 2;
  run(atoi(argv[1]));
  return 0;
}
