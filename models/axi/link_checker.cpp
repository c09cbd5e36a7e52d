#include <axi/link_checker.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <vp/text.h>

namespace axi {

namespace {

using vp::Rule;

[[gnu::cold]] std::string text_of(const Address& a) {
  static constexpr const char* types[] = {"FIXED", "INCR", "WRAP", "reserved"};
  return std::string(types[static_cast<unsigned>(a.burst) & 3]) + " of " + std::to_string(a.beats) +
         " beats of " + std::to_string(a.beat_bytes()) + " bytes from " + vp::hex(a.address);
}

/// Lanes of the bus that a beat may write.
Strobes lanes_of(const Address& a, unsigned beat, unsigned data_bytes) {
  return lanes(static_cast<unsigned>(a.beat_address(beat)) & (data_bytes - 1), a.bytes_in(beat));
}

/// Whether bytes that are to be written differ.
bool written_differ(const WriteChannel& a, const WriteChannel& b, unsigned data_bytes) {
  for (unsigned lane = 0; lane < data_bytes; ++lane) {
    if (a.strobes[lane] && a.data[lane] != b.data[lane]) return true;
  }
  return false;
}

/// Which wires of AW differ; `first` is the first rule of the channel.
template <Rule first>
auto request_changes(const AddressChannel& held, const AddressChannel& now) {
  const auto rule = [](Rule of_aw) {
    return first == Rule::aw_addr_boundary ? of_aw : vp::on_ar(of_aw);
  };
  const Address &a = held.beat, &b = now.beat;
  return std::array{std::pair{rule(Rule::aw_addr_stable), a.address != b.address},
                    std::pair{rule(Rule::aw_id_stable), a.id != b.id},
                    std::pair{rule(Rule::aw_len_stable), a.beats != b.beats},
                    std::pair{rule(Rule::aw_size_stable), a.size != b.size},
                    std::pair{rule(Rule::aw_burst_stable), a.burst != b.burst},
                    std::pair{rule(Rule::aw_lock_stable), a.lock != b.lock},
                    std::pair{rule(Rule::aw_cache_stable), a.cache != b.cache},
                    std::pair{rule(Rule::aw_prot_stable), a.prot != b.prot},
                    std::pair{rule(Rule::aw_qos_stable), a.qos != b.qos},
                    std::pair{rule(Rule::aw_region_stable), a.region != b.region}};
}

}  // namespace

void LinkChecker::broken(Rule rule, const std::string& what) {
  reports_.violate(rule, &clock_, what);
}

void LinkChecker::edge(const Wires& wires, bool in_reset) {
  if (in_reset || was_reset_) check_reset(wires, in_reset);
  if (in_reset) return;
  const bool new_response = !held_.b.valid, new_data = !held_.r.valid;
  check_stable(wires);
  if (wires.quiet()) return;
  // Responses first: what they answer passed on an earlier edge.
  if (wires.b.valid) check_response(wires, new_response);
  if (wires.r.valid) check_read_data(wires, new_data);
  if (wires.aw.passes()) {
    if (!shape_.lite) check_request(wires.aw.beat, false);
    writes_.push_back({wires.aw.beat});
    match_data();
  }
  if (wires.ar.passes()) {
    if (!shape_.lite) check_request(wires.ar.beat, true);
    reads_.push_back({wires.ar.beat});
  }
  if (wires.w.passes()) check_write_beat(wires.w);
  forget_answered(wires);
}

/// What was answered on the edge of its request, against the rules, waits no more.
void LinkChecker::forget_answered(const Wires& wires) {
  if (std::exchange(early_response_, false) && wires.aw.passes()) writes_.pop_back();
  if (std::exchange(early_data_, false) && wires.ar.passes() && reads_.back().address.beats == 1)
    reads_.pop_back();
}

// During reset and on the first edge behind it no VALID is high. What was under way is forgotten.
void LinkChecker::check_reset(const Wires& wires, bool in_reset) {
  if (was_reset_) {
    const bool manager = resets_ != Resets::subordinate, subordinate = resets_ != Resets::manager;
    const std::pair<bool, Rule> channels[] = {{manager && wires.aw.valid, Rule::aw_valid_reset},
                                              {manager && wires.w.valid, Rule::w_valid_reset},
                                              {manager && wires.ar.valid, Rule::ar_valid_reset},
                                              {subordinate && wires.b.valid, Rule::b_valid_reset},
                                              {subordinate && wires.r.valid, Rule::r_valid_reset}};
    for (const auto& [valid, rule] : channels) {
      if (valid) broken(rule, "it is high");
    }
  }
  was_reset_ = in_reset;
  held_ = Wires();
  writes_.clear();
  reads_.clear();
  early_.clear();
  early_beats_ = 0;
}

// A channel whose VALID waited on the last edge: `fell` if VALID fell, else each rule whose wire
// has changed.
template <class Channel, class Changes>
void LinkChecker::check_stable(Channel& held, const Channel& now, Rule fell, Changes changes) {
  const bool waits = now.valid && !now.ready;
  if (!held.valid && !waits) return;
  bool same = held.valid && now.valid;
  if (held.valid && !now.valid) {
    broken(fell, "it fell without READY");
  } else if (held.valid) {
    for (const auto& [rule, changed] : changes(held, now)) {
      if (!changed) continue;
      broken(rule, "it changed without READY");
      same = false;
    }
  }
  if (waits && !same) held = now;
  held.valid = waits;
}

void LinkChecker::check_stable(const Wires& wires) {
  const auto waits = [](const Handshake& channel) { return channel.valid && !channel.ready; };
  const bool manager = resets_ != Resets::subordinate, subordinate = resets_ != Resets::manager;
  const bool any_waits = (manager && (waits(wires.aw) || waits(wires.ar) || waits(wires.w))) ||
                         (subordinate && (waits(wires.b) || waits(wires.r)));
  if (!std::exchange(any_held_, any_waits) && !any_waits) return;
  if (manager) check_requests_stable(wires);
  if (!subordinate) return;
  const unsigned bytes = shape_.data_bytes;
  const auto other_data = [bytes](const auto& a, const auto& b) {
    return !std::equal(a.data.begin(), a.data.begin() + bytes, b.data.begin());
  };
  check_stable(held_.b, wires.b, Rule::b_valid_stable,
               [](const ResponseChannel& a, const ResponseChannel& b) {
                 return std::array{std::pair{Rule::b_id_stable, a.id != b.id},
                                   std::pair{Rule::b_resp_stable, a.response != b.response}};
               });
  check_stable(held_.r, wires.r, Rule::r_valid_stable,
               [&](const ReadChannel& a, const ReadChannel& b) {
                 return std::array{std::pair{Rule::r_id_stable, a.id != b.id},
                                   std::pair{Rule::r_data_stable, other_data(a, b)},
                                   std::pair{Rule::r_resp_stable, a.response != b.response},
                                   std::pair{Rule::r_last_stable, a.last != b.last}};
               });
}

void LinkChecker::check_requests_stable(const Wires& wires) {
  const unsigned bytes = shape_.data_bytes;
  check_stable(held_.aw, wires.aw, Rule::aw_valid_stable, request_changes<Rule::aw_addr_boundary>);
  check_stable(held_.ar, wires.ar, Rule::ar_valid_stable, request_changes<Rule::ar_addr_boundary>);
  check_stable(held_.w, wires.w, Rule::w_valid_stable,
               [&](const WriteChannel& a, const WriteChannel& b) {
                 return std::array{std::pair{Rule::w_data_stable, written_differ(a, b, bytes)},
                                   std::pair{Rule::w_strb_stable, a.strobes != b.strobes},
                                   std::pair{Rule::w_last_stable, a.last != b.last}};
               });
}

// Of AXI4-Lite all of this is so by itself: one whole word.
void LinkChecker::check_request(const Address& a, bool read) {
  const auto report = [&](Rule of_aw) __attribute__((cold)) {
    broken(read ? vp::on_ar(of_aw) : of_aw, text_of(a));
  };
  const std::uint64_t bytes = std::uint64_t{a.beats} * a.beat_bytes();
  if (a.beat_bytes() > shape_.data_bytes) report(Rule::aw_size);
  if ((a.cache & 0xC) != 0 && (a.cache & 2) == 0) report(Rule::aw_cache);
  if (a.lock && (a.beats > 16 || bytes > 128 || !power_of_two(static_cast<unsigned>(bytes)) ||
                 a.address % bytes != 0))
    report(Rule::aw_len_lock);
  switch (a.burst) {
    case BurstType::incr:
      if (a.address / boundary != (a.address - a.skew() + bytes - 1) / boundary)
        report(Rule::aw_addr_boundary);
      break;
    case BurstType::wrap:
      if (a.skew() != 0) report(Rule::aw_addr_wrap_align);
      if (a.beats < 2 || a.beats > 16 || !power_of_two(a.beats)) report(Rule::aw_len_wrap);
      break;
    case BurstType::fixed:
      if (a.beats > 16) report(Rule::aw_len_fixed);
      break;
    case BurstType::reserved:
      report(Rule::aw_burst);
      break;
  }
}

/// Bursts of data meet their addresses in order; either may come first.
void LinkChecker::match_data() {
  if (early_.empty()) {
    Open& write = writes_.back();
    // The first one that is without data takes what is there of a burst.
    const bool first = writes_.size() == 1 || (writes_.end() - 2)->complete;
    if (first) write.beats = std::exchange(early_beats_, 0);
    return;
  }
  Open& write = writes_.back();
  write.beats = early_.front();
  write.complete = true;
  early_.pop_front();
  if (write.beats != write.address.beats)
    broken(Rule::w_data_num, text_of(write.address) + " got " + std::to_string(write.beats));
}

void LinkChecker::check_write_beat(const WriteChannel& beat) {
  const auto open = std::find_if(writes_.begin(), writes_.end(),
                                 [](const Open& write) { return !write.complete; });
  const bool last = beat.last || shape_.lite;
  if (open == writes_.end()) {
    ++early_beats_;
    if (last) early_.push_back(std::exchange(early_beats_, 0));
    return;
  }
  const Address& a = open->address;
  if (!shape_.lite && open->beats < a.beats && a.bytes_in(open->beats) < shape_.data_bytes) {
    const Strobes others = bus_lanes_ & ~lanes_of(a, open->beats, shape_.data_bytes);
    if ((beat.strobes & others).any())
      broken(Rule::w_strb, "beat " + std::to_string(open->beats) + " of " + text_of(a));
  }
  ++open->beats;
  if (last != (open->beats == a.beats))
    broken(Rule::w_data_num, text_of(a) + " has WLAST " + (last ? "with" : "missing at") +
                                 " beat " + std::to_string(open->beats));
  open->complete = last || open->beats == a.beats;
}

void LinkChecker::check_response(const Wires& wires, bool is_new) {
  const auto of_id = [&](const Open& write) { return write.address.id == wires.b.id; };
  const auto oldest = std::find_if(writes_.begin(), writes_.end(), of_id);
  if (oldest == writes_.end()) {
    if (is_new && !writes_.empty())
      broken(Rule::b_id, "BID is " + std::to_string(wires.b.id));
    else if (is_new)
      broken(Rule::b_resp_aw, "BVALID without a write");
    early_response_ = wires.b.passes();
    return;
  }
  if (is_new && !oldest->complete)
    broken(Rule::b_resp_wlast, "BVALID for " + text_of(oldest->address));
  if (wires.b.response == Response::exokay && (shape_.lite || !oldest->address.lock))
    broken(Rule::b_resp_exokay, "BRESP of " + text_of(oldest->address));
  if (wires.b.passes()) writes_.erase(oldest);
}

void LinkChecker::check_read_data(const Wires& wires, bool is_new) {
  const auto oldest = std::find_if(reads_.begin(), reads_.end(),
                                   [&](const Open& read) { return read.address.id == wires.r.id; });
  if (oldest == reads_.end()) {
    if (is_new)
      broken(Rule::r_id, reads_.empty()
                             ? "RVALID without a read whose address has passed"
                             : "RID is " + std::to_string(wires.r.id) + ", and of " +
                                   std::to_string(reads_.size()) + " reads that wait none has it");
    early_data_ = wires.r.passes();
    return;
  }
  const Address& a = oldest->address;
  if (wires.r.response == Response::exokay && (shape_.lite || !a.lock))
    broken(Rule::r_resp_exokay, "RRESP of " + text_of(a));
  if (!wires.r.passes()) return;
  const bool last = ++oldest->beats == a.beats;
  if (!shape_.lite && wires.r.last != last)
    broken(Rule::r_data_num, text_of(a) + " has RLAST " + (last ? "missing at" : "with") +
                                 " beat " + std::to_string(oldest->beats));
  if (last || (wires.r.last && !shape_.lite)) reads_.erase(oldest);
}

void LinkChecker::finish() {
  const std::size_t open = writes_.size() + reads_.size();
  if (open != 0)
    broken(Rule::axi_all_done_eos, std::to_string(open) + " bursts wait for their response");
  reports_.finish();
}

}  // namespace axi
