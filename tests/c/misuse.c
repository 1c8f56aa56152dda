/* Every misuse that can be detected gives a status and changes nothing.
 *
 *   misuse LIBRARY.aspl, whose textures are for 1 kHz */
#include "asperity.h"

#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ASPERITY_ALIGNED unsigned char texture_memory[ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char state_memory[ASPERITY_STATE_SIZE];
static unsigned failures;

static void expect(int line, const char *call, AsperityStatus found, AsperityStatus wanted) {
  if (found == wanted) return;
  printf("line %d: %s: %s, not %s\n", line, call, asperity_error_text(found),
         asperity_error_text(wanted));
  failures++;
}
#define EXPECT(wanted, call) expect(__LINE__, #call, call, ASPERITY_STATUS_##wanted)

static void check(int line, const char *what, int holds) {
  if (holds) return;
  printf("line %d: not so: %s\n", line, what);
  failures++;
}
#define CHECK(what) check(__LINE__, #what, what)

static AsperityRenderer *renderer_of(const AsperityConfig *config) {
  AsperityRenderer *renderer = NULL;
  EXPECT(OK, asperity_renderer_init(renderer_memory, sizeof renderer_memory, config, &renderer, NULL));
  return renderer;
}

static AsperityConfig defaults(void) {
  AsperityConfig config;
  EXPECT(OK, asperity_config_default(&config, sizeof config));
  return config;
}

static void of_memory(void) {
  AsperityConfig config = defaults();
  const AsperityRenderer *renderer = renderer_of(&config);
  const uint32_t small = ASPERITY_CAPACITY_SMALL, large = ASPERITY_CAPACITY_LARGE;
  const size_t size = sizeof texture_memory;
  AsperityTexture *texture = NULL;
  AsperityState *state = NULL;
  EXPECT(NULL_POINTER, asperity_texture_init(NULL, size, renderer, large, &texture));
  EXPECT(NULL_POINTER, asperity_texture_init(texture_memory, size, renderer, large, NULL));
  EXPECT(NULL_POINTER, asperity_texture_init(texture_memory, size, NULL, large, &texture));
  EXPECT(MEMORY, asperity_texture_init(texture_memory, size - 1, renderer, large, &texture));
  EXPECT(MEMORY, asperity_texture_init(texture_memory, ASPERITY_TEXTURE_SIZE_SMALL - 1, renderer, small, &texture));
  EXPECT(MEMORY, asperity_texture_init(texture_memory + 8, size, renderer, large, &texture));
  EXPECT(ARGUMENT, asperity_texture_init(texture_memory, size, renderer, 3, &texture));
  EXPECT(MEMORY, asperity_state_init(state_memory, 0, renderer, 1, &state));
  EXPECT(NULL_POINTER, asperity_state_init(state_memory, sizeof state_memory, NULL, 1, &state));
  EXPECT(NOT_INITIALISED, asperity_state_init(state_memory, sizeof state_memory,
                                              (AsperityRenderer *)texture_memory, 1, &state));
  CHECK(texture == NULL && state == NULL);
}

