#include <algorithm>
#include <map>
#include <set>

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

struct Edge {
  std::string from, to;
  const Wait* wait;
};

std::string clocks_text(std::uint64_t clocks) {
  return std::to_string(clocks) + (clocks == 1 ? " clock" : " clocks");
}

std::string waits_text(const Edge& edge) {
  return edge.from + " waits for " + edge.to + " since " + vp::format_time(edge.wait->since_ps) +
         " (" + edge.wait->channel + ": " + edge.wait->what + ", " +
         clocks_text(edge.wait->clocks) + ")";
}

/// The edges from one that nothing else waits for along the waits, as far as they lead.
std::vector<Edge> chain_from(const std::vector<Edge>& edges, Edge first) {
  std::vector<Edge> chain = {std::move(first)};
  std::set<std::string> seen = {chain.front().from};
  while (seen.insert(chain.back().to).second) {
    const auto next = std::find_if(edges.begin(), edges.end(),
                                   [&](const Edge& edge) { return edge.from == chain.back().to; });
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

}  // namespace

std::string hang_sentence(const HangFacts& facts) {
  std::vector<Edge> edges;
  for (const Wait& wait : facts.waits) {
    const SurveyedInterface& bus = facts.survey.interfaces[wait.interface];
    const std::string manager = party(bus, Side::manager), other = party(bus, Side::subordinate);
    edges.push_back(
        {wait.for_manager ? other : manager, wait.for_manager ? manager : other, &wait});
  }
  if (edges.empty()) return "";
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.wait->since_ps < b.wait->since_ps;
  });
  std::set<std::string> waiting, awaited;
  for (const Edge& edge : edges) {
    waiting.insert(edge.from);
    awaited.insert(edge.to);
  }
  // Begin where nothing waits, so that the chain is as long as it may be.
  const auto first = std::find_if(edges.begin(), edges.end(),
                                  [&](const Edge& edge) { return awaited.count(edge.from) == 0; });
  const std::vector<Edge> chain = chain_from(edges, first == edges.end() ? edges.front() : *first);
  std::string text;
  for (const Edge& edge : chain) text += (text.empty() ? "" : ", ") + waits_text(edge);
  const std::string& root = chain.back().to;
  text += waiting.count(root) != 0 ? ": a deadlock" : ": " + root + " is the root";
  return text + "; " + last_moved(facts) + ".";
}

}  // namespace platform::trace
