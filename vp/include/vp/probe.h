#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <vp/signal.h>

namespace vp {

/// An internal register that a trace can show. It costs nothing while it is not traced: it does not
/// signal changes; a tracer samples it at the end of every instant in which a clock edge ran.
class ProbeBase : public SignalBase {
 public:
  const char* kind() const override { return "vp::Probe"; }
  unsigned width() const override { return width_; }

  /// Where the value lies in memory, byte_count() bytes long (1, 2, 4 or 8), for a tracer that
  /// compares without a call; null if only bits() tells the value.
  const void* address() const { return address_; }
  std::size_t byte_count() const { return byte_count_; }

 protected:
  ProbeBase(const char* name, unsigned width, const void* address, std::size_t byte_count);

 private:
  void commit() override;

  unsigned width_;
  const void* address_;
  std::size_t byte_count_;
};

/// A probe of a value of type T: bool, an integer, an enumeration, float or double. A member of the
/// module that holds the value, declared after it.
template <class T>
class Probe final : public ProbeBase {
  static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "a probe shows one number");
  static_assert(sizeof(T) <= 8, "a probe shows at most 64 bits");

 public:
  /// Shows `value`, which must live as long as the probe. `width` in bits, 1 to 64.
  Probe(const char* name, const T& value, unsigned width = default_width<T>())
      : ProbeBase(name, width, std::is_same_v<T, float> ? nullptr : &value, sizeof(T)),
        value_(&value) {}
  /// Shows what `getter` returns. Must not change anything: it is called when traced only.
  Probe(const char* name, std::function<T()> getter, unsigned width = default_width<T>())
      : ProbeBase(name, width, nullptr, sizeof(T)), getter_(std::move(getter)) {}

  T get() const { return value_ ? *value_ : getter_(); }
  std::uint64_t bits() const override {
    if constexpr (std::is_floating_point_v<T>) {
      const double real = get();
      std::uint64_t pattern = 0;
      std::memcpy(&pattern, &real, sizeof pattern);
      return pattern;
    } else {
      return static_cast<std::uint64_t>(get());
    }
  }
  bool is_real() const override { return std::is_floating_point_v<T>; }

 private:
  const T* value_ = nullptr;
  std::function<T()> getter_;
};

/// Probes of the registers of an array: name_0, name_1 …
template <class T>
class ProbeArray {
 public:
  /// Shows `count` values from `first` on.
  ProbeArray(const char* name, const T* first, std::size_t count,
             unsigned width = default_width<T>()) {
    for (std::size_t i = 0; i < count; ++i) {
      probes_.push_back(std::make_unique<Probe<T>>(element_name(name, i).c_str(), first[i], width));
    }
  }
  /// Shows a C array, std::array or std::vector that does not grow any more.
  template <class Array, class = decltype(std::size(std::declval<const Array&>()))>
  ProbeArray(const char* name, const Array& values, unsigned width = default_width<T>())
      : ProbeArray(name, std::data(values), std::size(values), width) {}
  /// Shows what `getter(i)` returns, for example a member of the i-th structure.
  ProbeArray(const char* name, std::size_t count, const std::function<T(std::size_t)>& getter,
             unsigned width = default_width<T>()) {
    for (std::size_t i = 0; i < count; ++i) {
      probes_.push_back(std::make_unique<Probe<T>>(
          element_name(name, i).c_str(), [getter, i] { return getter(i); }, width));
    }
  }

  std::size_t size() const { return probes_.size(); }
  const Probe<T>& operator[](std::size_t i) const { return *probes_[i]; }

 private:
  static std::string element_name(const char* name, std::size_t i) {
    return std::string(name) + "_" + std::to_string(i);
  }

  std::vector<std::unique_ptr<Probe<T>>> probes_;
};

/// Says in words what others are doing, for traces: a state's name, an access. Costs nothing while
/// it is not traced.
class TextSignal final : public SignalBase {
 public:
  /// `text` is asked when a source changes or touch() is called. It must not change anything.
  TextSignal(const char* name, std::function<std::string()> text,
             std::vector<SignalBase*> sources = {})
      : SignalBase(name), text_(std::move(text)), sources_(std::move(sources)) {}
  const char* kind() const override { return "vp::TextSignal"; }

  /// There is a new text.
  void touch() {
    if (observed_) changed();
  }
  std::string text() const { return text_(); }
  const std::vector<SignalBase*>& sources() const { return sources_; }

  unsigned width() const override { return 1; }
  std::uint64_t bits() const override { return 0; }

 private:
  void commit() override {}

  std::function<std::string()> text_;
  std::vector<SignalBase*> sources_;
};

}  // namespace vp