static void of_configurations(void) {
  AsperityConfig config;
  AsperityError error = ASPERITY_ERROR_INIT;
  AsperityRenderer *renderer = NULL;
  const size_t size = sizeof renderer_memory;
  EXPECT(NULL_POINTER, asperity_config_default(NULL, sizeof config));
  EXPECT(STRUCT_SIZE, asperity_config_default(&config, 12));
  EXPECT(STRUCT_SIZE, asperity_config_default(&config, SIZE_MAX));
  EXPECT(OK, asperity_config_default(&config, sizeof config));
  CHECK(config.struct_size == sizeof config);
  EXPECT(NULL_POINTER, asperity_renderer_init(renderer_memory, size, NULL, &renderer, &error));
  config.peak_n = -1.0f;
  EXPECT(CONFIG, asperity_renderer_init(renderer_memory, size, &config, &renderer, &error));
  CHECK(strstr(error.message, "limits.peak_n = -1") != NULL && error.status == ASPERITY_STATUS_CONFIG);
  EXPECT(CONFIG, asperity_renderer_init(renderer_memory, size, &config, &renderer, NULL));
  memset(&config, 0xff, sizeof config); /* NaN everywhere, no solid, no axis, no arithmetic */
  EXPECT(STRUCT_SIZE, asperity_renderer_init(renderer_memory, size, &config, &renderer, &error));
  config.struct_size = (uint32_t)sizeof config;
  EXPECT(CONFIG, asperity_renderer_init(renderer_memory, size, &config, &renderer, &error));
  config = defaults();
  config.arithmetic = 2;
  EXPECT(CONFIG, asperity_renderer_init(renderer_memory, size, &config, &renderer, &error));
  CHECK(strstr(error.message, "arithmetic is 2, but must be 0") != NULL);
  config = defaults();
  config.solid = 7;
  EXPECT(CONFIG, asperity_renderer_init(renderer_memory, size, &config, &renderer, &error));
  CHECK(strcmp(error.message, "solid is 7, but must be 0 (plane), 1 (sphere) or 2 (box)") == 0);
  config = defaults();
  config.vibration_axis = 3;
  EXPECT(CONFIG, asperity_renderer_init(renderer_memory, size, &config, &renderer, &error));
  CHECK(strstr(error.message, "vibration_axis is 3, but must be 0 (tangent)") != NULL);
  error.struct_size = 7; /* An error that was not begun: nothing is done and nothing written. */
  config = defaults();
  EXPECT(STRUCT_SIZE, asperity_renderer_init(renderer_memory, size, &config, &renderer, &error));
  CHECK(renderer == NULL);
}

/* Structs of another size than the library's. */
static void of_sizes(unsigned char *library, size_t len) {
  struct { AsperityConfig known; uint32_t later; } config;
  struct { AsperityOutput known; uint32_t later, behind; } output;
  AsperitySample sample = ASPERITY_SAMPLE_INIT;
  AsperityRenderer *renderer = NULL;
  AsperityTexture *texture = NULL;
  AsperityState *state = NULL;
  const uint32_t longer = (uint32_t)(sizeof config.known + sizeof config.later);

  EXPECT(OK, asperity_config_default(&config.known, longer));
  CHECK(config.known.struct_size == longer && config.later == 0);
  EXPECT(OK, asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config.known, &renderer, NULL));
  config.later = 1; /* Something that this library does not know. */
  EXPECT(STRUCT_SIZE, asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config.known, &renderer, NULL));
  config.known.struct_size = (uint32_t)sizeof config.known + 2; /* A size that no struct has. */
  EXPECT(STRUCT_SIZE, asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config.known, &renderer, NULL));

  EXPECT(OK, asperity_texture_init(texture_memory, sizeof texture_memory, renderer, ASPERITY_CAPACITY_LARGE, &texture));
  EXPECT(OK, asperity_texture_load_index(texture, library, len, 0, NULL));
  EXPECT(OK, asperity_state_init(state_memory, sizeof state_memory, renderer, 1, &state));
  memset(&output, 0x55, sizeof output);
  output.known.struct_size = (uint32_t)(sizeof output.known + sizeof output.later);
  EXPECT(OK, asperity_tick(renderer, texture, state, &sample, &output.known));
  CHECK(output.known.surface == ASPERITY_NO_SURFACE && output.later == 0 && output.behind == 0x55555555);
  output.known.struct_size = (uint32_t)offsetof(AsperityOutput, surface); /* the first version */
  output.known.surface = 77;
  EXPECT(OK, asperity_tick(renderer, texture, state, &sample, &output.known));
  CHECK(output.known.surface == 77);
  output.known.struct_size = 0;
  EXPECT(STRUCT_SIZE, asperity_tick(renderer, texture, state, &sample, &output.known));
  output.known.struct_size = (uint32_t)sizeof output.known;
  sample.struct_size = 8;
  EXPECT(STRUCT_SIZE, asperity_tick(renderer, texture, state, &sample, &output.known));
  CHECK(output.known.flags == ASPERITY_FLAG_SAFE_STATE);
}

