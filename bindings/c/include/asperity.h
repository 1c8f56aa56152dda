/* Asperity for C: docs/c.md has the rules and a complete program.
 * Generated: cargo run --manifest-path bindings/c/header/Cargo.toml */

#ifndef ASPERITY_H
#define ASPERITY_H

#include <stddef.h>
#include <stdint.h>

/* Before the memory of an object: `static ASPERITY_ALIGNED unsigned char memory[SIZE];` */
#if defined(__GNUC__)
#define ASPERITY_ALIGNED __attribute__((aligned(ASPERITY_ALIGNMENT)))
#elif defined(_MSC_VER)
#define ASPERITY_ALIGNED __declspec(align(64))
#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L
#define ASPERITY_ALIGNED _Alignas(ASPERITY_ALIGNMENT)
#endif

/* Where a struct that has a `struct_size` begins. */
#define ASPERITY_ERROR_INIT {(uint32_t)sizeof(AsperityError), ASPERITY_STATUS_OK, {0}}
#define ASPERITY_SAMPLE_INIT {(uint32_t)sizeof(AsperitySample), {0.0f, 0.0f, 0.0f}, 1}
#define ASPERITY_OUTPUT_INIT \
  {(uint32_t)sizeof(AsperityOutput), {0.0f, 0.0f, 0.0f}, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, \
   ASPERITY_NO_SURFACE}
#define ASPERITY_COUNTERS_INIT {(uint32_t)sizeof(AsperityCounters), 0, 0, 0, 0, 0, 0, 0}
#define ASPERITY_COUPLING_INIT \
  {(uint32_t)sizeof(AsperityCoupling), 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f}

// `AsperityConfig::arithmetic`: floats, which need an FPU to be fast.
#define ASPERITY_ARITHMETIC_FLOAT 0

// `AsperityConfig::arithmetic`: fixed point, for processors without an FPU. Samples and outputs
// stay floats, which are converted.
#define ASPERITY_ARITHMETIC_FIXED 1

// Capacity of a slot: 48 vertices, 64 triangles, order 8 without an MA part, 520 tap samples. That
// is a material that was compiled with `--fidelity 8`, at 1 kHz.
#define ASPERITY_CAPACITY_SMALL 0

// Capacity of a slot: 48 vertices, 64 triangles, order 24 without an MA part, 520 tap samples. That
// is a material of a prompt, at 1 kHz.
#define ASPERITY_CAPACITY_MEDIUM 1

// Capacity of a slot: every texture of the format, at servo rates up to 10 kHz.
#define ASPERITY_CAPACITY_LARGE 2

// Size of the memory of an `AsperityTexture` of `ASPERITY_CAPACITY_SMALL`, bytes.
#define ASPERITY_TEXTURE_SIZE_SMALL 7168

// Size of the memory of an `AsperityTexture` of `ASPERITY_CAPACITY_MEDIUM`, bytes.
#define ASPERITY_TEXTURE_SIZE_MEDIUM 10240

// Size of the memory of an `AsperityTexture` of `ASPERITY_CAPACITY_LARGE`, bytes.
#define ASPERITY_TEXTURE_SIZE_LARGE 40960

// `AsperityConfig::solid`: the half-space below a plane through `solid_point_m` with
// the outward normal `solid_normal`.
#define ASPERITY_SOLID_PLANE 0

// `AsperityConfig::solid`: a ball of `solid_radius_m` around `solid_point_m`.
#define ASPERITY_SOLID_SPHERE 1

// `AsperityConfig::solid`: a box around `solid_point_m`, edges along the axes, half
// as long as `solid_half_extents_m` says.
#define ASPERITY_SOLID_BOX 2

// `AsperityConfig::vibration_axis`: along the motion.
#define ASPERITY_VIBRATION_TANGENT 0

// `AsperityConfig::vibration_axis`: across it.
#define ASPERITY_VIBRATION_BINORMAL 1

// Size of the memory of an exchange without its slots, bytes. The slot that plays and each spare
// one add `ASPERITY_TEXTURE_SIZE_*`.
#define ASPERITY_EXCHANGE_SIZE 4096

// Largest number of spare slots.
#define ASPERITY_EXCHANGE_SPARE 3

// Size of a buffer for the name of any texture and its terminating null, bytes.
#define ASPERITY_NAME_SIZE 65

// Alignment of the memory of every object, bytes.
#define ASPERITY_ALIGNMENT 64

