// asperity.hpp: errors arrive with their message, objects move, a tick allocates nothing.
//
//   wrapper TEXTURE.asp DESK.aspl
#include "asperity.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>
#include <vector>

namespace {

int allocations = 0;
int failures = 0;

void check(bool holds, const char *claim) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", claim);
  failures++;
}

std::vector<std::uint8_t> read_file(const char *path) {
  std::vector<std::uint8_t> bytes(1 << 20);
  std::FILE *file = std::fopen(path, "rb");
  if (file == nullptr) std::exit(2);
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file));
  std::fclose(file);
  return bytes;
}

template <class T>
constexpr bool moves_only = std::is_nothrow_move_constructible_v<T> &&
                            std::is_nothrow_move_assignable_v<T> && !std::is_copy_constructible_v<T> &&
                            !std::is_copy_assignable_v<T>;
static_assert(moves_only<asperity::Renderer> && moves_only<asperity::Texture> &&
              moves_only<asperity::State> && moves_only<asperity::Scene> &&
              moves_only<asperity::SceneState> && moves_only<asperity::Exchange>);

}  // namespace

// Counts what this program takes from the heap.
#if defined(__GNUC__)
__attribute__((noinline))
#endif
void *operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t &) noexcept {
  allocations++;
  const auto step = static_cast<std::size_t>(alignment);
  return std::aligned_alloc(step, (size + step - 1) / step * step);
}
// Out of line, or g++ takes the pair for a mismatch.
#if defined(__GNUC__)
__attribute__((noinline))
#endif
void operator delete(void *memory, std::align_val_t) noexcept { std::free(memory); }

int main(int argc, char **argv) {
  if (argc != 3) return 2;
  const auto asset = read_file(argv[1]), desk = read_file(argv[2]);
  check(asperity::version_fits(), "header and library fit");

  asperity::Config wrong;
  wrong.peak_n = -1.0f;
  const auto refused = asperity::Renderer::make(wrong);
  check(!refused && refused.error().status() == ASPERITY_STATUS_CONFIG, "a wrong field is refused");
  check(!refused && std::strstr(refused.error().message(), "peak") != nullptr, "and is named");

  auto renderer = asperity::Renderer::make(asperity::Config());
  check(renderer.has_value(), "the defaults are a configuration");
  if (!renderer) return EXIT_FAILURE;
  auto texture = renderer->make_texture();
  auto state = renderer->make_state(1);
  if (!texture || !state) return EXIT_FAILURE;
  const asperity::Sample deep(0.0f, 0.0f, -0.001f);

  const auto empty = renderer->tick(*texture, *state, deep);
  check(empty.status != ASPERITY_STATUS_OK && empty.safe_state() && empty.force_n[2] == 0.0f,
        "an empty slot gives no force");
  const auto damaged = texture->load(asperity::Bytes(asset.data(), 100));
  check(!damaged && damaged.error().status() == ASPERITY_STATUS_FORMAT, "the beginning of an asset is refused");
  check(texture->load(asset).has_value(), "a whole one is loaded");
  check(texture->coupling().stiffness_n_m > 0.0f, "a texture has a wall");
  const auto none = texture->load(desk, "no such thing");
  check(!none && none.error().status() == ASPERITY_STATUS_NO_SUCH_TEXTURE, "an unknown name is refused");

  // The slot keeps its address, so ticks go on after it moved.
  asperity::Texture moved = std::move(*texture);
  check(renderer->tick(moved, *state, deep).contact(), "a moved texture is felt");
  check(renderer->tick(*texture, *state, deep).status == ASPERITY_STATUS_NULL_POINTER,
        "the one it was moved from is refused");

  static asperity::Storage<ASPERITY_STATE_SIZE> enough;
  static asperity::Storage<64> little;
  check(renderer->make_state(1, enough).has_value(), "lent memory holds a state");
  const auto small = renderer->make_state(1, little);
  check(!small && small.error().status() == ASPERITY_STATUS_MEMORY, "too little memory is refused");

  auto exchange = renderer->make_exchange(1, 1);
  auto scene = renderer->make_scene(desk);
  auto scene_state = renderer->make_scene_state(1);
  if (!exchange || !scene || !scene_state) return EXIT_FAILURE;
  auto preparer = exchange->preparer();
  auto player = exchange->player();
  check(preparer.load(asset).has_value(), "the first texture is sent");
  const auto busy = preparer.load(asset);
  check(!busy && busy.error().status() == ASPERITY_STATUS_BUSY, "the second one has to wait");
  check(!renderer->make_scene(asset).has_value(), "an asset is no scene");

  const asperity::Library library(desk);
  char name[ASPERITY_NAME_SIZE];
  const auto cork = library.find("cork");
  check(library.count() && *library.count() == 2, "the desk has two textures");
  check(cork && library.name(*cork, name) && std::strcmp(name, "cork") == 0, "one is called cork");

  const int before = allocations;
  bool felt = false;
  for (int tick = 0; tick < 1000; tick++) {
    const asperity::Sample sample(1.0e-4f * static_cast<float>(tick), 0.0f, -0.001f);
    felt |= renderer->tick(moved, *state, sample).contact();
    felt &= renderer->tick(*scene, *scene_state, sample).status == ASPERITY_STATUS_OK;
    felt &= renderer->tick(player, sample).status == ASPERITY_STATUS_OK;
  }
  check(felt, "every kind of tick is felt");
  check(before >= 6, "objects were allocated");
  check(allocations == before, "no tick allocates");
  check(player.counters().ticks == 1000 && scene_state->counters().ticks == 1000, "ticks are counted");
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