static void of_libraries(const unsigned char *library, size_t len) {
  size_t count = 0, index = 0, size = 0;
  uint32_t capacity = 99;
  char name[ASPERITY_NAME_SIZE], short_name[2];
  AsperityError error = ASPERITY_ERROR_INIT;
  EXPECT(OK, asperity_library_count(library, len, &count, &error));
  CHECK(count > 0 && error.status == ASPERITY_STATUS_OK && error.message[0] == 0);
  EXPECT(NULL_POINTER, asperity_library_count(NULL, len, &count, NULL));
  EXPECT(NULL_POINTER, asperity_library_count(library, len, NULL, NULL));
  EXPECT(FORMAT, asperity_library_count(library, 3, &count, &error));
  CHECK(strstr(error.message, "library header") != NULL);
  for (size_t i = 0; i < count; i++) {
    EXPECT(OK, asperity_library_name(library, len, i, name, sizeof name, NULL));
    EXPECT(OK, asperity_library_find(library, len, name, &index, NULL));
    CHECK(index == i);
  }
  EXPECT(NO_SUCH_TEXTURE, asperity_library_name(library, len, count, name, sizeof name, &error));
  EXPECT(NO_SUCH_TEXTURE, asperity_library_name(library, len, SIZE_MAX, name, sizeof name, &error));
  EXPECT(MEMORY, asperity_library_name(library, len, 0, short_name, sizeof short_name, NULL));
  EXPECT(NULL_POINTER, asperity_library_name(library, len, 0, NULL, 9, NULL));
  EXPECT(NO_SUCH_TEXTURE, asperity_library_find(library, len, "no such thing", &index, NULL));
  EXPECT(TEXT, asperity_library_find(library, len, "\xff\xfe", &index, NULL));
  EXPECT(NULL_POINTER, asperity_library_find(library, len, NULL, &index, NULL));
  EXPECT(OK, asperity_library_capacity(library, len, 1000.0f, &capacity, NULL));
  CHECK(capacity == ASPERITY_CAPACITY_MEDIUM || capacity == ASPERITY_CAPACITY_LARGE);
  EXPECT(RATE, asperity_library_capacity(library, len, 1500.0f, &capacity, &error));
  EXPECT(NULL_POINTER, asperity_library_capacity(library, len, 1000.0f, NULL, NULL));
  EXPECT(FORMAT, asperity_asset_capacity(library, len, 1000.0f, &capacity, &error));
  EXPECT(NO_SCENE, asperity_scene_size(library, len, capacity, &size, &error));
  CHECK(strstr(error.message, "asperity build") != NULL);
}

