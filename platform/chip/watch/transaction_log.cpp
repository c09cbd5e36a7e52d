#include <chip/watch/transaction_log.h>

#include <utility>

#include <trace/transactions/decoder.h>

namespace platform {

namespace {

/// Transactions that wait until none can come that began earlier. Beyond it the first is written:
/// an access that is announced so late comes behind those that began after it.
constexpr std::size_t most_waiting = 4096;

}  // namespace

TransactionLog::TransactionLog(const std::string& file, Zynq& zynq)
    : BusWatch(zynq),
      file_(file),
      json_([this](std::string_view text) { file_.write(text); }),
      lines_(zynq.ps.gic.irq_f2p.signal()) {
  if (!lines_) return;
  lines_->attach(*this, 0);
  lines_now_ = lines_->bits();
}

TransactionLog::~TransactionLog() {
  if (lines_) lines_->detach(*this);
}

std::uint32_t TransactionLog::interface_of(const std::string& name, trace::BusKind kind) {
  const auto [known, is_new] =
      place_of_.emplace(name, static_cast<std::uint32_t>(survey_.interfaces.size()));
  if (is_new) {
    trace::SurveyedInterface& added = survey_.interfaces.emplace_back();
    added.bus.name = name;
    added.bus.kind = kind;
  }
  return known->second;
}

void TransactionLog::note(const BusAccess& access) {
  trace::Transaction one;
  one.interface = interface_of(access.link, trace::BusKind::axi4);
  one.operation = access.read ? "read" : "write";
  one.address = access.address;
  one.bytes = access.bytes;
  one.response = access.response == tlm::TLM_OK_RESPONSE ? "OKAY" : access.answer();
  if (access.by_processor && access.word) {
    one.beats = one.beats_done = 1;
    one.size = access.bytes;
    trace::add_word(one, *access.word);
  }
  if (!access.by_processor) one.note = "answered at once; its beats take their time in the engine";
  one.begin_ps = access.ps;
  one.end_ps = access.end_ps;
  add(std::move(one));
}

void TransactionLog::on_change(vp::SignalBase& lines, std::uint32_t) {
  const std::uint64_t now = lines.bits(), changed = now ^ std::exchange(lines_now_, now);
  const std::uint64_t ps = zynq().scheduler.now_ps();
  for (unsigned line = 0; line < lines.width(); ++line) {
    if ((changed >> line & 1U) == 0) continue;
    if ((now >> line & 1U) != 0) {
      active_since_[line] = ps;
      continue;
    }
    const auto active = active_since_.find(line);
    if (active == active_since_.end()) continue;
    trace::Transaction one;
    one.interface = interface_of(lines.name(), trace::BusKind::irq);
    one.operation = "interrupt";
    one.id = line;
    one.begin_ps = active->second;
    one.end_ps = ps;
    active_since_.erase(active);
    add(std::move(one));
  }
}

void TransactionLog::add(trace::Transaction&& one) {
  waiting_.emplace(one.begin_ps, std::move(one));
  if (waiting_.size() > most_waiting) write_first();
}

void TransactionLog::write_first() {
  const auto first = waiting_.begin();
  json_.add(first->second, survey_.interfaces[first->second.interface]);
  summary_.add(first->second);
  waiting_.erase(first);
}

void TransactionLog::close() {
  for (const auto& [line, since] : active_since_) {
    trace::Transaction one;
    one.interface = interface_of(lines_->name(), trace::BusKind::irq);
    one.operation = "interrupt";
    one.id = line;
    one.begin_ps = since;
    one.note = "active at the end";
    waiting_.emplace(since, std::move(one));
  }
  while (!waiting_.empty()) write_first();
  survey_.last_ps = zynq().scheduler.now_ps();
  std::vector<trace::Table> tables = trace::interface_tables(survey_);
  for (trace::Table& table : summary_.tables()) tables.push_back(std::move(table));
  for (trace::Table& table : trace::end_tables(survey_, {})) tables.push_back(std::move(table));
  json_.close(tables, "");
  file_.commit();
}

}  // namespace platform
