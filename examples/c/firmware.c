/* A stroke over a texture in flash, on a Cortex-M4F without an operating system.
 *
 *   asperity export sandpaper.asp --to c-array -o texture.c --symbol texture_image
 *   arm-none-eabi-gcc -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard -O2 -nostdlib -T firmware.ld \
 *     -Iinclude firmware.c texture.c lib/libasperity.a -Wl,--gc-sections -lgcc -o firmware
 *
 * Prints the forces of 600 ticks as the bits of three floats. Semihosting needs a debugger or QEMU: on hardware of your
 * own, call `asperity_tick` in the handler of a timer, and send the forces to the device. */
#include "asperity.h"
#include "texture.h"

extern unsigned char stack_top[], data_start[], data_end[], data_in_flash[], bss_start[], bss_end[];

static ASPERITY_ALIGNED unsigned char texture_memory[ASPERITY_TEXTURE_SIZE_LARGE];
static ASPERITY_ALIGNED unsigned char renderer_memory[ASPERITY_RENDERER_SIZE];
static ASPERITY_ALIGNED unsigned char state_memory[ASPERITY_STATE_SIZE];

static void semihosting(unsigned operation, const void *argument) {
  register unsigned r0 __asm__("r0") = operation;
  register const void *r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}
static void print(const char *text) { semihosting(0x04, text); }
static void leave(unsigned status) {
  const unsigned reason[2] = {0x20026, status}; /* The application exits. */
  semihosting(0x20, reason);
  for (;;) {}
}
static void require(AsperityStatus status, const AsperityError *error) {
  if (status == ASPERITY_STATUS_OK) return;
  print(error != NULL ? error->message : asperity_error_text(status));
  print("\n");
  leave(1);
}

static void print_bits(const float force_n[3]) {
  char line[28], *at = line;
  for (int axis = 0; axis < 3; axis++) {
    union { float value; unsigned bits; } force = {force_n[axis]};
    for (int shift = 28; shift >= 0; shift -= 4) *at++ = "0123456789abcdef"[force.bits >> shift & 15];
    *at++ = axis < 2 ? ' ' : '\n';
  }
  *at = '\0';
  print(line);
}

static void stroke(void) {
  AsperityError error = ASPERITY_ERROR_INIT;
  AsperityConfig config;
  AsperityRenderer *renderer;
  AsperityTexture *texture;
  AsperityState *state;
  require(asperity_config_default(&config, sizeof config), NULL);
  require(asperity_renderer_init(renderer_memory, sizeof renderer_memory, &config, &renderer, &error), &error);
  require(asperity_texture_init(texture_memory, sizeof texture_memory, renderer, ASPERITY_CAPACITY_LARGE, &texture), NULL);
  require(asperity_texture_load_asset(texture, texture_image, sizeof texture_image, &error), &error);
  require(asperity_state_init(state_memory, sizeof state_memory, renderer, 1, &state), NULL);
  for (int tick = 0; tick < 600; tick++) {
    /* Down to a depth of 0.75 mm, and along at 125 mm/s: doubles and floats hold these numbers exactly. */
    double depth_mm = tick < 112 ? tick / 64.0 - 1.0 : 0.75;
    AsperitySample sample = ASPERITY_SAMPLE_INIT;
    AsperityOutput out = ASPERITY_OUTPUT_INIT;
    sample.position_m[0] = (float)(tick * 0.125 / 1000.0);
    sample.position_m[2] = (float)(-depth_mm / 1000.0);
    require(asperity_tick(renderer, texture, state, &sample, &out), NULL);
    print_bits(out.force_n);
  }
}

static void reset(void) {
  /* The FPU is off after a reset. */
  *(volatile unsigned *)0xe000ed88 |= 0xfu << 20;
  __asm__ volatile("dsb\n\tisb" ::: "memory");
  for (unsigned char *to = data_start, *from = data_in_flash; to < data_end;) *to++ = *from++;
  for (unsigned char *to = bss_start; to < bss_end;) *to++ = 0;
  stroke();
  leave(0);
}
static void fault(void) {
  print("fault\n");
  leave(1);
}

__attribute__((section(".vectors"), used)) static const void *const vectors[] = {
    stack_top, (const void *)reset, (const void *)fault, (const void *)fault,
    (const void *)fault, (const void *)fault, (const void *)fault,
};