static void of_objects(unsigned char *library, size_t len) {
  AsperityConfig config = defaults();
  AsperityError error = ASPERITY_ERROR_INIT;
  AsperityTexture *texture;
  AsperityState *state;
  AsperityOutput output = ASPERITY_OUTPUT_INIT;
  AsperityCounters counters = ASPERITY_COUNTERS_INIT;
  AsperityCoupling coupling = ASPERITY_COUPLING_INIT;
  AsperitySample pressed = ASPERITY_SAMPLE_INIT;
  pressed.position_m[2] = -0.001f;
  memset(texture_memory, 0, sizeof texture_memory);
  EXPECT(NOT_INITIALISED, asperity_texture_load_index((AsperityTexture *)texture_memory, library, len, 0, NULL));
  memset(texture_memory, 0xff, sizeof texture_memory);
  EXPECT(NOT_INITIALISED, asperity_texture_load_index((AsperityTexture *)texture_memory, library, len, 0, NULL));
  const AsperityRenderer *renderer = renderer_of(&config);
  EXPECT(OK, asperity_texture_init(texture_memory, sizeof texture_memory, renderer, ASPERITY_CAPACITY_LARGE, &texture));
  EXPECT(OK, asperity_state_init(state_memory, sizeof state_memory, renderer, 1, &state));

  output.force_n[2] = 99.0f;
  EXPECT(NOT_LOADED, asperity_tick(renderer, texture, state, &pressed, &output));
  CHECK(output.force_n[2] == 0.0f && output.flags == ASPERITY_FLAG_SAFE_STATE);
  EXPECT(OK, asperity_texture_coupling(texture, &coupling));
  CHECK(coupling.stiffness_n_m == 0.0f && coupling.mu == 0.0f);
  EXPECT(OK, asperity_texture_load_index(texture, library, len, 0, &error));
  EXPECT(OK, asperity_texture_coupling(texture, &coupling));
  CHECK(coupling.stiffness_n_m > 0.0f);
  EXPECT(NULL_POINTER, asperity_texture_coupling(texture, NULL));
  EXPECT(NO_SUCH_TEXTURE, asperity_texture_load_index(texture, library, len, 1000, &error));
  EXPECT(FORMAT, asperity_texture_load_asset(texture, library, len, &error));
  EXPECT(FORMAT, asperity_texture_load_index(texture, library, len - 1, 0, &error));
  EXPECT(NULL_POINTER, asperity_texture_load_index(texture, NULL, len, 0, &error));
  EXPECT(NULL_POINTER, asperity_texture_load_name(texture, library, len, NULL, &error));
  library[len - 1] ^= 1; /* the last texture's preview, or its last haptic section */
  library[len / 2] ^= 1;
  (void)asperity_texture_load_index(texture, library, len, 0, &error);
  library[len - 1] ^= 1;
  library[len / 2] ^= 1;

  /* The texture that was loaded before still works. */
  EXPECT(OK, asperity_tick(renderer, texture, state, &pressed, &output));
  CHECK(output.force_n[2] > 0.0f && (output.flags & ASPERITY_FLAG_CONTACT) != 0);

  EXPECT(NULL_POINTER, asperity_tick(NULL, texture, state, &pressed, &output));
  EXPECT(NULL_POINTER, asperity_tick(renderer, NULL, state, &pressed, &output));
  EXPECT(NULL_POINTER, asperity_tick(renderer, texture, NULL, &pressed, &output));
  EXPECT(NULL_POINTER, asperity_tick(renderer, texture, state, NULL, &output));
  EXPECT(NULL_POINTER, asperity_tick(renderer, texture, state, &pressed, NULL));
  /* Objects of another kind. */
  EXPECT(NOT_INITIALISED, asperity_tick((AsperityRenderer *)state_memory, texture, state, &pressed, &output));
  EXPECT(NOT_INITIALISED, asperity_tick(renderer, (AsperityTexture *)state_memory, state, &pressed, &output));
  EXPECT(NOT_INITIALISED, asperity_tick(renderer, texture, (AsperityState *)renderer_memory, &pressed, &output));
  EXPECT(NOT_INITIALISED, asperity_scene_tick(renderer, (AsperityScene *)texture_memory,
                                              (AsperitySceneState *)state_memory, &pressed, &output));
  EXPECT(NOT_INITIALISED, asperity_player_tick(renderer, (AsperityPlayer *)texture_memory, &pressed, &output));
  EXPECT(NULL_POINTER, asperity_state_counters(NULL, &counters));
  EXPECT(NULL_POINTER, asperity_state_counters(state, NULL));
  EXPECT(OK, asperity_state_counters(state, &counters));
  CHECK(counters.ticks == 1);

  /* Every sample is a valid call. */
  const float odd[] = {NAN, INFINITY, -INFINITY, 1e38f, -0.0f};
  for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
    AsperitySample sample = ASPERITY_SAMPLE_INIT;
    sample.position_m[0] = sample.position_m[2] = odd[i];
    sample.elapsed_ticks = (uint32_t)(i * 1000000000u);
    EXPECT(OK, asperity_tick(renderer, texture, state, &sample, &output));
    CHECK(isfinite(output.force_n[0]) && isfinite(output.force_n[1]) && isfinite(output.force_n[2]));
  }

  /* Another servo rate: the texture of one renderer is refused by the other. */
  config.servo_rate_hz = 2000.0f;
  renderer = renderer_of(&config);
  EXPECT(RATE, asperity_tick(renderer, texture, state, &pressed, &output));
  config.servo_rate_hz = 1500.0f;
  renderer = renderer_of(&config);
  EXPECT(OK, asperity_texture_init(texture_memory, sizeof texture_memory, renderer, ASPERITY_CAPACITY_LARGE, &texture));
  EXPECT(RATE, asperity_texture_load_index(texture, library, len, 0, &error));
  CHECK(strstr(error.message, "1500 Hz") != NULL);

  /* Another arithmetic. */
  config = defaults();
  config.arithmetic = ASPERITY_ARITHMETIC_FIXED;
  renderer = renderer_of(&config);
  EXPECT(NOT_INITIALISED, asperity_tick(renderer, texture, state, &pressed, &output));

  /* A slot that is too small. */
  config = defaults();
  renderer = renderer_of(&config);
  EXPECT(OK, asperity_texture_init(texture_memory, sizeof texture_memory, renderer, ASPERITY_CAPACITY_SMALL, &texture));
  EXPECT(CAPACITY, asperity_texture_load_index(texture, library, len, 0, &error));
  CHECK(strstr(error.message, "the slot has room for") != NULL);
}

