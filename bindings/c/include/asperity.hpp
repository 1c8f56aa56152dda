// Asperity for C++17 and later: asperity.h with ownership, spans and results.
//
// Nothing here throws, and nothing allocates but the `make` functions, which say so. A tick
// allocates nothing, takes no lock and makes no system call. Link with the C library.
#ifndef ASPERITY_HPP
#define ASPERITY_HPP

#include "asperity_base.hpp"

namespace asperity {

/// Largest texture that a slot takes.
enum class Capacity : std::uint32_t {
  small = ASPERITY_CAPACITY_SMALL,
  medium = ASPERITY_CAPACITY_MEDIUM,
  large = ASPERITY_CAPACITY_LARGE,
};

/// Bytes of a slot.
constexpr std::size_t texture_size(Capacity capacity) noexcept {
  return capacity == Capacity::small    ? ASPERITY_TEXTURE_SIZE_SMALL
         : capacity == Capacity::medium ? ASPERITY_TEXTURE_SIZE_MEDIUM
                                        : ASPERITY_TEXTURE_SIZE_LARGE;
}

/// Configuration of a renderer: the defaults, of which any field may be changed.
struct Config : AsperityConfig {
  Config() noexcept : AsperityConfig() {
    asperity_config_default(this, sizeof(AsperityConfig));
  }
};

/// Device sample of one servo period: a position in metres, and the periods since the one before.
struct Sample : AsperitySample {
  Sample(float x_m, float y_m, float z_m, std::uint32_t elapsed = 1) noexcept
      : AsperitySample ASPERITY_SAMPLE_INIT {
    position_m[0] = x_m;
    position_m[1] = y_m;
    position_m[2] = z_m;
    elapsed_ticks = elapsed;
  }
  /// The device had nothing new.
  static Sample stale() noexcept { return Sample(0.0f, 0.0f, 0.0f, 0); }
};

/// Output of a tick. A tick that is refused gives no force and the safe state.
struct Output : AsperityOutput {
  Output() noexcept : AsperityOutput ASPERITY_OUTPUT_INIT {}

  /// `ASPERITY_STATUS_OK`, or why the tick was refused.
  AsperityStatus status = ASPERITY_STATUS_OK;

  /// Whether all of these bits `ASPERITY_FLAG_*` are set.
  bool has(std::uint32_t bits) const noexcept { return (flags & bits) == bits; }
  bool contact() const noexcept { return has(ASPERITY_FLAG_CONTACT); }
  bool safe_state() const noexcept { return has(ASPERITY_FLAG_SAFE_STATE); }
};

/// Counts of events.
struct Counters : AsperityCounters {
  Counters() noexcept : AsperityCounters ASPERITY_COUNTERS_INIT {}
};

/// How a texture couples to the hand.
struct Coupling : AsperityCoupling {
  Coupling() noexcept : AsperityCoupling ASPERITY_COUPLING_INIT {}
};

/// The library in words, e.g. `0.1.0`.
inline const char *version() noexcept { return asperity_version(); }

/// Whether the library that was found at run time serves this header.
inline bool version_fits() noexcept {
  const std::uint32_t found = asperity_version_number();
  const bool major = found / 10000 == ASPERITY_VERSION_MAJOR;
  // While the major version is 0, a minor version may break the ABI.
  const bool minor = ASPERITY_VERSION_MAJOR > 0 || found / 100 == ASPERITY_VERSION / 100;
  return major && minor && found >= ASPERITY_VERSION;
}

class Renderer;

/// State of one stylus on one texture. One thread at a time may use it.
class State {
 public:
  AsperityState *get() const noexcept { return object_.get(); }

  Counters counters() const noexcept {
    Counters found;
    asperity_state_counters(get(), &found);
    return found;
  }

 private:
  friend class Renderer;
  explicit State(detail::Object<AsperityState> object) noexcept : object_(std::move(object)) {}
  detail::Object<AsperityState> object_;
};

/// State of one stylus in a scene. One thread at a time may use it.
class SceneState {
 public:
  AsperitySceneState *get() const noexcept { return object_.get(); }

