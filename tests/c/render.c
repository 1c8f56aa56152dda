/* Renders a trajectory with a texture of a library and prints every force.
 *
 *   render LIBRARY.aspl NAME < trajectory.txt
 *
 * A line of input is a position, x y z in metres; "nan nan nan" stands for a device that
 * had nothing new. A line of output is a force, x y z in newtons. */
#include "asperity.h"

#include <stdio.h>
#include <stdlib.h>

static ASPERITY_ALIGNED unsigned char texture_memory[ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char state_memory[ASPERITY_STATE_SIZE];

static void require(AsperityStatus status, const char *what, const AsperityError *error) {
  if (status == ASPERITY_STATUS_OK) return;
  fprintf(stderr, "%s: %s", what, asperity_error_text(status));
  if (error != NULL) fprintf(stderr, " (%s)", error->message);
  fputc('\n', stderr);
  exit(EXIT_FAILURE);
}

static unsigned char *read_file(const char *path, size_t *len) {
  FILE *file = fopen(path, "rb");
  if (file == NULL || fseek(file, 0, SEEK_END) != 0) {
    perror(path);
    exit(EXIT_FAILURE);
  }
  *len = (size_t)ftell(file);
  rewind(file);
  unsigned char *bytes = malloc(*len);
  if (bytes == NULL || fread(bytes, 1, *len, file) != *len) {
    perror(path);
    exit(EXIT_FAILURE);
  }
  fclose(file);
  return bytes;
}

int main(int argc, char **argv) {
  if (argc != 3) {
    fprintf(stderr, "usage: %s LIBRARY.aspl NAME < trajectory.txt\n", argv[0]);
    return 2;
  }
  AsperityError error = ASPERITY_ERROR_INIT;
  AsperityConfig config;
  require(asperity_config_default(&config, sizeof config), "configuration", NULL);
  AsperityRenderer *renderer;
  require(asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, &error),
          "renderer", &error);

  AsperityTexture *texture;
  require(asperity_texture_init(texture_memory, sizeof texture_memory, renderer,
                                ASPERITY_CAPACITY_LARGE, &texture), "texture", NULL);
  size_t len;
  unsigned char *library = read_file(argv[1], &len);
  require(asperity_texture_load_name(texture, library, len, argv[2], &error), argv[1], &error);
  free(library); /* The slot keeps nothing of it. */

  AsperityState *state;
  require(asperity_state_init(state_memory, sizeof state_memory, renderer, 7, &state), "state", NULL);

  /* A servo loop waits for its period here; this one reads the next line. */
  AsperitySample sample = ASPERITY_SAMPLE_INIT; /* One period after the sample before. */
  AsperityOutput output = ASPERITY_OUTPUT_INIT;
  while (scanf("%f %f %f", &sample.position_m[0], &sample.position_m[1], &sample.position_m[2]) == 3) {
    require(asperity_tick(renderer, texture, state, &sample, &output), "tick", NULL);
    /* Nine digits name a float exactly. */
    printf("%.9g %.9g %.9g\n", output.force_n[0], output.force_n[1], output.force_n[2]);
  }

  AsperityCounters counters = ASPERITY_COUNTERS_INIT;
  char words[ASPERITY_TEXT_SIZE];
  require(asperity_state_counters(state, &counters), "counters", NULL);
  require(asperity_counters_text(&counters, words, sizeof words), "counters", NULL);
  fprintf(stderr, "asperity %s: %s\n", asperity_version(), words);
  return EXIT_SUCCESS;
}