static void of_exchanges(const unsigned char *library, size_t len) {
  static ASPERITY_ALIGNED unsigned char memory[ASPERITY_EXCHANGE_SIZE + 4 * ASPERITY_TEXTURE_SIZE_LARGE];
  const AsperityConfig config = defaults();
  const AsperityRenderer *renderer = renderer_of(&config);
  const uint32_t large = ASPERITY_CAPACITY_LARGE;
  AsperityPreparer *preparer = NULL;
  AsperityPlayer *player = NULL;
  AsperityCounters counters = ASPERITY_COUNTERS_INIT;
  AsperityOutput output = ASPERITY_OUTPUT_INIT;
  AsperityError error = ASPERITY_ERROR_INIT;
  AsperitySample pressed = ASPERITY_SAMPLE_INIT;
  size_t size = 0;
  pressed.position_m[2] = -0.001f;
  EXPECT(ARGUMENT, asperity_exchange_size(large, 0, &size));
  EXPECT(ARGUMENT, asperity_exchange_size(large, 4, &size));
  EXPECT(ARGUMENT, asperity_exchange_size(9, 1, &size));
  EXPECT(NULL_POINTER, asperity_exchange_size(large, 1, NULL));
  EXPECT(OK, asperity_exchange_size(large, 3, &size));
  CHECK(size == sizeof memory);
  EXPECT(MEMORY, asperity_exchange_init(memory, size - 1, renderer, large, 3, 1, &preparer, &player));
  EXPECT(MEMORY, asperity_exchange_init(memory + 4, size, renderer, large, 3, 1, &preparer, &player));
  EXPECT(NULL_POINTER, asperity_exchange_init(memory, size, renderer, large, 3, 1, NULL, &player));
  EXPECT(NULL_POINTER, asperity_exchange_init(memory, size, renderer, large, 3, 1, &preparer, NULL));
  EXPECT(ARGUMENT, asperity_exchange_init(memory, size, renderer, large, 0, 1, &preparer, &player));
  CHECK(preparer == NULL && player == NULL);
  EXPECT(OK, asperity_exchange_init(memory, size, renderer, large, 1, 1, &preparer, &player));
  EXPECT(OK, asperity_player_tick(renderer, player, &pressed, &output)); /* An empty slot has no force. */
  CHECK(output.force_n[2] == 0.0f);
  EXPECT(FORMAT, asperity_preparer_load_asset(preparer, library, len, &error));
  EXPECT(NO_SUCH_TEXTURE, asperity_preparer_load_name(preparer, library, len, "no such thing", &error));
  EXPECT(NO_SUCH_TEXTURE, asperity_preparer_load_index(preparer, library, len, 99, &error));
  CHECK(fesetround(FE_UPWARD) == 0);
  EXPECT(ROUNDING, asperity_preparer_load_index(preparer, library, len, 0, &error));
  EXPECT(ROUNDING, asperity_player_tick(renderer, player, &pressed, &output));
  CHECK(fesetround(FE_TONEAREST) == 0);
  EXPECT(OK, asperity_preparer_load_index(preparer, library, len, 0, &error));
  EXPECT(BUSY, asperity_preparer_load_index(preparer, library, len, 0, &error));
  CHECK(strstr(error.message, "try again") != NULL);
  EXPECT(NOT_INITIALISED, asperity_preparer_load_index((AsperityPreparer *)player, library, len, 0, NULL));
  EXPECT(NOT_INITIALISED, asperity_player_tick(renderer, (AsperityPlayer *)preparer, &pressed, &output));
  for (int i = 0; i < 200; i++) EXPECT(OK, asperity_player_tick(renderer, player, &pressed, &output));
  CHECK(output.force_n[2] > 0.0f);
  EXPECT(OK, asperity_preparer_load_index(preparer, library, len, 0, &error));
  /* A copy would play from the memory of the original. */
  static ASPERITY_ALIGNED unsigned char copy[sizeof memory];
  memcpy(copy, memory, sizeof memory);
  AsperityPlayer *copied_player = (AsperityPlayer *)(copy + ((unsigned char *)player - memory));
  AsperityPreparer *copied_preparer = (AsperityPreparer *)(copy + ((unsigned char *)preparer - memory));
  EXPECT(NOT_INITIALISED, asperity_player_tick(renderer, copied_player, &pressed, &output));
  EXPECT(NOT_INITIALISED, asperity_player_counters(copied_player, &counters));
  EXPECT(NOT_INITIALISED, asperity_preparer_load_index(copied_preparer, library, len, 0, &error));
  EXPECT(NULL_POINTER, asperity_player_counters(player, NULL));
  EXPECT(OK, asperity_player_counters(player, &counters));
  CHECK(counters.ticks == 201);
}

