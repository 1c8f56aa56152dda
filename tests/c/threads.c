/* A servo loop, a thread that swaps its textures and a thread that reads its records.
 *
 *   threads LIBRARY.aspl, of at least two textures */
#define _POSIX_C_SOURCE 200809L
#include "asperity.h"

#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>

enum { TICKS = 200000, RECORDS = 64 };
static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char exchange_memory[ASPERITY_EXCHANGE_SIZE + 4 * ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char recorder_memory[ASPERITY_RECORDER_SIZE + RECORDS * ASPERITY_RECORDER_RECORD_SIZE];
static unsigned char library[1 << 20];
static size_t len;
static AsperityRenderer *renderer;
static AsperityPreparer *preparer;
static AsperityPlayer *player;
static AsperityRecorder *recorder;
static unsigned long loads, busy, read_records, gaps;
static uint32_t lost;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int over;

static void require(AsperityStatus status, const char *what) {
  if (status == ASPERITY_STATUS_OK) return;
  fprintf(stderr, "%s: %s\n", what, asperity_error_text(status));
  exit(EXIT_FAILURE);
}

/* The program's own; the library needs no lock. */
static int is_over(void) {
  pthread_mutex_lock(&lock);
  const int found = over;
  pthread_mutex_unlock(&lock);
  return found;
}

static void *swap(void *none) {
  while (!is_over()) {
    const AsperityStatus status = asperity_preparer_load_index(preparer, library, len, loads % 2, NULL);
    if (status == ASPERITY_STATUS_BUSY) {
      busy++;
      sched_yield();
    } else {
      require(status, "load");
      loads++;
    }
  }
  return none;
}

static void drain(uint64_t *next) {
  AsperityRecord records[16];
  size_t count;
  do {
    require(asperity_recorder_read(recorder, records, sizeof *records, 16, &count, &lost), "records");
    for (size_t i = 0; i < count; i++) {
      /* A torn record would not name its tick twice. */
      if (records[i].tick < *next || records[i].elapsed_ticks != 1 ||
          records[i].position_m[1] != (float)(records[i].tick % 1024) / 1024.0f) {
        fprintf(stderr, "a record is out of order or torn\n");
        exit(EXIT_FAILURE);
      }
      gaps += (unsigned long)(records[i].tick - *next);
      *next = records[i].tick + 1;
      read_records++;
    }
  } while (count > 0);
}

static void *listen(void *none) {
  uint64_t next = 0;
  while (!is_over()) drain(&next);
  drain(&next);
  gaps += (unsigned long)(TICKS - next);
  return none;
}

int main(int argc, char **argv) {
  FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
  AsperityConfig config;
  AsperitySample sample = ASPERITY_SAMPLE_INIT;
  AsperityOutput output = ASPERITY_OUTPUT_INIT;
  pthread_t swapping, listening;
  double sum = 0.0;
  if (file == NULL) return 2;
  len = fread(library, 1, sizeof library, file);
  fclose(file);
  require(asperity_config_default(&config, sizeof config), "configuration");
  require(asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, NULL), "renderer");
  require(asperity_exchange_init(exchange_memory, sizeof exchange_memory, renderer, ASPERITY_CAPACITY_LARGE, 3, 7,
                                 &preparer, &player), "exchange");
  require(asperity_recorder_init(recorder_memory, sizeof recorder_memory, &recorder), "recorder");
  if (pthread_create(&swapping, NULL, swap, NULL) != 0 || pthread_create(&listening, NULL, listen, NULL) != 0) return 2;
  for (uint64_t tick = 0; tick < TICKS; tick++) {
    const float way = (float)(tick % 400) * 1.0e-4f;
    sample.position_m[0] = way < 0.02f ? way : 0.04f - way;
    sample.position_m[1] = (float)(tick % 1024) / 1024.0f;
    sample.position_m[2] = -0.001f;
    require(asperity_player_tick(renderer, player, &sample, &output), "tick");
    if (!isfinite(output.force_n[0]) || !isfinite(output.force_n[2])) return EXIT_FAILURE;
    sum += (double)output.force_n[2];
    require(asperity_recorder_write(recorder, &sample, &output), "record");
  }
  pthread_mutex_lock(&lock);
  over = 1;
  pthread_mutex_unlock(&lock);
  pthread_join(swapping, NULL);
  pthread_join(listening, NULL);
  printf("%lu loads, %lu times busy, %lu records read, %lu lost\n", loads, busy, read_records, (unsigned long)lost);
  if (loads < 5 || sum <= 0.0 || read_records + gaps != TICKS || lost != gaps) {
    fprintf(stderr, "%lu gaps, force %g\n", gaps, sum);
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
