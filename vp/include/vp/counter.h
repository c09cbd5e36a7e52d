#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

namespace vp {

/// Counts events of a link or a model: a member of the object it belongs to, found by its
/// hierarchical name.
class Counter : public sc_core::sc_object {
 public:
  /// `documentation` is one line: what one event is.
  Counter(const char* name, std::string documentation)
      : sc_core::sc_object(name), documentation_(std::move(documentation)) {}

  const char* kind() const override { return "vp::Counter"; }
  const std::string& documentation() const { return documentation_; }

  Counter& operator++() {
    ++value_;
    return *this;
  }
  void add(std::uint64_t events) { value_ += events; }
  void reset() { value_ -= get(); }
  /// Some of its events are counted elsewhere, for several counters at once: each one there is
  /// `weight` here.
  void include(std::shared_ptr<const std::uint64_t> count, std::uint64_t weight) {
    included_.push_back({std::move(count), weight});
  }

  std::uint64_t get() const {
    std::uint64_t sum = value_;
    for (const Included& part : included_) sum += *part.count * part.weight;
    return sum;
  }
  operator std::uint64_t() const { return get(); }

 private:
  struct Included {
    std::shared_ptr<const std::uint64_t> count;
    std::uint64_t weight;
  };

  std::uint64_t value_ = 0;
  std::vector<Included> included_;
  std::string documentation_;
};

/// Appends the counters below `objects` in the order of their construction.
inline void collect_counters(const std::vector<sc_core::sc_object*>& objects,
                             std::vector<const Counter*>& counters) {
  for (const sc_core::sc_object* object : objects) {
    if (const auto* counter = dynamic_cast<const Counter*>(object)) counters.push_back(counter);
    collect_counters(object->get_child_objects(), counters);
  }
}

/// The counters below `root`, or of the whole simulation, in the order of their construction.
inline std::vector<const Counter*> counters_below(const sc_core::sc_object& root) {
  std::vector<const Counter*> counters;
  collect_counters(root.get_child_objects(), counters);
  return counters;
}
inline std::vector<const Counter*> all_counters() {
  std::vector<const Counter*> counters;
  collect_counters(sc_core::sc_get_top_level_objects(), counters);
  return counters;
}

}  // namespace vp