static void of_recorders(void) {
  static ASPERITY_ALIGNED unsigned char memory[ASPERITY_RECORDER_SIZE + 3 * ASPERITY_RECORDER_RECORD_SIZE];
  AsperityRecorder *recorder = NULL;
  AsperityRecord records[5];
  AsperitySample sample = ASPERITY_SAMPLE_INIT;
  AsperityOutput output = ASPERITY_OUTPUT_INIT;
  size_t count = 99;
  uint32_t lost = 99;
  uint64_t next = 0, gaps = 0;
  EXPECT(MEMORY, asperity_recorder_init(memory, ASPERITY_RECORDER_SIZE, &recorder));
  EXPECT(MEMORY, asperity_recorder_init(memory + 8, sizeof memory - 8, &recorder));
  EXPECT(NULL_POINTER, asperity_recorder_init(NULL, sizeof memory, &recorder));
  EXPECT(NOT_INITIALISED, asperity_recorder_write((AsperityRecorder *)renderer_memory, &sample, &output));
  EXPECT(OK, asperity_recorder_init(memory, sizeof memory, &recorder));
  EXPECT(OK, asperity_recorder_read(recorder, records, sizeof *records, 5, &count, &lost));
  CHECK(count == 0 && lost == 0);
  EXPECT(STRUCT_SIZE, asperity_recorder_read(recorder, records, 8, 5, &count, NULL));
  EXPECT(NULL_POINTER, asperity_recorder_read(recorder, NULL, sizeof *records, 5, &count, NULL));
  EXPECT(NULL_POINTER, asperity_recorder_read(recorder, records, sizeof *records, 5, NULL, NULL));
  EXPECT(NULL_POINTER, asperity_recorder_write(recorder, NULL, &output));
  EXPECT(NULL_POINTER, asperity_recorder_write(recorder, &sample, NULL));
  /* Bursts of one to five records into a ring of three: the newest of a burst are lost. */
  for (unsigned burst = 1, number = 0; burst <= 50; burst++) {
    for (unsigned i = 0; i < 1 + burst % 5; i++, number++) {
      output.force_n[0] = (float)number;
      EXPECT(OK, asperity_recorder_write(recorder, &sample, &output));
    }
    EXPECT(OK, asperity_recorder_read(recorder, records, sizeof *records, 5, &count, &lost));
    for (size_t i = 0; i < count; i++) {
      CHECK(records[i].tick >= next && records[i].force_n[0] == (float)records[i].tick);
      gaps += records[i].tick - next;
      next = records[i].tick + 1;
    }
    CHECK(count == (burst % 5 < 3 ? 1 + burst % 5 : 3));
  }
  CHECK(lost == gaps && lost == 10 * (1 + 2));
}

