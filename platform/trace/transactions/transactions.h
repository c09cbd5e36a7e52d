#pragma once

#include <trace/statistics.h>
#include <trace/transactions/decoder.h>
#include <vp/expression.h>
#include <vp/frame_gate.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace platform::trace {

/// Which transactions are looked for, and how.
struct TransactionsOptions {
  std::vector<BusKind> kinds;          ///< empty: all
  vp::TraceFilter filter;              ///< of the interfaces' names
  std::vector<std::string> described;  ///< see describe_interface()
  StatisticsOptions clocks;
  DecodeOptions decode;
  std::uint64_t to_ps = std::numeric_limits<std::uint64_t>::max();  ///< the trace ends there
};

/// The buses of a trace. Reads it once. Throws vp::InputError if none is found.
Survey survey_transactions(TraceFile& file, const TransactionsOptions& options);

/// A rule and how often a bus broke it.
struct BrokenRule {
  std::uint32_t interface = 0;
  std::string rule;
  std::uint64_t count = 0;
  Violation first;
};

/// What a whole reading found beside the transactions.
struct TransactionsEnd {
  std::vector<BrokenRule> broken;  ///< by interface, then rule
  std::vector<Wait> waits;         ///< at the end of the trace
  std::string hang;                ///< who waits for whom, in a sentence; empty: something moves
};

/// Hands over every transaction, in the order in which they begin; only one that is open while
/// 4096 later ones end comes when it ends. `file` is a fresh one of the trace that `survey` is of.
/// `hang_clocks`: waits of fewer clocks are no hang. Throws vp::InputError.
TransactionsEnd read_transactions(TraceFile& file, const Survey& survey,
                                  const TransactionsOptions& options, std::uint64_t hang_clocks,
                                  const std::function<void(const Transaction&)>& take);

/// Who waits for whom, and what moved last.
struct HangFacts {
  const Survey& survey;
  std::vector<Wait> waits;                       ///< long enough to count
  std::vector<std::optional<SampleEdge>> moved;  ///< by interface
  std::vector<std::string> moved_what;
  std::uint64_t end_ps = 0;
};

/// One sentence: who waits, since when, for whom, and the last thing that moved. The party that
/// others wait for and that waits for none is the root; if all wait, it is a deadlock. Empty
/// without waits.
std::string hang_sentence(const HangFacts& facts);

}  // namespace platform::trace
