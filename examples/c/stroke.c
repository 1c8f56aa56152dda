/* A stroke on a texture, from C: memory, load, tick, and a device that is lost.
 *
 *   stroke TEXTURE.asp
 *
 * Exits with 1 when the texture cannot be loaded or a force is left on a lost device. */
#include "asperity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The caller owns all memory; there is nothing to release. */
static ASPERITY_ALIGNED unsigned char texture_memory[ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char state_memory[ASPERITY_STATE_SIZE];

/* Every function returns a status; an error says which field, its value and the rule. */
static void require(AsperityStatus status, const char *what, const AsperityError *error) {
  if (status == ASPERITY_STATUS_OK) return;
  fprintf(stderr, "%s: %s\n", what, error != NULL ? error->message : asperity_error_text(status));
  exit(EXIT_FAILURE);
}

int main(int argc, char **argv) {
  static unsigned char bytes[1 << 20];
  FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
  if (file == NULL) {
    fprintf(stderr, "usage: %s TEXTURE.asp\n", argv[0]);
    return 2;
  }
  size_t len = fread(bytes, 1, sizeof bytes, file);
  fclose(file);

  AsperityError error = ASPERITY_ERROR_INIT;
  AsperityConfig config; /* Of another device: change fields between these two calls. */
  AsperityRenderer *renderer;
  require(asperity_config_default(&config, sizeof config), "configuration", NULL);
  require(asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, &error),
          "renderer", &error);

  AsperityTexture *texture; /* The slot keeps no pointer into the bytes. */
  require(asperity_texture_init(texture_memory, sizeof texture_memory, renderer,
                                ASPERITY_CAPACITY_LARGE, &texture),
          "slot", NULL);
  require(asperity_texture_load_asset(texture, bytes, len, &error), argv[1], &error);

  AsperityState *state; /* The same seed and the same samples give the same bits. */
  require(asperity_state_init(state_memory, sizeof state_memory, renderer, 1, &state), "state", NULL);

  printf("%5s %8s %8s %8s %8s\n", "ms", "mm/s", "fx N", "fz N", "state");
  AsperityOutput output = ASPERITY_OUTPUT_INIT;
  for (int tick = 0; tick < 1000; tick++) {
    /* A servo loop waits for its period and asks its device here. This one moves by itself: down
     * for 0.1 s, then along x at 100 mm/s, 1.5 mm deep. After 0.9 s the device is lost. */
    AsperitySample sample = ASPERITY_SAMPLE_INIT;
    sample.position_m[0] = 1.0e-4f * (float)(tick < 100 ? 0 : tick - 100);
    sample.position_m[2] = tick < 100 ? 2.5e-3f - 4.0e-5f * (float)tick : -1.5e-3f;
    if (tick >= 900) sample.elapsed_ticks = 0;
    require(asperity_tick(renderer, texture, state, &sample, &output), "tick", NULL);
    if (tick % 100 == 99) {
      const char *now = (output.flags & ASPERITY_FLAG_SAFE_STATE)  ? "safe"
                        : (output.flags & ASPERITY_FLAG_CONTACT) ? "contact" : "air";
      printf("%5d %8.1f %8.3f %8.3f %8s\n", tick + 1, (double)output.speed_mm_s,
             (double)output.force_n[0], (double)output.force_n[2], now);
    }
  }

  AsperityCounters counters = ASPERITY_COUNTERS_INIT;
  require(asperity_state_counters(state, &counters), "counters", NULL);
  printf("%u ticks, %u taps, %u faults\n", (unsigned)counters.ticks, (unsigned)counters.taps,
         (unsigned)counters.faults);
  int left = fabsf(output.force_n[0]) + fabsf(output.force_n[1]) + fabsf(output.force_n[2]) > 0.0f;
  if (left) fprintf(stderr, "a force was left on a lost device\n");
  return left ? EXIT_FAILURE : EXIT_SUCCESS;
}
