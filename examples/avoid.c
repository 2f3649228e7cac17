/* A robot that drives about and turns away from what is in front of it, in C.
 *
 *   avoid_c HOST PORT ROBOT_FILE [SECONDS]
 *
 * The server: ortung sim maps/fields/arena.toml --listen 7777
 */
#include <stdio.h>
#include <stdlib.h>

#include "ortung/client/ortung_client.h"

enum { kBeams = 180 };

/* The nearest thing within 30 degrees of straight ahead [mm]; words of a scan are ranges. */
static uint32_t nearest(const uint32_t* ranges) {
  uint32_t least = 8000;
  for (int i = kBeams / 2 - 30; i < kBeams / 2 + 30; ++i)
    if (ranges[i] > 0 && ranges[i] < least) least = ranges[i]; /* 0: the beam saw nothing valid */
  return least;
}

int main(int argc, char** argv) {
  if (argc < 4) {
    fprintf(stderr, "avoid_c HOST PORT ROBOT_FILE [SECONDS]\n");
    return 2;
  }
  const double seconds = argc > 4 ? atof(argv[4]) : 10.0;
  char text[256];
  ortung_robot* robot = ortung_connect(argv[1], (uint16_t)atoi(argv[2]), argv[3], "avoid-c",
                                       getenv("ORTUNG_TOKEN"), 0.1, text, sizeof text);
  if (robot == NULL) {
    fprintf(stderr, "%s\n", text);
    return 1;
  }
  for (int cycle = 0; cycle < seconds / 0.1; ++cycle) {
    uint32_t ranges[kBeams];
    int64_t stamp;
    ortung_wait_for_update(robot, 1.0);
    if (ortung_read(robot, "*/LRF/*", ranges, kBeams, &stamp) != kBeams) continue;
    const uint32_t ahead = nearest(ranges);
    if (!ortung_set_velocity(robot, ahead > 800 ? 0.5 : 0.0, ahead > 800 ? 0.0 : 0.8)) {
      ortung_trouble(robot, text, sizeof text);
      fprintf(stderr, "%s\n", text);
    }
    printf("%lld us: %u mm ahead\n", (long long)stamp, (unsigned)ahead);
  }
  ortung_disconnect(robot);
  return 0;
}
