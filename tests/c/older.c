/* A program of the older header in `old/`: the library must touch no more than its structs have.
 *
 *   older LIBRARY.aspl */
#include "asperity.h"

#include <stdio.h>
#include <stdlib.h>

static ASPERITY_ALIGNED unsigned char texture_memory[ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char state_memory[ASPERITY_STATE_SIZE];
static struct { AsperityConfig known; uint32_t behind; } config = {.behind = 0xfeedbeef};
static struct { AsperityOutput known; uint32_t behind; } output = {ASPERITY_OUTPUT_INIT, 0xfeedbeef};
static unsigned char library[1 << 20];

static void require(AsperityStatus status, const char *what) {
  if (status == ASPERITY_STATUS_OK) return;
  fprintf(stderr, "%s: %s\n", what, asperity_error_text(status));
  exit(EXIT_FAILURE);
}

int main(int argc, char **argv) {
  FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
  if (file == NULL) return 2;
  const size_t len = fread(library, 1, sizeof library, file);
  AsperityRenderer *renderer;
  AsperityTexture *texture;
  AsperityState *state;
  AsperitySample sample = ASPERITY_SAMPLE_INIT;
  fclose(file);
  require(asperity_config_default(&config.known, sizeof config.known), "configuration");
  require(asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config.known, &renderer, NULL), "renderer");
  require(asperity_texture_init(texture_memory, sizeof texture_memory, renderer, ASPERITY_CAPACITY_LARGE, &texture),
          "slot");
  require(asperity_texture_load_index(texture, library, len, 0, NULL), "texture");
  require(asperity_state_init(state_memory, sizeof state_memory, renderer, 1, &state), "state");
  sample.position_m[2] = -0.001f;
  require(asperity_tick(renderer, texture, state, &sample, &output.known), "tick");
  if (config.behind != 0xfeedbeef || output.behind != 0xfeedbeef || !(output.known.force_n[2] > 0.0f)) {
    fprintf(stderr, "the library wrote behind a struct of the older header, or gave no force\n");
    return EXIT_FAILURE;
  }
  printf("%lu %lu\n", (unsigned long)sizeof config.known, (unsigned long)sizeof output.known);
  return asperity_version_number() >= ASPERITY_VERSION ? EXIT_SUCCESS : EXIT_FAILURE;
}
