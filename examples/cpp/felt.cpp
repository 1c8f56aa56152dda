// What a hand feels along a trajectory: `asperity render`, in C++.
//
//   felt TEXTURE.asp SEED < in.csv > out.csv
//
// The columns are those of `asperity render`. Nine digits name a float exactly.
#include "asperity.hpp"
#include "file.hpp"

namespace {

int refuse(const char *what, const asperity::Error &error) {
  std::fprintf(stderr, "%s: %s\n", what, error.message());
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s TEXTURE.asp SEED < in.csv > out.csv\n", argv[0]);
    return 2;
  }
  const auto renderer = asperity::Renderer::make(asperity::Config());
  if (!renderer) return refuse("renderer", renderer.error());
  auto texture = renderer->make_texture();
  if (!texture) return refuse("slot", texture.error());
  const auto bytes = read_file(argv[1]);
  if (const auto loaded = texture->load(bytes); !loaded) return refuse(argv[1], loaded.error());
  auto state = renderer->make_state(std::strtoull(argv[2], nullptr, 10));
  if (!state) return refuse("state", state.error());

  char header[64];
  if (std::fgets(header, sizeof header, stdin) == nullptr) return EXIT_FAILURE;
  std::puts("tick,t_s,depth_mm,speed_mm_s,normal_force_n,vib_m_s2,tap_n,friction_n,fx_n,fy_n,fz_n,flags");
  double t_s, x_mm, y_mm, z_mm;
  for (int tick = 0; std::scanf("%lf,%lf,%lf,%lf", &t_s, &x_mm, &y_mm, &z_mm) == 4; tick++) {
    const asperity::Sample sample(static_cast<float>(x_mm / 1000.0), static_cast<float>(y_mm / 1000.0),
                                  static_cast<float>(z_mm / 1000.0));
    const auto out = renderer->tick(*texture, *state, sample);
    if (out.status != ASPERITY_STATUS_OK) return refuse("tick", asperity::Error(out.status));
    std::printf("%d,%.17g", tick, t_s);
    for (float value : {out.depth_m * 1000.0f, out.speed_mm_s, out.normal_force_n, out.vib_m_s2,
                        out.tap_n, out.friction_n, out.force_n[0], out.force_n[1], out.force_n[2]})
      std::printf(",%.9g", static_cast<double>(value));
    std::printf(",%u\n", static_cast<unsigned>(out.flags));
  }
  return EXIT_SUCCESS;
}
