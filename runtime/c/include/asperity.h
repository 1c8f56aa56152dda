/* Asperity for C: docs/c.md has the rules and a complete program.
 * Generated: cargo run --manifest-path runtime/c/header/Cargo.toml */

#ifndef ASPERITY_H
#define ASPERITY_H

#include <stddef.h>
#include <stdint.h>

// `AsperityConfig::surface`: the half-space below a plane through `surface_point_m` with
// the outward normal `surface_normal`.
#define ASPERITY_SURFACE_PLANE 0

// `AsperityConfig::surface`: a ball of `surface_radius_m` around `surface_point_m`.
#define ASPERITY_SURFACE_SPHERE 1

// `AsperityConfig::surface`: a box around `surface_point_m`, edges along the axes, half
// as long as `surface_half_extents_m` says.
#define ASPERITY_SURFACE_BOX 2

// `AsperityConfig::vibration_axis`: along the motion.
#define ASPERITY_VIBRATION_TANGENT 0

// `AsperityConfig::vibration_axis`: across it.
#define ASPERITY_VIBRATION_BINORMAL 1

// Size of a buffer for the name of any texture and its terminating null, bytes.
#define ASPERITY_NAME_SIZE 65

// Alignment of the memory of every object, bytes.
#define ASPERITY_ALIGNMENT 64

// Size of the memory of an `AsperityTexture`, bytes.
#define ASPERITY_TEXTURE_SIZE 65536

// Size of the memory of an `AsperityRenderer`, bytes.
#define ASPERITY_RENDERER_SIZE 1024

// Size of the memory of an `AsperityState`, bytes.
#define ASPERITY_STATE_SIZE 2048

// Size of `AsperityError::message`, bytes.
#define ASPERITY_MESSAGE_SIZE 252

// The stylus is inside the surface.
#define ASPERITY_FLAG_CONTACT 1

// A tap transient started.
#define ASPERITY_FLAG_TAP_STARTED 2

// A tap transient is under way.
#define ASPERITY_FLAG_TAP_ACTIVE 4

// Speed or force lie outside the grid.
#define ASPERITY_FLAG_OUTSIDE_GRID 8

// The force was cut to the device's peak.
#define ASPERITY_FLAG_PEAK_LIMITED 16

// The force was held back by the slew limit.
#define ASPERITY_FLAG_SLEW_LIMITED 32

// A bad sample; the last good one was held.
#define ASPERITY_FLAG_HELD_SAMPLE 64

// The safe state: the force goes to zero.
#define ASPERITY_FLAG_SAFE_STATE 128

// The force comes back after a fault.
#define ASPERITY_FLAG_RAMPING 256

// The vibration reached its bound.
#define ASPERITY_FLAG_VIB_CLAMPED 512

// Result of a call.
enum AsperityStatus
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Success.
  ASPERITY_STATUS_OK = 0,
  // A required pointer is null.
  ASPERITY_STATUS_NULL_POINTER = 1,
  // The memory is too small or misaligned.
  ASPERITY_STATUS_MEMORY = 2,
  // A pointer does not lead to an initialised object of the right kind.
  ASPERITY_STATUS_NOT_INITIALISED = 3,
  // The bytes are not a valid library or asset.
  ASPERITY_STATUS_FORMAT = 4,
  // The library has no such texture.
  ASPERITY_STATUS_NO_SUCH_TEXTURE = 5,
  // The texture is too large for a slot.
  ASPERITY_STATUS_CAPACITY = 6,
  // The texture cannot be used at this servo rate, or none was loaded.
  ASPERITY_STATUS_RATE = 7,
  // A field of the configuration is out of its range.
  ASPERITY_STATUS_CONFIG = 8,
  // A name is not UTF-8.
  ASPERITY_STATUS_TEXT = 9,
  // A panic was caught, which is a defect of this library.
  ASPERITY_STATUS_INTERNAL = 10,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum AsperityStatus AsperityStatus;
#else
typedef int32_t AsperityStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A checked configuration; it serves any number of states and textures.
typedef struct AsperityRenderer AsperityRenderer;

// State of one stylus. One thread at a time may use it.
typedef struct AsperityState AsperityState;

// A slot for any texture of the format. It serves any number of states: loading writes to
// it, a tick only reads it.
typedef struct AsperityTexture AsperityTexture;

