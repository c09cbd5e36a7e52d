#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <trace/transactions/transactions.h>
#include <vp/unit.h>

// Who waits for whom when nothing moves: an edge from each party that waits to the one that it
// waits for. The root has edges that come in, and none that go out.

namespace platform::trace {

namespace {

using Side = BusInterface::Side;

/// The module at one side of a bus, if one of its names says so.
std::string party(const SurveyedInterface& surveyed, Side side) {
  const BusInterface& bus = surveyed.bus;
  if (bus.side == side && !bus.scope.empty()) return bus.scope;
  for (const BusInterface::Copy& copy : bus.copies) {
    if (copy.side == side && !copy.scope.empty()) return copy.scope;
  }
  const bool stream = bus.kind == BusKind::axi_stream, manager = side == Side::manager;
  return std::string("the ") +
         (stream ? (manager ? "sender" : "receiver") : (manager ? "manager" : "subordinate")) +
         " of " + bus.name;
}

struct WaitsFor {
  std::string from, to;
  std::vector<const Wait*> waits;  ///< the longest first
};

std::string clocks_text(std::uint64_t clocks) {
  return std::to_string(clocks) + (clocks == 1 ? " clock" : " clocks");
}

std::string waits_text(const WaitsFor& edge) {
  std::string text = edge.from + " waits for " + edge.to + " since " +
                     vp::format_time(edge.waits.front()->since_ps) + " (";
  for (const Wait* wait : edge.waits) {
    text +=
        (wait == edge.waits.front() ? "" : "; ") + wait->what + ", " + clocks_text(wait->clocks);
    if (wait->idle_since_cycle)
      text += ", low since cycle " + std::to_string(*wait->idle_since_cycle);
  }
  return text + ")";
}

/// The edges from one that nothing else waits for along the waits, as far as they lead.
std::vector<WaitsFor> chain_from(const std::vector<WaitsFor>& edges, WaitsFor first) {
  std::vector<WaitsFor> chain = {std::move(first)};
  std::set<std::string> seen = {chain.front().from};
  while (seen.insert(chain.back().to).second) {
    const auto next = std::find_if(edges.begin(), edges.end(), [&](const WaitsFor& edge) {
      return edge.from == chain.back().to;
    });
    if (next == edges.end()) break;
    chain.push_back(*next);
  }
  return chain;
}

std::string last_moved(const HangFacts& facts) {
  const SampleEdge* last = nullptr;
  std::size_t place = 0;
  for (std::size_t i = 0; i < facts.moved.size(); ++i) {
    // A line without a handshake says nothing about who waits.
    if (!is_clocked(facts.survey.interfaces[i].bus.kind)) continue;
    if (facts.moved[i] && (!last || facts.moved[i]->ps > last->ps)) {
      last = &*facts.moved[i];
      place = i;
    }
  }
  if (!last) return "nothing ever moved";
  return "the last thing that moved was " + facts.moved_what[place] + " on " +
         facts.survey.interfaces[place].bus.name + " at " + vp::format_time(last->ps);
}

/// One edge from a party to another, with all that it waits for there; the oldest first.
std::vector<WaitsFor> edges_of(const HangFacts& facts) {
  std::vector<const Wait*> waits;
  for (const Wait& wait : facts.waits) waits.push_back(&wait);
  std::stable_sort(waits.begin(), waits.end(),
                   [](const Wait* a, const Wait* b) { return a->since_ps < b->since_ps; });
  std::vector<WaitsFor> edges;
  for (const Wait* wait : waits) {
    const SurveyedInterface& bus = facts.survey.interfaces[wait->interface];
    std::string from = party(bus, Side::subordinate), to = party(bus, Side::manager);
    if (!wait->for_manager) std::swap(from, to);
    const auto same = std::find_if(edges.begin(), edges.end(), [&](const WaitsFor& edge) {
      return edge.from == from && edge.to == to;
    });
    if (same == edges.end()) {
      edges.push_back({from, to, {wait}});
    } else {
      same->waits.push_back(wait);
    }
  }
  return edges;
}

}  // namespace

std::string hang_sentence(const HangFacts& facts) {
  const std::vector<WaitsFor> edges = edges_of(facts);
  if (edges.empty()) return "";
  std::set<std::string> waiting, awaited;
  for (const WaitsFor& edge : edges) {
    waiting.insert(edge.from);
    awaited.insert(edge.to);
  }
  // Begin where nothing waits, so that the chain is as long as it may be.
  const auto first = std::find_if(edges.begin(), edges.end(), [&](const WaitsFor& edge) {
    return awaited.count(edge.from) == 0;
  });
  const std::vector<WaitsFor> chain =
      chain_from(edges, first == edges.end() ? edges.front() : *first);
  std::string text;
  for (const WaitsFor& edge : chain) text += (text.empty() ? "" : ", ") + waits_text(edge);
  const std::string& root = chain.back().to;
  text += waiting.count(root) != 0 ? ": a deadlock" : ": " + root + " is the root";
  return text + "; " + last_moved(facts) + ".";
}

}  // namespace platform::trace
