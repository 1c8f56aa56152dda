// What asperity.hpp is made of: errors, results, spans, and memory that owns itself.
#ifndef ASPERITY_BASE_HPP
#define ASPERITY_BASE_HPP

#include "asperity.h"

#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#if __has_include(<version>)
#include <version>
#endif
#if defined(__cpp_lib_span)
#include <span>
#endif
#if defined(__cpp_lib_expected)
#include <expected>
#endif

namespace asperity {

/// What went wrong: a status, and a message that names the field, its value and the rule.
class Error {
 public:
  Error() noexcept : raw_ ASPERITY_ERROR_INIT {}
  explicit Error(AsperityStatus status) noexcept : Error() { raw_.status = status; }

  AsperityStatus status() const noexcept { return raw_.status; }
  /// UTF-8 that ends with a null; the text of the status where nothing more can be said.
  const char *message() const noexcept {
    return raw_.message[0] != '\0' ? raw_.message : asperity_error_text(raw_.status);
  }
  /// For functions of asperity.h.
  AsperityError *raw() noexcept { return &raw_; }
  /// Takes over what such a function returned.
  Error &with(AsperityStatus status) noexcept {
    raw_.status = status;
    return *this;
  }

 private:
  AsperityError raw_;
};

#if defined(__cpp_lib_expected)
template <class T>
using Result = std::expected<T, Error>;
using Failure = std::unexpected<Error>;
#else
/// An error on its way into a `Result`.
class Failure {
 public:
  explicit Failure(Error error) noexcept : error_(error) {}
  const Error &error() const noexcept { return error_; }

 private:
  Error error_;
};

/// A value or an error: what `std::expected` has in common with it, without exceptions. Reading the
/// one that is not there is undefined.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) noexcept : has_(true) { ::new (static_cast<void *>(&value_)) T(std::move(value)); }
  Result(const Failure &failure) noexcept : has_(false) {
    ::new (static_cast<void *>(&error_)) Error(failure.error());
  }
  Result(Result &&other) noexcept : has_(other.has_) { take(other); }
  Result &operator=(Result &&other) noexcept {
    if (this != &other) {
      drop();
      has_ = other.has_;
      take(other);
    }
    return *this;
  }
  ~Result() { drop(); }

  bool has_value() const noexcept { return has_; }
  explicit operator bool() const noexcept { return has_; }
  T &operator*() & noexcept { return value_; }
  const T &operator*() const & noexcept { return value_; }
  T &&operator*() && noexcept { return std::move(value_); }
  T *operator->() noexcept { return &value_; }
  const T *operator->() const noexcept { return &value_; }
  const Error &error() const noexcept { return error_; }

 private:
  void drop() noexcept {
    if (has_) value_.~T();
  }
  void take(Result &other) noexcept {
    if (has_) {
      ::new (static_cast<void *>(&value_)) T(std::move(other.value_));
    } else {
      ::new (static_cast<void *>(&error_)) Error(other.error_);
    }
  }

  bool has_;
  union {
    T value_;
    Error error_;
  };
};

/// Success or an error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() noexcept = default;
  Result(const Failure &failure) noexcept : has_(false), error_(failure.error()) {}

  bool has_value() const noexcept { return has_; }
  explicit operator bool() const noexcept { return has_; }
  const Error &error() const noexcept { return error_; }

 private:
  bool has_ = true;
  Error error_;
};
#endif

#if defined(__cpp_lib_span)
template <class T>
using Span = std::span<T>;
#else
/// Elements of somebody else: the part of `std::span` that this header needs.
template <class T>
class Span {
 public:
  constexpr Span() noexcept = default;
  constexpr Span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
  template <std::size_t N>
  constexpr Span(T (&array)[N]) noexcept : data_(array), size_(N) {}
  /// A container with `data()` and `size()`.
  template <class C, class = decltype(static_cast<T *>(std::declval<C &>().data()))>
  constexpr Span(C &container) noexcept : data_(container.data()), size_(container.size()) {}

  constexpr T *data() const noexcept { return data_; }
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr T &operator[](std::size_t index) const noexcept { return data_[index]; }
  constexpr T *begin() const noexcept { return data_; }
  constexpr T *end() const noexcept { return data_ + size_; }

 private:
  T *data_ = nullptr;
  std::size_t size_ = 0;
};
#endif

/// The bytes of an asset or a library.
using Bytes = Span<const std::uint8_t>;

namespace detail {

/// Aligned memory of an object: from the heap, or lent by the caller.
class Memory {
 public:
  Memory() noexcept = default;
  explicit Memory(std::size_t size) noexcept
      : data_(::operator new(size, std::align_val_t{ASPERITY_ALIGNMENT}, std::nothrow)),
        size_(data_ != nullptr ? size : 0),
        owned_(true) {}
  Memory(void *lent, std::size_t size) noexcept : data_(lent), size_(size) {}
  Memory(Memory &&other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(other.size_), owned_(other.owned_) {}
  Memory &operator=(Memory &&other) noexcept {
    if (this != &other) {
      release();
      data_ = std::exchange(other.data_, nullptr);
      size_ = other.size_;
      owned_ = other.owned_;
    }
    return *this;
  }
  ~Memory() { release(); }

  void *data() const noexcept { return data_; }
  std::size_t size() const noexcept { return size_; }

 private:
  void release() noexcept {
    if (owned_ && data_ != nullptr) ::operator delete(data_, std::align_val_t{ASPERITY_ALIGNMENT});
  }

  void *data_ = nullptr;
  std::size_t size_ = 0;
  bool owned_ = false;
};

/// An object of the C library and the memory it lives in. It moves; it does not copy.
template <class T>
class Object {
 public:
  Object(Memory memory, T *object) noexcept : memory_(std::move(memory)), object_(object) {}
  Object(Object &&other) noexcept
      : memory_(std::move(other.memory_)), object_(std::exchange(other.object_, nullptr)) {}
  Object &operator=(Object &&other) noexcept {
    memory_ = std::move(other.memory_);
    object_ = std::exchange(other.object_, nullptr);
    return *this;
  }
  T *get() const noexcept { return object_; }

 private:
  Memory memory_;
  T *object_;
};

inline Failure failed(AsperityStatus status, Error error = Error()) noexcept {
  return Failure(error.with(status));
}

inline Result<void> done(AsperityStatus status, Error error = Error()) noexcept {
  if (status != ASPERITY_STATUS_OK) return failed(status, error);
  return {};
}

}  // namespace detail

/// Memory that the caller lends to an object, aligned and large enough:
/// `static asperity::Storage<ASPERITY_STATE_SIZE> memory;`
template <std::size_t Size>
struct Storage {
  alignas(ASPERITY_ALIGNMENT) unsigned char bytes[Size];
};

}  // namespace asperity

#endif  // ASPERITY_BASE_HPP