// Size of the memory of an `AsperityRecorder` without its records, bytes.
#define ASPERITY_RECORDER_SIZE 256

// Bytes of memory that a record takes in an `AsperityRecorder`.
#define ASPERITY_RECORDER_RECORD_SIZE 128

// Size of the memory of an `AsperityRenderer`, bytes.
#define ASPERITY_RENDERER_SIZE 1024

// Size of the memory of an `AsperityScene` without its textures, bytes. Each texture of the
// library adds `ASPERITY_TEXTURE_SIZE_*`.
#define ASPERITY_SCENE_SIZE 8192

// Size of the memory of an `AsperitySceneState`, bytes.
#define ASPERITY_SCENE_STATE_SIZE 2048

// Size of the memory of an `AsperityState`, bytes.
#define ASPERITY_STATE_SIZE 2048

// Size of `AsperityError::message`, bytes.
#define ASPERITY_MESSAGE_SIZE 248

// `AsperityOutput::surface` where no surface of a scene is in contact.
#define ASPERITY_NO_SURFACE 4294967295

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

// Major version of the header. Programs of one major version run with every later library of it.
#define ASPERITY_VERSION_MAJOR 0

// Minor version of the header.
#define ASPERITY_VERSION_MINOR 1

// Patch level of the header.
#define ASPERITY_VERSION_PATCH 0

// Version of the header as one number: 10000·major + 100·minor + patch.
// `asperity_version_number` has that of the library.
#define ASPERITY_VERSION 100

// Size of a buffer for any text that a function of this header writes, bytes.
#define ASPERITY_TEXT_SIZE 256

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
  // A pointer does not lead to an initialised object of the right kind, or leads to an exchange
  // or a scene that was copied.
  ASPERITY_STATUS_NOT_INITIALISED = 3,
  // The bytes are not a valid library or asset.
  ASPERITY_STATUS_FORMAT = 4,
  // The library has no such texture.
  ASPERITY_STATUS_NO_SUCH_TEXTURE = 5,
  // The texture is too large for a slot.
  ASPERITY_STATUS_CAPACITY = 6,
  // The texture cannot be used at this servo rate, or was loaded for another.
  ASPERITY_STATUS_RATE = 7,
  // A field of the configuration is out of its range.
  ASPERITY_STATUS_CONFIG = 8,
  // A name is not UTF-8.
  ASPERITY_STATUS_TEXT = 9,
  // A panic was caught, which is a defect of this library.
  ASPERITY_STATUS_INTERNAL = 10,
  // The `struct_size` of a struct is not that of any version, or the struct asks for something
  // that this version does not know.
  ASPERITY_STATUS_STRUCT_SIZE = 11,
  // A number is none of those that the header names, such as a capacity.
  ASPERITY_STATUS_ARGUMENT = 12,
  // Every spare slot of an exchange is on its way: try again some ticks later.
  ASPERITY_STATUS_BUSY = 13,
  // The library has textures but no surfaces.
  ASPERITY_STATUS_NO_SCENE = 14,
  // The processor is set to round otherwise than to nearest: forces would have other bits.
  ASPERITY_STATUS_ROUNDING = 15,
  // The slot holds no texture: none was loaded, or the last load was refused.
  ASPERITY_STATUS_NOT_LOADED = 16,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum AsperityStatus AsperityStatus;
#else
typedef int32_t AsperityStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A status and its message, which names the field, its value and the rule where it can. Begin with
// `ASPERITY_ERROR_INIT`.
typedef struct AsperityError {
  // `sizeof(AsperityError)`, from the caller.
  uint32_t struct_size;
  // Return value of the function.
  AsperityStatus status;
  // UTF-8 that ends with a null; truncated where it is too long.
  char message[ASPERITY_MESSAGE_SIZE];
} AsperityError;

// Configuration of a renderer. Start from `asperity_config_default`, which also sets `struct_size`.
typedef struct AsperityConfig {
  // `sizeof(AsperityConfig)`.
  uint32_t struct_size;
  // Servo rate, Hz; one tick is one period.
  float servo_rate_hz;
  // Cut-off of the velocity filter, Hz.
  float velocity_cutoff_hz;
  // Cut-off of the normal velocity that the wall's damping sees, Hz.
  float normal_cutoff_hz;
  // One of `ASPERITY_SOLID_*`.
  uint32_t solid;
  // A point of the plane, or the centre, m.
  float solid_point_m[3];
  // Plane only: outward normal, any length above 0.
  float solid_normal[3];
  // Sphere only: radius, m.
  float solid_radius_m;
  // Box only: half the edge lengths, m.
  float solid_half_extents_m[3];
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
  // One of `ASPERITY_ARITHMETIC_*`.
  uint32_t arithmetic;
  // Largest coordinate of a position, m, at most 1 in fixed point; beyond it a sample is bad. 1 in a
  // struct of an older header.
  float reach_m;
} AsperityConfig;

