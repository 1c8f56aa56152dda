/* A library of our own that exports the functions of Force Dimension DHD over a small simulated
   device, for tests. Calls are logged. Functions that begin with `fake_` are for the tests alone. */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static char calls[1 << 16];
static size_t used;
static int open_error, read_error, write_error, last_error, force_off_cause;
static int is_open, force_on, calibrated = 1, guarded, saturated;
static double position[3] = {0.01, 0.02, 0.03}, force[3];
static unsigned buttons;

static void note(const char *text) {
  size_t length = strlen(text);
  if (used + length + 2 < sizeof calls) {
    memcpy(calls + used, text, length);
    used += length;
    calls[used++] = ' ';
    calls[used] = 0;
  }
}

const char *fake_calls(void) { return calls; }
void fake_open_error(int code) { open_error = code; }
void fake_read_error(int code) { read_error = code; }
void fake_write_error(int code, int cause) {
  write_error = code;
  force_off_cause = cause;
}
void fake_calibrated(int yes) { calibrated = yes; }
void fake_guarded(int yes) { guarded = yes; }
void fake_saturated(int yes) { saturated = yes; }
void fake_place(double x, double y, double z) {
  position[0] = x;
  position[1] = y;
  position[2] = z;
}
void fake_buttons(unsigned mask) { buttons = mask; }
double fake_force(int axis) { return force[axis]; }
int fake_is_open(void) { return is_open; }

static int failed(int code) {
  last_error = code;
  return -1;
}

int dhdOpen(void) {
  note("open");
  if (open_error) return failed(open_error);
  is_open = 1;
  return 0;
}

int dhdOpenSerial(int serial) {
  char text[32];
  snprintf(text, sizeof text, "open:%d", serial);
  note(text);
  if (open_error) return failed(open_error);
  if (serial != 4321) return failed(5);
  is_open = 1;
  return 3;
}

int dhdClose(signed char id) {
  note("close");
  (void)id;
  is_open = 0;
  return 0;
}

int dhdEnableForce(bool on, signed char id) {
  (void)id;
  note(on ? "force_on" : "force_off");
  force_on = on;
  return 0;
}

int dhdGetPosition(double *x, double *y, double *z, signed char id) {
  (void)id;
  if (!is_open) return failed(2);
  if (read_error) return failed(read_error);
  *x = position[0];
  *y = position[1];
  *z = position[2];
  return guarded ? 1 : 0;
}

unsigned dhdGetButtonMask(signed char id) {
  (void)id;
  return buttons;
}

int dhdSetForce(double x, double y, double z, signed char id) {
  (void)id;
  if (x == 0 && y == 0 && z == 0) note("zero");
  if (write_error) return failed(write_error);
  force[0] = force_on ? x : 0;
  force[1] = force_on ? y : 0;
  force[2] = force_on ? z : 0;
  return saturated ? 2 : 0;
}

int dhdGetStatus(int *status, signed char id) {
  (void)id;
  memset(status, 0, 17 * sizeof *status);
  status[3] = calibrated;
  status[5] = force_on && !force_off_cause;
  status[14] = force_off_cause;
  return 0;
}

const char *dhdGetSystemName(signed char id) {
  (void)id;
  return "omega.3";
}

int dhdGetSerialNumber(unsigned short *serial, signed char id) {
  (void)id;
  *serial = 4321;
  return 0;
}

int dhdErrorGetLast(void) { return last_error; }

const char *dhdErrorGetStr(int code) {
  return code == 5 ? "no device found" : "some error";
}
