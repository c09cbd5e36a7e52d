#include <trace/transactions/transactions.h>

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include <vp/error.h>
#include <vp/text.h>

namespace platform::trace {

namespace {

constexpr unsigned __int128 ps_per_s_wide = 1'000'000'000'000;

/// Passes transactions on in the order of their tickets.
class Order final : public TransactionSink {
 public:
  explicit Order(const std::function<void(const Transaction&)>& take) : take_(take) {}

  Ticket open() override {
    waiting_.emplace_back();
    // One that is open for long keeps no more than these waiting.
    if (waiting_.size() > most_waiting && !waiting_.front()) skip_front();
    return first_ + waiting_.size() - 1;
  }
  void take(Ticket ticket, Transaction transaction) override {
    if (ticket < first_) {
      take_(transaction);
      return;
    }
    waiting_[ticket - first_] = std::move(transaction);
    pass_on();
  }
  void broken(std::uint32_t interface, const Violation& violation) override {
    BrokenRule& rule = broken_[{interface, violation.rule}];
    if (rule.count++ == 0) rule.first = violation;
    rule.interface = interface;
    rule.rule = violation.rule;
  }

  std::vector<BrokenRule> broken_rules() const {
    std::vector<BrokenRule> rules;
    for (const auto& [key, rule] : broken_) rules.push_back(rule);
    return rules;
  }

 private:
  static constexpr std::size_t most_waiting = 4096;

  void skip_front() {
    waiting_.pop_front();
    ++first_;
    pass_on();
  }
  void pass_on() {
    while (!waiting_.empty() && waiting_.front()) {
      take_(*waiting_.front());
      waiting_.pop_front();
      ++first_;
    }
  }

  const std::function<void(const Transaction&)>& take_;
  std::deque<std::optional<Transaction>> waiting_;  ///< by ticket; none: still open
  Ticket first_ = 0;
  std::map<std::pair<std::uint32_t, std::string>, BrokenRule> broken_;
};

std::vector<std::unique_ptr<Decoder>> decoders_of(const DecoderContext& context) {
  std::vector<std::unique_ptr<Decoder>> decoders;
  const BusInterface& bus = context.surveyed.bus;
  switch (bus.kind) {
    case BusKind::axi4:
    case BusKind::axi4_lite:
      if (bus.role("arvalid")) decoders.push_back(axi_read_decoder(context));
      if (bus.role("awvalid")) decoders.push_back(axi_write_decoder(context));
      break;
    case BusKind::axi_stream:
      decoders.push_back(stream_decoder(context));
      break;
    case BusKind::apb:
      decoders.push_back(apb_decoder(context));
      break;
    case BusKind::wishbone:
      decoders.push_back(wishbone_decoder(context));
      break;
    case BusKind::uart:
      decoders.push_back(uart_decoder(context));
      break;
    case BusKind::i2c:
      decoders.push_back(i2c_decoder(context));
      break;
    case BusKind::spi:
      decoders.push_back(spi_decoder(context));
      break;
    case BusKind::irq:
      decoders.push_back(interrupt_decoder(context));
      break;
  }
  return decoders;
}

/// Drives the decoders over a trace: those of a clock on its edges, when something changed or is
/// going on, the others on every change.
class Reading final : public Replay::Listener {
 public:
  Reading(TraceFile& file, const Survey& survey, const TransactionsOptions& options,
          TransactionSink& sink)
      : file_(file),
        survey_(survey),
        options_(options),
        replay_(file),
        clocks_(replay_, file, options.clocks) {
    replay_.keep_texts();
    replay_.end_at(options.to_ps);
    for (std::uint32_t i = 0; i < survey.interfaces.size(); ++i) add(i, sink);
  }

  void run() {
    replay_.run(*this);
    for (Driven& one : all_) {
      const std::uint64_t edges = one.clock ? cycles_of(*one.clock) : 0;
      one.decoder->finish(replay_.last_ps(), edges);
    }
  }
  HangFacts facts(std::uint64_t hang_clocks) const;
  std::vector<Wait> waits() const {
    std::vector<Wait> all;
    for (const Driven& one : all_) {
      const auto own = one.decoder->waits();
      all.insert(all.end(), own.begin(), own.end());
    }
    return all;
  }

 private:
  struct Driven {
    std::unique_ptr<Decoder> decoder;
    std::uint32_t interface = 0;
    std::optional<std::size_t> clock;
    bool pending = false;  ///< the next edge matters, or this instant of a bus without a clock
  };

  void add(std::uint32_t place, TransactionSink& sink);
  bool instant(std::uint64_t ps) override;
  void edges_of(std::size_t clock, std::uint64_t ps);
  void edge(std::size_t clock, const SampleEdge& edge);
  /// Edges up to now; of an assumed clock the one at 0 counts.
  std::uint64_t cycles_of(std::size_t clock) const {
    return clocks_[clock].edges() + (clocks_[clock].has_wire() ? 0 : 1);
  }

