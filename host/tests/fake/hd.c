/* A library of our own that exports the functions of OpenHaptics HD over a small simulated device,
   for tests. Calls are logged. Functions that begin with `fake_` are for the tests alone.

   WITHOUT_X leaves out a function. With MANUAL the scheduler has no thread: fake_period() is a
   period. */
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

typedef struct {
  unsigned code;
  int internal;
  unsigned device;
} ErrorInfo;
typedef unsigned (*Callback)(void *);

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static char calls[1 << 16];
static size_t used;

static atomic_uint pending;      /* error that the next hdGetError takes */
static atomic_uint persistent;   /* error of every frame */
static atomic_uint init_error;   /* error of hdInitDevice */
static atomic_uint calibration = 0x5000;
static atomic_int manual_only, frozen, is_open, force_on, running, in_frame, out_of_frame;
static atomic_uint periods;
#ifndef MANUAL
static pthread_t thread;
#endif
static Callback callback;
static void *user;
static double position[3] = {1, 2, 3}, velocity[3], force[3], last_force[3];
static double largest_step, largest_force, push[3];
static int buttons;

static void note(const char *text) {
  pthread_mutex_lock(&lock);
  size_t length = strlen(text);
  if (used + length + 2 < sizeof calls) {
    memcpy(calls + used, text, length);
    used += length;
    calls[used++] = ' ';
    calls[used] = 0;
  }
  pthread_mutex_unlock(&lock);
}

const char *fake_calls(void) { return calls; }
void fake_pending(unsigned code) { pending = code; }
void fake_persistent(unsigned code) { persistent = code; }
void fake_init_error(unsigned code) { init_error = code; }
void fake_calibration(unsigned code, int manual) {
  calibration = code;
  manual_only = manual;
}
void fake_freeze(int on) { frozen = on; }
void fake_place(double x, double y, double z) {
  position[0] = x;
  position[1] = y;
  position[2] = z;
}
void fake_buttons(int mask) { buttons = mask; }
double fake_force(int axis) { return force[axis]; }
double fake_largest_step(void) { return largest_step; }
double fake_largest_force(void) { return largest_force; }
unsigned fake_periods(void) { return periods; }
int fake_is_open(void) { return is_open; }
int fake_out_of_frame(void) { return out_of_frame; }

unsigned hdInitDevice(const char *name) {
  char text[96];
  snprintf(text, sizeof text, "init:%s", name ? name : "default");
  note(text);
  if (init_error) {
    pending = init_error;
    return 0xFFFFFFFFu;
  }
  is_open = 1;
  return 7;
}

void hdDisableDevice(unsigned device) {
  note(device == 7 ? "disable_device" : "disable_device?");
  is_open = 0;
}

void hdMakeCurrentDevice(unsigned device) { note(device == 7 ? "current" : "current?"); }

void hdBeginFrame(unsigned device) {
  if (device != 7 || in_frame) out_of_frame = 1;
  in_frame = 1;
}

void hdEndFrame(unsigned device) {
  if (device != 7 || !in_frame) out_of_frame = 1;
  in_frame = 0;
  double way = 0, size = 0;
  for (int i = 0; i < 3; i++) {
    double step = force[i] - last_force[i];
    way += step * step;
    size += force[i] * force[i];
    last_force[i] = force[i];
    /* A mass of 0.1 kg with much damping, in mm. */
    velocity[i] += 1e-3 * (1e3 * (force[i] + push[i]) / 0.1 - 50 * velocity[i]);
    position[i] += 1e-3 * velocity[i];
  }
  if (sqrt(way) > largest_step) largest_step = sqrt(way);
  if (sqrt(size) > largest_force) largest_force = sqrt(size);
}

#ifndef WITHOUT_hdGetError
ErrorInfo hdGetError(void) {
  ErrorInfo info = {atomic_exchange(&pending, 0), 42, 7};
  return info;
}
#endif

const char *hdGetErrorString(unsigned code) {
  switch (code) {
    case 0x0200: return "HD_WARM_MOTORS";
    case 0x0301: return "HD_DEVICE_ALREADY_INITIATED";
    case 0x0302: return "HD_COMM_ERROR";
    case 0x0303: return "HD_COMM_CONFIG_ERROR";
    default: return "some error";
  }
}

void hdEnable(unsigned what) {
  note(what == 0x4000 ? "enable_force" : "enable?");
  force_on = 1;
}

void hdDisable(unsigned what) {
  note(what == 0x4000 ? "disable_force" : "disable?");
  force_on = 0;
}

void hdGetDoublev(unsigned what, double *out) {
  switch (what) {
    case 0x2050:
      if (!in_frame) out_of_frame = 1;
      memcpy(out, position, sizeof position);
      break;
    case 0x2603: *out = 3.3; break;
    case 0x2604: *out = 0.88; break;
    default: pending = 0x0100;
  }
}

void hdSetDoublev(unsigned what, const double *in) {
  if (what != 0x2700 || !in_frame) out_of_frame = 1;
  for (int i = 0; i < 3; i++) force[i] = force_on ? in[i] : 0;
}

void hdGetIntegerv(unsigned what, int *out) {
  switch (what) {
    case 0x2000: *out = buttons; break;
    case 0x2555: *out = 4; break;
    default: pending = 0x0100;
  }
}

const char *hdGetString(unsigned what) {
  switch (what) {
    case 0x2501: return "Touch";
    case 0x2503: return "3D Systems";
    case 0x2504: return "A1B2";
    default: pending = 0x0100; return 0;
  }
}

unsigned hdCheckCalibration(void) { return calibration; }

void hdUpdateCalibration(unsigned style) {
  note(style == 4 ? "calibrate:inkwell" : "calibrate?");
  if (!manual_only) calibration = 0x5000;
}

void fake_period(void) {
  if (!running || frozen || !callback) return;
  callback(user);
  if (persistent) pending = persistent;
  periods++;
}

#ifndef MANUAL
static void *run(void *nothing) {
  struct timespec next;
  clock_gettime(CLOCK_MONOTONIC, &next);
  while (running) {
    fake_period();
    next.tv_nsec += 1000000;
    if (next.tv_nsec >= 1000000000) {
      next.tv_nsec -= 1000000000;
      next.tv_sec++;
    }
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, 0);
  }
  return nothing;
}
#endif

void hdStartScheduler(void) {
  note("start_scheduler");
  if (running) return;
  running = 1;
#ifdef MANUAL
  fake_period();
#else
  pthread_create(&thread, 0, run, 0);
#endif
}

void hdStopScheduler(void) {
  note("stop_scheduler");
  if (!running) return;
  running = 0;
#ifndef MANUAL
  pthread_join(thread, 0);
#endif
}

unsigned long hdScheduleAsynchronous(Callback function, void *data, unsigned short priority) {
  note(priority == 65535 ? "schedule" : "schedule?");
  user = data;
  callback = function;
  return 99;
}

void hdUnschedule(unsigned long handle) {
  note(handle == 99 ? "unschedule" : "unschedule?");
  callback = 0;
}
