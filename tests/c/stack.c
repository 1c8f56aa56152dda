/* Measures how much stack each call takes.
 *
 *   stack TEXTURE.asp LIBRARY.aspl SCENE.aspl
 *
 * Each call runs in a thread of its own on a stack of our making, which is painted first; what lost
 * its paint was used. A line of output is a function and its bytes. Link with -Wl,-z,now: the first call of a function of the C library must
 * not run the dynamic linker on that stack. */
#define _POSIX_C_SOURCE 200809L
#include "asperity.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STACK = 1 << 18, PAINT = 0xa5 };
static ASPERITY_ALIGNED unsigned char stack[STACK];

static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char texture_memory[ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char state_memory[ASPERITY_STATE_SIZE];
static ASPERITY_ALIGNED unsigned char scene_memory[ASPERITY_SCENE_SIZE + 8 * ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char scene_state_memory[ASPERITY_SCENE_STATE_SIZE];
static ASPERITY_ALIGNED unsigned char exchange_memory[ASPERITY_EXCHANGE_SIZE + 4 * ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char recorder_memory[ASPERITY_RECORDER_SIZE + 8 * ASPERITY_RECORDER_RECORD_SIZE];

static unsigned char library[1 << 20], scene_library[1 << 20];
static size_t library_len, scene_len, asset_len, index_or_size, count;
static unsigned char *asset;
static AsperityConfig config;
static AsperityError error = ASPERITY_ERROR_INIT;
static AsperitySample sample = ASPERITY_SAMPLE_INIT;
static AsperityOutput output = ASPERITY_OUTPUT_INIT;
static AsperityCounters counters = ASPERITY_COUNTERS_INIT;
static AsperityCoupling coupling = ASPERITY_COUPLING_INIT;
static AsperityRecord record;
static char name[ASPERITY_NAME_SIZE], text[ASPERITY_TEXT_SIZE];
static uint32_t capacity;

static AsperityRenderer *renderer;
static AsperityTexture *texture;
static AsperityState *state;
static AsperityScene *scene;
static AsperitySceneState *scene_state;
static AsperityPreparer *preparer;
static AsperityPlayer *player;
static AsperityRecorder *recorder;

static AsperityStatus status;

/* A function that makes a call and is named after it. */
#define CALL(function, ...) \
  static void call_##function(void) { status = function(__VA_ARGS__); }
CALL(asperity_config_default, &config, sizeof config)
CALL(asperity_renderer_init, renderer_memory, sizeof renderer_memory, &config, &renderer, &error)
CALL(asperity_library_count, library, library_len, &count, &error)
CALL(asperity_library_find, library, library_len, name, &index_or_size, &error)
CALL(asperity_library_name, library, library_len, 0, name, sizeof name, &error)
CALL(asperity_library_capacity, library, library_len, config.servo_rate_hz, &capacity, &error)
CALL(asperity_asset_capacity, asset, asset_len, config.servo_rate_hz, &capacity, &error)
CALL(asperity_texture_init, texture_memory, sizeof texture_memory, renderer, ASPERITY_CAPACITY_LARGE, &texture)
CALL(asperity_texture_load_asset, texture, asset, asset_len, &error)
CALL(asperity_texture_load_index, texture, library, library_len, 0, &error)
CALL(asperity_texture_load_name, texture, library, library_len, name, &error)
CALL(asperity_texture_coupling, texture, &coupling)
CALL(asperity_state_init, state_memory, sizeof state_memory, renderer, 1, &state)
CALL(asperity_tick, renderer, texture, state, &sample, &output)
CALL(asperity_state_counters, state, &counters)
CALL(asperity_scene_size, scene_library, scene_len, ASPERITY_CAPACITY_LARGE, &index_or_size, &error)
CALL(asperity_scene_init, scene_memory, sizeof scene_memory, renderer, ASPERITY_CAPACITY_LARGE,
     scene_library, scene_len, &scene, &error)
CALL(asperity_scene_state_init, scene_state_memory, sizeof scene_state_memory, renderer, 1, &scene_state)
CALL(asperity_scene_tick, renderer, scene, scene_state, &sample, &output)
CALL(asperity_scene_state_counters, scene_state, &counters)
CALL(asperity_exchange_size, ASPERITY_CAPACITY_LARGE, 3, &index_or_size)
CALL(asperity_exchange_init, exchange_memory, sizeof exchange_memory, renderer, ASPERITY_CAPACITY_LARGE, 3, 1,
     &preparer, &player)
CALL(asperity_preparer_load_asset, preparer, asset, asset_len, &error)
CALL(asperity_preparer_load_index, preparer, library, library_len, 0, &error)
CALL(asperity_preparer_load_name, preparer, library, library_len, name, &error)
CALL(asperity_player_tick, renderer, player, &sample, &output)
CALL(asperity_player_counters, player, &counters)
CALL(asperity_recorder_init, recorder_memory, sizeof recorder_memory, &recorder)
CALL(asperity_recorder_write, recorder, &sample, &output)
CALL(asperity_recorder_read, recorder, &record, sizeof record, 1, &count, NULL)
CALL(asperity_counters_text, &counters, text, sizeof text)
CALL(asperity_flags_text, 1023, text, sizeof text)

static void call_asperity_version(void) { status = asperity_version()[0] == 0; }
static void call_asperity_version_number(void) { status = asperity_version_number() == 0; }
static void call_asperity_error_text(void) { status = asperity_error_text(99)[0] == 0; }

/* Errors are put into words, floats included. */
static void call_error_of_a_field(void) {
  AsperityRenderer *none = NULL;
  status = !asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &none, &error);
}

/* The bytes between this function's frame and the deepest byte that lost its paint. */
static void *run(void *argument) {
  void (*const *call)(void) = argument;
  const volatile unsigned char here = PAINT;
  size_t clean = 0;
  (*call)();
  while (stack[clean] == PAINT) clean++;
  return (void *)(uintptr_t)((uintptr_t)&here - (uintptr_t)(stack + clean));
}

static size_t used(void (*call)(void)) {
  pthread_attr_t attributes;
  pthread_t thread;
  void *bytes = NULL;
  memset(stack, PAINT, sizeof stack);
  if (pthread_attr_init(&attributes) != 0 || pthread_attr_setstack(&attributes, stack, sizeof stack) != 0 ||
      pthread_create(&thread, &attributes, run, &call) != 0 || pthread_join(thread, &bytes) != 0) {
    fprintf(stderr, "no thread on a stack of its own\n");
    exit(EXIT_FAILURE);
  }
  pthread_attr_destroy(&attributes);
  return (size_t)(uintptr_t)bytes;
}

static void measure(const char *what, void (*call)(void)) {
  const size_t bytes = used(call);
  if (status != ASPERITY_STATUS_OK) {
    fprintf(stderr, "%s: %s: %s\n", what, asperity_error_text(status), error.message);
    exit(EXIT_FAILURE);
  }
  printf("%s %lu\n", what, (unsigned long)bytes);
}
#define MEASURE(function) measure(#function, call_##function)

/* The deepest of many ticks: down onto the surface, along it, up, and away, and again. */
static void measure_ticks(const char *what, void (*call)(void)) {
  size_t most = 0;
  for (int tick = 0; tick < 400; tick++) {
    const int phase = tick % 100;
    sample.position_m[0] = 1.0e-4f * (float)tick;
    sample.position_m[2] = phase < 50 ? 1.0e-3f - 1.0e-4f * (float)phase : -5.0e-3f + 1.5e-4f * (float)(phase - 50);
    sample.elapsed_ticks = phase == 99 ? 0 : 1;
    const size_t bytes = used(call);
    if (status != ASPERITY_STATUS_OK) break;
    if (bytes > most) most = bytes;
  }
  if (status != ASPERITY_STATUS_OK) {
    fprintf(stderr, "%s: %s\n", what, asperity_error_text(status));
    exit(EXIT_FAILURE);
  }
  printf("%s %lu\n", what, (unsigned long)most);
}
#define MEASURE_TICKS(function) measure_ticks(#function, call_##function)

static size_t read_file(const char *path, unsigned char *bytes, size_t room) {
  FILE *file = fopen(path, "rb");
  if (file == NULL) {
    perror(path);
    exit(EXIT_FAILURE);
  }
  const size_t len = fread(bytes, 1, room, file);
  fclose(file);
  return len;
}

static void of_arithmetic(uint32_t arithmetic) {
  MEASURE(asperity_config_default);
  config.arithmetic = arithmetic;
  MEASURE(asperity_renderer_init);
  config.peak_n = -1.25f;
  measure("asperity_renderer_init", call_error_of_a_field);
  config.peak_n = 3.3f;
  MEASURE(asperity_library_count);
  MEASURE(asperity_library_name);
  MEASURE(asperity_library_find);
  MEASURE(asperity_library_capacity);
  MEASURE(asperity_asset_capacity);
  MEASURE(asperity_texture_init);
  MEASURE(asperity_texture_load_asset);
  MEASURE(asperity_texture_load_index);
  MEASURE(asperity_texture_load_name);
  MEASURE(asperity_texture_coupling);
  MEASURE(asperity_state_init);
  MEASURE_TICKS(asperity_tick);
  MEASURE(asperity_state_counters);
  MEASURE(asperity_scene_size);
  MEASURE(asperity_scene_init);
  MEASURE(asperity_scene_state_init);
  MEASURE_TICKS(asperity_scene_tick);
  MEASURE(asperity_scene_state_counters);
  MEASURE(asperity_exchange_size);
  MEASURE(asperity_exchange_init);
  MEASURE(asperity_preparer_load_asset);
  MEASURE(asperity_preparer_load_index);
  MEASURE(asperity_preparer_load_name);
  MEASURE_TICKS(asperity_player_tick);
  MEASURE(asperity_player_counters);
}

int main(int argc, char **argv) {
  if (argc != 4) {
    fprintf(stderr, "usage: %s TEXTURE.asp LIBRARY.aspl SCENE.aspl\n", argv[0]);
    return 2;
  }
  static unsigned char asset_bytes[1 << 20];
  asset = asset_bytes;
  asset_len = read_file(argv[1], asset_bytes, sizeof asset_bytes);
  library_len = read_file(argv[2], library, sizeof library);
  scene_len = read_file(argv[3], scene_library, sizeof scene_library);
  of_arithmetic(ASPERITY_ARITHMETIC_FLOAT);
  of_arithmetic(ASPERITY_ARITHMETIC_FIXED);
  MEASURE(asperity_recorder_init);
  MEASURE(asperity_recorder_write);
  MEASURE(asperity_recorder_read);
  MEASURE(asperity_counters_text);
  MEASURE(asperity_flags_text);
  MEASURE(asperity_version);
  MEASURE(asperity_version_number);
  MEASURE(asperity_error_text);
  return EXIT_SUCCESS;
}