// Configuration of a renderer. Start from `asperity_config_default`.
typedef struct AsperityConfig {
  // Servo rate, Hz; one tick is one period.
  float servo_rate_hz;
  // Cut-off of the velocity filter, Hz.
  float velocity_cutoff_hz;
  // Cut-off of the normal velocity that the wall's damping sees, Hz.
  float normal_cutoff_hz;
  // One of `ASPERITY_SURFACE_*`.
  uint32_t surface;
  // A point of the plane, or the centre, m.
  float surface_point_m[3];
  // Plane only: outward normal, any length above 0.
  float surface_normal[3];
  // Sphere only: radius, m.
  float surface_radius_m;
  // Box only: half the edge lengths, m.
  float surface_half_extents_m[3];
  // One of `ASPERITY_VIBRATION_*`.
  uint32_t vibration_axis;
  // Largest force, N.
  float peak_n;
  // Largest change of force, N/s.
  float slew_n_s;
  // Slowest impact that plays a transient, m/s.
  float tap_min_speed_m_s;
  // Distance from the surface that re-arms the tap detector, m.
  float tap_rearm_m;
  // Stiffness of the bristle, N/m.
  float friction_stiffness_n_m;
  // Dead zone of the bristle, m.
  float friction_dead_zone_m;
  // Speed at which the bristle's deflection leaks, m/s.
  float friction_leak_speed_m_s;
  // Viscous damping of the mechanism alone, without a hand, N·s/m.
  float mechanics_damping_n_s_m;
  // Coulomb friction of the mechanism, N.
  float mechanics_coulomb_n;
  // Largest speed at which the Coulomb friction counts as damping, m/s.
  float mechanics_fastest_m_s;
  // Size of one count of position, m; 0 if positions are not quantised.
  float mechanics_position_step_m;
  // Whole periods between a force and its effect, beyond the one for which it is held.
  uint32_t mechanics_delay_ticks;
  // Number of bad samples in a row for which the last good one is held, at most 2.
  uint32_t hold_ticks;
  // Duration of the ramp after a fault, s.
  float ramp_s;
  // Time constant with which model parameters follow speed and force, s.
  float parameter_time_constant_s;
} AsperityConfig;

// A status and its message, which names the field, its value and the rule where it can.
typedef struct AsperityError {
  // What the function returned.
  AsperityStatus status;
  // UTF-8 that ends with a null; truncated where it is too long.
  char message[ASPERITY_MESSAGE_SIZE];
} AsperityError;

// Counts of events since the state was made. They saturate.
typedef struct AsperityCounters {
  // Ticks.
  uint32_t ticks;
  // Bad samples: stale, not finite, out of reach.
  uint32_t bad_samples;
  // Servo periods that the caller reported as missed.
  uint32_t missed_ticks;
  // Times the safe state was entered.
  uint32_t faults;
  // Taps.
  uint32_t taps;
  // Ticks whose force was cut to the peak.
  uint32_t peak_limited;
  // Ticks whose force was held back by the slew limit.
  uint32_t slew_limited;
} AsperityCounters;

// Device sample of one servo period.
typedef struct AsperitySample {
  // Stylus position in the world frame, m. Anything not finite, or beyond 10 km, is a bad
  // sample.
  float position_m[3];
  // Servo periods since the sample before: 1 in a healthy loop, more after missed
  // periods, 0 when the device had nothing new.
  uint32_t elapsed_ticks;
} AsperitySample;

// Output of a tick.
typedef struct AsperityOutput {
  // Force on the hand in the world frame, N; finite, within peak and slew.
  float force_n[3];
  // Depth inside the surface, m; 0 outside.
  float depth_m;
  // Estimated tangential speed, mm/s.
  float speed_mm_s;
  // Normal force of the spring, k·δ, N.
  float normal_force_n;
  // Vibration before device gain, m/s².
  float vib_m_s2;
  // Tap force along the normal, N.
  float tap_n;
  // Magnitude of the friction force, N.
  float friction_n;
  // Events: bits `ASPERITY_FLAG_*`.
  uint32_t flags;
} AsperityOutput;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The version of the library, e.g. `0.1.0`.
const char *asperity_version(void);

// Fills in the defaults: a 3D Systems Touch at 1 kHz over the plane z = 0.
//
// # Safety
// `config` is null or valid for writes.
AsperityStatus asperity_config_default(struct AsperityConfig *config);

// Counts the textures of a library. Only the index is checked, so the beginning of a file
// is enough.
//
// # Safety
// `library` is null or `len` readable bytes; `count` and `error` are null or valid for
// writes.
AsperityStatus asperity_library_count(const uint8_t *library,
                                      size_t len,
                                      size_t *count,
                                      struct AsperityError *error);

