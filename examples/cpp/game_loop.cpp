// A game at 90 Hz beside a haptic thread at 1 kHz.
//
//   game_loop DESK.aspl            two threads, two seconds of wall-clock time
//   game_loop DESK.aspl --steps    the same in virtual time, on one thread: the same bits each run
//
// `asperity build examples/desk.toml -o desk.aspl` makes the library. The stylus strokes the desk,
// which is a scene of two materials, and then a slab above it. While it is on the slab, the game
// gives the slab other materials, which reach the haptic thread through an exchange.
#include "asperity.hpp"
#include "file.hpp"

#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>

namespace {

constexpr int RATE_HZ = 1000;
constexpr int FRAMES_HZ = 90;
constexpr int TICKS = 2 * RATE_HZ;
constexpr int FRAMES = 2 * FRAMES_HZ;
// The slab stands on the desk; its top is 10 mm above it.
constexpr float SLAB_TOP_M = 0.01f;

/// The simulated device: across the desk from x = −20 mm, up, and across the slab from +30 mm, 1 mm
/// deep at 50 mm/s.
asperity::Sample position(int tick) {
  const int phase = tick % RATE_HZ;
  const float down_m = 2.0e-3f - 3.0e-5f * static_cast<float>(phase < 100 ? phase : 100);
  const float along_m = phase < 100 ? 0.0f : 5.0e-5f * static_cast<float>(phase - 100);
  return tick < RATE_HZ ? asperity::Sample(-0.02f + along_m, 0.0f, down_m)
                        : asperity::Sample(0.03f + along_m, 0.0f, SLAB_TOP_M + down_m);
}

/// What the haptic thread tells the game: the newest values, one at a time.
struct Telemetry {
  std::atomic<std::uint32_t> surface{ASPERITY_NO_SURFACE};
  std::atomic<bool> on_slab{false};
  std::atomic<bool> refused{false};
};

/// All that the haptic thread owns.
class Haptics {
 public:
  Haptics(const asperity::Renderer &desk_renderer, const asperity::Scene &desk,
          asperity::SceneState &state, const asperity::Renderer &slab_renderer, asperity::Player slab)
      : desk_renderer_(desk_renderer), desk_(desk), state_(state), slab_renderer_(slab_renderer),
        slab_(slab) {}

  /// One servo period. Both objects are ticked, so that each knows where the stylus has been; they
  /// are so far apart that it touches one at a time.
  void tick(const asperity::Sample &sample, Telemetry &telemetry) {
    const auto desk = desk_renderer_.tick(desk_, state_, sample);
    const auto slab = slab_renderer_.tick(slab_, sample);
    for (int axis = 0; axis < 3; axis++) {
      // A device would get this force.
      const float force_n = desk.force_n[axis] + slab.force_n[axis];
      std::uint32_t bits;
      std::memcpy(&bits, &force_n, sizeof bits);
      hash_ = (hash_ ^ bits) * 0x100000001b3u;
    }
    desk_ticks_ += desk.contact();
    slab_ticks_ += slab.contact();
    both_ticks_ += desk.contact() && slab.contact();
    telemetry.surface.store(desk.surface, std::memory_order_relaxed);
    telemetry.on_slab.store(slab.contact(), std::memory_order_relaxed);
    if (desk.status != ASPERITY_STATUS_OK || slab.status != ASPERITY_STATUS_OK)
      telemetry.refused.store(true, std::memory_order_relaxed);
  }

  std::uint64_t hash() const { return hash_; }
  int desk_ticks() const { return desk_ticks_; }
  int slab_ticks() const { return slab_ticks_; }
  int both_ticks() const { return both_ticks_; }
  asperity::Counters slab_counters() const { return slab_.counters(); }

 private:
  const asperity::Renderer &desk_renderer_;
  const asperity::Scene &desk_;
  asperity::SceneState &state_;
  const asperity::Renderer &slab_renderer_;
  asperity::Player slab_;
  std::uint64_t hash_ = 0xcbf29ce484222325u;
  int desk_ticks_ = 0, slab_ticks_ = 0, both_ticks_ = 0;
};

/// The game: it draws nothing, but it chooses the slab's material.
class Game {
 public:
  Game(asperity::Preparer slab, asperity::Bytes library) : slab_(slab), library_(library) {}

  /// One frame. Every third of a second on the slab brings another material; one that finds no
  /// spare slot is tried again in the next frame.
  void frame(const Telemetry &telemetry) {
    frames_on_slab_ += telemetry.on_slab.load(std::memory_order_relaxed);
    const int wanted = 1 + frames_on_slab_ / (FRAMES_HZ / 3);
    if (sent_ < wanted) {
      const auto sent = slab_.load(library_, sent_ % 2 == 0 ? "cork" : "grit");
      if (sent) {
        sent_++;
      } else if (sent.error().status() != ASPERITY_STATUS_BUSY) {
        std::fprintf(stderr, "slab: %s\n", sent.error().message());
        failed_ = true;
      }
    }
    const auto surface = telemetry.surface.load(std::memory_order_relaxed);
    if (surface != ASPERITY_NO_SURFACE) seen_ |= 1u << surface;
  }

