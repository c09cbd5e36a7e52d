#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <chip/watch/bus_log.h>
#include <trace/transactions/json_rows.h>
#include <trace/transactions/summary.h>
#include <trace/transactions/transactions.h>
#include <vp/file.h>
#include <vp/signal.h>

namespace platform {

/// Writes what passes the buses as `markervp trace transactions --json` writes it, without a trace:
/// accesses of the processors, bursts of the DMA engines, interrupts of the logic. An access lasts
/// from when it leaves its initiator to when its answer is there. There is no clock to count by,
/// and bursts have neither beats nor data.
class TransactionLog : public BusWatch, private vp::SignalListener {
 public:
  /// Before the simulation starts. Throws vp::OutputError if the file cannot be written.
  TransactionLog(const std::string& file, Zynq& zynq);
  ~TransactionLog() override;

  /// Ends the file, which has its name only now. Throws vp::OutputError if not all could be
  /// written.
  void close();

 private:
  void note(const BusAccess& access) override;
  void on_change(vp::SignalBase& lines, std::uint32_t) override;
  std::uint32_t interface_of(const std::string& name, trace::BusKind kind);
  void add(trace::Transaction&& one);
  void write_first();

  vp::OutputFile file_;
  trace::TransactionsJson json_;
  trace::Survey survey_;
  std::map<std::string, std::uint32_t> place_of_;  ///< of interfaces
  /// By when they begin, until those that began earlier are there.
  std::multimap<std::uint64_t, trace::Transaction> waiting_;
  trace::TransactionSummary summary_{survey_};
  vp::SignalBase* lines_;
  std::uint64_t lines_now_ = 0;
  std::map<unsigned, std::uint64_t> active_since_;  ///< by line
};

}  // namespace platform