  Counters counters() const noexcept {
    Counters found;
    asperity_scene_state_counters(get(), &found);
    return found;
  }

 private:
  friend class Renderer;
  explicit SceneState(detail::Object<AsperitySceneState> object) noexcept
      : object_(std::move(object)) {}
  detail::Object<AsperitySceneState> object_;
};

/// A slot for a texture. Loading writes to it, which no tick may use meanwhile.
class Texture {
 public:
  AsperityTexture *get() const noexcept { return object_.get(); }

  /// Loads an asset (`.asp`); if it is refused, the slot keeps the texture it had.
  Result<void> load(Bytes asset) noexcept {
    Error error;
    const auto status = asperity_texture_load_asset(get(), asset.data(), asset.size(), error.raw());
    return detail::done(status, error);
  }
  /// Loads the texture at `index` of a library (`.aspl`).
  Result<void> load(Bytes library, std::size_t index) noexcept {
    Error error;
    return detail::done(
        asperity_texture_load_index(get(), library.data(), library.size(), index, error.raw()), error);
  }
  /// Loads the texture of this name, which ends with a null.
  Result<void> load(Bytes library, const char *name) noexcept {
    Error error;
    return detail::done(
        asperity_texture_load_name(get(), library.data(), library.size(), name, error.raw()), error);
  }
  Coupling coupling() const noexcept {
    Coupling found;
    asperity_texture_coupling(get(), &found);
    return found;
  }

 private:
  friend class Renderer;
  explicit Texture(detail::Object<AsperityTexture> object) noexcept : object_(std::move(object)) {}
  detail::Object<AsperityTexture> object_;
};

/// The surfaces and textures of a library. A tick only reads it.
class Scene {
 public:
  AsperityScene *get() const noexcept { return object_.get(); }

 private:
  friend class Renderer;
  explicit Scene(detail::Object<AsperityScene> object) noexcept : object_(std::move(object)) {}
  detail::Object<AsperityScene> object_;
};

/// The half of an exchange that loads textures, outside of the servo loop. One thread at a time.
class Preparer {
 public:
  AsperityPreparer *get() const noexcept { return object_; }

  /// Sends an asset to the servo loop. `ASPERITY_STATUS_BUSY`: try again some ticks later.
  Result<void> load(Bytes asset) noexcept {
    Error error;
    const auto status = asperity_preparer_load_asset(get(), asset.data(), asset.size(), error.raw());
    return detail::done(status, error);
  }
  Result<void> load(Bytes library, std::size_t index) noexcept {
    Error error;
    return detail::done(
        asperity_preparer_load_index(get(), library.data(), library.size(), index, error.raw()), error);
  }
  Result<void> load(Bytes library, const char *name) noexcept {
    Error error;
    return detail::done(
        asperity_preparer_load_name(get(), library.data(), library.size(), name, error.raw()), error);
  }

 private:
  friend class Exchange;
  explicit Preparer(AsperityPreparer *object) noexcept : object_(object) {}
  AsperityPreparer *object_;
};

/// The half of an exchange that the servo loop plays. One thread at a time.
class Player {
 public:
  AsperityPlayer *get() const noexcept { return object_; }

  Counters counters() const noexcept {
    Counters found;
    asperity_player_counters(get(), &found);
    return found;
  }

 private:
  friend class Exchange;
  explicit Player(AsperityPlayer *object) noexcept : object_(object) {}
  AsperityPlayer *object_;
};

/// Another texture while the servo loop runs. It must outlive the use of its two halves, each of
/// which belongs to one thread at a time.
class Exchange {
 public:
  Preparer preparer() const noexcept { return Preparer(preparer_); }
  Player player() const noexcept { return Player(object_.get()); }