  int sent() const { return sent_; }
  unsigned surfaces() const { return (seen_ & 1u) + (seen_ >> 1 & 1u); }
  bool failed() const { return failed_; }

 private:
  asperity::Preparer slab_;
  asperity::Bytes library_;
  int frames_on_slab_ = 0, sent_ = 0;
  unsigned seen_ = 0;
  bool failed_ = false;
};

void in_steps(Haptics &haptics, Game &game, Telemetry &telemetry) {
  int frame = 0;
  for (int tick = 0; tick < TICKS; tick++) {
    for (; frame < FRAMES && frame * RATE_HZ <= tick * FRAMES_HZ; frame++) game.frame(telemetry);
    haptics.tick(position(tick), telemetry);
  }
}

void in_threads(Haptics &haptics, Game &game, Telemetry &telemetry) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::thread servo([&] {
    constexpr auto PERIOD = std::chrono::nanoseconds(1000000000 / RATE_HZ);
    for (int tick = 0, last = -1; tick < TICKS; tick++) {
      std::this_thread::sleep_until(start + tick * PERIOD);
      // Whoever wakes late goes on where the hand is by now, and says how many periods went by.
      const auto now = static_cast<int>((Clock::now() - start) / PERIOD);
      if (now > tick) tick = now < TICKS ? now : TICKS - 1;
      auto sample = position(tick);
      sample.elapsed_ticks = static_cast<std::uint32_t>(tick - last);
      last = tick;
      haptics.tick(sample, telemetry);
    }
  });
  for (int frame = 0; frame < FRAMES; frame++) {
    std::this_thread::sleep_until(start + frame * std::chrono::nanoseconds(1000000000 / FRAMES_HZ));
    game.frame(telemetry);
  }
  servo.join();
}

int refuse(const char *what, const asperity::Error &error) {
  std::fprintf(stderr, "%s: %s\n", what, error.message());
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char **argv) {
  const bool steps = argc == 3 && std::strcmp(argv[2], "--steps") == 0;
  if (argc != 2 && !steps) {
    std::fprintf(stderr, "usage: %s DESK.aspl [--steps]\n", argv[0]);
    return 2;
  }
  if (!asperity::version_fits()) {
    std::fprintf(stderr, "the library is version %s, which this program was not built for\n",
                 asperity::version());
    return EXIT_FAILURE;
  }
  const auto library = read_file(argv[1]);

  // The desk's surfaces are in the library; the slab is a box that the game made.
  const auto desk_renderer = asperity::Renderer::make(asperity::Config());
  if (!desk_renderer) return refuse("desk", desk_renderer.error());
  const auto desk = desk_renderer->make_scene(library);
  if (!desk) return refuse(argv[1], desk.error());
  auto state = desk_renderer->make_scene_state(1);
  if (!state) return refuse("desk", state.error());

  asperity::Config box;
  box.solid = ASPERITY_SOLID_BOX;
  const float centre_m[] = {0.05f, 0.0f, SLAB_TOP_M - 0.004f}, half_m[] = {0.03f, 0.03f, 0.004f};
  std::memcpy(box.solid_point_m, centre_m, sizeof centre_m);
  std::memcpy(box.solid_half_extents_m, half_m, sizeof half_m);
  const auto slab_renderer = asperity::Renderer::make(box);
  if (!slab_renderer) return refuse("slab", slab_renderer.error());
  const auto slab = slab_renderer->make_exchange(2);
  if (!slab) return refuse("slab", slab.error());

  Telemetry telemetry;
  Haptics haptics(*desk_renderer, *desk, *state, *slab_renderer, slab->player());
  Game game(slab->preparer(), library);
  steps ? in_steps(haptics, game, telemetry) : in_threads(haptics, game, telemetry);

  std::printf("desk: %d ticks in contact, %u surfaces\n", haptics.desk_ticks(), game.surfaces());
  std::printf("slab: %d ticks in contact, %d materials\n", haptics.slab_ticks(), game.sent());
  const auto counters = haptics.slab_counters();
  std::printf("%u ticks, %u missed, %u taps, %u faults\n", static_cast<unsigned>(counters.ticks),
              static_cast<unsigned>(counters.missed_ticks), static_cast<unsigned>(counters.taps),
              static_cast<unsigned>(counters.faults));
  if (steps) std::printf("forces %016llx\n", static_cast<unsigned long long>(haptics.hash()));
  const bool wrong = telemetry.refused || game.failed() || haptics.both_ticks() > 0;
  if (wrong) std::fprintf(stderr, "a tick was refused, or two objects were touched at once\n");
  return wrong ? EXIT_FAILURE : EXIT_SUCCESS;
}
