#include <algorithm>
#include <deque>
#include <iterator>

#include <trace/transactions/axi_side.h>

// Write data have no id: they are paired in the order of addresses, and may come before theirs.
// AXI3 pairs them by WID.

namespace platform::trace {

namespace {

/// Bursts of data without an address that are kept.
constexpr std::size_t most_early = 4096;

class AxiWrites final : public AxiSide {
 public:
  explicit AxiWrites(const DecoderContext& context)
      : AxiSide(context, "write", "AW", "W"),
        data_channel_(channel("W", true, {"DATA", "STRB", "LAST", "ID", "USER"})),
        response_(channel("B", false, {"ID", "RESP", "USER"})),
        write_id_(role("wid")),
        data_(role("wdata")),
        strobe_(role("wstrb")),
        last_(role("wlast")),
        id_(role("bid")),
        code_(role("bresp")) {}

  bool busy() const override { return AxiSide::busy() || data_channel_.beat() || response_.beat(); }

 private:
  /// Data that came before their address.
  struct Early {
    std::optional<std::uint64_t> id;
    Transaction beats;
    std::vector<std::string> strobes;  ///< digits, by beat
    SampleEdge last_beat;
    bool closed = false;  ///< LAST passed
  };

  void forget() override {
    data_channel_.reset();
    response_.reset();
    early_.clear();
  }
  void requested(Request& request, const SampleEdge& edge) override;
  void sample_answers(const SampleEdge& edge) override;
  Transaction& data_target(const SampleEdge& edge);
  void add_beat(Transaction& one, const SampleEdge& edge);
  void note_strobe(Request& request, std::uint64_t beat, const std::string& digits,
                   const SampleEdge& edge);
  void check_end(Request& request, bool last, const SampleEdge& edge);
  void respond(const SampleEdge& edge);
  void add_waits(std::uint64_t edges) override;
  std::string strobe_digits() const { return strobe_ ? digits(*strobe_) : std::string(); }

