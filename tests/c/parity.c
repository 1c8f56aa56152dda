/* Renders a trajectory in one of several ways and prints every force with its flags and surface.
 *
 *   parity float|fixed|small|medium LIBRARY.aspl NAME     one texture
 *   parity scene|scene-fixed LIBRARY.aspl                 a scene
 *   parity exchange LIBRARY.aspl NAME NEXT                NEXT is sent after 1000 ticks
 *
 * Positions come from the standard input, as `render` reads them. Every tick is also recorded, and
 * the records must be what was printed. */
#include "asperity.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char texture_memory[ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char state_memory[ASPERITY_STATE_SIZE];
static ASPERITY_ALIGNED unsigned char scene_memory[ASPERITY_SCENE_SIZE + 8 * ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char scene_state_memory[ASPERITY_SCENE_STATE_SIZE];
static ASPERITY_ALIGNED unsigned char exchange_memory[ASPERITY_EXCHANGE_SIZE + 3 * ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char recorder_memory[ASPERITY_RECORDER_SIZE + 4 * ASPERITY_RECORDER_RECORD_SIZE];
static unsigned char library[1 << 20];

static void require(AsperityStatus status, const char *what, const AsperityError *error) {
  if (status == ASPERITY_STATUS_OK) return;
  fprintf(stderr, "%s: %s (%s)\n", what, asperity_error_text(status), error == NULL ? "" : error->message);
  exit(EXIT_FAILURE);
}

static void require_record(AsperityRecorder *recorder, unsigned long number, const AsperityOutput *output) {
  AsperityRecord record;
  size_t count = 0;
  uint32_t lost = 1;
  require(asperity_recorder_read(recorder, &record, sizeof record, 1, &count, &lost), "record", NULL);
  if (count != 1 || lost != 0 || record.tick != number || record.flags != output->flags ||
      memcmp(record.force_n, output->force_n, sizeof record.force_n) != 0) {
    fprintf(stderr, "record %lu is not the tick\n", number);
    exit(EXIT_FAILURE);
  }
}

int main(int argc, char **argv) {
  if (argc < 3) return 2;
  const char *way = argv[1];
  const int scenic = strncmp(way, "scene", 5) == 0, exchanged = strcmp(way, "exchange") == 0;
  const int fixed = strstr(way, "fixed") != NULL;
  const uint32_t capacity = strcmp(way, "small") == 0    ? ASPERITY_CAPACITY_SMALL
                            : strcmp(way, "medium") == 0 ? ASPERITY_CAPACITY_MEDIUM
                                                         : ASPERITY_CAPACITY_LARGE;
  FILE *file = fopen(argv[2], "rb");
  if (file == NULL) return 2;
  const size_t len = fread(library, 1, sizeof library, file);
  fclose(file);

  AsperityError error = ASPERITY_ERROR_INIT;
  AsperityConfig config;
  AsperityRenderer *renderer = NULL;
  AsperityTexture *texture = NULL;
  AsperityState *state = NULL;
  AsperityScene *scene = NULL;
  AsperitySceneState *scene_state = NULL;
  AsperityPreparer *preparer = NULL;
  AsperityPlayer *player = NULL;
  AsperityRecorder *recorder = NULL;
  AsperityCounters counters = ASPERITY_COUNTERS_INIT;
  require(asperity_config_default(&config, sizeof config), "configuration", NULL);
  config.arithmetic = fixed ? ASPERITY_ARITHMETIC_FIXED : ASPERITY_ARITHMETIC_FLOAT;
  require(asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, &error), "renderer", &error);
  require(asperity_recorder_init(recorder_memory, sizeof recorder_memory, &recorder), "recorder", NULL);
  if (scenic) {
    uint32_t least = 0;
    size_t size = 0;
    require(asperity_library_capacity(library, len, config.servo_rate_hz, &least, &error), "capacity", &error);
    require(asperity_scene_size(library, len, least, &size, &error), "size", &error);
    require(asperity_scene_init(scene_memory, size, renderer, least, library, len, &scene, &error), "scene", &error);
    require(asperity_scene_state_init(scene_state_memory, sizeof scene_state_memory, renderer, 7, &scene_state), "state", NULL);
  } else if (exchanged) {
    require(asperity_exchange_init(exchange_memory, sizeof exchange_memory, renderer, capacity, 2, 7, &preparer, &player),
            "exchange", NULL);
    require(asperity_preparer_load_name(preparer, library, len, argv[3], &error), argv[3], &error);
  } else {
    require(asperity_texture_init(texture_memory, sizeof texture_memory, renderer, capacity, &texture), "slot", NULL);
    require(asperity_texture_load_name(texture, library, len, argv[3], &error), argv[3], &error);
    require(asperity_state_init(state_memory, sizeof state_memory, renderer, 7, &state), "state", NULL);
  }

  AsperitySample sample = ASPERITY_SAMPLE_INIT;
  AsperityOutput output = ASPERITY_OUTPUT_INIT;
  unsigned long tick = 0;
  for (; scanf("%f %f %f", &sample.position_m[0], &sample.position_m[1], &sample.position_m[2]) == 3; tick++) {
    if (exchanged && tick == 1000) {
      require(asperity_preparer_load_name(preparer, library, len, argv[4], &error), argv[4], &error);
    }
    if (scenic) {
      require(asperity_scene_tick(renderer, scene, scene_state, &sample, &output), "tick", NULL);
    } else if (exchanged) {
      require(asperity_player_tick(renderer, player, &sample, &output), "tick", NULL);
    } else {
      require(asperity_tick(renderer, texture, state, &sample, &output), "tick", NULL);
    }
    require(asperity_recorder_write(recorder, &sample, &output), "record", NULL);
    require_record(recorder, tick, &output);
    printf("%.9g %.9g %.9g %lu %lu\n", output.force_n[0], output.force_n[1], output.force_n[2],
           (unsigned long)output.flags, (unsigned long)output.surface);
  }
  if (scenic) require(asperity_scene_state_counters(scene_state, &counters), "counters", NULL);
  else if (exchanged) require(asperity_player_counters(player, &counters), "counters", NULL);
  else require(asperity_state_counters(state, &counters), "counters", NULL);
  if (counters.ticks != tick) return EXIT_FAILURE;
  return EXIT_SUCCESS;
}
