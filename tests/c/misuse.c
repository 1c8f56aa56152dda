/* Every misuse that can be detected gives a status and changes nothing.
 *
 *   misuse LIBRARY.aspl, whose textures are for 1 kHz */
#include "asperity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static _Alignas(ASPERITY_ALIGNMENT) unsigned char texture_memory[ASPERITY_TEXTURE_SIZE];
static _Alignas(ASPERITY_ALIGNMENT) unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static _Alignas(ASPERITY_ALIGNMENT) unsigned char state_memory[ASPERITY_STATE_SIZE];
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

static void of_memory(void) {
  AsperityTexture *texture = NULL;
  AsperityState *state = NULL;
  EXPECT(NULL_POINTER, asperity_texture_init(NULL, sizeof texture_memory, &texture));
  EXPECT(NULL_POINTER, asperity_texture_init(texture_memory, sizeof texture_memory, NULL));
  EXPECT(MEMORY, asperity_texture_init(texture_memory, sizeof texture_memory - 1, &texture));
  EXPECT(MEMORY, asperity_texture_init(texture_memory + 8, sizeof texture_memory, &texture));
  EXPECT(MEMORY, asperity_state_init(state_memory, 0, 1, &state));
  CHECK(texture == NULL && state == NULL);
}

static void of_configurations(void) {
  AsperityConfig config;
  AsperityError error;
  AsperityRenderer *renderer = NULL;
  EXPECT(NULL_POINTER, asperity_config_default(NULL));
  EXPECT(OK, asperity_config_default(&config));
  EXPECT(NULL_POINTER, asperity_renderer_init(renderer_memory, sizeof renderer_memory, NULL, &renderer, &error));
  config.peak_n = -1.0f;
  EXPECT(CONFIG, asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, &error));
  CHECK(strstr(error.message, "limits.peak_n = -1") != NULL && error.status == ASPERITY_STATUS_CONFIG);
  EXPECT(CONFIG, asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, NULL));
  memset(&config, 0xff, sizeof config); /* NaN everywhere, no surface, no axis */
  EXPECT(CONFIG, asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, &error));
  CHECK(renderer == NULL);
}

static void of_libraries(const unsigned char *library, size_t len) {
  size_t count = 0, index = 0;
  char name[ASPERITY_NAME_SIZE], short_name[2];
  AsperityError error;
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
}

static void of_objects(unsigned char *library, size_t len) {
  AsperityConfig config;
  AsperityError error;
  AsperityRenderer *renderer;
  AsperityTexture *texture;
  AsperityState *state;
  AsperityOutput output;
  AsperityCounters counters;
  const AsperitySample pressed = {{0.0f, 0.0f, -0.001f}, 1};
  EXPECT(OK, asperity_config_default(&config));
  EXPECT(NOT_INITIALISED, asperity_texture_load_index((AsperityTexture *)texture_memory, library, len, 0, 1000.0f, NULL));
  EXPECT(OK, asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, NULL));
  EXPECT(OK, asperity_texture_init(texture_memory, sizeof texture_memory, &texture));
  EXPECT(OK, asperity_state_init(state_memory, sizeof state_memory, 1, &state));

  output.force_n[2] = 99.0f;
  EXPECT(RATE, asperity_tick(renderer, texture, state, &pressed, &output)); /* nothing loaded */
  CHECK(output.force_n[2] == 0.0f && output.flags == ASPERITY_FLAG_SAFE_STATE);
  EXPECT(RATE, asperity_texture_load_index(texture, library, len, 0, 1500.0f, &error));
  CHECK(strstr(error.message, "1500 Hz") != NULL);
  EXPECT(RATE, asperity_texture_load_index(texture, library, len, 0, NAN, NULL));
  EXPECT(OK, asperity_texture_load_index(texture, library, len, 0, 1000.0f, &error));
  EXPECT(NO_SUCH_TEXTURE, asperity_texture_load_index(texture, library, len, 1000, 1000.0f, &error));
  EXPECT(FORMAT, asperity_texture_load_asset(texture, library, len, 1000.0f, &error));
  EXPECT(FORMAT, asperity_texture_load_index(texture, library, len - 1, 0, 1000.0f, &error));
  EXPECT(NULL_POINTER, asperity_texture_load_index(texture, NULL, len, 0, 1000.0f, &error));
  EXPECT(NULL_POINTER, asperity_texture_load_name(texture, library, len, NULL, 1000.0f, &error));
  library[len - 1] ^= 1; /* the last texture's preview, or its last haptic section */
  library[len / 2] ^= 1;
  (void)asperity_texture_load_index(texture, library, len, 0, 1000.0f, &error);
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
  EXPECT(NULL_POINTER, asperity_state_counters(NULL, &counters));
  EXPECT(NULL_POINTER, asperity_state_counters(state, NULL));
  EXPECT(OK, asperity_state_counters(state, &counters));
  CHECK(counters.ticks == 1);

  /* Every sample is a valid call. */
  const float odd[] = {NAN, INFINITY, -INFINITY, 1e38f, -0.0f};
  for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
    const AsperitySample sample = {{odd[i], 0.0f, odd[i]}, (uint32_t)(i * 1000000000u)};
    EXPECT(OK, asperity_tick(renderer, texture, state, &sample, &output));
    CHECK(isfinite(output.force_n[0]) && isfinite(output.force_n[1]) && isfinite(output.force_n[2]));
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
  of_libraries(library, len);
  of_objects(library, len);
  printf("%u failures\n", failures);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
