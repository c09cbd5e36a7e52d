#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <systemc>
#include <typeinfo>
#include <unordered_set>
#include <utility>
#include <vector>

#include <vp/clock.h>
#include <vp/configuration.h>

namespace vp {

/// While it lives, SystemC objects made during elaboration become children of `parent`, as if made
/// in its constructor.
class HierarchyScope {
 public:
  explicit HierarchyScope(sc_core::sc_module& parent) { context()->hierarchy_push(&parent); }
  ~HierarchyScope() { context()->hierarchy_pop(); }
  HierarchyScope(const HierarchyScope&) = delete;
  HierarchyScope& operator=(const HierarchyScope&) = delete;

 private:
  static sc_core::sc_simcontext* context() { return sc_core::sc_get_curr_simcontext(); }
};

/// Finds the objects of type T. What a class is it asks once: most objects are parameters and
/// counters.
template <class T>
class ObjectSearch {
 public:
  /// In the order in which they were made; those inside one of them come after it.
  std::vector<T*> found;

  void look_at(const std::vector<sc_core::sc_object*>& objects) {
    for (sc_core::sc_object* object : objects) {
      if (others_.count(&typeid(*object)) == 0) {
        if (auto* wanted = dynamic_cast<T*>(object)) {
          found.push_back(wanted);
        } else {
          others_.insert(&typeid(*object));
        }
      }
      look_at(object->get_child_objects());
    }
  }

 private:
  std::unordered_set<const std::type_info*> others_;
};

/// The objects of type T below `top`, in the order of ObjectSearch.
template <class T>
std::vector<T*> all_below(const sc_core::sc_object& top) {
  ObjectSearch<T> search;
  search.look_at(top.get_child_objects());
  return std::move(search.found);
}

/// Those of the whole simulation.
template <class T>
std::vector<T*> all_objects() {
  ObjectSearch<T> search;
  search.look_at(sc_core::sc_get_top_level_objects());
  return std::move(search.found);
}

/// Makes SystemC begin again: what is built from here on is another simulation, and time is 0. What
/// was built before must be gone. SystemC 2.3.4 cannot destroy its old context safely: each call
/// costs memory until the process ends, about 50 KiB for the whole platform (measured).
inline void begin_fresh_context() {
  static auto& contexts = *new std::vector<sc_core::sc_simcontext*>;  // kept, they are no leaks
  contexts.push_back(new sc_core::sc_simcontext);
  sc_core::sc_curr_simcontext = sc_core::sc_default_global_context = contexts.back();
}

/// Where a range of Fmax comes from.
enum class FmaxOrigin {
  published,    ///< reported by those who built it
  derived,      ///< follows from a published design in which it works at that clock
  synthesised,  ///< from synthesis of its RTL
  estimated,    ///< from its structure; it was never built
};

const char* to_string(FmaxOrigin origin);

/// What an IP is as hardware: how much of the device it takes, how fast it can be clocked, and when
/// its logic toggles. Follows from the model's own parameters.
struct IpEstimate {
  // Primitives of a Xilinx 7 series device. A block memory of 18 kbit is half of one of 36.
  std::uint32_t lut = 0;
  std::uint32_t ff = 0;
  double bram36 = 0;
  std::uint32_t dsp = 0;
  unsigned uncertainty_percent = 0;
  std::string source;  ///< of the four numbers

  /// The RTL that comes with the IP. Where figures from its synthesis are known
  /// (data/rtl/synthesis.json), they take the place of LUT, flip-flops and DSP, and of block
  /// memories that are not given here; and the range of Fmax becomes theirs, within the limits that
  /// are given here.
  struct Rtl {
    std::string module;  ///< empty: no RTL
    std::map<std::string, std::int64_t> parameters;
    /// Of the module that the coefficient of power was read from: `size` follows. Empty: it is 1.
    std::map<std::string, std::int64_t> measured;
  };
  Rtl rtl;

  /// A user's RTL in the place of the model: what the model says of size and speed is not its own.
  struct Foreign {
    std::string file;                  ///< empty: it is the model
    std::string figures;               ///< of its synthesis, as the user names the file
    std::vector<std::string> sources;  ///< SHA-256 of each file that it is built from
    std::map<std::string, std::uint64_t> parameters;  ///< with which it is built

    /// What its signals do, where nothing else knows when it works.
    struct Toggles {
      std::uint64_t bits = 0;               ///< of its signals; 0: they are not counted
      std::function<void()> begin;          ///< nothing is counted before
      std::function<double()> changes;      ///< of all bits, since then
      std::function<double()> busy_clocks;  ///< in which they changed at the vendor's default rate
    };
    Toggles toggles;
  };
  Foreign foreign;
  /// Resources and Fmax are; if not, `source` says why.
  bool known = true;

  // Its highest clock in the slowest speed grade, as far as it is known.
  std::uint64_t fmax_hz = 0;       ///< works up to this clock
  std::uint64_t fmax_high_hz = 0;  ///< fails above this clock; 0: unknown
  FmaxOrigin fmax_origin = FmaxOrigin::estimated;
  std::string fmax_documentation;

  /// IP of one kind share the coefficient `ip.KIND` of the power table, if it has one. Without
  /// one, power follows from the primitives.
  std::string kind;
  /// How many times as large as the IP that the coefficient was read from.
  double size = 1;
  /// The coefficient includes the block memories.
  bool includes_memory = false;

  /// Clocks since the start in which the logic worked. Empty: as long as a frame runs.
  std::function<std::uint64_t()> active_clocks;
  /// Reads since the start of a memory in which one block works at a time. Empty: its blocks work
  /// as the logic does.
  std::function<std::uint64_t()> memory_reads;
};

/// A part of the programmable logic: what its sc_module derives from, besides, to say what it is as
/// hardware. Nothing lists the parts: ips_below() finds them in the hierarchy.
///
///   class Median : public vp::Clocked, public vp::Ip {
///     Median(sc_core::sc_module_name name, vp::Clock& clk) : Clocked(name, clk), Ip(&clk) {}
///     vp::IpEstimate own_estimate() const override;
class Ip {
 public:
  virtual ~Ip() = default;

  /// The module that this is.
  const sc_core::sc_object& object() const;
  /// The clock that its logic must reach; of a gated one the source. Throws std::logic_error if it
  /// has none.
  const Clock& logic_clock() const;
  /// From the parameters as they are configured.
  IpEstimate estimate() const;
  /// The part of the design that it belongs to, for reports.
  const std::string& group() const { return group_; }
  /// Its position in reports: sorted by this number, then by the order of the hierarchy.
  unsigned place() const { return place_; }

  /// A user's RTL runs in its place.
  void set_foreign(IpEstimate::Foreign foreign) { foreign_ = std::move(foreign); }

  // What only the design knows.
  void set_logic_clock(const Clock& clock) { clock_ = &clock; }
  void set_group(std::string group, unsigned place) {
    group_ = std::move(group);
    place_ = place;
  }
  /// When its logic works, where it cannot tell itself.
  void set_active_clocks(std::function<std::uint64_t()> clocks) { clocks_ = std::move(clocks); }

 protected:
  /// `clock`: null if the design says which.
  explicit Ip(const Clock* clock) : clock_(clock) {}

 private:
  virtual IpEstimate own_estimate() const = 0;

  const Clock* clock_;
  std::string group_ = "pl";
  unsigned place_ = ~0u;
  std::function<std::uint64_t()> clocks_;
  IpEstimate::Foreign foreign_;
};

/// The parts below `top`, in the order of reports.
std::vector<const Ip*> ips_below(const sc_core::sc_object& top);

}  // namespace vp
