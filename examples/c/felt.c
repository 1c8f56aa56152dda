/* What a hand feels along a trajectory: `asperity render`, in C.
 *
 *   felt TEXTURE.asp SEED < in.csv > out.csv
 *
 * The columns are those of `asperity render`. Nine digits name a float exactly. */
#include "asperity.h"

#include <stdio.h>
#include <stdlib.h>

static ASPERITY_ALIGNED unsigned char texture_memory[ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char state_memory[ASPERITY_STATE_SIZE];

static void require(AsperityStatus status, const char *what, const AsperityError *error) {
  if (status == ASPERITY_STATUS_OK) return;
  fprintf(stderr, "%s: %s\n", what, error != NULL ? error->message : asperity_error_text(status));
  exit(EXIT_FAILURE);
}

int main(int argc, char **argv) {
  static unsigned char bytes[1 << 20];
  FILE *file = argc == 3 ? fopen(argv[1], "rb") : NULL;
  if (file == NULL) {
    fprintf(stderr, "usage: %s TEXTURE.asp SEED < in.csv > out.csv\n", argv[0]);
    return 2;
  }
  size_t len = fread(bytes, 1, sizeof bytes, file);
  fclose(file);

  AsperityError error = ASPERITY_ERROR_INIT;
  AsperityConfig config;
  AsperityRenderer *renderer;
  AsperityTexture *texture;
  AsperityState *state;
  require(asperity_config_default(&config, sizeof config), "configuration", NULL);
  require(asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, &error),
          "renderer", &error);
  require(asperity_texture_init(texture_memory, sizeof texture_memory, renderer,
                                ASPERITY_CAPACITY_LARGE, &texture),
          "slot", NULL);
  require(asperity_texture_load_asset(texture, bytes, len, &error), argv[1], &error);
  require(asperity_state_init(state_memory, sizeof state_memory, renderer,
                              strtoull(argv[2], NULL, 10), &state),
          "state", NULL);

  char header[64];
  if (fgets(header, sizeof header, stdin) == NULL) return EXIT_FAILURE;
  puts("tick,t_s,depth_mm,speed_mm_s,normal_force_n,vib_m_s2,tap_n,friction_n,fx_n,fy_n,fz_n,flags");
  double t_s, mm[3];
  for (int tick = 0; scanf("%lf,%lf,%lf,%lf", &t_s, &mm[0], &mm[1], &mm[2]) == 4; tick++) {
    AsperitySample sample = ASPERITY_SAMPLE_INIT;
    AsperityOutput out = ASPERITY_OUTPUT_INIT;
    for (int axis = 0; axis < 3; axis++) sample.position_m[axis] = (float)(mm[axis] / 1000.0);
    require(asperity_tick(renderer, texture, state, &sample, &out), "tick", NULL);
    printf("%d,%.17g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%u\n", tick, t_s,
           (double)(out.depth_m * 1000.0f), (double)out.speed_mm_s, (double)out.normal_force_n,
           (double)out.vib_m_s2, (double)out.tap_n, (double)out.friction_n, (double)out.force_n[0],
           (double)out.force_n[1], (double)out.force_n[2], (unsigned)out.flags);
  }
  return EXIT_SUCCESS;
}