  Handshake data_channel_, response_;
  std::optional<Replay::Slot> write_id_, data_, strobe_, last_, id_, code_;
  std::deque<Early> early_;
};

/// Data that came before this address are its own.
void AxiWrites::requested(Request& request, const SampleEdge& edge) {
  const auto own = std::find_if(early_.begin(), early_.end(), [&](const Early& early) {
    return !early.id || early.id == request.write_id;
  });
  if (own == early_.end()) return;
  Transaction& one = request.transaction;
  one.add_note("data before address");
  one.beats_done = own->beats.beats_done;
  one.first_data_ps = own->beats.first_data_ps;
  one.last_data_ps = own->beats.last_data_ps;
  one.data_wait = own->beats.data_wait;
  one.data = std::move(own->beats.data);
  one.data_hash = own->beats.data_hash;
  std::move(own->beats.violations.begin(), own->beats.violations.end(),
            std::back_inserter(one.violations));
  request.moved = own->last_beat;
  for (std::size_t i = 0; i < own->strobes.size(); ++i)
    note_strobe(request, i, own->strobes[i], edge);
  check_end(request, own->closed, edge);
  early_.erase(own);
}

void AxiWrites::add_beat(Transaction& one, const SampleEdge& edge) {
  pass_on(data_channel_, &one);
  ++one.beats_done;
  if (!one.first_data_ps) one.first_data_ps = edge.ps;
  one.last_data_ps = edge.ps;
  one.data_wait += data_channel_.waited(edge);
  if (data_) add_data(one, *data_);
}

void AxiWrites::sample_answers(const SampleEdge& edge) {
  sample(data_channel_, edge);
  if (!data_channel_.beat()) {
    pass_on(data_channel_, nullptr);
    respond(edge);
    return;
  }
  const auto id = number(write_id_);
  const bool last = last_ ? high(last_) : lite_;
  const auto next = std::find_if(open_.begin(), open_.end(), [&](const Request& request) {
    return !request.data_done && (!id || id == request.write_id);
  });
  if (next != open_.end()) {
    add_beat(next->transaction, edge);
    next->moved = edge;
    note_strobe(*next, next->transaction.beats_done - 1, strobe_digits(), edge);
    check_end(*next, last, edge);
    moved(edge, "W of " + named(*next));
  } else {
    auto early = std::find_if(early_.begin(), early_.end(),
                              [&](const Early& one) { return !one.closed && one.id == id; });
    if (early == early_.end()) {
      if (early_.size() == most_early) early_.pop_front();
      early_.emplace_back();
      early = std::prev(early_.end());
      early->id = id;
    }
    add_beat(early->beats, edge);
    early->strobes.push_back(strobe_digits());
    early->last_beat = edge;
    early->closed = last;
    moved(edge, "W without an address yet");
  }
  respond(edge);
}

void AxiWrites::note_strobe(Request& request, std::uint64_t beat, const std::string& digits,
                            const SampleEdge& edge) {
  Transaction& one = request.transaction;
  const auto lanes = request.burst.lanes(beat);
  if (!strobe_) {
    one.bytes += lanes.second > lanes.first ? lanes.second - lanes.first : 0;
    return;
  }
  const std::string full = vp::full_digits(digits, width(*strobe_));
  const AxiStrobe strobe = axi_strobe(full, lanes);
  one.bytes += strobe.bytes;
  const std::string shown = bits_as_hexadecimal(full);
  if (beat == 0) {
    one.strobe = shown;
  } else if (one.strobe != shown) {
    one.strobe = "mixed";
  }
  if (!strobe.inside && !lite_)
    report_rule(edge, "ERRM_WSTRB",
                "strobe " + shown + " on beat " + std::to_string(beat + 1) +
                    " beside the lanes of the address",
                &one);
}

/// LAST ends the data, or their number.
void AxiWrites::check_end(Request& request, bool last, const SampleEdge& edge) {
  Transaction& one = request.transaction;
  const bool all = one.beats_done >= one.beats;
  if (!last_) last = all;
  if (one.beats_done > one.beats || last != all) {
    report_rule(
        edge, "ERRM_WDATA_NUM",
        last ? "LAST on beat " + std::to_string(one.beats_done) + " of " + std::to_string(one.beats)
             : "no LAST on the last of " + std::to_string(one.beats) + " beats",
        &one);
  }
  request.data_done = last || all;
}

void AxiWrites::respond(const SampleEdge& edge) {
  sample(response_, edge);
  const std::uint64_t id = number(id_).value_or(0);
  const auto found = std::find_if(open_.begin(), open_.end(), [&](const Request& request) {
    return request.accepted && !request.responded && request.transaction.id.value_or(0) == id;
  });
  if (response_.beat() && found != open_.end()) {
    Request& request = *found;
    Transaction& one = request.transaction;
    pass_on(response_, &one);
    const std::uint64_t offered = response_.offered().ps;
    if (offered <= *one.accepted_ps) {
      report_rule(edge, "ERRS_BRESP_AW", "B is offered before the address has passed", &one);
    } else if (!request.data_done || offered <= one.last_data_ps.value_or(0)) {
      report_rule(edge, "ERRS_BRESP_WLAST", "B is offered before the last data have passed", &one);
    }
    one.response_wait = response_.waited(edge);
    note_response(request, edge, code_, "B");
    complete(static_cast<std::size_t>(found - open_.begin()), edge);
    moved(edge, "B of " + named(request));
  } else {
    pass_on(response_, nullptr);
    if (response_.beat()) {
      // An id that no write waits for, or a response before any address has passed.
      const bool others = std::any_of(open_.begin(), open_.end(), [](const Request& request) {
        return request.accepted && !request.responded;
      });
      report_rule(edge, others ? "ERRS_BID" : "ERRS_BRESP_AW",
                  "B of id " + std::to_string(id) + " without a write that is outstanding",
                  nullptr);
    }
  }
  for (std::size_t i = open_.size(); i-- > 0;) {
    if (open_[i].responded && open_[i].data_done) erase(i);
  }
}

void AxiWrites::add_waits(std::uint64_t edges) {
  bool first_data = true, first_response = true;
  for (Request& request : open_) {
    Transaction& one = request.transaction;
    if (request.accepted) {
      one.add_note(std::to_string(one.beats_done) + " of " + std::to_string(one.beats) +
                   (one.beats == 1 ? " beat" : " beats") +
                   (request.responded ? "" : ", no response") + ": open at the end");
    }
    if (!request.data_done) {
      // A receiver that is ready waits for data, also before it takes the address.
      const bool waits = request.accepted || !data_channel_.ready_low_since();
      if (first_data && waits && !data_channel_.valid())
        add_starved(data_channel_, named(request), request.moved, edges);
      first_data = false;
    } else if (request.accepted && !request.responded) {
      if (first_response && !response_.valid())
        add_starved(response_, named(request), request.moved, edges);
      first_response = false;
    }
  }
  if (data_channel_.valid() && !data_channel_.beat()) add_wanting(data_channel_, "", edges);
  if (response_.valid() && !response_.beat()) add_wanting(response_, "", edges);
}

}  // namespace

std::unique_ptr<Decoder> axi_write_decoder(const DecoderContext& context) {
  return std::make_unique<AxiWrites>(context);
}

}  // namespace platform::trace
