#include <fpga/synthesis/timing_graph.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace platform::synthesis {

void TimingGraph::add_arc(Arc arc) {
  bits[arc.from].arcs.push_back(static_cast<unsigned>(arcs.size()));
  ++bits[arc.to].waits_for;
  arcs.push_back(std::move(arc));
}

std::vector<unsigned> TimingGraph::in_order() const {
  std::vector<unsigned> open(bits.size()), order;
  for (unsigned i = 0; i < bits.size(); ++i) {
    open[i] = bits[i].waits_for;
    if (open[i] == 0) order.push_back(i);
  }
  for (std::size_t next = 0; next < order.size(); ++next) {
    for (const unsigned arc : bits[order[next]].arcs) {
      if (--open[arcs[arc].to] == 0) order.push_back(arcs[arc].to);
    }
  }
  if (order.size() == bits.size()) return order;
  const auto on_loop = std::find_if(open.begin(), open.end(), [](unsigned n) { return n > 0; });
  throw LoopError("a combinational loop goes through '" +
                  name_of(static_cast<unsigned>(on_loop - open.begin())) +
                  "': put a register into it");
}

std::set<unsigned> TimingGraph::fan_outs() const {
  std::set<unsigned> found{0};
  for (const Bit& bit : bits) {
    if (bit.fan_out > 0) found.insert(bit.fan_out);
  }
  return found;
}

TimingGraph::Way TimingGraph::arrivals(const std::vector<unsigned>& order, unsigned fan_out,
                                       double net_ns) const {
  Way way{std::vector<double>(2 * bits.size(), -1), std::vector<unsigned>(2 * bits.size(), none)};
  for (const unsigned i : order) {
    const Bit& bit = bits[i];
    if (bit.start_ns > way.at[2 * i]) {
      way.at[2 * i] = bit.start_ns;
      way.through[2 * i] = none;
    }
    for (unsigned state = 0; state < 2; ++state) {
      const double now = way.at[2 * i + state];
      if (now < 0) continue;
      for (const unsigned a : bit.arcs) {
        const Arc& arc = arcs[a];
        if (arc.leaves_slice && bit.fan_out > fan_out) continue;
        const unsigned next = 2 * arc.to + after(i, arc.leaves_slice, state, fan_out);
        const double then = now + arc.ns + (arc.leaves_slice ? net_ns : 0);
        if (then <= way.at[next]) continue;
        way.at[next] = then;
        way.through[next] = 2 * a + state;
      }
    }
  }
  return way;
}

std::optional<Path> TimingGraph::longest(const std::vector<unsigned>& order, unsigned fan_out,
                                         double net_ns) const {
  const Way way = arrivals(order, fan_out, net_ns);
  const End* last = nullptr;
  unsigned last_state = 0;
  double latest = 0;
  for (const End& end : ends) {
    if (end.leaves_slice && bits[end.bit].fan_out > fan_out) continue;
    for (unsigned state = 0; state < 2; ++state) {
      const double now = way.at[2 * end.bit + state];
      const double then = now + end.setup_ns + (end.leaves_slice ? net_ns : 0);
      const bool counts = fan_out == 0 || after(end.bit, end.leaves_slice, state, fan_out) == 1;
      if (now < 0 || !counts || (last && then <= latest)) continue;
      last = &end;
      last_state = state;
      latest = then;
    }
  }
  if (!last) return std::nullopt;
  return walk_back(*last, last_state, way.through);
}

std::string TimingGraph::name_of(unsigned bit) const {
  return bits[bit].name.empty() ? "a net without name" : bits[bit].name;
}

Path TimingGraph::walk_back(const End& end, unsigned state,
                            const std::vector<unsigned>& through) const {
  Path path;
  path.setup_ns = end.setup_ns;
  path.to = name_of(end.output == none ? end.bit : end.output);
  const auto pass = [&](unsigned net, bool leaves_slice) {
    if (!leaves_slice) return;
    ++path.nets;
    path.fan_out = std::max(path.fan_out, bits[net].fan_out);
  };
  pass(end.bit, end.leaves_slice);
  unsigned i = end.bit;
  while (through[2 * i + state] != none) {
    const unsigned step = through[2 * i + state];
    const Arc& arc = arcs[step / 2];
    state = step % 2;
    path.cells_ns += arc.ns;
    path.cells.push_back(arc.cell);
    pass(arc.from, arc.leaves_slice);
    i = arc.from;
  }
  path.cells_ns += bits[i].start_ns;
  path.from = name_of(i);
  std::reverse(path.cells.begin(), path.cells.end());
  return path;
}

}  // namespace platform::synthesis
