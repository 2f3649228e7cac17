/* A robot that drives about and turns away from obstacles ahead, in C.
 *
 *   avoid_c HOST PORT ROBOT_FILE [SECONDS]
 *
 * The server: ortung sim maps/fields/arena.toml --listen 7777
 */
#include <stdio.h>
#include <stdlib.h>

#include "ortung/client/ortung_client.h"

enum { kMostBeams = 1024 };

/* Returns the least range in the middle third of the scan [mm]; words of a scan are ranges. */
static uint32_t nearest_ahead(const uint32_t* ranges, long beams) {
  uint32_t nearest = 8000;
  for (long i = beams / 3; i < beams - beams / 3; ++i)
    if (ranges[i] > 0 && ranges[i] < nearest) nearest = ranges[i]; /* 0: invalid */
  return nearest;
}

int main(int argc, char** argv) {
  if (argc < 4) {
    fprintf(stderr, "avoid_c HOST PORT ROBOT_FILE [SECONDS]\n");
    return 2;
  }
  const int port = atoi(argv[2]);
  const double seconds = argc > 4 ? atof(argv[4]) : 10.0;
  if (port < 1 || port > 65535 || !(seconds > 0.0)) {
    fprintf(stderr, "PORT must be from 1 to 65535, SECONDS more than 0\n");
    return 2;
  }
  char text[256];
  ortung_robot* robot = ortung_connect(argv[1], (uint16_t)port, argv[3], "avoid-c",
                                       getenv("ORTUNG_TOKEN"), 0.1, text, sizeof text);
  if (robot == NULL) {
    fprintf(stderr, "%s\n", text);
    return 1;
  }
  for (int cycle = 0; cycle < seconds / 0.1; ++cycle) {
    uint32_t ranges[kMostBeams];
    int64_t stamp;
    if (!ortung_wait_for_update(robot, 5.0)) {
      ortung_trouble(robot, text, sizeof text);
      fprintf(stderr, "no update: %s\n", text);
      ortung_disconnect(robot);
      return 1;
    }
    const long beams = ortung_read(robot, "*/LRF/*", ranges, kMostBeams, &stamp);
    if (beams < 1 || beams > kMostBeams) continue; /* there is no reading yet */
    const uint32_t ahead = nearest_ahead(ranges, beams);
    if (!ortung_set_velocity(robot, ahead > 800 ? 0.5 : 0.0, ahead > 800 ? 0.0 : 0.8)) {
      ortung_trouble(robot, text, sizeof text);
      fprintf(stderr, "%s\n", text);
    }
    printf("%lld us: %u mm ahead\n", (long long)stamp, (unsigned)ahead);
  }
  ortung_disconnect(robot);
  return 0;
}
