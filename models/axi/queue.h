#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

namespace axi {

/// A queue of plain values in one piece of memory, which it keeps: std::deque gives its blocks back
/// and takes new ones as beats pass.
template <class T>
class Queue {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  using iterator = typename std::vector<T>::iterator;

  bool empty() const { return first_ == values_.size(); }
  std::size_t size() const { return values_.size() - first_; }
  T& front() { return values_[first_]; }
  const T& front() const { return values_[first_]; }
  T& back() { return values_.back(); }
  iterator begin() { return values_.begin() + static_cast<std::ptrdiff_t>(first_); }
  iterator end() { return values_.end(); }

  void push_back(const T& value) {
    if (first_ == most_unused) forget_passed();
    values_.push_back(value);
  }
  void pop_back() {
    values_.pop_back();
    if (empty()) clear();
  }
  void pop_front() {
    ++first_;
    if (empty()) clear();
  }
  void erase(iterator place) {
    if (place == begin()) return pop_front();
    values_.erase(place);
  }
  void clear() {
    values_.clear();
    first_ = 0;
  }

 private:
  static constexpr std::size_t most_unused = 64;
  void forget_passed() {
    values_.erase(values_.begin(), begin());
    first_ = 0;
  }

  std::vector<T> values_;
  std::size_t first_ = 0;  ///< values before it have passed
};

}  // namespace axi