// Tag at the start of an object: its kind, arithmetic and capacity.
typedef uint32_t Tag;

// A checked configuration; it serves any number of states and textures.
typedef struct AsperityRenderer {
  Tag tag;
} AsperityRenderer;

// The half of an exchange that loads textures, outside of the servo loop. One thread at a time may
// use it, also while another one uses the player.
typedef struct AsperityPreparer {
  Tag tag;
} AsperityPreparer;

// The half of an exchange that the servo loop plays. One thread at a time may use it, also while
// another one uses the preparer.
typedef struct AsperityPlayer {
  Tag tag;
} AsperityPlayer;

// Device sample of one servo period. Set `struct_size`, or begin with `ASPERITY_SAMPLE_INIT`.
typedef struct AsperitySample {
  // `sizeof(AsperitySample)`, from the caller.
  uint32_t struct_size;
  // Stylus position in the world frame, m. Anything not finite, or beyond the
  // configuration's `reach_m`, is a bad sample.
  float position_m[3];
  // Servo periods since the sample before: 1 in a healthy loop, more after missed
  // periods, 0 when the device had nothing new.
  uint32_t elapsed_ticks;
} AsperitySample;

// Output of a tick. Set `struct_size` once, or begin with `ASPERITY_OUTPUT_INIT`.
typedef struct AsperityOutput {
  // `sizeof(AsperityOutput)`, from the caller.
  uint32_t struct_size;
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
  // Index in the scene of the surface in contact, `ASPERITY_NO_SURFACE` for none and outside of
  // scenes.
  uint32_t surface;
} AsperityOutput;

