// A haptic thread inside CHAI3D 3.3 that renders a texture on the plane z = 0.
//
//   textured_plane TEXTURE.asp               the first device that CHAI3D finds, until Enter
//   textured_plane TEXTURE.asp --simulated   a device that moves by itself, for one second
//
// Axes are CHAI3D's: x towards the user, y to the right, z up, in metres.
#include "asperity.hpp"
#include "../file.hpp"

#include "chai3d.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>

namespace {

constexpr auto PERIOD = std::chrono::milliseconds(1);

/// A device that strokes along y at 100 mm/s, 1 mm deep, as CHAI3D sees a real one.
class SimulatedDevice : public chai3d::cGenericHapticDevice {
 public:
  SimulatedDevice() {
    m_specifications.m_maxLinearForce = 3.3;
    m_deviceAvailable = true;
  }
  bool open() override { return m_deviceReady = true; }
  bool close() override { return !(m_deviceReady = false); }
  bool getPosition(chai3d::cVector3d &position) override {
    const int tick = tick_++;
    const double z_m = 2.0e-3 - 3.0e-5 * std::min(tick, 100);
    position.set(0.0, 1.0e-4 * std::max(tick - 100, 0), z_m);
    return true;
  }
  bool setForceAndTorqueAndGripperForce(const chai3d::cVector3d &force, const chai3d::cVector3d &,
                                        double) override {
    strongest_n_ = std::max(strongest_n_, force.length());
    return true;
  }
  double strongest_n() const { return strongest_n_; }

 private:
  int tick_ = 0;
  double strongest_n_ = 0.0;
};

/// What the haptic thread works with; the main thread looks at it after the end.
struct Loop {
  chai3d::cGenericHapticDevice *device;
  const asperity::Renderer *renderer;
  const asperity::Texture *texture;
  asperity::State *state;
  std::atomic<bool> running{true};
  std::atomic<bool> ended{false};
  std::atomic<int> ticks{0};
};

/// Runs in a thread of CHAI3D's, once a millisecond.
void haptics(void *argument) {
  Loop &loop = *static_cast<Loop *>(argument);
  const auto start = std::chrono::steady_clock::now();
  for (int last = -1; loop.running;) {
    std::this_thread::sleep_until(start + (last + 1) * PERIOD);
    const auto elapsed = std::chrono::steady_clock::now() - start;
    const int tick = std::max(last + 1, static_cast<int>(elapsed / PERIOD));

    chai3d::cVector3d position;
    const bool fresh = loop.device->getPosition(position);
    auto sample = asperity::Sample::stale();
    if (fresh)
      sample = asperity::Sample(static_cast<float>(position.x()), static_cast<float>(position.y()),
                                static_cast<float>(position.z()),
                                static_cast<std::uint32_t>(tick - last));
    last = tick;
    const auto output = loop.renderer->tick(*loop.texture, *loop.state, sample);
    loop.device->setForce(
        chai3d::cVector3d(output.force_n[0], output.force_n[1], output.force_n[2]));
    loop.ticks++;
  }
  loop.device->setForce(chai3d::cVector3d(0.0, 0.0, 0.0));
  loop.ended = true;
}

int refuse(const char *what, const asperity::Error &error) {
  std::fprintf(stderr, "%s: %s\n", what, error.message());
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char **argv) {
  const bool simulated = argc == 3 && std::strcmp(argv[2], "--simulated") == 0;
  if (argc != 2 && !simulated) {
    std::fprintf(stderr, "usage: %s TEXTURE.asp [--simulated]\n", argv[0]);
    return 2;
  }
  const auto simulation = std::make_shared<SimulatedDevice>();
  chai3d::cGenericHapticDevicePtr device = simulation;
  if (!simulated) {
    chai3d::cHapticDeviceHandler handler;
    if (handler.getNumDevices() == 0) {
      std::fprintf(stderr, "CHAI3D found no device: connect one, or try --simulated\n");
      return EXIT_FAILURE;
    }
    handler.getDevice(device, 0);
  }
  if (!device->open()) {
    std::fprintf(stderr, "the device cannot be opened: is another program using it?\n");
    return EXIT_FAILURE;
  }
  device->calibrate();

  asperity::Config config;  // of a Touch; the peak is the device's where that is lower
  const auto most_n = static_cast<float>(device->getSpecifications().m_maxLinearForce);
  if (most_n > 0.0f) config.peak_n = std::min(config.peak_n, most_n);
  const auto renderer = asperity::Renderer::make(config);
  if (!renderer) return refuse("renderer", renderer.error());
  auto texture = renderer->make_texture();
  if (!texture) return refuse("slot", texture.error());
  const auto bytes = read_file(argv[1]);
  if (const auto loaded = texture->load(bytes); !loaded) return refuse(argv[1], loaded.error());
  auto state = renderer->make_state(1);
  if (!state) return refuse("state", state.error());

  Loop loop{device.get(), &*renderer, &*texture, &*state};
  chai3d::cThread thread;
  thread.start(haptics, chai3d::CTHREAD_PRIORITY_HAPTICS, &loop);
  if (simulated) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
  } else {
    std::puts("Enter ends it.");
    std::getchar();
  }
  loop.running = false;
  while (!loop.ended) std::this_thread::sleep_for(PERIOD);
  device->close();

  const auto counters = state->counters();
  std::printf("%d ticks, %u taps\n", loop.ticks.load(), static_cast<unsigned>(counters.taps));
  if (!simulated) return EXIT_SUCCESS;
  std::printf("strongest force %.3f N\n", simulation->strongest_n());
  const bool felt = simulation->strongest_n() > 0.1 && simulation->strongest_n() <= config.peak_n + 1e-6;
  if (!felt) std::fprintf(stderr, "the simulated device felt nothing, or more than the peak\n");
  return felt ? EXIT_SUCCESS : EXIT_FAILURE;
}
