#ifndef ORTUNG_CLIENT_H
#define ORTUNG_CLIENT_H
/* A robot on a server's field, for C and for every language that can call C.
 *
 * Readings are words: unsigned numbers whose meaning docs/protocol.md and `DESCRIBE robot` tell; a
 * range of 1234 is 1.234 m. All functions may be called from any thread, but ortung_disconnect()
 * is the last. Functions that return int return 1 for success, 0 otherwise; ortung_trouble() then
 * says why. Texts end in a zero byte. NULL is an error like any other where it is not permitted.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define ORTUNG_C_API __attribute__((visibility("default")))
#else
#define ORTUNG_C_API
#endif

typedef struct ortung_robot ortung_robot;

/* Connects and puts a robot on the field.
 * robot_file: configuration of the robot (TOML); name: of client and robot; token: or NULL
 * cycle_s: time between two updates [s], 0: by ortung_update() or ortung_next() only
 * error: NULL, or where the reason of a failure goes, cut to error_size bytes with its end
 * Returns NULL on failure. */
ORTUNG_C_API ortung_robot* ortung_connect(const char* host, uint16_t port, const char* robot_file,
                                          const char* name, const char* token, double cycle_s,
                                          char* error, size_t error_size);
/* Does not wait for the server, whatever that does. NULL: nothing happens. */
ORTUNG_C_API void ortung_disconnect(ortung_robot* robot);

/* Velocities: [m/s] and [rad/s]. */
ORTUNG_C_API int ortung_set_velocity(ortung_robot* robot, double translational, double rotational);
/* The command vector of the robot's drive. */
ORTUNG_C_API int ortung_set_motion(ortung_robot* robot, const double* command, size_t count);
/* state: its name, or its number from 0 */
ORTUNG_C_API int ortung_set_manipulator(ortung_robot* robot, const char* manipulator,
                                        const char* state);

/* The robot's parameters, as the server says them; 0 where it does not. Results may be NULL.
 * Greatest velocities: [m/s] and [rad/s]. */
ORTUNG_C_API int ortung_max_velocity(ortung_robot* robot, double* translational,
                                     double* rotational);
/* Where the sensor of the first feature that matches is on the robot: [m], [m], [rad]. */
ORTUNG_C_API int ortung_mount(ortung_robot* robot, const char* feature, double* x, double* y,
                              double* theta);

ORTUNG_C_API int ortung_update(ortung_robot* robot);
/* Lockstep: lets the world go on for so many cycles. */
ORTUNG_C_API int ortung_next(ortung_robot* robot, uint64_t cycles);
/* Waits until there are newer readings; 0 if there are none after timeout_s. 0 or less does not
 * wait; infinity is permitted. */
ORTUNG_C_API int ortung_wait_for_update(ortung_robot* robot, double timeout_s);

/* Newest reading of the first feature that matches "model/type/feature" (* for any).
 * words: room for capacity words, as many as fit are written, NULL if capacity is 0; stamp: [us],
 * may be NULL Returns the number of words of the reading, or -1 if there is no reading yet or no
 * feature. */
ORTUNG_C_API long ortung_read(ortung_robot* robot, const char* feature, uint32_t* words,
                              size_t capacity, int64_t* stamp);

ORTUNG_C_API int ortung_is_connected(ortung_robot* robot);
/* What went wrong last, or "", cut to size bytes with its end. */
ORTUNG_C_API void ortung_trouble(ortung_robot* robot, char* text, size_t size);

#ifdef __cplusplus
}
#endif
#endif