  TraceFile& file_;
  const Survey& survey_;
  const TransactionsOptions& options_;
  Replay replay_;
  ClockSet clocks_;
  std::vector<Driven> all_;
  std::vector<std::vector<std::size_t>> users_;    ///< by slot: places in all_
  std::vector<std::vector<std::size_t>> pending_;  ///< by clock: places in all_
  std::vector<std::uint64_t> seen_;                ///< edges, by clock
  std::vector<std::size_t> changed_;               ///< without a clock, in this instant
};

void Reading::add(std::uint32_t place, TransactionSink& sink) {
  const SurveyedInterface& surveyed = survey_.interfaces[place];
  std::optional<std::size_t> clock;
  if (is_clocked(surveyed.bus.kind))
    clock = surveyed.clock ? clocks_.of(*surveyed.clock, surveyed.falling) : clocks_.assumed();
  if (clock && pending_.size() <= *clock) {
    pending_.resize(*clock + 1);
    seen_.resize(*clock + 1);
  }
  for (auto& decoder : decoders_of({surveyed, place, replay_, sink, options_.decode})) {
    for (const Replay::Slot slot : decoder->slots()) {
      if (users_.size() <= slot) users_.resize(slot + 1);
      auto& users = users_[slot];
      if (users.empty() || users.back() != all_.size()) users.push_back(all_.size());
    }
    all_.push_back({std::move(decoder), place, clock, false});
  }
}

bool Reading::instant(std::uint64_t ps) {
  clocks_.instant(ps);
  for (std::size_t clock = 0; clock < pending_.size(); ++clock) {
    if (clocks_[clock].edges() != seen_[clock]) edges_of(clock, ps);
  }
  for (const Replay::Slot slot : replay_.changed()) {
    if (slot >= users_.size()) continue;
    for (const std::size_t user : users_[slot]) {
      Driven& one = all_[user];
      if (one.pending) continue;
      one.pending = true;
      (one.clock ? pending_[*one.clock] : changed_).push_back(user);
    }
  }
  for (const std::size_t user : changed_) {
    all_[user].pending = false;
    all_[user].decoder->change(ps);
  }
  changed_.clear();
  return true;
}

/// All edges since the last look saw what stood before this instant.
void Reading::edges_of(std::size_t clock, std::uint64_t ps) {
  const std::uint64_t now = clocks_[clock].edges();
  if (clocks_[clock].has_wire()) {
    edge(clock, {ps, now - 1});
    seen_[clock] = now;
    return;
  }
  constexpr std::uint64_t most = 1'000'000;
  std::uint64_t looked_at = 0;
  while (seen_[clock] != now && !pending_[clock].empty()) {
    const std::uint64_t n = ++seen_[clock];
    const auto time =
        (static_cast<unsigned __int128>(n) * ps_per_s_wide + options_.clocks.system_hz / 2) /
        options_.clocks.system_hz;
    edge(clock, {static_cast<std::uint64_t>(time), n});
    if (++looked_at == most) {
      throw vp::InputError("trace '" + file_.name() + "': nothing changes for " +
                           std::to_string(most) + " clocks of " + clocks_.text(clock) +
                           " while data pass: give the right clock with --clock");
    }
  }
  seen_[clock] = now;
}

void Reading::edge(std::size_t clock, const SampleEdge& edge) {
  std::vector<std::size_t>& pending = pending_[clock];
  std::size_t kept = 0;
  for (const std::size_t user : pending) {
    Driven& one = all_[user];
    one.decoder->edge(edge);
    one.pending = one.decoder->busy() || options_.decode.max_wait != 0;
    if (one.pending) pending[kept++] = user;
  }
  pending.resize(kept);
}

HangFacts Reading::facts(std::uint64_t hang_clocks) const {
  HangFacts facts{survey_, {}, {}, {}, replay_.last_ps()};
  for (const Wait& wait : waits()) {
    if (wait.clocks >= hang_clocks) facts.waits.push_back(wait);
  }
  facts.moved.resize(survey_.interfaces.size());
  facts.moved_what.resize(survey_.interfaces.size());
  for (const Driven& one : all_) {
    const auto& moved = one.decoder->moved();
    auto& last = facts.moved[one.interface];
    if (!moved || (last && last->ps > moved->ps)) continue;
    last = moved;
    facts.moved_what[one.interface] = one.decoder->moved_what();
  }
  return facts;
}

[[noreturn]] void refuse(const TraceFile& file, const Survey& found) {
  std::string message = "trace '" + file.name() + "': no bus was found";
  if (!found.left_out.empty()) {
    message += "; " + found.left_out.front().name + " " + found.left_out.front().reason;
  }
  throw vp::InputError(message +
                       ": describe one with --as 'axi4 NAME: awvalid=SIGNAL …', or rename its "
                       "signals with --map");
}

}  // namespace

Survey survey_transactions(TraceFile& file, const TransactionsOptions& options) {
  FoundInterfaces found = find_interfaces(file);
  for (const std::string& text : options.described) describe_interface(file, text, found);
  std::vector<std::string> names;
  for (const BusInterface& one : found.interfaces) names.push_back(one.name);
  for (const LeftOut& one : found.left_out) names.push_back(one.name);
  if (!names.empty()) options.filter.check(names, {});
  auto& all = found.interfaces;
  const auto unwanted = [&](const BusInterface& one) {
    const bool kind = options.kinds.empty() || std::find(options.kinds.begin(), options.kinds.end(),
                                                         one.kind) != options.kinds.end();
    return !kind || !options.filter.selects(one.name);
  };
  all.erase(std::remove_if(all.begin(), all.end(), unwanted), all.end());
  Survey result = survey(file, std::move(found), options.clocks, options.to_ps);
  if (result.interfaces.empty()) refuse(file, result);
  // Two buses of one name, as a stream and an interrupt in one scope, get names of their own.
  std::map<std::string, unsigned> count;
  for (SurveyedInterface& one : result.interfaces) {
    const unsigned n = ++count[one.bus.name];
    if (n > 1) one.bus.name += "#" + std::to_string(n);
  }
  return result;
}

TransactionsEnd read_transactions(TraceFile& file, const Survey& survey,
                                  const TransactionsOptions& options, std::uint64_t hang_clocks,
                                  const std::function<void(const Transaction&)>& take) {
  Order order(take);
  Reading reading(file, survey, options, order);
  reading.run();
  TransactionsEnd end;
  end.broken = order.broken_rules();
  end.waits = reading.waits();
  end.hang = hang_sentence(reading.facts(hang_clocks));
  return end;
}

}  // namespace platform::trace