 private:
  friend class Renderer;
  Exchange(detail::Object<AsperityPlayer> object, AsperityPreparer *preparer) noexcept
      : object_(std::move(object)), preparer_(preparer) {}
  detail::Object<AsperityPlayer> object_;
  AsperityPreparer *preparer_;
};

/// A checked configuration. It makes the objects that fit it, and serves any number of them. Every
/// `make_*` allocates once, or takes memory that the caller lends (`Storage`).
class Renderer {
 public:
  static Result<Renderer> make(const Config &config) noexcept {
    return make(config, detail::Memory(ASPERITY_RENDERER_SIZE));
  }
  template <std::size_t N>
  static Result<Renderer> make(const Config &config, Storage<N> &lent) noexcept {
    return make(config, detail::Memory(lent.bytes, N));
  }

  Result<Texture> make_texture(Capacity capacity = Capacity::large) const noexcept {
    return make_texture(capacity, detail::Memory(texture_size(capacity)));
  }
  template <std::size_t N>
  Result<Texture> make_texture(Capacity capacity, Storage<N> &lent) const noexcept {
    return make_texture(capacity, detail::Memory(lent.bytes, N));
  }

  /// A state at rest. `seed` selects the noise of the excitation.
  Result<State> make_state(std::uint64_t seed) const noexcept {
    return make_state(seed, detail::Memory(ASPERITY_STATE_SIZE));
  }
  template <std::size_t N>
  Result<State> make_state(std::uint64_t seed, Storage<N> &lent) const noexcept {
    return make_state(seed, detail::Memory(lent.bytes, N));
  }

  /// Every surface and texture of a library that holds a scene.
  Result<Scene> make_scene(Bytes library) const noexcept {
    Error error;
    std::uint32_t capacity = 0;
    std::size_t size = 0;
    auto status = asperity_library_capacity(library.data(), library.size(), rate_hz_, &capacity,
                                            error.raw());
    if (status == ASPERITY_STATUS_OK)
      status = asperity_scene_size(library.data(), library.size(), capacity, &size, error.raw());
    if (status != ASPERITY_STATUS_OK) return detail::failed(status, error);
    detail::Memory memory(size);
    if (memory.data() == nullptr) return detail::failed(ASPERITY_STATUS_MEMORY);
    AsperityScene *scene = nullptr;
    status = asperity_scene_init(memory.data(), memory.size(), get(), capacity, library.data(),
                                 library.size(), &scene, error.raw());
    if (status != ASPERITY_STATUS_OK) return detail::failed(status, error);
    return Scene(detail::Object<AsperityScene>(std::move(memory), scene));
  }

  Result<SceneState> make_scene_state(std::uint64_t seed) const noexcept {
    detail::Memory memory(ASPERITY_SCENE_STATE_SIZE);
    if (memory.data() == nullptr) return detail::failed(ASPERITY_STATUS_MEMORY);
    AsperitySceneState *state = nullptr;
    const auto status =
        asperity_scene_state_init(memory.data(), memory.size(), get(), seed, &state);
    if (status != ASPERITY_STATUS_OK) return detail::failed(status);
    return SceneState(detail::Object<AsperitySceneState>(std::move(memory), state));
  }

  /// An exchange without a texture: there is no force until one is loaded.
  Result<Exchange> make_exchange(std::uint64_t seed, std::uint32_t spare = 1,
                                 Capacity capacity = Capacity::large) const noexcept {
    std::size_t size = 0;
    const auto number = static_cast<std::uint32_t>(capacity);
    auto status = asperity_exchange_size(number, spare, &size);
    if (status != ASPERITY_STATUS_OK) return detail::failed(status);
    detail::Memory memory(size);
    if (memory.data() == nullptr) return detail::failed(ASPERITY_STATUS_MEMORY);
    AsperityPreparer *preparer = nullptr;
    AsperityPlayer *player = nullptr;
    status = asperity_exchange_init(memory.data(), memory.size(), get(), number, spare, seed,
                                    &preparer, &player);
    if (status != ASPERITY_STATUS_OK) return detail::failed(status);
    return Exchange(detail::Object<AsperityPlayer>(std::move(memory), player), preparer);
  }