// Finds the index of the texture called `texture`.
//
// # Safety
// `library` is null or `len` readable bytes, `texture` null or a text that ends with a
// null; `index` and `error` are null or valid for writes.
AsperityStatus asperity_library_find(const uint8_t *library,
                                     size_t len,
                                     const char *texture,
                                     size_t *index,
                                     struct AsperityError *error);

// Copies the name of the texture at `index`, in order of names, into `text` of `size`
// bytes; `ASPERITY_NAME_SIZE` are always enough.
//
// # Safety
// `library` is null or `len` readable bytes; `text` is null or `size` writable bytes;
// `error` is null or valid for writes.
AsperityStatus asperity_library_name(const uint8_t *library,
                                     size_t len,
                                     size_t index,
                                     char *text,
                                     size_t size,
                                     struct AsperityError *error);

// Checks a configuration and makes a renderer in `memory` of at least
// `ASPERITY_RENDERER_SIZE` bytes.
//
// # Safety
// `memory` is null or `size` bytes that nothing else uses; `config` is null or readable;
// `renderer` and `error` are null or valid for writes.
AsperityStatus asperity_renderer_init(void *memory,
                                      size_t size,
                                      const struct AsperityConfig *config,
                                      struct AsperityRenderer **renderer,
                                      struct AsperityError *error);

// Makes a state at rest, without force, in `memory` of at least `ASPERITY_STATE_SIZE`
// bytes. `seed` selects the noise of the excitation.
//
// # Safety
// `memory` is null or `size` bytes that nothing else uses; `state` is null or valid for
// writes.
AsperityStatus asperity_state_init(void *memory,
                                   size_t size,
                                   uint64_t seed,
                                   struct AsperityState **state);

// Reads the counters of a state.
//
// # Safety
// `state` is null or an initialised state that nobody writes during the call; `counters`
// is null or valid for writes.
AsperityStatus asperity_state_counters(const struct AsperityState *state,
                                       struct AsperityCounters *counters);

// Text of a status. Never null; an unknown number has a text, too.
const char *asperity_error_text(int32_t status);

// Makes an empty slot in `memory` of at least `ASPERITY_TEXTURE_SIZE` bytes.
//
// # Safety
// `memory` is null or `size` bytes that nothing else uses; `texture` is null or valid for
// writes.
AsperityStatus asperity_texture_init(void *memory, size_t size, struct AsperityTexture **texture);

// Loads one asset (`.asp`) for a servo rate. If the asset is refused, the slot keeps the
// texture it had. The bytes are not needed afterwards.
//
// # Safety
// `texture` is null or an initialised slot that nobody else uses during the call; `asset`
// is null or `len` readable bytes; `error` is null or valid for writes.
AsperityStatus asperity_texture_load_asset(struct AsperityTexture *texture,
                                           const uint8_t *asset,
                                           size_t len,
                                           float servo_rate_hz,
                                           struct AsperityError *error);

// Loads the texture at `index` of a whole library (`.aspl`); its other textures are not
// read.
//
// # Safety
// As `asperity_texture_load_asset`.
AsperityStatus asperity_texture_load_index(struct AsperityTexture *texture,
                                           const uint8_t *library,
                                           size_t len,
                                           size_t index,
                                           float servo_rate_hz,
                                           struct AsperityError *error);

// Loads the texture called `texture_name` of a whole library (`.aspl`).
//
// # Safety
// As `asperity_texture_load_asset`; `texture_name` is null or ends with a null.
AsperityStatus asperity_texture_load_name(struct AsperityTexture *texture,
                                          const uint8_t *library,
                                          size_t len,
                                          const char *texture_name,
                                          float servo_rate_hz,
                                          struct AsperityError *error);

// One servo period: a device sample in, a limited force out. If the pointers are right and
// the texture was loaded for the renderer's rate, it succeeds for every sample. Otherwise
// the output, where there is one, is zero force and the safe state.
//
// # Safety
// `renderer`, `texture` and `state` are null or initialised objects; nobody writes to the
// first two during the call, nobody else uses the third. `sample` is null or readable,
// `output` null or valid for writes.
AsperityStatus asperity_tick(const struct AsperityRenderer *renderer,
                             const struct AsperityTexture *texture,
                             struct AsperityState *state,
                             const struct AsperitySample *sample,
                             struct AsperityOutput *output);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* ASPERITY_H */