// Counts of events since the state was made. They saturate. Set `struct_size`, or begin with
// `ASPERITY_COUNTERS_INIT`.
typedef struct AsperityCounters {
  // `sizeof(AsperityCounters)`, from the caller.
  uint32_t struct_size;
  // Ticks.
  uint32_t ticks;
  // Bad samples: stale, not finite, out of reach.
  uint32_t bad_samples;
  // Servo periods that the caller reported as missed: overruns.
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

// A ring of records. One thread at a time may write, one may read meanwhile.
typedef struct AsperityRecorder {
  Tag tag;
} AsperityRecorder;

// Input and output of a tick.
typedef struct AsperityRecord {
  // Number of the write, from 0, lost ones included: a gap shows where records were lost.
  uint64_t tick;
  // `AsperitySample::position_m`.
  float position_m[3];
  // `AsperitySample::elapsed_ticks`.
  uint32_t elapsed_ticks;
  // `AsperityOutput::force_n`.
  float force_n[3];
  // `AsperityOutput::depth_m`.
  float depth_m;
  // `AsperityOutput::speed_mm_s`.
  float speed_mm_s;
  // `AsperityOutput::normal_force_n`.
  float normal_force_n;
  // `AsperityOutput::vib_m_s2`.
  float vib_m_s2;
  // `AsperityOutput::tap_n`.
  float tap_n;
  // `AsperityOutput::friction_n`.
  float friction_n;
  // `AsperityOutput::flags`.
  uint32_t flags;
  // `AsperityOutput::surface`.
  uint32_t surface;
  // 0.
  uint32_t reserved;
} AsperityRecord;

// The surfaces of a library and their textures. It serves any number of states; a tick only reads
// it.
typedef struct AsperityScene {
  Tag tag;
} AsperityScene;

// State of one stylus in a scene. One thread at a time may use it.
typedef struct AsperitySceneState {
  Tag tag;
} AsperitySceneState;

// State of one stylus on one texture. One thread at a time may use it.
typedef struct AsperityState {
  Tag tag;
} AsperityState;

// A slot for textures up to its capacity. It serves any number of states: loading writes to it, a
// tick only reads it.
typedef struct AsperityTexture {
  Tag tag;
} AsperityTexture;

// Coupling of a texture to the hand. Set `struct_size`, or begin with `ASPERITY_COUPLING_INIT`.
typedef struct AsperityCoupling {
  // `sizeof(AsperityCoupling)`, from the caller.
  uint32_t struct_size;
  // Stiffness of the wall, N/m, before the renderer lowers it to what the device can bear.
  float stiffness_n_m;
  // Damping of the wall, N·s/m.
  float damping_n_s_m;
  // Gain of the vibration, s²/m.
  float vib_s2_m;
  // Effective mass of a tap, kg.
  float effective_mass_kg;
  // Force that the gain of the vibration refers to, N.
  float f_max_n;
  // Coefficient of kinetic friction.
  float mu;
} AsperityCoupling;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The smallest `ASPERITY_CAPACITY_*` whose slots have room for an asset (`.asp`) at a servo rate.
// It does not depend on the arithmetic.
//
// # Safety
// `asset` is null or `len` readable bytes; `capacity` and `error` are null or valid for writes.
AsperityStatus asperity_asset_capacity(const uint8_t *asset,
                                       size_t len,
                                       float servo_rate_hz,
                                       uint32_t *capacity,
                                       struct AsperityError *error);

// The smallest `ASPERITY_CAPACITY_*` whose slots have room for every texture of a library
// (`.aspl`) at a servo rate.
//
// # Safety
// As `asperity_asset_capacity`.
AsperityStatus asperity_library_capacity(const uint8_t *library,
                                         size_t len,
                                         float servo_rate_hz,
                                         uint32_t *capacity,
                                         struct AsperityError *error);

// Fills in the defaults: a 3D Systems Touch at 1 kHz over the plane z = 0, in floats.
// `struct_size` is `sizeof(AsperityConfig)`.
//
// # Safety
// `config` is null or leads to `struct_size` writable bytes.
AsperityStatus asperity_config_default(struct AsperityConfig *config, size_t struct_size);

// Bytes of memory that `asperity_exchange_init` needs: `ASPERITY_EXCHANGE_SIZE` and
// `ASPERITY_TEXTURE_SIZE_*` for `spare + 1` slots.
//
// # Safety
// `size` is null or valid for writes.
AsperityStatus asperity_exchange_size(uint32_t capacity, uint32_t spare, size_t *size);

// Makes an exchange with an empty slot that plays and 1 to `ASPERITY_EXCHANGE_SPARE` spare ones of
// `capacity` (`ASPERITY_CAPACITY_*`), in `memory` of at least as many bytes as
// `asperity_exchange_size` says, for the servo rate and the arithmetic of a renderer. The memory
// must not be copied elsewhere: a copy is refused as not initialised. `seed` selects the noise of
// the excitation. Until a texture is loaded there is no force. One spare slot is enough; with two,
// a texture can be prepared while another one is on its way.
//
// # Safety
// `memory` is null or `size` bytes that nothing else uses; `renderer` is null or an initialised
// renderer; `preparer` and `player` are null or valid for writes.
AsperityStatus asperity_exchange_init(void *memory,
                                      size_t size,
                                      const struct AsperityRenderer *renderer,
                                      uint32_t capacity,
                                      uint32_t spare,
                                      uint64_t seed,
                                      struct AsperityPreparer **preparer,
                                      struct AsperityPlayer **player);

// Loads one asset (`.asp`) into a spare slot and sends it to the servo loop, which neither waits
// nor is waited for. Textures play in the order in which they were sent. If no slot is spare
// (`ASPERITY_STATUS_BUSY`), or the asset is refused, nothing is sent. The bytes are not needed
// afterwards.
//
// # Safety
// `preparer` is null or an initialised preparer that nobody else uses during the call; `asset` is
// null or `len` readable bytes; `error` is null or valid for writes.
AsperityStatus asperity_preparer_load_asset(struct AsperityPreparer *preparer,
                                            const uint8_t *asset,
                                            size_t len,
                                            struct AsperityError *error);

// `asperity_preparer_load_asset` for the texture at `index` of a whole library (`.aspl`).
//
// # Safety
// As `asperity_preparer_load_asset`.
AsperityStatus asperity_preparer_load_index(struct AsperityPreparer *preparer,
                                            const uint8_t *library,
                                            size_t len,
                                            size_t index,
                                            struct AsperityError *error);

// `asperity_preparer_load_asset` for the texture called `texture_name` of a whole library
// (`.aspl`).
//
// # Safety
// As `asperity_preparer_load_asset`; `texture_name` is null or ends with a null.
AsperityStatus asperity_preparer_load_name(struct AsperityPreparer *preparer,
                                           const uint8_t *library,
                                           size_t len,
                                           const char *texture_name,
                                           struct AsperityError *error);

// Renders one servo period of a player: takes the next texture, if one was sent and may begin, and
// then does what `asperity_tick` does.
//
// # Safety
// As `asperity_tick`; nobody else uses `player` during the call.
AsperityStatus asperity_player_tick(const struct AsperityRenderer *renderer,
                                    struct AsperityPlayer *player,
                                    const struct AsperitySample *sample,
                                    struct AsperityOutput *output);

// Reads the counters of a player, in the thread that plays it.
//
// # Safety
// `player` is null or an initialised player that nobody writes during the call; `counters` is null
// or valid for writes.
AsperityStatus asperity_player_counters(const struct AsperityPlayer *player,
                                        struct AsperityCounters *counters);

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

// Makes an empty ring in `memory`: `ASPERITY_RECORDER_SIZE` bytes, and
// `ASPERITY_RECORDER_RECORD_SIZE` for each record, at least one.
//
// # Safety
// `memory` is null or `size` bytes that nothing else uses; `recorder` is null or valid for writes.
AsperityStatus asperity_recorder_init(void *memory,
                                      size_t size,
                                      struct AsperityRecorder **recorder);

// Records a tick, in the thread of the servo loop. If the ring is full, the record is lost and
// counted. Never waits.
//
// # Safety
// `recorder` is null or an initialised ring to which nobody else writes during the call; `sample`
// and `output` are null or readable.
AsperityStatus asperity_recorder_write(struct AsperityRecorder *recorder,
                                       const struct AsperitySample *sample,
                                       const struct AsperityOutput *output);

// Takes up to `room` records out of the ring, the oldest first, in another thread than the
// writer's or in the same. `record_size` is `sizeof(AsperityRecord)`. `count` says how many were
// taken, `lost` how many were lost since the ring was made; its pointer may be null.
//
// # Safety
// `recorder` is null or an initialised ring from which nobody else reads during the call;
// `records` is null or has room for `room` records; `count` and `lost` are null or valid for
// writes.
AsperityStatus asperity_recorder_read(struct AsperityRecorder *recorder,
                                      struct AsperityRecord *records,
                                      size_t record_size,
                                      size_t room,
                                      size_t *count,
                                      uint32_t *lost);

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

// Bytes of memory that `asperity_scene_init` needs for a library (`.aspl`) in slots of `capacity`
// (`ASPERITY_CAPACITY_*`; `asperity_library_capacity` has the smallest).
//
// # Safety
// `library` is null or `len` readable bytes; `size` and `error` are null or valid for writes.
AsperityStatus asperity_scene_size(const uint8_t *library,
                                   size_t len,
                                   uint32_t capacity,
                                   size_t *size,
                                   struct AsperityError *error);

// Loads every surface and texture of a library (`.aspl`) that holds a scene, in `memory` of at
// least as many bytes as `asperity_scene_size` says, for the servo rate and the arithmetic of a
// renderer. The memory must not be copied elsewhere: a copy is refused as not initialised. The
// bytes are not needed afterwards. A library that is refused leaves no scene.
//
// # Safety
// `memory` is null or `size` bytes that nothing else uses; `renderer` is null or an initialised
// renderer; `library` is null or `len` readable bytes outside of `memory`; `scene` and `error` are
// null or valid for writes.
AsperityStatus asperity_scene_init(void *memory,
                                   size_t size,
                                   const struct AsperityRenderer *renderer,
                                   uint32_t capacity,
                                   const uint8_t *library,
                                   size_t len,
                                   struct AsperityScene **scene,
                                   struct AsperityError *error);

// Makes a state at rest, without force, in `memory` of at least `ASPERITY_SCENE_STATE_SIZE` bytes,
// for the arithmetic of a renderer. `seed` selects the noise of the excitation.
//
// # Safety
// As `asperity_state_init`.
AsperityStatus asperity_scene_state_init(void *memory,
                                         size_t size,
                                         const struct AsperityRenderer *renderer,
                                         uint64_t seed,
                                         struct AsperitySceneState **state);

// Reads the counters of a state in a scene.
//
// # Safety
// As `asperity_state_counters`.
AsperityStatus asperity_scene_state_counters(const struct AsperitySceneState *state,
                                             struct AsperityCounters *counters);

// Renders one servo period in a scene: as `asperity_tick`, on the touched surface instead of the
// solid of the configuration. `AsperityOutput::surface` says which one is in contact.
//
// # Safety
// As `asperity_tick`.
AsperityStatus asperity_scene_tick(const struct AsperityRenderer *renderer,
                                   const struct AsperityScene *scene,
                                   struct AsperitySceneState *state,
                                   const struct AsperitySample *sample,
                                   struct AsperityOutput *output);

// Makes a state at rest, without force, in `memory` of at least `ASPERITY_STATE_SIZE` bytes, for
// the arithmetic of a renderer. `seed` selects the noise of the excitation.
//
// # Safety
// `memory` is null or `size` bytes that nothing else uses; `renderer` is null or an initialised
// renderer; `state` is null or valid for writes.
AsperityStatus asperity_state_init(void *memory,
                                   size_t size,
                                   const struct AsperityRenderer *renderer,
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

// Makes an empty slot in `memory` of at least `ASPERITY_TEXTURE_SIZE_*` bytes, as `capacity`
// (`ASPERITY_CAPACITY_*`) asks for. The slot takes textures for the servo rate and the arithmetic
// of a renderer.
//
// # Safety
// `memory` is null or `size` bytes that nothing else uses; `renderer` is null or an initialised
// renderer; `texture` is null or valid for writes.
AsperityStatus asperity_texture_init(void *memory,
                                     size_t size,
                                     const struct AsperityRenderer *renderer,
                                     uint32_t capacity,
                                     struct AsperityTexture **texture);

// Loads one asset (`.asp`). If the asset is refused, the slot keeps the texture it had. The bytes
// are not needed afterwards.
//
// # Safety
// `texture` is null or an initialised slot that nobody else uses during the call; `asset`
// is null or `len` readable bytes; `error` is null or valid for writes.
AsperityStatus asperity_texture_load_asset(struct AsperityTexture *texture,
                                           const uint8_t *asset,
                                           size_t len,
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
                                           struct AsperityError *error);

// Loads the texture called `texture_name` of a whole library (`.aspl`).
//
// # Safety
// As `asperity_texture_load_asset`; `texture_name` is null or ends with a null.
AsperityStatus asperity_texture_load_name(struct AsperityTexture *texture,
                                          const uint8_t *library,
                                          size_t len,
                                          const char *texture_name,
                                          struct AsperityError *error);

// Reads wall, gains and friction of the texture that a slot holds; all 0 for an empty slot.
//
// # Safety
// `texture` is null or an initialised slot that nobody writes during the call; `coupling` is null
// or valid for writes.
AsperityStatus asperity_texture_coupling(const struct AsperityTexture *texture,
                                         struct AsperityCoupling *coupling);

// Renders one servo period: a device sample in, a limited force out. If the pointers are right,
// the texture was loaded for the renderer's rate and the processor rounds to nearest, it succeeds
// for every sample. Otherwise the output, where there is one, is zero force and the safe state.
//
// # Safety
// `renderer`, `texture` and `state` are null or initialised objects; nobody writes to the
// first two during the call, nobody else uses the third. `sample` is null or readable,
// `output` null or valid for writes, both as long as their `struct_size` says.
AsperityStatus asperity_tick(const struct AsperityRenderer *renderer,
                             const struct AsperityTexture *texture,
                             struct AsperityState *state,
                             const struct AsperitySample *sample,
                             struct AsperityOutput *output);

// The version of the library in words, e.g. `0.1.0`.
const char *asperity_version(void);

// The version of the library, to compare with the header's `ASPERITY_VERSION`.
uint32_t asperity_version_number(void);

// Puts counters into words, such as `5000 ticks, 2 overruns (missed periods), 11 bad samples, 1
// entry of the safe state, 4 taps, 0 ticks cut to the peak, 3 ticks held back by the slew limit`.
// A text that does not fit into `size` bytes is cut, and the status is
// `ASPERITY_STATUS_MEMORY`; `ASPERITY_TEXT_SIZE` are always enough.
//
// # Safety
// `counters` is null or readable; `text` is null or `size` writable bytes.
AsperityStatus asperity_counters_text(const struct AsperityCounters *counters,
                                      char *text,
                                      size_t size);

// Puts `AsperityOutput::flags` into words: the names of `ASPERITY_FLAG_*` in lower case, a space
// between two; no text for no flag. Sizes as in `asperity_counters_text`.
//
// # Safety
// `text` is null or `size` writable bytes.
AsperityStatus asperity_flags_text(uint32_t flags, char *text, size_t size);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* ASPERITY_H */