  /// One servo period on a texture.
  Output tick(const Texture &texture, State &state, const Sample &sample) const noexcept {
    Output output;
    output.status = asperity_tick(get(), texture.get(), state.get(), &sample, &output);
    return output;
  }
  /// One servo period in a scene.
  Output tick(const Scene &scene, SceneState &state, const Sample &sample) const noexcept {
    Output output;
    output.status = asperity_scene_tick(get(), scene.get(), state.get(), &sample, &output);
    return output;
  }
  /// One servo period on what an exchange plays.
  Output tick(Player &player, const Sample &sample) const noexcept {
    Output output;
    output.status = asperity_player_tick(get(), player.get(), &sample, &output);
    return output;
  }

  AsperityRenderer *get() const noexcept { return object_.get(); }

 private:
  Renderer(detail::Object<AsperityRenderer> object, float rate_hz) noexcept
      : object_(std::move(object)), rate_hz_(rate_hz) {}

  static Result<Renderer> make(const Config &config, detail::Memory memory) noexcept {
    if (memory.data() == nullptr) return detail::failed(ASPERITY_STATUS_MEMORY);
    Error error;
    AsperityRenderer *renderer = nullptr;
    const auto status =
        asperity_renderer_init(memory.data(), memory.size(), &config, &renderer, error.raw());
    if (status != ASPERITY_STATUS_OK) return detail::failed(status, error);
    return Renderer(detail::Object<AsperityRenderer>(std::move(memory), renderer),
                    config.servo_rate_hz);
  }
  Result<Texture> make_texture(Capacity capacity, detail::Memory memory) const noexcept {
    if (memory.data() == nullptr) return detail::failed(ASPERITY_STATUS_MEMORY);
    AsperityTexture *texture = nullptr;
    const auto status = asperity_texture_init(memory.data(), memory.size(), get(),
                                              static_cast<std::uint32_t>(capacity), &texture);
    if (status != ASPERITY_STATUS_OK) return detail::failed(status);
    return Texture(detail::Object<AsperityTexture>(std::move(memory), texture));
  }
  Result<State> make_state(std::uint64_t seed, detail::Memory memory) const noexcept {
    if (memory.data() == nullptr) return detail::failed(ASPERITY_STATUS_MEMORY);
    AsperityState *state = nullptr;
    const auto status = asperity_state_init(memory.data(), memory.size(), get(), seed, &state);
    if (status != ASPERITY_STATUS_OK) return detail::failed(status);
    return State(detail::Object<AsperityState>(std::move(memory), state));
  }

  detail::Object<AsperityRenderer> object_;
  float rate_hz_;
};

/// Looks into a library (`.aspl`) without loading its textures. It borrows the bytes.
class Library {
 public:
  explicit Library(Bytes bytes) noexcept : bytes_(bytes) {}

  Result<std::size_t> count() const noexcept {
    Error error;
    std::size_t found = 0;
    const auto status = asperity_library_count(bytes_.data(), bytes_.size(), &found, error.raw());
    if (status != ASPERITY_STATUS_OK) return detail::failed(status, error);
    return found;
  }
  Result<std::size_t> find(const char *name) const noexcept {
    Error error;
    std::size_t found = 0;
    const auto status =
        asperity_library_find(bytes_.data(), bytes_.size(), name, &found, error.raw());
    if (status != ASPERITY_STATUS_OK) return detail::failed(status, error);
    return found;
  }
  /// The name of the texture at `index`, with its terminating null.
  Result<void> name(std::size_t index, char (&text)[ASPERITY_NAME_SIZE]) const noexcept {
    Error error;
    return detail::done(asperity_library_name(bytes_.data(), bytes_.size(), index, text,
                                              sizeof text, error.raw()),
                        error);
  }

 private:
  Bytes bytes_;
};

}  // namespace asperity

#endif  // ASPERITY_HPP