static void of_words(void) {
  AsperityCounters counters = ASPERITY_COUNTERS_INIT;
  char text[ASPERITY_TEXT_SIZE], short_text[8];
  EXPECT(OK, asperity_counters_text(&counters, text, sizeof text));
  CHECK(strncmp(text, "0 ticks, 0 overruns", 19) == 0);
  EXPECT(MEMORY, asperity_counters_text(&counters, short_text, sizeof short_text));
  CHECK(strcmp(short_text, "0 ticks") == 0);
  EXPECT(MEMORY, asperity_counters_text(&counters, text, 0));
  EXPECT(NULL_POINTER, asperity_counters_text(NULL, text, sizeof text));
  EXPECT(NULL_POINTER, asperity_counters_text(&counters, NULL, sizeof text));
  EXPECT(OK, asperity_flags_text(ASPERITY_FLAG_CONTACT | ASPERITY_FLAG_SAFE_STATE, text, sizeof text));
  CHECK(strcmp(text, "contact safe_state") == 0);
  CHECK(asperity_version_number() >= ASPERITY_VERSION);
}

/* Forces would have other bits. */
static void of_rounding(const unsigned char *library, size_t len) {
  static const int others[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  static ASPERITY_ALIGNED unsigned char memory[ASPERITY_RENDERER_SIZE];
  AsperityConfig config = defaults();
  AsperityError error = ASPERITY_ERROR_INIT;
  const AsperityRenderer *renderer = renderer_of(&config);
  AsperityRenderer *refused;
  AsperityTexture *texture;
  AsperityState *state;
  EXPECT(OK, asperity_texture_init(texture_memory, sizeof texture_memory, renderer, ASPERITY_CAPACITY_LARGE, &texture));
  EXPECT(OK, asperity_texture_load_index(texture, library, len, 0, NULL));
  EXPECT(OK, asperity_state_init(state_memory, sizeof state_memory, renderer, 7, &state));
  AsperitySample pressed = ASPERITY_SAMPLE_INIT;
  pressed.position_m[2] = -0.001f;
  AsperityOutput output = ASPERITY_OUTPUT_INIT;
  EXPECT(OK, asperity_tick(renderer, texture, state, &pressed, &output));
  for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
    CHECK(fesetround(others[i]) == 0);
    EXPECT(ROUNDING, asperity_renderer_init(memory, sizeof memory, &config, &refused, &error));
    EXPECT(ROUNDING, asperity_texture_load_index(texture, library, len, 0, &error));
    CHECK(strstr(error.message, "round") != NULL);
    output.force_n[2] = 5.0f;
    EXPECT(ROUNDING, asperity_tick(renderer, texture, state, &pressed, &output));
    CHECK(output.force_n[2] == 0.0f && output.flags == ASPERITY_FLAG_SAFE_STATE);
    CHECK(fesetround(FE_TONEAREST) == 0);
    EXPECT(OK, asperity_tick(renderer, texture, state, &pressed, &output));
  }
}

int main(int argc, char **argv) {
  FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
  static unsigned char library[1 << 20];
  size_t len = file == NULL ? 0 : fread(library, 1, sizeof library, file);
  if (len == 0) {
    fprintf(stderr, "usage: %s LIBRARY.aspl\n", argv[0]);
    return 2;
  }
  fclose(file);
  of_memory();
  of_configurations();
  of_sizes(library, len);
  of_libraries(library, len);
  of_objects(library, len);
  of_exchanges(library, len);
  of_recorders();
  of_words();
  of_rounding(library, len);
  printf("%u failures\n", failures);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
