#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fpga/synthesis/path_timing.h>
#include <vp/error.h>

namespace platform::synthesis {

/// A combinational loop, named by a signal on it.
struct LoopError : vp::InputError {
  using InputError::InputError;
};

/// What waits for what in a netlist: the bits of its nets, the arcs through cells from one to
/// another, and where paths from register to register begin and end.
struct TimingGraph {
  static constexpr unsigned none = ~0u;

  struct Bit {
    unsigned fan_out = 0;
    double start_ns = -1;  ///< a register's clock to output; less than 0: no register drives it
    unsigned waits_for = 0;
    std::vector<unsigned> arcs;
    std::string name;  ///< empty: it has none
  };
  struct Arc {
    unsigned from, to;
    double ns;
    bool leaves_slice;
    std::string cell;  ///< its type
  };
  struct End {
    unsigned bit;
    double setup_ns;
    bool leaves_slice;
    unsigned output;  ///< of the register, which names it; none: memory
  };

  std::vector<Bit> bits;
  std::vector<Arc> arcs;
  std::vector<End> ends;

  void add_arc(Arc arc);
  /// Every bit after those that it waits for. Throws LoopError.
  std::vector<unsigned> in_order() const;
  /// The fan-outs that there are. 0 represents a path that never leaves its slice.
  std::set<unsigned> fan_outs() const;
  /// The longest path whose largest fan-out that is, with bits `in_order`; each net that leaves a
  /// slice takes `net_ns`.
  std::optional<Path> longest(const std::vector<unsigned>& order, unsigned fan_out,
                              double net_ns) const;

 private:
  /// When the last of what a bit waits for is there, ns, less than 0: never; and through which arc
  /// and from which state it came (2 * arc + state; none: it begins there). Two entries a bit: what
  /// has not passed a net of the largest fan-out yet, state 0, is kept apart from what has.
  struct Way {
    std::vector<double> at;
    std::vector<unsigned> through;
  };

  unsigned after(unsigned bit, bool leaves_slice, unsigned state, unsigned fan_out) const {
    return state == 1 || (leaves_slice && bits[bit].fan_out == fan_out) ? 1u : 0u;
  }
  std::string name_of(unsigned bit) const;
  Way arrivals(const std::vector<unsigned>& order, unsigned fan_out, double net_ns) const;
  Path walk_back(const End& end, unsigned state, const std::vector<unsigned>& through) const;
};

}  // namespace platform::synthesis
